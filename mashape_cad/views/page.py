"""The answer of a search as a sheet: the query first, then its matches in order; one HTML page or one PNG.

Both are drawn from what sidecars hold, so that no part file is opened and no kernel loaded. That goes for hits that
were compared with the query, too: the placement is known by then, and light outlines show what differs.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from mashape_cad.library.match import Match
from mashape_cad.library.record import ProfileRecord
from mashape_cad.matching.portion import Portion
from mashape_cad.matching.relation import Relation
from mashape_cad.views.colours import ACCENT, PAGE, PAPER, Theme
from mashape_cad.views.drawing import Area, Drawing, Label, Lines, Placement, Shape, dimensions, printable, rectangle
from mashape_cad.views.html import html
from mashape_cad.views.likeness import Likeness
from mashape_cad.views.output import checked_suffix, write
from mashape_cad.views.profile_panel import axis_lines, outline, overlay
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
    query: ProfileRecord | None = None
    relation: Relation | None = None
    portion: Portion | None = None
    finding: str = ""

    @property
    def spoken(self) -> str:
        """What the picture is called where it cannot be seen."""
        return ", ".join([f"{self.heading}: {self.name}", *([self.finding] if self.finding else []), self.facts])


def write_sheet(out: Path, query: ProfileRecord, matches: Sequence[Match], name: str = "the query") -> None:
    """Draw a query and its matches, each with outline, medial axis, rank, name, score and size.

    A match that was compared with the query is laid over it, with the relation and what differs.

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
    tiles = [_tile(match, query) for match in matches]
    write(out, png(_sheet(asked, tiles)) if suffix == ".png" else _html(asked, tiles).encode())


def _tile(match: Match, query: ProfileRecord) -> _Tile:
    said, name = _finding(match), printable(match.path.name)
    facts, place = _facts(match), _place(match)
    return _Tile(str(match.rank), name, place, facts, match.record, query, match.relation, match.portion, said)


def _finding(match: Match) -> str:
    found = match.relation
    if match.portion is not None:
        return f"contains {match.portion.share:.0%} of the query"
    if found is None:
        return "not compared" if match.unverified else ""
    return str(found)


def _facts(match: Match) -> str:
    facts = f"score {match.score:.0f} · {_size(match.record)}"
    if match.relation is None:
        return facts
    off = f"off by {round(match.relation.deviation_mm, 6):.2g} mm"
    return f"{off} · {match.relation.area_difference:.2%} of the area differs"


def _place(match: Match) -> str:
    return printable(str(match.path)) + (f", profile {match.profile}" if match.profile else "")


def _size(record: ProfileRecord) -> str:
    return dimensions(*record.size)


def _explanation(tiles: Sequence[_Tile]) -> str:
    if not tiles:
        return "No part was found."
    parts = "1 part" if len(tiles) == 1 else f"{len(tiles)} parts"
    if any(tile.relation for tile in tiles):
        lines = "Each is laid over the query (thin line): what only one of the two covers is red"
        return f"{parts}. {lines}. Off by: the largest distance of the outlines."
    if any(tile.portion for tile in tiles):
        said = "the one that contains most of the query's outline first; that portion is drawn in colour"
        return f"{parts}, {said}."
    axis = "The lines inside are the medial axis, brighter where there is more room"
    order = "" if len(tiles) == 1 else ", the nearest first"
    return f"{parts}{order}. A score of 100 means equal signatures. {axis}."


def _html(query: _Tile, tiles: Sequence[_Tile]) -> str:
    return html("sheet.html", query=query, tiles=tiles, explanation=_explanation(tiles), drawing=_tile_drawing)


def _tile_drawing(tile: _Tile) -> Drawing:
    return Drawing(*_TILE, tile.spoken, tuple(_picture(tile, 0, 0, *_TILE, PAGE)))


def _picture(tile: _Tile, left: float, top: float, width: float, height: float, theme: Theme) -> Iterator[Shape]:
    box = left + 3, top + 3, width - 6, height - 6
    likeness = Likeness.of_record(tile.record)
    if tile.query and tile.relation:
        yield from overlay(Likeness.of_record(tile.query), likeness.placed(tile.relation.placement), box, theme)
        return
    placement = Placement.fitting(likeness.bounds, *box)
    yield from outline(likeness, placement, theme, 1.1)
    if tile.portion:
        yield Lines(tuple(placement.apply(stretch) for stretch in tile.portion.stretches), ACCENT, 3.0)
        return
    yield from axis_lines(likeness, placement, theme, 1.5)


_COLUMNS, _FEWEST_COLUMNS = 4, 3  # with fewer, the line under the title would not fit
_FACTS_WIDTH = 448.0  # letters of a tile's last line, times their size, that fit beside the rank
_GAP, _MARGIN, _HEAD, _CAPTION, _PADDING = 16.0, 28.0, 84.0, 62.0, 14.0


def _sheet(query: _Tile, tiles: Sequence[_Tile]) -> Drawing:
    cell_width, cell_height = _TILE[0] + 2 * _PADDING, _TILE[1] + _PADDING + _CAPTION
    columns = min(_COLUMNS, max(_FEWEST_COLUMNS, 1 + len(tiles)))
    rows = -(-(1 + len(tiles)) // columns)
    shapes: list[Shape] = [
        Label(_MARGIN, 42, f"Parts like {printable(query.name, 60)}", 21, PAPER.ink, bold=True),
        Label(_MARGIN, 64, _explanation(tiles), 12.5, PAPER.muted),
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
    yield from _picture(tile, left + _PADDING, top + _PADDING, *_TILE, PAPER)
    lift = 6 if tile.finding else 0  # room for one line more
    base, indent = top + height - _CAPTION + 28 - lift, left + _PADDING + 14 + 10 * len(tile.heading)
    yield Label(left + _PADDING, base, tile.heading, 15, ACCENT if is_query else PAPER.ink, bold=True)
    yield Label(indent, base, printable(tile.name, 24), 14, PAPER.ink)
    if tile.finding:
        yield Label(indent, base + 17, tile.finding, 11.5, PAPER.ink, bold=True)
    yield Label(
        indent,
        base + (32 if tile.finding else 19),
        tile.facts,
        min(11.5, _FACTS_WIDTH / max(len(tile.facts), 1)),
        PAPER.muted,
    )
