"""A profile with its medial axis, placed on a canvas: the part that all pictures share."""

from collections import Counter
from collections.abc import Iterator

import numpy as np

from mashape_cad.views.colours import Theme, runs_by_colour
from mashape_cad.views.drawing import (
    Anchor,
    Area,
    Circle,
    Difference,
    Floats,
    Label,
    Lines,
    Placement,
    Shape,
    rectangle,
)
from mashape_cad.views.likeness import Likeness

__all__ = ["axis_lines", "colour_bar", "junctions", "maximal_discs", "outline", "overlay"]

_MOST_DISCS = 10
# Discs below this share of the largest would look like specks.
_SMALLEST_DISC = 0.18
# How much room around a disc counts against its own radius: with 0 all discs gather where the part is wide, and with
# more they seek the tips.
_SPREAD = 0.2
_BETWEEN = 8  # places tried for a disc between two points of a branch
_BAR = 260.0  # width of a colour bar, pixels
# Radii and distances this close (relative) look the same; light pictures are good to 5e-4 of the size.
_SAME = 0.01


def outline(likeness: Likeness, placement: Placement, theme: Theme, width: float) -> Iterator[Shape]:
    """Yield the profile, filled lightly, holes left out."""
    yield Area(tuple(placement.apply(loop) for loop in likeness.loops), theme.fill, theme.ink, width)


def overlay(under: Likeness, over: Likeness, box: tuple[float, float, float, float], theme: Theme) -> Iterator[Shape]:
    """Yield two profiles on top of one another in a box (left, top, width, height) of the canvas."""
    bounds = np.stack([under.bounds, over.bounds])
    placement = Placement.fitting(np.array([bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)]), *box)
    below, above = (tuple(placement.apply(loop) for loop in each.loops) for each in (under, over))
    yield Area(above, theme.fill)
    yield Difference(below, above, theme.wrong)
    yield Area(above, "none", theme.ink, 1.3)
    yield Area(below, "none", theme.muted, 0.6)


def axis_lines(likeness: Likeness, placement: Placement, theme: Theme, width: float) -> Iterator[Shape]:
    """Yield the branches in the colours of their clearance radius, the largest radius of the part being the last."""
    largest = likeness.largest_radius
    for branch in likeness.branches:
        if len(branch) == 1:  # the axis of a disc
            x, y = placement.apply(branch[:, :2])[0].tolist()
            yield Circle(x, y, 1.5 * width, theme.axis[-1], theme.axis[-1], 0.0)
    if largest > 0:
        for colour, runs in zip(theme.axis, runs_by_colour(likeness.branches, largest, len(theme.axis)), strict=True):
            yield Lines(tuple(placement.apply(run) for run in runs), colour, width)


def maximal_discs(likeness: Likeness, placement: Placement, theme: Theme) -> Iterator[Shape]:
    """Yield a few maximal discs: the largest, then others, large and far from those chosen, that overlap none."""
    largest = likeness.largest_radius
    for x, y, radius in _chosen(likeness):
        colour = theme.axis[min(int(radius / largest * len(theme.axis)), len(theme.axis) - 1)]
        left, top = placement.apply(np.array([[x, y]]))[0].tolist()
        yield Circle(left, top, radius * placement.scale, colour, colour, 1.0, opacity=0.12)
        yield Circle(left, top, 1.8, colour, colour, 0.0)


def junctions(likeness: Likeness, placement: Placement, theme: Theme, radius: float) -> Iterator[Shape]:
    """Yield a small ring where three or more branches meet."""
    size = float(np.max(np.abs(likeness.bounds))) or 1.0
    ends = [branch[i, :2] for branch in likeness.branches if len(branch) > 1 for i in (0, -1)]
    met = Counter(tuple(np.rint(end / size * 1e6).astype(int).tolist()) for end in ends)
    for place, count in met.items():
        if count > 2:
            x, y = placement.apply(np.array([place]) * size / 1e6)[0].tolist()
            yield Circle(x, y, radius, theme.background, theme.ink, 0.9)


def colour_bar(largest: float, right: float, bottom: float, theme: Theme) -> Iterator[Shape]:
    """Yield what the colours of an axis mean, ending at `right`, its figures' base line just below `bottom`."""
    if largest <= 0:
        return
    left, top = right - _BAR, bottom - 21
    pitch = _BAR / len(theme.axis)
    for i, colour in enumerate(theme.axis):  # each a little wider than its step, or seams would shine through
        yield Area((rectangle(left + i * pitch, top, min(pitch + 0.6, _BAR - i * pitch), 9),), colour)
    yield Label(left - 12, top + 9, "clearance radius", 12, theme.muted, "end")
    anchors: tuple[tuple[float, Anchor], ...] = ((0.0, "start"), (0.5, "middle"), (1.0, "end"))
    for share, anchor in anchors:
        text = f"{largest * share:.3g}" + (" mm" if share == 1 else "")
        yield Label(left + share * _BAR, bottom + 3, text, 12, theme.muted, anchor)


def _chosen(likeness: Likeness) -> list[Floats]:
    found = np.concatenate([*(_closely(branch) for branch in likeness.branches), np.zeros((0, 3))])
    found = found[found[:, 2] >= _SMALLEST_DISC * likeness.largest_radius]
    gap = np.zeros(len(found))
    chosen: list[Floats] = []
    while len(found) and len(chosen) <= _MOST_DISCS:
        disc = found[np.argmax(found[:, 2] + _SPREAD * gap)]
        chosen.append(disc)
        apart = np.hypot(*(found[:, :2] - disc[:2]).T) - found[:, 2] - disc[2]
        gap = apart if len(chosen) == 1 else np.minimum(gap, apart)
        clear = gap > -_SAME * (found[:, 2] + disc[2])
        found, gap = found[clear], gap[clear]
    return chosen if len(chosen) <= _MOST_DISCS else _without_last_size(chosen)


def _closely(branch: Floats) -> Floats:
    """Add places between those of a branch, since few points are enough for a straight one."""
    places = np.arange(0, len(branch) - 1 + 1e-9, 1 / _BETWEEN)
    return np.column_stack([np.interp(places, np.arange(len(branch)), column) for column in branch.T])


def _without_last_size(chosen: list[Floats]) -> list[Floats]:
    """Leave out the last discs that are of one size: of those that are alike, a symmetric part shows all or none."""
    alike = [abs(disc[2] - chosen[-1][2]) <= _SAME * disc[2] for disc in chosen]
    kept = len(chosen) - alike[::-1].index(False) if False in alike else _MOST_DISCS
    return chosen[:kept]
