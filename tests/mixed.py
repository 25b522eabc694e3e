"""Random profiles of everything at once: lines, arcs, splines of degree 2 to 5, rational ones, holes, tiny features.

One construction asks a `Chance` for every choice: numbers from a seed here, draws of Hypothesis in `strategies`. What
crosses itself is told apart by a fine polygon, and nothing else is left out.
"""

import math
from itertools import combinations
from typing import Protocol

import numpy as np
import shapely
from catalogue import circle, periodic_spline, polygon, slot

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["Chance", "crossings", "is_simple", "mixed_outline", "mixed_profile", "straightened", "with_holes"]

TAU = 2 * math.pi
_NEAR_END = np.geomspace(1e-8, 0.02, 150)
# Rounded, since two that differ in the last digit would make a polygon turn back.
_FINE = np.unique(np.round(np.concatenate([np.linspace(0, 1, 600, endpoint=False), _NEAR_END, 1 - _NEAR_END]), 12))


class Chance(Protocol):
    """Where the choices of a profile come from."""

    def uniform(self, low: float, high: float) -> float:
        """A number between two bounds."""

    def uniforms(self, low: float, high: float, count: int) -> Floats:
        """So many of them."""

    def whole(self, low: int, high: int) -> int:
        """A whole number, `high` excluded."""

    def likely(self, share: float) -> bool:
        """Yes in this share of cases."""

    def places(self, bounds: tuple[float, float, float, float]) -> list[shapely.Point]:
        """Points all over a box (x0, y0, x1, y1)."""


class _Seeded:
    """See `Chance`."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng(seed)

    def uniform(self, low: float, high: float) -> float:
        return float(self._rng.uniform(low, high))

    def uniforms(self, low: float, high: float, count: int) -> Floats:
        return self._rng.uniform(low, high, count)

    def whole(self, low: int, high: int) -> int:
        return int(self._rng.integers(low, high))

    def likely(self, share: float) -> bool:
        return bool(self._rng.random() < share)

    def places(self, bounds: tuple[float, float, float, float]) -> list[shapely.Point]:
        x0, y0, x1, y1 = bounds
        return [shapely.Point(self._rng.uniform(x0, x1), self._rng.uniform(y0, y1)) for _ in range(40)]


def mixed_profile(seed: int) -> Profile:
    """Draw a profile; the first outline among the seed's draws that does not cross itself."""
    chance = _Seeded(seed)
    while True:
        outer = mixed_outline(chance)
        ring = shapely.Polygon(outer.flattened(64))
        if ring.is_valid and ring.area > 1e-3:
            return with_holes(chance, outer)


def with_holes(chance: Chance, outer: Loop) -> Profile:
    """Add up to six holes to an outline."""
    ring = shapely.Polygon(outer.flattened(64))
    return Profile.of(outer, _holes(chance, ring) if ring.is_valid else [])


def straightened(outline: Loop) -> Loop:
    """Replace sides by their chords where they cross others, until none does: polygons of their corners never do."""
    edges = list(outline.edges)
    while True:
        lines = [shapely.LineString(edge.flattened(64)) for edge in edges]
        crossed = {k for pair in _crossed(lines) for k in pair if not isinstance(edges[k], Line)}
        if not crossed:
            return Loop(tuple(edges))
        for k in crossed:
            edges[k] = Line.of(edges[k].start, edges[k].end)


def _crossed(lines: list[shapely.LineString]) -> list[tuple[int, int]]:
    """Pairs of lines that meet elsewhere than where one follows the other; with itself, one that crosses itself."""
    count, found = len(lines), [(k, k) for k, line in enumerate(lines) if not line.is_simple]
    for i, j in combinations(range(count), 2):
        met = shapely.intersection(lines[i], lines[j])
        shared = [shapely.Point(lines[a].coords[-1]) for a, b in ((i, j), (j, i)) if (a + 1) % count == b]
        if not shapely.difference(met, shapely.MultiPoint(shared).buffer(1e-9) if shared else shapely.Point()).is_empty:
            found.append((i, j))
    return found


def crossings(profile: Profile) -> Floats:
    """Places where loops cross or touch themselves or one another, by polygons that are fine near vertices: (n, 2)."""
    rings = [np.concatenate([_fine_points(edge) for edge in loop.edges]) for loop in profile.loops]
    segments = np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])
    lines = shapely.linestrings(segments)
    first, last = shapely.STRtree(lines).query(lines, predicate="intersects")
    # Each meets itself and its two neighbours; by right.
    ends = segments[first][:, [0, 0, 1, 1]] == segments[last][:, [0, 1, 0, 1]]
    met = shapely.intersection(lines[first], lines[last])[(first < last) & ~ends.all(axis=2).any(axis=1)]
    return np.array([point.centroid.coords[0] for point in met]).reshape(-1, 2)


def is_simple(profile: Profile) -> bool:
    """Whether the loops neither cross nor touch and are nested, judged by polygons that are fine near vertices."""
    rings = [np.concatenate([_fine_points(edge) for edge in loop.edges]) for loop in profile.loops]
    return bool(shapely.Polygon(rings[0], rings[1:]).is_valid)


def _fine_points(edge: Edge) -> Floats:
    """Points along an edge without its end; more on a straight one would only turn back by rounding."""
    return edge.point([0.0] if isinstance(edge, Line) else _FINE)


def mixed_outline(chance: Chance) -> Loop:
    """Draw an outline, which may cross itself."""
    corners = _snake(chance) if chance.likely(0.3) else _star(chance)
    sides = [_side(chance, a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    edges: list[Edge] = []
    for k, side in enumerate(sides):
        smoothed = _tangent_to(sides[k - 1], side) if k and chance.likely(0.3) else side
        sides[k] = smoothed
        edges.append(smoothed)
    return Loop(tuple(_trimmed(chance, edges)))


def _star(chance: Chance) -> Floats:
    count = chance.whole(3, 12)
    angle = TAU * (np.arange(count) + chance.uniforms(-0.35, 0.35, count)) / count
    radius = np.exp(chance.uniforms(np.log(0.25), 0, count))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def _snake(chance: Chance) -> Floats:
    """A band along a winding line: neither star-shaped nor convex."""
    count = chance.whole(3, 7)
    x = np.arange(count) * 0.5
    y = chance.uniforms(0.2, 0.7, count) * (-1.0) ** np.arange(count)
    width = 10 ** chance.uniforms(-2.5, -0.8, count)
    return np.concatenate([np.column_stack([x, y - width]), np.column_stack([x, y + width])[::-1]])


def _side(chance: Chance, a: Floats, b: Floats) -> Edge:
    kind = chance.uniform(0, 1)
    chord = b - a
    if kind < 0.35:
        return Line.of(a, b)
    if kind < 0.55:
        return _arc(a, b, float(chance.uniform(-0.4, 0.4)))
    degree = chance.whole(2, 6)
    extra = chance.whole(0, 5) if chance.likely(0.4) else 0
    along = np.linspace(0, 1, degree + 1 + extra)
    bend = chance.uniforms(-0.25, 0.25, len(along)) * np.hypot(*chord)
    bend[[0, -1]] = 0.0
    poles = a + along[:, None] * chord + bend[:, None] * np.array([-chord[1], chord[0]]) / np.hypot(*chord)
    inner = np.sort(chance.uniforms(0.1, 0.9, extra))
    knots = np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)])
    weights = chance.uniforms(0.5, 2.0, len(poles)) if chance.likely(0.3) else np.ones(len(poles))
    return BSpline.of(degree, knots, poles, weights)


def _arc(a: Floats, b: Floats, bulge: float) -> Edge:
    if abs(bulge) < 1e-3:
        return Line.of(a, b)
    start, end = complex(*a), complex(*b)
    centre = (start + end) / 2 + 1j * (end - start) * (1 - bulge**2) / (4 * bulge)
    spoke = start - centre
    return Arc.of([centre.real, centre.imag], abs(spoke), float(np.angle(spoke)), 4 * math.atan(bulge))


def _tangent_to(before: Edge, edge: Edge) -> Edge:
    """Let a spline leave in the direction in which the edge before it arrives."""
    if not isinstance(edge, BSpline) or edge.degree < 3:
        return edge
    heading = before.derivatives([1.0])[0, 1]
    leg = np.hypot(*(edge.poles[1] - edge.poles[0]))
    poles = np.array(edge.poles)
    poles[1] = poles[0] + leg * heading / np.hypot(*heading)
    return BSpline.of(edge.degree, edge.knots, poles, edge.weights)


def _trimmed(chance: Chance, sides: list[Edge]) -> list[Edge]:
    """Cut some corners between lines, by a chamfer or a fillet of any size over four orders of magnitude."""
    sizes = [_cut_size(chance, sides[k - 1], side) for k, side in enumerate(sides)]
    kept = [
        _shortened(side, front, back) for side, front, back in zip(sides, sizes, [*sizes[1:], sizes[0]], strict=True)
    ]
    out: list[Edge] = []
    for k, side in enumerate(kept):
        if sizes[k] > 0:
            out.append(_blend(chance, kept[k - 1], side))
        out.append(side)
    return out


def _cut_size(chance: Chance, left: Edge, right: Edge) -> float:
    """How much to take off both sides of a corner; nothing off most."""
    if not (isinstance(left, Line) and isinstance(right, Line)) or not chance.likely(0.5):
        return 0.0
    u, v = left.last - left.first, right.last - right.first
    if abs(u[0] * v[1] - u[1] * v[0]) < 0.1 * np.hypot(*u) * np.hypot(*v):
        return 0.0
    return float(min(np.hypot(*u), np.hypot(*v)) * 10 ** chance.uniform(-4, -0.4))


def _shortened(side: Edge, front: float, back: float) -> Edge:
    if not isinstance(side, Line) or front == back == 0:
        return side
    along = (side.last - side.first) / np.hypot(*(side.last - side.first))
    return Line.of(side.first + front * along, side.last - back * along)


def _blend(chance: Chance, left: Edge, right: Edge) -> Edge:
    """A chamfer, or an arc tangent to both lines."""
    p, q = left.end, right.start
    if chance.likely(0.4):
        return Line.of(p, q)
    u, v = left.derivatives([1.0])[0, 1], right.derivatives([0.0])[0, 1]
    return _arc(p, q, math.tan(math.atan2(u[0] * v[1] - u[1] * v[0], u @ v) / 4))


def _holes(chance: Chance, ring: shapely.Polygon) -> list[Loop]:
    holes: list[Loop] = []
    room = ring
    for _ in range(chance.whole(0, 7)):
        places = chance.places(room.bounds)
        inside = [(room.boundary.distance(place), place) for place in places if room.contains(place)]
        if not inside:
            break
        clearance, place = max(inside, key=lambda row: row[0]) if chance.likely(0.5) else inside[0]
        if clearance < 1e-3:
            continue
        near = 1 - 10 ** chance.uniform(-2, -1) if chance.likely(0.3) else chance.uniform(0.05, 0.8)
        hole = _hole(chance, place.x, place.y, clearance * near)
        holes.append(hole)
        room = room.difference(shapely.Polygon(hole.flattened(64)))
    return holes


def _hole(chance: Chance, x: float, y: float, radius: float) -> Loop:
    kind = chance.whole(0, 5)
    if kind == 0:
        return circle(x, y, radius)
    if kind == 1:
        loop = slot(0.0, 0.0, radius * 0.6, radius * 0.39)
        return loop.transformed(Similarity.of(angle=float(chance.uniform(0, TAU)), offset=(x, y)))
    if kind == 2:
        tilt = chance.uniform(0, TAU)
        a = radius * np.array([np.cos(tilt), np.sin(tilt)])
        b = radius * chance.uniform(0.1, 0.99) * np.array([-np.sin(tilt), np.cos(tilt)])
        return Loop((EllipseArc(frozen([x, y]), frozen(a), frozen(b), 0.0, TAU),))
    count = chance.whole(3, 8)
    angle = TAU * (np.arange(count) + chance.uniforms(0, 0.5, count)) / count
    reach = radius * chance.uniforms(0.4, 1.0, count)
    points = np.column_stack([x + reach * np.cos(angle), y + reach * np.sin(angle)])
    if kind == 3:
        return polygon([(float(px), float(py)) for px, py in points])
    return periodic_spline(points, chance.whole(2, 6))
