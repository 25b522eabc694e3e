"""The answer of a search as a sheet: the query first, then its matches in order; one HTML page or one PNG.

Both are drawn from what sidecars hold, so that no part file is opened and no kernel loaded.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from mashape_cad.library.match import Match
from mashape_cad.library.record import ProfileRecord
from mashape_cad.views.colours import ACCENT, PAGE, PAPER, Theme
from mashape_cad.views.drawing import Area, Drawing, Label, Placement, Shape, dimensions, printable, rectangle
from mashape_cad.views.html import html
from mashape_cad.views.likeness import Likeness
from mashape_cad.views.output import checked_suffix, write
from mashape_cad.views.profile_panel import axis_lines, outline
from mashape_cad.views.raster import png

__all__ = ["SUFFIXES", "write_sheet"]

SUFFIXES = (".html", ".png")

_TILE = (240.0, 190.0)


@dataclass(frozen=True, slots=True)
class _Tile:
    """One part on the sheet."""

    heading: str
    name: str
    place: str
    facts: str
    record: ProfileRecord

    @property
    def spoken(self) -> str:
        """What the picture is called where it cannot be seen."""
        return f"{self.heading}: {self.name}, {self.facts}"


def write_sheet(out: Path, query: ProfileRecord, matches: Sequence[Match], name: str = "the query") -> None:
    """Draw a query and its matches, each with outline, medial axis, rank, name, distance and size.

    Parameters
    ----------
    out : Path
        Ends with one of `SUFFIXES`.
    query : ProfileRecord
    matches : sequence of Match
        In the order of their rank.
    name : str
        What the query is called, such as its file's name.

    Raises
    ------
    PictureError
        If the suffix is not known or the file cannot be written.
    """
    suffix = checked_suffix(out, SUFFIXES)
    asked = _Tile("query", printable(name), "", _size(query), query)
    tiles = [_tile(match) for match in matches]
    write(out, png(_sheet(asked, tiles)) if suffix == ".png" else _html(asked, tiles).encode())


def _tile(match: Match) -> _Tile:
    facts = f"distance {match.distance:.3f} · {_size(match.record)}"
    return _Tile(str(match.rank), printable(match.path.name), _place(match), facts, match.record)


def _place(match: Match) -> str:
    return printable(str(match.path)) + (f", profile {match.profile}" if match.profile else "")


def _size(record: ProfileRecord) -> str:
    return dimensions(*record.size)


def _explanation(count: int) -> str:
    if not count:
        return "No part was found."
    parts = "1 part" if count == 1 else f"{count} parts, the nearest first"
    axis = "The lines inside are the medial axis, brighter where there is more room"
    return f"{parts}. Distance 0 means equal signatures. {axis}."


def _html(query: _Tile, tiles: Sequence[_Tile]) -> str:
    return html("sheet.html", query=query, tiles=tiles, explanation=_explanation(len(tiles)), drawing=_tile_drawing)


def _tile_drawing(tile: _Tile) -> Drawing:
    return Drawing(*_TILE, tile.spoken, tuple(_profile(tile.record, 0, 0, *_TILE, PAGE)))


def _profile(
    record: ProfileRecord, left: float, top: float, width: float, height: float, theme: Theme
) -> Iterator[Shape]:
    likeness = Likeness.of_record(record)
    placement = Placement.fitting(likeness.bounds, left + 3, top + 3, width - 6, height - 6)
    yield from outline(likeness, placement, theme, 1.1)
    yield from axis_lines(likeness, placement, theme, 1.5)


_COLUMNS, _FEWEST_COLUMNS = 4, 3  # with fewer, the line under the title would not fit
_GAP, _MARGIN, _HEAD, _CAPTION, _PADDING = 16.0, 28.0, 84.0, 62.0, 14.0


def _sheet(query: _Tile, tiles: Sequence[_Tile]) -> Drawing:
    cell_width, cell_height = _TILE[0] + 2 * _PADDING, _TILE[1] + _PADDING + _CAPTION
    columns = min(_COLUMNS, max(_FEWEST_COLUMNS, 1 + len(tiles)))
    rows = -(-(1 + len(tiles)) // columns)
    shapes: list[Shape] = [
        Label(_MARGIN, 42, f"Parts like {printable(query.name, 60)}", 21, PAPER.ink, bold=True),
        Label(_MARGIN, 64, _explanation(len(tiles)), 12.5, PAPER.muted),
    ]
    for i, tile in enumerate([query, *tiles]):
        row, column = divmod(i, columns)
        left, top = _MARGIN + column * (cell_width + _GAP), _HEAD + row * (cell_height + _GAP)
        shapes += _cell(tile, left, top, cell_width, cell_height, is_query=i == 0)
    width = 2 * _MARGIN + columns * (cell_width + _GAP) - _GAP
    height = _HEAD + rows * (cell_height + _GAP) - _GAP + _MARGIN
    return Drawing(width, height, f"Parts like {query.name}", tuple(shapes), "#f4f6f8")


def _cell(tile: _Tile, left: float, top: float, width: float, height: float, *, is_query: bool) -> Iterator[Shape]:
    edge, weight = (ACCENT, 2.0) if is_query else (PAPER.faint, 1.0)
    yield Area((rectangle(left, top, width, height),), PAPER.background, edge, weight)
    yield from _profile(tile.record, left + _PADDING, top + _PADDING, *_TILE, PAPER)
    base, indent = top + height - _CAPTION + 28, left + _PADDING + 14 + 10 * len(tile.heading)
    yield Label(left + _PADDING, base, tile.heading, 15, ACCENT if is_query else PAPER.ink, bold=True)
    yield Label(indent, base, printable(tile.name, 24), 14, PAPER.ink)
    yield Label(indent, base + 19, tile.facts, 11.5, PAPER.muted)
