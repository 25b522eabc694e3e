"""An evaluation as CSV (RFC 4180): a line for each class, mode, protocol and step, and one for each mean."""

import csv
import io
import math

from mashape_cad.evaluation.evaluation import ModeResult
from mashape_cad.evaluation.measures import Protocol
from mashape_cad.evaluation.report import Report
from mashape_cad.evaluation.trial import coarser
from mashape_cad.library.json_text import valid_text
from mashape_cad.views.evaluation_rows import step_of

__all__ = ["COLUMNS", "evaluation_csv"]

_MEASURES = ("first_tier", "second_tier", "nearest_neighbour", "average_precision", "bulls_eye")
COLUMNS = ("mode", "protocol", "step", "class", "shapes", *_MEASURES, "paper_first_tier", "paper_second_tier")
_DIGITS = 6


def evaluation_csv(report: Report) -> str:
    """Return the text. Shares are 0 to 1, empty where not defined; the mean over all queries has no class."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for per_edge, evaluation in ((report.per_edge, report.full), (coarser(report.per_edge), report.coarse)):
        for result in evaluation.results if evaluation else ():
            for row in _rows(result):
                label, members, means = row
                measured = (_number(means[name]) for name in _MEASURES)
                published = _published(report, result, per_edge, label)
                writer.writerow(
                    (result.mode, result.protocol.value, step_of(per_edge), label, members, *measured, *published)
                )
    return out.getvalue()


def _rows(result: ModeResult) -> list[tuple[str, int, dict[str, float]]]:
    rows = [(valid_text(each.label), each.members, dict(each.means)) for each in result.classes]
    return [*rows, ("", sum(members for _, members, _ in rows), dict(result.means))]


def _published(report: Report, result: ModeResult, per_edge: int, label: str) -> tuple[str, str]:
    for table in report.published:
        if (table.mode, table.per_edge, result.protocol) == (result.mode, per_edge, Protocol.PAPER):
            first, second = table.tiers.get(label, table.means)
            return _number(first / 100), _number(second / 100)
    return "", ""


def _number(share: float) -> str:
    return "" if math.isnan(share) else f"{round(share, _DIGITS):g}"
