"""Medial axes as an SVG in true size: outlines, and branches in the colours of their clearance."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mashape_cad.views.colours import PAPER
from mashape_cad.views.drawing import Drawing, Label, Placement, Shape, printable
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
    groups = _groups(traced)
    panels = _stacked([Likeness.of_traces(group) for group in groups])
    likeness = Likeness(
        tuple(loop for panel in panels for loop in panel.loops),
        tuple(branch for panel in panels for branch in panel.branches),
    )
    width, height = (likeness.bounds[1] - likeness.bounds[0]).tolist()
    scale = _SIDE / max(width, height)
    across, down = max(scale * width, _LEAST_WIDTH), scale * height
    placement = Placement.fitting(likeness.bounds, _MARGIN, _MARGIN, across, down)
    bottom = _MARGIN + down + _LEGEND
    shapes = (
        *outline(likeness, placement, PAPER, 1.5),
        *axis_lines(likeness, placement, PAPER, 2.2),
        *junctions(likeness, placement, PAPER, 2.4),
        *(_names(groups, panels, placement) if len(panels) > 1 else ()),
        *colour_bar(likeness.largest_radius, _MARGIN + across, bottom, PAPER),
    )
    title = f"medial axis of {printable(source.name)}"
    return svg(Drawing(across + 2 * _MARGIN, bottom + _MARGIN, title, shapes, PAPER.background, 1 / placement.scale))


def _groups(traced: Sequence["TracedProfile"]) -> list[list["TracedProfile"]]:
    """Return the profiles of each plane."""
    planes: dict[Plane | None, list[TracedProfile]] = {}
    for each in traced:
        planes.setdefault(each.profile.origin.plane, []).append(each)
    return list(planes.values())


def _stacked(panels: list[Likeness]) -> list[Likeness]:
    """Put likenesses below one another, the first where it is."""
    bounds = np.array([panel.bounds for panel in panels])
    sizes = bounds[:, 1] - bounds[:, 0]
    gap = _APART * float(sizes.max())
    tops = bounds[0, 1, 1] - np.concatenate([[0.0], np.cumsum(sizes[:-1, 1] + gap)])
    shifts = np.column_stack([bounds[0, 0, 0] - bounds[:, 0, 0], tops - bounds[:, 1, 1], np.zeros(len(panels))])
    return [
        Likeness(
            tuple(loop + shift[:2] for loop in panel.loops),
            tuple(branch + shift for branch in panel.branches),
        )
        for panel, shift in zip(panels, shifts, strict=True)
    ]


def _names(groups: list[list["TracedProfile"]], panels: list[Likeness], placement: Placement) -> Iterator[Shape]:
    """Yield the numbers of the profiles above each panel."""
    for group, panel in zip(groups, panels, strict=True):
        corner = np.array([[panel.bounds[0, 0], panel.bounds[1, 1]]])
        x, y = placement.apply(corner)[0].tolist()
        yield Label(x, y - 8, ", ".join(_name(each) for each in group), 12, PAPER.muted)


def _name(each: "TracedProfile") -> str:
    face = each.profile.origin.face
    return f"profile {each.number}" + ("" if face is None else f" (face {face})")
