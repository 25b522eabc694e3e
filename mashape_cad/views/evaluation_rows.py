"""An evaluation as rows of plain values: what text, CSV, JSON and page have in common."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from mashape_cad.evaluation.evaluation import ModeResult, Times
from mashape_cad.evaluation.measures import Protocol
from mashape_cad.evaluation.published import PAPER_MINUTES, PublishedTable
from mashape_cad.evaluation.report import Report
from mashape_cad.evaluation.trial import coarser

__all__ = [
    "MEAN",
    "Grid",
    "class_grid",
    "mode_label",
    "paper_grid",
    "percent",
    "sampling_grid",
    "step_of",
    "summary_grid",
    "time_grid",
]

MEAN = "mean"
_HALVES_UP = 1e-9  # far below what is shown, far above the rounding of a mean
_PROTOCOL_SENTENCES = {
    Protocol.PAPER: "the query counts: K = C and 2C in a class of C",
    Protocol.PRINCETON: "the query is left out: K = C - 1 and 2(C - 1)",
}
_MEASURES = {
    "nearest_neighbour": "nearest",
    "first_tier": "1st tier",
    "second_tier": "2nd tier",
    "average_precision": "mAP",
    "bulls_eye": "bull's-eye",
}


@dataclass(frozen=True, slots=True)
class Grid:
    """A table: a title, a note, headings and rows of as many cells; the last row is a mean if `has_mean`."""

    title: str
    note: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    has_mean: bool = False


def mode_label(mode: str) -> str:
    """Return a mode's name as headings have it: ``DF+RF`` for ``paper-df-rf``."""
    functions = mode.removeprefix("paper-")
    if functions == mode:
        return mode
    return "DF+RF+CF" if functions == "all" else functions.upper().replace("-", "+")


def step_of(per_edge: int) -> str:
    """Return the paper's word for so many stations on an edge: 0.01 for 100 (readings 1 and 2)."""
    return f"{1 / per_edge:.3g}"


def percent(share: float, digits: int = 0) -> str:
    """Return a share as per cent, halves rounded up; a dash for one that is not defined."""
    return "-" if math.isnan(share) else f"{100 * share + _HALVES_UP:.{digits}f}"


def paper_grid(report: Report) -> Grid | None:
    """Return Tables 1 to 4 of the paper, each column beside what was measured here; None for another set."""
    pairs = [(table, _measured(report, table)) for table in report.published]
    shown = [(table, result) for table, result in pairs if result is not None]
    if not shown:
        return None
    headings = ["class"]
    for table, _ in shown:
        headings += [f"{mode_label(table.mode)} {step_of(table.per_edge)}", f"Tab. {table.number}"]
    rows = [[label] for label in shown[0][0].tiers]
    mean = [MEAN]
    for table, result in shown:
        here = {each.label: each.means for each in result.classes}
        for row in rows:
            first, second = table.tiers[row[0]]
            row += [_tiers(here[row[0]]), f"{first} / {second}"]
        mean += [_tiers(result.means, 1), " / ".join(percent(each / 100, 1) for each in table.means)]
    note = (
        "First / second tier, per cent; the query counts, K = 10 and 20. On the left measured on this reconstruction "
        "of the database, on the right as the paper prints it of its own, which was never published; its means are "
        "over its rows."
    )
    return Grid("The paper's Tables 1 to 4", note, tuple(headings), tuple(map(tuple, [*rows, mean])), has_mean=True)


def _measured(report: Report, table: PublishedTable) -> ModeResult | None:
    evaluation = report.evaluation(table.per_edge)
    if evaluation is None or table.mode not in evaluation.modes:
        return None
    return evaluation.result(table.mode, Protocol.PAPER)


def class_grid(report: Report, protocol: Protocol) -> Grid:
    """Return first and second tier of each class in each mode."""
    results = [each for each in report.full.results if each.protocol is protocol]
    rows = [
        (each.label, str(each.members), *(_tiers(result.classes[i].means) for result in results))
        for i, each in enumerate(results[0].classes)
    ]
    mean = (MEAN, str(len(report.full.labels)), *(_tiers(result.means, 1) for result in results))
    return Grid(
        f"Tiers by class, protocol {protocol}",
        f"First / second tier, per cent; {_PROTOCOL_SENTENCES[protocol]}.",
        ("class", "shapes", *(mode_label(result.mode) for result in results)),
        (*rows, mean),
        has_mean=True,
    )


def summary_grid(report: Report) -> Grid:
    """Return all measures of each mode, over all queries."""
    rows = [
        (mode_label(each.mode), each.protocol.value, *(percent(each.means[name], 1) for name in _MEASURES))
        for each in report.full.results
    ]
    note = (
        "Means over all queries, per cent. Nearest neighbour never counts the query, the bull's-eye (2C ranks) always "
        "does. Of equal distances, shapes of other classes come first."
    )
    return Grid("All measures", note, ("mode", "protocol", *_MEASURES.values()), tuple(rows))


def sampling_grid(report: Report) -> Grid | None:
    """Return the paper-protocol means of each mode at both steps; None if only one was evaluated."""
    if report.coarse is None:
        return None
    steps = [step_of(report.per_edge), step_of(coarser(report.per_edge))]
    rows = []
    for mode in report.coarse.modes:
        both = [each.result(mode, Protocol.PAPER).means for each in (report.full, report.coarse)]
        rows.append((mode_label(mode), *(_tiers(each, 1) for each in both)))
    note = "First / second tier, per cent, means over all queries; the query counts."
    return Grid("Sampling", note, ("mode", *(f"step {step}" for step in steps)), tuple(rows))


def time_grid(report: Report) -> Grid | None:
    """Return what each step of the way took, beside the paper's Table 5 where there is such a step."""
    if report.times is None:
        return None
    rows = [(text, step, f"{seconds:.2f}", paper) for text, step, seconds, paper in _times(report, report.times)]
    note = (
        f"CPU seconds of one processor for all {report.times.shapes} shapes, in a process that is warm; the paper "
        "states minutes for 80 shapes, on hardware that it does not name. Our medial axis is exact and has no step."
    )
    return Grid("Running times", note, ("computation of", "step", "CPU s", "paper, min"), tuple(rows))


def _times(report: Report, times: Times) -> Iterator[tuple[str, str, float, str]]:
    full, coarse = report.per_edge, coarser(report.per_edge)
    has_paper = bool(report.published)

    def minutes(per_edge: int, column: int) -> str:
        return f"{PAPER_MINUTES[per_edge][column]:g}" if has_paper and per_edge in PAPER_MINUTES else ""

    yield "reading the files", "", times.reading, ""
    yield "medial axes", "", times.axes, minutes(full, 0)
    yield "default signatures", "", times.default_signatures, ""
    yield "signatures, all functions", step_of(full), times.signatures, ""
    yield "queries, all against all", step_of(full), times.queries, minutes(full, 1)
    yield "signatures, all functions", step_of(coarse), times.coarse_signatures, ""
    yield "queries, all against all", step_of(coarse), times.coarse_queries, minutes(coarse, 1)
    yield "axes, signatures and queries", step_of(full), times.total, "16" if has_paper else ""


def _tiers(means: Mapping[str, float], digits: int = 0) -> str:
    return f"{percent(means['first_tier'], digits)} / {percent(means['second_tier'], digits)}"
