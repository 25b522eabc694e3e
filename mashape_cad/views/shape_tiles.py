"""Many shapes on one drawing: rows of small tiles, pairs of larger ones with their axes, and their signatures."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mashape_cad.library.record import ProfileRecord
from mashape_cad.views.colours import Theme
from mashape_cad.views.drawing import Area, Drawing, Label, Placement, printable, rectangle
from mashape_cad.views.drawing import Shape as Mark
from mashape_cad.views.histogram import histogram
from mashape_cad.views.likeness import Likeness
from mashape_cad.views.profile_panel import axis_lines, outline

__all__ = ["COLUMNS", "Tile", "TileRow", "axes_drawing", "branches_of", "signatures_drawing", "tiles_drawing"]

COLUMNS = 10  # of small tiles, as the paper's figures have
_MARGIN, _LEGEND, _GAP = 20.0, 110.0, 8.0
_SMALL, _CAPTION = (92.0, 74.0), 16.0
_LARGE, _BETWEEN = (230.0, 170.0), 60.0
_BESIDE, _CHART, _CHART_GAP = (200.0, 130.0), 230.0, 46.0
_CHARTS = (("df", "DF"), ("rf", "RF"), ("cf", "CF"))


@dataclass(frozen=True, slots=True)
class Tile:
    """One shape: what it is called, what is known of it, and whether it is a query or a wrong hit."""

    name: str
    record: ProfileRecord
    is_query: bool = False
    is_wrong: bool = False


@dataclass(frozen=True, slots=True)
class TileRow:
    """Tiles that belong together, and what stands before them."""

    legend: str
    tiles: tuple[Tile, ...]


def branches_of(record: ProfileRecord) -> int:
    """Return how many branches the medial axis of a profile has."""
    return record.axis.branches if record.axis else 0


def tiles_drawing(title: str, rows: Sequence[TileRow], theme: Theme) -> Drawing:
    """Draw rows of outlines; a row that is longer than `COLUMNS` goes on below."""
    marks: list[Mark] = []
    wide, high = _SMALL
    columns = min(COLUMNS, max(len(row.tiles) for row in rows))
    top = _MARGIN
    for row in rows:
        marks.append(Label(_MARGIN, top + high / 2, printable(row.legend, 14), 13, theme.ink, bold=True))
        for start in range(0, len(row.tiles), columns):
            for column, tile in enumerate(row.tiles[start : start + columns]):
                marks += _tile(tile, _MARGIN + _LEGEND + column * (wide + _GAP), top, theme)
            top += high + _CAPTION + _GAP
    width = 2 * _MARGIN + _LEGEND + columns * (wide + _GAP) - _GAP
    return Drawing(width, top - _GAP + _MARGIN, printable(title), tuple(marks), theme.background)


def _tile(tile: Tile, left: float, top: float, theme: Theme) -> Iterator[Mark]:
    wide, high = _SMALL
    if tile.is_query or tile.is_wrong:
        colour, weight = (theme.ink, 2.0) if tile.is_query else (theme.wrong, 1.0)
        yield Area((rectangle(left, top, wide, high),), "none", colour, weight)
    likeness = Likeness.of_record(tile.record)
    placement = Placement.fitting(likeness.bounds, left + 6, top + 6, wide - 12, high - 12)
    yield from outline(likeness, placement, theme, 0.9)
    colour = theme.wrong if tile.is_wrong else theme.muted
    yield Label(left + wide / 2, top + high + 12, printable(tile.name, 15), 10, colour, "middle", bold=tile.is_query)


def axes_drawing(title: str, rows: Sequence[TileRow], theme: Theme) -> Drawing:
    """Draw large tiles with medial axes, two to a row, two rows beside one another."""
    wide, high = _LARGE
    pair = 2 * wide + 10
    marks: list[Mark] = []
    for number, row in enumerate(rows):
        down, across = divmod(number, 2)
        left, top = _MARGIN + across * (pair + 30), _MARGIN + 22 + down * (high + _BETWEEN)
        marks.append(Label(left, top - 8, printable(row.legend, 24), 14, theme.ink, bold=True))
        for column, tile in enumerate(row.tiles[:2]):
            marks += _with_axis(tile, left + column * (wide + 10), top, _LARGE, theme)
    width = 2 * _MARGIN + (2 * pair + 30 if len(rows) > 1 else pair)
    height = 2 * _MARGIN + -(-len(rows) // 2) * (high + _BETWEEN)
    return Drawing(width, height, printable(title), tuple(marks), theme.background)


def _with_axis(tile: Tile, left: float, top: float, size: tuple[float, float], theme: Theme) -> Iterator[Mark]:
    wide, high = size
    likeness = Likeness.of_record(tile.record)
    placement = Placement.fitting(likeness.bounds, left + 4, top + 4, wide - 8, high - 8)
    yield from outline(likeness, placement, theme, 1.0)
    yield from axis_lines(likeness, placement, theme, 1.4)
    said = f"{printable(tile.name, 20)}, {branches_of(tile.record)} branches"
    yield Label(left + wide / 2, top + high + 14, said, 11, theme.muted, "middle")


def signatures_drawing(title: str, tiles: Sequence[Tile], theme: Theme) -> Drawing:
    """Draw a line for each shape: its medial axis and its three histograms."""
    wide, high = _BESIDE
    marks: list[Mark] = []
    top, first = _MARGIN + 14, _MARGIN + wide + _CHART_GAP + 10
    for tile in tiles:
        marks += _with_axis(tile, _MARGIN, top, _BESIDE, theme)
        for column, (name, short) in enumerate(_CHARTS):
            left = first + column * (_CHART + _CHART_GAP)
            shares = (tile.record.vectors or {}).get(name, ())
            marks.append(Label(left, top - 2, short, 11, theme.ink, bold=True))
            marks += histogram(shares, left, top + 4, _CHART, high - 12, (theme.muted,), theme)
        top += high + 44
    width = first + len(_CHARTS) * (_CHART + _CHART_GAP) - _CHART_GAP + _MARGIN
    return Drawing(width, top, printable(title), tuple(marks), theme.background)
