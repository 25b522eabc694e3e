"""The picture of one profile: outline, medial axis, a few maximal discs, and its three histograms; SVG or PNG."""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mashape_cad.library.record import ProfileRecord
from mashape_cad.views.colours import PAPER
from mashape_cad.views.drawing import (
    Circle,
    Drawing,
    Floats,
    Label,
    Lines,
    Placement,
    Shape,
    dimensions,
    printable,
)
from mashape_cad.views.histogram import histogram
from mashape_cad.views.likeness import Likeness
from mashape_cad.views.output import checked_suffix, write
from mashape_cad.views.profile_panel import axis_lines, colour_bar, junctions, maximal_discs, outline
from mashape_cad.views.raster import png
from mashape_cad.views.svg import svg

if TYPE_CHECKING:
    from mashape_cad.geometry.profile import Profile
    from mashape_cad.medial.axis import MedialAxis
    from mashape_cad.signatures.vectors import Signature

__all__ = ["SUFFIXES", "write_record", "write_show"]

SUFFIXES = (".svg", ".png")

_CHARTS = (
    ("df", "DF", "distance of the footpoints"),
    ("rf", "RF", "clearance radius"),
    ("cf", "CF", "turning of the axis"),
)
_WIDTH = 1180.0
_MARGIN = 32.0
_PANEL_TOP, _PANEL_WIDTH = 92.0, 730.0
_PANEL_HEIGHTS = (430.0, 720.0)  # lowest, highest: flat parts keep room for the charts, tall ones stay on a screen
_CHART_LEFT, _CHART_WIDTH = 850.0, 298.0
_FOOTER = 62.0


@dataclass(frozen=True, slots=True)
class _Subject:
    """All that the picture says of one profile."""

    title: str
    facts: str
    likeness: Likeness
    vectors: Mapping[str, Sequence[float]]
    refused: str | None = None
    place: tuple[float, float] | None = None


def write_show(out: Path, profile: "Profile", axis: "MedialAxis", signature: "Signature", title: str) -> None:
    """Draw a profile from its exact values.

    Parameters
    ----------
    out : Path
        Ends with one of `SUFFIXES`.
    profile : Profile
    axis : MedialAxis
        Of that profile.
    signature : Signature
        Of that axis; its vectors ``df``, ``rf`` and ``cf`` are drawn.
    title : str
        What the picture is called, such as the file's name.

    Raises
    ------
    PictureError
        If the suffix is not known or the file cannot be written.
    """
    likeness = Likeness.of_axis(profile, axis)
    facts = _facts(likeness.bounds, len(profile.edges), len(profile.holes), len(axis.branches))
    vectors = {name: vector.tolist() for name, vector in signature.vectors.items()}
    _write(out, _Subject(title, facts, likeness, vectors))


def write_record(out: Path, record: ProfileRecord, title: str) -> None:
    """Draw a profile from its sidecar's light picture, without kernel; see `write_show`.

    A profile whose axis was refused is drawn with the reason and the place.
    """
    bounds = np.array(record.bounds).reshape(2, 2)
    facts = _facts(bounds, record.edges, record.holes, record.axis.branches if record.axis else 0)
    refused, place = (record.refused.text, record.refused.place) if record.refused else (None, None)
    _write(out, _Subject(title, facts, Likeness.of_record(record), record.vectors or {}, refused, place))


def _write(out: Path, subject: _Subject) -> None:
    suffix = checked_suffix(out, SUFFIXES)
    drawing = _drawing(subject)
    write(out, png(drawing) if suffix == ".png" else svg(drawing).encode())


def _facts(bounds: Floats, edges: int, holes: int, branches: int) -> str:
    width, height = (bounds[1] - bounds[0]).tolist()
    counts = _counted(edges, "edge"), _counted(holes, "hole"), _counted(branches, "branch", "branches")
    return " · ".join([dimensions(width, height), *counts])


def _counted(count: int, one: str, many: str | None = None) -> str:
    return f"{count or 'no'} {one if count == 1 else many or one + 's'}"


def _drawing(subject: _Subject) -> Drawing:
    width, height = (subject.likeness.bounds[1] - subject.likeness.bounds[0]).tolist()
    panel = float(np.clip(_PANEL_WIDTH * height / width if width > 0 else np.inf, *_PANEL_HEIGHTS))
    placement = Placement.fitting(subject.likeness.bounds, _MARGIN, _PANEL_TOP, _PANEL_WIDTH, panel)
    bottom = _PANEL_TOP + panel + _FOOTER
    shapes = [
        *_header(subject),
        *_profile(subject, placement),
        *_scale_bar(subject.likeness, placement.scale, bottom),
        *colour_bar(subject.likeness.largest_radius, _MARGIN + _PANEL_WIDTH, bottom, PAPER),
        *_charts(subject, bottom),
    ]
    return Drawing(_WIDTH, bottom + _MARGIN, subject.title, tuple(shapes), PAPER.background)


def _header(subject: _Subject) -> Iterator[Shape]:
    yield Label(_MARGIN, 46, printable(subject.title, 60), 22, PAPER.ink, bold=True)
    yield Label(_MARGIN, 69, subject.facts, 13.5, PAPER.muted)


def _profile(subject: _Subject, placement: Placement) -> Iterator[Shape]:
    likeness = subject.likeness
    yield from outline(likeness, placement, PAPER, 1.6)
    yield from maximal_discs(likeness, placement, PAPER)
    yield from axis_lines(likeness, placement, PAPER, 2.2)
    yield from junctions(likeness, placement, PAPER, 2.4)
    if subject.place:
        x, y = placement.apply(np.array([subject.place]))[0].tolist()
        yield Circle(x, y, 9, "none", "#c0392b", 2.5)


def _scale_bar(likeness: Likeness, scale: float, bottom: float) -> Iterator[Shape]:
    """Yield a bar of a round length, at most a quarter of the panel."""
    if not likeness.loops:
        return
    length = _round_length(_PANEL_WIDTH / 4 / scale)
    right, y = _MARGIN + length * scale, bottom - 16
    ticks = [np.array([(x, y - 4), (x, y + 4)]) for x in (_MARGIN, right)]
    yield Lines((np.array([(_MARGIN, y), (right, y)]), *ticks), PAPER.ink, 1.2)
    yield Label((_MARGIN + right) / 2, bottom + 2, f"{length:g} mm", 12, PAPER.muted, "middle")


def _round_length(most: float) -> float:
    power = 10.0 ** np.floor(np.log10(most))
    return float(max(step for step in (1, 2, 5) if step * power <= most) * power)


def _charts(subject: _Subject, bottom: float) -> Iterator[Shape]:
    if subject.refused:
        yield Label(_CHART_LEFT, _PANEL_TOP + 20, "no medial axis", 13.5, PAPER.ink, bold=True)
        for i, line in enumerate(textwrap.wrap(subject.refused, 44)):
            yield Label(_CHART_LEFT, _PANEL_TOP + 42 + 18 * i, line, 12, PAPER.muted)
        return
    pitch = (bottom - _PANEL_TOP + 30) / len(_CHARTS)
    for i, (name, short, text) in enumerate(_CHARTS):
        top = _PANEL_TOP + i * pitch
        yield Label(_CHART_LEFT, top + 1, short, 13.5, PAPER.ink, bold=True)
        yield Label(_CHART_LEFT + 30, top + 1, f"{text} / maximum", 12, PAPER.muted)
        colours = PAPER.axis if name == "rf" else (PAPER.muted,)
        yield from histogram(subject.vectors[name], _CHART_LEFT, top + 14, _CHART_WIDTH, pitch - 62, colours, PAPER)
