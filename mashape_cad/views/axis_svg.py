"""Medial axes as an SVG in true size: outlines, and branches in the colours of their clearance."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mashape_cad.views.colours import PAPER
from mashape_cad.views.drawing import Drawing, Floats, Placement, printable
from mashape_cad.views.likeness import Likeness
from mashape_cad.views.profile_panel import axis_lines, colour_bar, junctions, outline
from mashape_cad.views.svg import svg

if TYPE_CHECKING:
    from mashape_cad.geometry.profile import Plane
    from mashape_cad.library.tracing import TracedProfile

__all__ = ["axes_svg"]

# Pixels of the larger side. SVG holds hundredths of a pixel, so places are good to 5e-6 of the size.
_SIDE = 1000.0
_MARGIN = 24.0
_LEGEND = 48.0
_LEAST_WIDTH = 420.0  # the colour bar with its words
_APART = 0.1  # between faces in planes of their own, of the larger side of all


def axes_svg(traced: Sequence["TracedProfile"], source: Path) -> str:
    """Return the text of a picture of all profiles.

    Those of a drawing lie where they lie in it; faces of a solid, which have planes of their own, below one another.
    """
    likeness = _stacked(_groups(traced))
    width, height = (likeness.bounds[1] - likeness.bounds[0]).tolist()
    scale = _SIDE / max(width, height)
    across, down = max(scale * width, _LEAST_WIDTH), scale * height
    placement = Placement.fitting(likeness.bounds, _MARGIN, _MARGIN, across, down)
    bottom = _MARGIN + down + _LEGEND
    shapes = (
        *outline(likeness, placement, PAPER, 1.5),
        *axis_lines(likeness, placement, PAPER, 2.2),
        *junctions(likeness, placement, PAPER, 2.4),
        *colour_bar(likeness.largest_radius, _MARGIN + across, bottom, PAPER),
    )
    title = f"medial axis of {printable(source.name)}"
    return svg(Drawing(across + 2 * _MARGIN, bottom + _MARGIN, title, shapes, PAPER.background, 1 / placement.scale))


def _groups(traced: Sequence["TracedProfile"]) -> list[Likeness]:
    """One likeness for all profiles of a plane."""
    planes: dict[Plane | None, list[TracedProfile]] = {}
    for each in traced:
        planes.setdefault(each.profile.origin.plane, []).append(each)
    return [Likeness.of_traces(group) for group in planes.values()]


def _stacked(groups: list[Likeness]) -> Likeness:
    """Put likenesses below one another, the first where it is."""
    bounds = np.array([group.bounds for group in groups])
    sizes = bounds[:, 1] - bounds[:, 0]
    gap = _APART * float(sizes.max())
    loops: list[Floats] = []
    branches: list[Floats] = []
    top = float(bounds[0, 1, 1])
    for group, ((left, _), (_, upper)), (_, height) in zip(groups, bounds.tolist(), sizes.tolist(), strict=True):
        shift = np.array([bounds[0, 0, 0] - left, top - upper, 0.0])
        loops += [loop + shift[:2] for loop in group.loops]
        branches += [branch + shift for branch in group.branches]
        top -= height + gap
    return Likeness(tuple(loops), tuple(branches))
