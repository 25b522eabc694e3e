"""Pictures of an evaluated set, after the paper's figures: the database, what each mode finds, axes, signatures."""

from collections.abc import Iterator
from dataclasses import dataclass

from mashape_cad.evaluation.report import Report
from mashape_cad.views.colours import Theme
from mashape_cad.views.drawing import Drawing, printable
from mashape_cad.views.evaluation_rows import mode_label
from mashape_cad.views.shape_tiles import (
    COLUMNS,
    Tile,
    TileRow,
    axes_drawing,
    branches_of,
    signatures_drawing,
    tiles_drawing,
)

__all__ = ["Sheet", "sheets"]

_MOST_HITS = 200  # of one query on one sheet
# Classes on the sheets of axes and signatures: more than the eye compares at once make a file heavy and say no more.
_MOST_CLASSES = 10
# The class whose query is shown with all that it finds, and the figures that show the like; in other sets the first.
_QUERY_CLASSES = {"paper-df": "airplane", "paper-rf": "gear", "paper-cf": "bracket"}
_FIRST_HITS_FIGURES = {"paper-df": "Figure 16", "paper-rf": "Figure 17", "paper-cf": "Figure 18"}
_ALL_HITS_FIGURES = {"paper-df": "Figure 13", "paper-rf": "Figure 14", "paper-cf": "Figure 15"}


@dataclass(frozen=True, slots=True)
class Sheet:
    """One picture.

    Attributes
    ----------
    name : str
        Of its file, without suffix.
    title, caption : str
        What it is, and how it is to be read.
    drawing : Drawing
    """

    name: str
    title: str
    caption: str
    drawing: Drawing


def sheets(report: Report, theme: Theme) -> Iterator[Sheet]:
    """Yield all sheets of a report in the colours of a theme, in the order in which they are looked at."""
    yield _database(report, theme)
    for mode in report.drawn:
        yield _first_hits(report, mode, theme)
        yield _all_hits(report, mode, theme)
    yield _axes(report, theme)
    yield _signatures(report, theme)


def _database(report: Report, theme: Theme) -> Sheet:
    rows = [TileRow(label, tuple(_tile(report, i) for i in members)) for label, members in _classes(report).items()]
    caption = f"All {len(report.full.labels)} shapes, class by class{_after(report, 'Figure 10')}."
    return Sheet("database", "The database", caption, tiles_drawing("The database", rows, theme))


def _first_hits(report: Report, mode: str, theme: Theme) -> Sheet:
    rows = [
        TileRow(label, _found(report, mode, members[0], len(members))) for label, members in _classes(report).items()
    ]
    title = f"First hits by {mode_label(mode)}"
    caption = (
        "The first shape of each class as query, in bold, and what it finds, the nearest first, as many as its class "
        f"has members. Hits of other classes are framed in red{_after(report, _FIRST_HITS_FIGURES.get(mode))}."
    )
    return Sheet(f"first-hits-{mode}", title, caption, tiles_drawing(title, rows, theme))


def _all_hits(report: Report, mode: str, theme: Theme) -> Sheet:
    classes = _classes(report)
    label = _QUERY_CLASSES.get(mode, "")
    query = classes[label if label in classes else next(iter(classes))][0]
    found = _found(report, mode, query, _MOST_HITS)
    rows = [
        TileRow(f"{start + 1} to {min(start + COLUMNS, len(found))}", found[start : start + COLUMNS])
        for start in range(0, len(found), COLUMNS)
    ]
    title = printable(f"All that {found[0].name} finds by {mode_label(mode)}")
    caption = f"The query first, then all shapes, the nearest first{_after(report, _ALL_HITS_FIGURES.get(mode))}."
    return Sheet(f"all-hits-{mode}", title, caption, tiles_drawing(title, rows, theme))


def _axes(report: Report, theme: Theme) -> Sheet:
    rows = []
    for label, members in _shown_classes(report):
        by_branches = sorted((_tile(report, i) for i in members), key=lambda tile: branches_of(tile.record))
        rows.append(TileRow(label, (*by_branches[:1], *by_branches[1:][-1:])))
    caption = (
        "Of each class the shapes whose medial axes have the fewest and the most branches; lines are brighter where "
        f"there is more room{_after(report, 'Figures 3, 5 and 11')}."
    )
    return Sheet("axes", "Medial axes", caption, axes_drawing("Medial axes", rows, theme))


def _signatures(report: Report, theme: Theme) -> Sheet:
    """Show the first member of each class and the mate that the last mode finds first."""
    labels, order = report.full.labels, list(report.full.orders.values())[-1]
    tiles = []
    for label, (query, *_) in _shown_classes(report):
        mates = [i for i in order[query, 1:].tolist() if labels[i] == label]
        tiles += [_tile(report, i) for i in (query, *mates[:1])]
    caption = (
        "Of each class two similar shapes and their signatures: distance of the footpoints (DF), radius (RF), turning "
        f"of the axis (CF), each over its maximum, on a square-root scale{_after(report, 'Figures 5, 7, 8 and 9')}."
    )
    return Sheet("signatures", "Signatures", caption, signatures_drawing("Signatures", tiles, theme))


def _after(report: Report, figure: str | None) -> str:
    return f"; after {figure} of the paper, on a reconstruction of its database" if report.published and figure else ""


def _classes(report: Report) -> dict[str, list[int]]:
    """Return the numbers of the shapes of each class."""
    classes: dict[str, list[int]] = {}
    for number, label in enumerate(report.full.labels):
        classes.setdefault(label, []).append(number)
    return classes


def _shown_classes(report: Report) -> list[tuple[str, list[int]]]:
    return list(_classes(report).items())[:_MOST_CLASSES]


def _found(report: Report, mode: str, query: int, count: int) -> tuple[Tile, ...]:
    labels = report.full.labels
    order = report.full.orders[mode][query, :count].tolist()
    return tuple(
        _tile(report, i, is_query=rank == 0, is_wrong=labels[i] != labels[query]) for rank, i in enumerate(order)
    )


def _tile(report: Report, number: int, *, is_query: bool = False, is_wrong: bool = False) -> Tile:
    shape = report.labelled.shapes[number]
    return Tile(shape.path.stem, shape.record, is_query, is_wrong)
