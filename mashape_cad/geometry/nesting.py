"""Which loop lies in which: even-odd nesting of loops into profiles.

A loop at an even depth bounds material from outside and starts a profile, a loop at an odd depth is a hole in the
profile of the loop around it. Loops are expected not to cross; if they do, the larger part decides, and the medial axis
will refuse what bounds no domain.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Edge, Floats, Line
from mashape_cad.geometry.profile import Loop

__all__ = ["Nested", "looks_like_frame", "nest"]

# Points of a loop that vote on whether it lies in another one. Odd, so that a vote never ties.
_VOTES = 9
# Polyline pieces for each span, tried in turn until the votes are clear of the polyline's error. The last one is good
# to 1e-7 of a round loop's size.
_FINENESS = (8, 64, 512)
# Of their size: how much boxes of loops may be too large.
_BOX = 0.02
# A frame's share of the width and height of all that is drawn.
_FRAME_SHARE = 0.9
# Parts with holes of their own that a frame holds at least.
_FRAMED_PARTS = 3


@dataclass(frozen=True, slots=True)
class Nested:
    """A profile as numbers of loops.

    Attributes
    ----------
    outer : int
    holes : tuple of int
    depth : int
        How many loops lie around the outer one: 0, 2, 4...
    """

    outer: int
    holes: tuple[int, ...]
    depth: int


def nest(loops: Sequence[Loop]) -> tuple[Nested, ...]:
    """Nest loops by the even-odd rule.

    Parameters
    ----------
    loops : sequence of Loop
        Of any orientation.

    Returns
    -------
    tuple of Nested
        Ordered by the outer loop's area, the largest first; each loop occurs once.
    """
    areas = np.array([abs(loop.signed_area) for loop in loops])
    boxes = np.array([loop.bounds for loop in loops]).reshape(-1, 2, 2)
    outlines = [_Outline(loop) for loop in loops]
    order = np.argsort(-areas, kind="stable")
    depth: dict[int, int] = {}
    holes: dict[int, list[int]] = {}
    for rank, inner in enumerate(order.tolist()):
        larger = order[:rank]
        around = larger[_may_hold(boxes[larger], boxes[inner])][::-1].tolist()  # the smallest first
        parent = next((outer for outer in around if outlines[outer].holds(outlines[inner])), None)
        depth[inner] = 0 if parent is None else depth[parent] + 1
        if parent is not None and depth[inner] % 2 == 1:
            holes[parent].append(inner)
        else:
            holes[inner] = []
    return tuple(Nested(outer, tuple(inner), depth[outer]) for outer, inner in holes.items())


def looks_like_frame(loops: Sequence[Loop], nested: Sequence[Nested]) -> Nested | None:
    """Return the profile that may be the frame of a sheet: a rectangle around nearly everything, parts as its holes."""
    if not nested or nested[0].depth != 0:
        return None
    frame = nested[0]
    if len(loops[frame.outer].edges) != 4 or len(nested) <= _FRAMED_PARTS:
        return None
    boxes = np.array([loop.bounds for loop in loops])
    whole = boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)
    own = boxes[frame.outer, 1] - boxes[frame.outer, 0]
    fills = abs(loops[frame.outer].signed_area) >= _FRAME_SHARE * own.prod()
    inside = sum(1 for one in nested if one.depth > 0)
    return frame if fills and np.all(own >= _FRAME_SHARE * whole) and inside >= _FRAMED_PARTS else None


def _may_hold(outer: Floats, inner: Floats) -> NDArray[np.bool_]:
    """Whether boxes (n, 2, 2), tight to a hundredth, allow a loop in one of them to hold the other loop."""
    slack = _BOX * (outer[:, 1] - outer[:, 0] + inner[1] - inner[0])
    return np.all((inner[0] >= outer[:, 0] - slack) & (inner[1] <= outer[:, 1] + slack), axis=1)


class _Outline:
    """A loop as polylines of rising fineness, made when needed."""

    def __init__(self, loop: Loop) -> None:
        self._loop = loop
        self._lines: dict[int, tuple[Floats, float]] = {}

    def holds(self, inner: "_Outline") -> bool:
        """Whether the larger part of another loop lies in this one."""
        places = inner.voters()
        inside = np.zeros(len(places), bool)
        for fineness in _FINENESS:
            line, error = self._polyline(fineness)
            inside = _inside(places, line)
            clear = _distances(places, line) > error
            if 2 * np.count_nonzero(clear) > len(places):
                return bool(2 * np.count_nonzero(inside & clear) > np.count_nonzero(clear))
        return bool(2 * np.count_nonzero(inside) > len(places))

    def voters(self) -> Floats:
        """Return points spread along the loop."""
        line = self._loop.flattened(_FINENESS[0])
        return line[np.linspace(0, len(line), _VOTES, endpoint=False).astype(int)]

    def _polyline(self, fineness: int) -> tuple[Floats, float]:
        """Return points along the loop, and how far the loop may be from the lines between them, mm."""
        if fineness not in self._lines:
            pieces = [_flattened(edge, fineness) for edge in self._loop.edges]
            points = np.concatenate([points for points, _ in pieces])
            rounding = 1e-14 * float(np.abs(points).max())
            self._lines[fineness] = points, rounding + max(error for _, error in pieces)
        return self._lines[fineness]


def _flattened(edge: Edge, fineness: int) -> tuple[Floats, float]:
    """Return points along an edge without the last one, and twice the distance of the curve from its chords, mm."""
    if isinstance(edge, Line):
        return edge.first[None], 0.0
    points = edge.flattened(2 * fineness)
    middles = (points[:-2:2] + points[2::2]) / 2
    return points[:-1:2], 2 * float(np.linalg.norm(points[1::2] - middles, axis=1).max())


def _inside(places: Floats, line: Floats) -> NDArray[np.bool_]:
    """Whether places lie in a closed polyline, by the even-odd rule."""
    first, second = line, np.roll(line, -1, axis=0)
    x, y = places[:, :1], places[:, 1:]
    spans = (first[:, 1] > y) != (second[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # on sides that the mask leaves out
        crossing = first[:, 0] + (y - first[:, 1]) / (second[:, 1] - first[:, 1]) * (second[:, 0] - first[:, 0])
    return np.count_nonzero(spans & (x < crossing), axis=1) % 2 == 1


def _distances(places: Floats, line: Floats) -> Floats:
    """Distance of each place to a closed polyline, mm."""
    chord = np.roll(line, -1, axis=0) - line
    offset = places[:, None] - line
    square = np.maximum(np.sum(chord**2, axis=1), np.finfo(float).tiny)
    along = np.clip(np.sum(offset * chord, axis=2) / square, 0.0, 1.0)
    return np.linalg.norm(offset - along[..., None] * chord, axis=2).min(axis=1)
