"""A profile made ready to be laid over another one: `Outline`.

Terminology
-----------
station
    Place on the boundary at which two outlines are compared: every vertex, and places between, evenly along each edge.
    A tessellated loop has its vertices only.
ring
    A loop as a fine polyline, for what need not be exact: finding the alignment, and areas.
tessellated loop
    A loop of many short lines that turn little from one to the next: a curve that was drawn as a polyline. Its
    vertices are data. What lies between them was lost: a corner may have been cut off, by half a *step* at most.
step
    Length that the chords of a tessellated loop typically have.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from mashape_cad.geometry.edge import Edge, Floats, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.matching.turning import Spectrum, spectrum

__all__ = ["Feet", "Outline"]

# Of the size: how far rings may be from the curves. Areas are good to about the same share; ten times finer costs
# three times the points.
_RING_ACCURACY = 1e-6
# Of the size: spacing of stations. A difference that is smaller than this and lies between two vertices of neither
# outline may be measured too small, but its own vertices are always stations.
_SPACING = 1 / 250
# Stations on an edge at least, its start counted: a short edge bulges in between.
_FEWEST_ON_CURVE, _FEWEST_ON_LINE = 4, 2
# Of the size: spacing of the points through which a nearest place is first looked for.
_SEARCH_SPACING = 1 / 1000
# A loop is tessellated if it has as many lines as a coarse circle, and most of its joints turn by less than a
# twelfth of a circle: the corners of combs and racks turn by more, so that those count as drawn.
_FEWEST_CHORDS = 24
_GENTLE_TURN = np.radians(30)
_MOST_ARE_GENTLE = 0.8
# Chords that cut a corner are shorter than the step that was taken along the curve; this quantile is not.
_STEP_QUANTILE = 0.9


@dataclass(frozen=True, slots=True, eq=False)
class Feet:
    """Nearest places on an outline.

    Attributes
    ----------
    point : (n, 2) array
        mm.
    distance : (n,) array
        mm.
    normal : (n, 2) array
        Unit vectors across the outline there.
    step : (n,) array
        Of the loop that each lies on, mm; 0 unless it is tessellated.
    """

    point: Floats
    distance: Floats
    normal: Floats
    step: Floats


class Outline:
    """A profile with its stations, rings and search trees, each made when it is first asked for.

    Parameters
    ----------
    profile : Profile

    Attributes
    ----------
    size : float
        Diagonal of the box around the outline, mm.
    centre : (2,) array
        Centroid of what the outer loop encloses, mm: holes that come, go or move leave it where it is.
    reach : float
        Square root of what the outer loop encloses, mm.
    is_tessellated : bool
        Whether any of its loops is.
    """

    def __init__(self, profile: Profile) -> None:
        self.profile = profile
        box = profile.diagonal
        self.rings = tuple(_ring(loop, _RING_ACCURACY * box) for loop in profile.loops)
        outer = self.rings[0]
        self.size = float(np.hypot(*np.ptp(outer, axis=0)))
        area, self.centre = _centroid(outer)
        self.reach = float(np.sqrt(abs(area)))
        self._steps = [_step(loop) for loop in profile.loops]
        self.is_tessellated = any(self._steps)

    @cached_property
    def stations(self) -> "Stations":
        """Places on the boundary for comparison."""
        spacing = _SPACING * self.size
        parts = [
            _vertices(loop) if step else _along(loop, spacing)
            for loop, step in zip(self.profile.loops, self._steps, strict=True)
        ]
        point, weight = (np.concatenate(column) for column in zip(*parts, strict=True))
        return Stations(point, weight)

    @cached_property
    def vertices(self) -> Floats:
        """Points where edges meet, (n, 2), mm."""
        return np.array([edge.start for edge in self.profile.edges])

    @cached_property
    def query(self) -> DistanceQuery:
        """The kernel's distances to the boundary."""
        return DistanceQuery(self.profile)

    @cached_property
    def spectrum(self) -> Spectrum:
        """How its boundary is spread over distances and directions from the centre."""
        stations = self.stations
        return spectrum((stations.point - self.centre) / self.reach, stations.weight / self.reach)

    @cached_property
    def area(self) -> float:
        """Area inside the rings, mm2."""
        return float(sum(_centroid(ring)[0] for ring in self.rings))

    def nearest(self, points: Floats) -> Feet:
        """Return the nearest places on the rings of points (n, 2): good to about `_RING_ACCURACY` of the size.

        Where two places are equally near to within `_SEARCH_SPACING`, the further one may be given: the kernel has the
        last word on any distance that is told.
        """
        search = self._search
        _, near = search.tree.query(points, k=min(2, len(search.start)))
        near = near.reshape(len(points), -1)
        candidates = np.concatenate([near, search.before[near]], axis=1)
        start, chord = search.start[candidates], search.chord[candidates]
        offset = points[:, None] - start
        square = np.maximum(np.sum(chord**2, axis=2), np.finfo(float).tiny)
        along = np.clip(np.sum(offset * chord, axis=2) / square, 0.0, 1.0)
        feet = start + along[..., None] * chord
        distances = np.linalg.norm(points[:, None] - feet, axis=2)
        rows, best = np.arange(len(points)), np.argmin(distances, axis=1)
        across = chord[rows, best] @ np.array([[0.0, 1.0], [-1.0, 0.0]])
        normal = across / np.sqrt(square[rows, best])[:, None]
        step = search.step[candidates[rows, best]]
        return Feet(feet[rows, best], distances[rows, best], normal, step)

    @cached_property
    def _search(self) -> "_Search":
        spacing = _SEARCH_SPACING * self.size
        starts = [_densified(ring, spacing) for ring in self.rings]
        chords = [np.roll(start, -1, axis=0) - start for start in starts]
        counts = [len(start) for start in starts]
        first = np.repeat(np.cumsum([0, *counts[:-1]]), counts)
        before = first + np.concatenate([np.roll(np.arange(n), 1) for n in counts])
        start = np.concatenate(starts)
        return _Search(cKDTree(start), start, np.concatenate(chords), before, np.repeat(self._steps, counts))


@dataclass(frozen=True, slots=True, eq=False)
class Stations:
    """Places on a boundary.

    Attributes
    ----------
    point : (n, 2) array
        mm.
    weight : (n,) array
        Length of boundary that each stands for, mm.
    """

    point: Floats
    weight: Floats


@dataclass(frozen=True, slots=True, eq=False)
class _Search:
    """All rings as short chords: where each starts, what follows, which one comes before, the step of its loop."""

    tree: cKDTree
    start: Floats
    chord: Floats
    before: NDArray[np.intp]
    step: Floats


def _ring(loop: Loop, accuracy: float) -> Floats:
    return np.concatenate([_polyline(edge, accuracy)[:-1] for edge in loop.edges])


def _polyline(edge: Edge, accuracy: float) -> Floats:
    """Return points along an edge, evenly in the parameter of each span, close enough for its chords to be accurate.

    A chord over a length l that turns by t is off by l t / 8, and n of them by a square of n less.
    """
    if isinstance(edge, Line):
        return np.array([edge.first, edge.last])
    coarse = edge.flattened(8)
    legs = np.diff(coarse, axis=0)
    spans = max(1, len(legs) // 8)
    length = np.linalg.norm(legs, axis=1).reshape(spans, -1).sum(axis=1)
    turn = np.abs(_turns(legs[:-1], legs[1:])).sum() / spans + 0.1
    finest = float(np.sqrt(length.max() * max(turn, 0.1) / (8 * accuracy)))
    return edge.flattened(int(np.clip(np.ceil(finest), 8, 1500)))


def _turns(before: Floats, after: Floats) -> Floats:
    """Angles from one chord to the next, radians."""
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(cross, np.sum(before * after, axis=1))


def _centroid(ring: Floats) -> tuple[float, Floats]:
    """Return signed area and centroid of a polygon, by Green's theorem about its first point."""
    local = ring - ring[0]
    after = np.roll(local, -1, axis=0)
    cross = local[:, 0] * after[:, 1] - local[:, 1] * after[:, 0]
    area = float(cross.sum() / 2)
    return area, ring[0] + (local + after).T @ cross / (6 * area)


def _step(loop: Loop) -> float:
    """Return the step of a tessellated loop, mm; 0 of any other."""
    if len(loop.edges) < _FEWEST_CHORDS or not all(isinstance(edge, Line) for edge in loop.edges):
        return 0.0
    chords = np.array([edge.end - edge.start for edge in loop.edges])
    gentle = np.abs(_turns(chords, np.roll(chords, -1, axis=0))) < _GENTLE_TURN
    if np.mean(gentle) < _MOST_ARE_GENTLE:
        return 0.0
    return float(np.quantile(np.linalg.norm(chords, axis=1), _STEP_QUANTILE))


def _vertices(loop: Loop) -> tuple[Floats, Floats]:
    """Return where the edges of a tessellated loop start, and how much of the loop lies around each."""
    start = np.array([edge.start for edge in loop.edges])
    length = np.linalg.norm(np.roll(start, -1, axis=0) - start, axis=1)
    return start, (length + np.roll(length, 1)) / 2


def _along(loop: Loop, spacing: float) -> tuple[Floats, Floats]:
    """Return stations of a loop, nearly even in length on each edge, and how much of the edge each stands for."""
    parts = [_on_edge(edge, spacing) for edge in loop.edges]
    return np.concatenate([points for points, _ in parts]), np.concatenate([weights for _, weights in parts])


def _on_edge(edge: Edge, spacing: float) -> tuple[Floats, Floats]:
    breaks = edge.spans()[1]
    between = 1 if isinstance(edge, Line) else 8
    u = np.append((breaks[:-1, None] + np.diff(breaks)[:, None] * np.arange(between) / between).ravel(), 1.0)
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(edge.point(u), axis=0), axis=1))])
    fewest = _FEWEST_ON_LINE if isinstance(edge, Line) else _FEWEST_ON_CURVE
    count = max(fewest, int(np.ceil(along[-1] / spacing)))
    places = np.interp(np.linspace(0.0, along[-1], count, endpoint=False), along, u)
    return edge.point(places), np.full(count, along[-1] / count)


def _densified(ring: Floats, spacing: float) -> Floats:
    """Return a ring with points added so that none are further apart than `spacing`."""
    chord = np.roll(ring, -1, axis=0) - ring
    counts = np.maximum(1, np.ceil(np.linalg.norm(chord, axis=1) / spacing).astype(int))
    first = np.repeat(np.cumsum(counts) - counts, counts)
    share = (np.arange(counts.sum()) - first) / np.repeat(counts, counts)
    return np.repeat(ring, counts, axis=0) + share[:, None] * np.repeat(chord, counts, axis=0)
