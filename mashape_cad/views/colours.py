"""Colours of all pictures, and which colour a clearance radius has."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mashape_cad.views.drawing import Floats

__all__ = ["ACCENT", "DARK_AXIS", "LIGHT_AXIS", "PAGE", "PAPER", "Theme", "runs_by_colour"]

# The map "plasma" of N. Smith and S. van der Walt (CC0). It is perceptually uniform: equal steps of the radius look
# equally far apart, in grey print and to colour-blind eyes too. White paper swallows its yellow end and a dark screen
# its blue one, so either shows the part that it can.
LIGHT_AXIS = (
    "#0d0887", "#3e049c", "#6400a7", "#8808a6", "#a82296", "#c33d80", "#d9586a", "#eb7556", "#f89441", "#feb72d",
)  # fmt: skip
DARK_AXIS = (
    "#8f0da4", "#aa2395", "#c03a83", "#d35171", "#e3685f", "#f0804e", "#fa9b3d", "#feb82c", "#fad824", "#f0f921",
)  # fmt: skip
ACCENT = LIGHT_AXIS[3]
# As many as the eye tells apart on a thin line of a large picture; each costs one path in a file.
_COUNT = 24


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours of one kind of picture, as CSS writes them."""

    ink: str
    muted: str
    faint: str
    fill: str
    background: str
    axis: tuple[str, ...]
    wrong: str


def _ramp(anchors: tuple[str, ...], count: int) -> tuple[str, ...]:
    """Return `count` colours evenly along the straight lines between anchors."""
    channels = np.array([[int(each[i : i + 2], 16) for i in (1, 3, 5)] for each in anchors])
    places = np.linspace(0.0, len(anchors) - 1.0, count)
    mixed = np.column_stack([np.interp(places, np.arange(len(anchors)), channel) for channel in channels.T])
    return tuple(f"#{red:02x}{green:02x}{blue:02x}" for red, green, blue in np.rint(mixed).astype(int).tolist())


PAPER = Theme(
    ink="#1f2933",
    muted="#5b6b7a",
    faint="#d5dce3",
    fill="#f2f5f9",
    background="#ffffff",
    axis=_ramp(LIGHT_AXIS, _COUNT),
    wrong="#c0392b",
)
# Colours of a page are named, so that its style sheet can turn them over at night.
PAGE = Theme(
    ink="var(--ink)",
    muted="var(--muted)",
    faint="var(--faint)",
    fill="var(--part)",
    background="var(--tile)",
    axis=tuple(f"var(--r{i})" for i in range(len(LIGHT_AXIS))),
    wrong="var(--wrong)",
)


def runs_by_colour(branches: tuple[Floats, ...], largest: float, count: int) -> tuple[tuple[Floats, ...], ...]:
    """Cut branches where their clearance passes from one of `count` equal steps to the next.

    Parameters
    ----------
    branches : tuple of (n, 3) arrays
        x, y, radius along each branch, straight in between.
    largest : float
        The radius that the last step ends with.
    count : int

    Returns
    -------
    tuple of tuple of (m, 2) arrays
        For each step the pieces of branches in it.
    """
    runs: list[list[Floats]] = [[] for _ in range(count)]
    for branch in branches:
        points = _with_crossings(branch, largest / count)
        middle = (points[1:, 2] + points[:-1, 2]) / 2
        steps = np.clip((middle * count / largest).astype(int), 0, count - 1)
        starts = np.flatnonzero(np.diff(steps, prepend=-1))
        for start, end in pairwise([*starts.tolist(), len(steps)]):
            runs[steps[start]].append(points[start : end + 1, :2])
    return tuple(tuple(pieces) for pieces in runs)


def _with_crossings(branch: Floats, step: float) -> Floats:
    """Add the points where the radius passes a multiple of `step`."""
    radii = branch[:, 2] / step
    along = np.arange(len(branch), dtype=float)
    added = [along]
    for i, (low, high) in enumerate(pairwise(radii.tolist())):
        levels = np.arange(np.ceil(min(low, high)), max(low, high))
        if low != high:
            added.append(i + (levels - low) / (high - low))
    places = np.unique(np.concatenate(added))
    return np.column_stack([np.interp(places, along, column) for column in branch.T])
