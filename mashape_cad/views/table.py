"""Answers for people: matches as a table, certificates line by line."""

from collections.abc import Callable, Sequence
from typing import TextIO

from rich.console import Console
from rich.table import Table
from rich.text import Text

from mashape_cad.library.match import Match
from mashape_cad.library.record import ProfileRecord
from mashape_cad.views.messages import readable

__all__ = ["certificate_line", "print_matches"]

# Into a file or a pipe a line is as long as it is: nothing is cut off or folded.
_UNBOUNDED = 10_000


def print_matches(matches: Sequence[Match], stream: TextIO, mode: str = "similar") -> None:
    """Print rank, part, profile, score, distance and size (width x height, mm) of each match.

    In mode ``same`` also what it is to the query and what says so, in mode ``part`` how much of the query it contains.
    """
    console = Console(file=stream, width=None if stream.isatty() else _UNBOUNDED, highlight=False)
    table = Table(box=None, pad_edge=False, header_style="bold")
    comparison, cells_of = _MORE.get(mode, ((), lambda _: ()))
    for heading in ("rank", "part", "profile", "score", "distance", "size (mm)", *comparison):
        table.add_column(heading, justify="left" if heading in ("part", "relation") else "right", overflow="fold")
    for match in matches:
        cells = *_row(match), *cells_of(match)
        table.add_row(*(Text(cell) for cell in cells))  # as text: a file name may look like markup
    console.print(table)


def certificate_line(profile: int, record: ProfileRecord) -> str:
    """Return the figures of one profile's medial axis, or why it has none."""
    shape = f"profile {profile}: {record.edges} edges, {record.holes} holes"
    if record.refused is not None:
        return f"no  {shape}; {record.refused.text}"
    if record.axis is None:
        return f"no  {shape}"
    axis = record.axis
    graph = f"{axis.branches} branches, {axis.junctions} junctions, {axis.ends} ends, {axis.cycles} cycles"
    whole = "connected" if axis.connected else "not connected"
    errors = f"disc error {axis.max_disc_error:.1e}, foot error {axis.max_foot_error:.1e}"
    for name, error in (("area", axis.area_error), ("completeness", axis.completeness_error)):
        errors += "" if error is None else f", {name} error {error:.1e}"
    reason = f"; {axis.reason}" if axis.reason else ""
    return f"{'ok' if axis.ok else 'no'}  {shape}; {graph}, {whole}; {errors}{reason}"


def _relation(match: Match) -> tuple[str, str, str]:
    if match.relation is None:
        return "not compared", "", ""
    return str(match.relation), f"{round(match.relation.deviation_mm, 6):.3g}", f"{match.relation.area_difference:.2%}"


def _portion(match: Match) -> tuple[str, str]:
    if match.portion is None:
        return "", ""
    placement = match.portion.placement
    return f"{match.portion.share:.0%}", f"{placement.scale:.3g}" + (", mirrored" if placement.mirrors else "")


# What more is told in some modes: the columns, and how they are filled.
_MORE: dict[str, tuple[tuple[str, ...], Callable[[Match], tuple[str, ...]]]] = {
    "same": (("relation", "deviation (mm)", "area differs"), _relation),
    "part": (("contains", "scale"), _portion),
}


def _row(match: Match) -> tuple[str, ...]:
    width, height = match.record.size
    size = f"{width:.4g} x {height:.4g}"
    return (
        str(match.rank),
        readable(match.path),
        str(match.profile),
        f"{match.score:.0f}",
        f"{match.distance:.4f}",
        size,
    )
