"""An evaluation as JSON lines for other programs, the summaries last. Fields are only ever added.

``class``, ``sampling`` and ``time`` lines come first; then one ``summary`` line for each mode and protocol.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

from mashape_cad.evaluation.measures import Protocol
from mashape_cad.evaluation.report import Report
from mashape_cad.evaluation.trial import coarser
from mashape_cad.library.json_text import valid_text

__all__ = ["evaluation_messages"]


def evaluation_messages(report: Report) -> Iterator[str]:
    """Yield the lines. Shares are 0 to 1, null where not defined; seconds are those of the processor."""
    yield from _class_lines(report)
    yield from _sampling_lines(report)
    if report.times is not None:
        yield _line("time", **msgspec.to_builtins(report.times), total=report.times.total)
    for result in report.full.results:
        yield _line(
            "summary",
            mode=result.mode,
            protocol=result.protocol,
            shapes=len(report.full.labels),
            classes=len(result.classes),
            **_measures(result.means),
            seconds=report.full.seconds[result.mode],
        )


def _class_lines(report: Report) -> Iterator[str]:
    tables = {table.mode: table.tiers for table in report.published if table.per_edge == report.per_edge}
    for result in report.full.results:
        for each in result.classes:
            paper = tables.get(result.mode, {}).get(each.label) if result.protocol is Protocol.PAPER else None
            yield _line(
                "class",
                mode=result.mode,
                protocol=result.protocol,
                **{"class": valid_text(each.label)},
                shapes=each.members,
                **_measures(each.means),
                paper=paper and [share / 100 for share in paper],
            )


def _sampling_lines(report: Report) -> Iterator[str]:
    """Yield the means of each mode with half the stations."""
    if report.coarse is None:
        return
    for result in report.coarse.results:
        yield _line(
            "sampling",
            mode=result.mode,
            protocol=result.protocol,
            step=1 / coarser(report.per_edge),
            **_measures(result.means),
        )


def _measures(means: Mapping[str, float]) -> dict[str, float | None]:
    known = {name: None if math.isnan(value) else value for name, value in means.items()}
    known["mean_average_precision"] = known.pop("average_precision")
    return known


def _line(message_type: str, **fields: Any) -> str:
    return msgspec.json.encode({"message_type": message_type, **fields}).decode()
