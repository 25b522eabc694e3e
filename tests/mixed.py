"""Random profiles of everything at once, from a seed: lines, arcs, splines of degree 2 to 5, rational ones, holes, tiny
features. What crosses itself is told apart by a fine polygon, and nothing else is left out.
"""

import math

import numpy as np
import shapely
from catalogue import circle, periodic_spline, polygon, slot

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["is_simple", "mixed_profile"]

TAU = 2 * math.pi
_NEAR_END = np.geomspace(1e-8, 0.02, 150)
_FINE = np.unique(np.concatenate([np.linspace(0, 1, 600, endpoint=False), _NEAR_END, 1 - _NEAR_END]))


def mixed_profile(seed: int) -> Profile:
    """Draw a profile; the first outline among the seed's draws that does not cross itself."""
    rng = np.random.default_rng(seed)
    while True:
        outer = Loop(tuple(_outline(rng)))
        ring = shapely.Polygon(outer.flattened(64))
        if ring.is_valid and ring.area > 1e-3:
            break
    return Profile.of(outer, _holes(rng, ring))


def is_simple(profile: Profile) -> bool:
    """Whether the loops neither cross nor touch and are nested, judged by polygons that are fine near vertices."""
    rings = [np.concatenate([_fine_points(edge) for edge in loop.edges]) for loop in profile.loops]
    return bool(shapely.Polygon(rings[0], rings[1:]).is_valid)


def _fine_points(edge: Edge) -> Floats:
    """Points along an edge without its end; more on a straight one would only turn back by rounding."""
    return edge.point([0.0] if isinstance(edge, Line) else _FINE)


def _outline(rng: np.random.Generator) -> list[Edge]:
    corners = _snake(rng) if rng.random() < 0.3 else _star(rng)
    sides = [_side(rng, a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    edges: list[Edge] = []
    for k, side in enumerate(sides):
        smoothed = _tangent_to(sides[k - 1], side) if k and rng.random() < 0.3 else side
        sides[k] = smoothed
        edges.append(smoothed)
    return _trimmed(rng, edges)


def _star(rng: np.random.Generator) -> Floats:
    count = int(rng.integers(3, 12))
    angle = TAU * (np.arange(count) + rng.uniform(-0.35, 0.35, count)) / count
    radius = np.exp(rng.uniform(np.log(0.25), 0, count))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def _snake(rng: np.random.Generator) -> Floats:
    """A band along a winding line: neither star-shaped nor convex."""
    count = int(rng.integers(3, 7))
    x = np.arange(count) * 0.5
    y = rng.uniform(0.2, 0.7, count) * (-1.0) ** np.arange(count)
    width = 10 ** rng.uniform(-2.5, -0.8, count)
    return np.concatenate([np.column_stack([x, y - width]), np.column_stack([x, y + width])[::-1]])


def _side(rng: np.random.Generator, a: Floats, b: Floats) -> Edge:
    kind = rng.random()
    chord = b - a
    if kind < 0.35:
        return Line.of(a, b)
    if kind < 0.55:
        return _arc(a, b, float(rng.uniform(-0.4, 0.4)))
    degree = int(rng.integers(2, 6))
    extra = int(rng.integers(0, 5)) if rng.random() < 0.4 else 0
    along = np.linspace(0, 1, degree + 1 + extra)
    bend = rng.uniform(-0.25, 0.25, len(along)) * np.hypot(*chord)
    bend[[0, -1]] = 0.0
    poles = a + along[:, None] * chord + bend[:, None] * np.array([-chord[1], chord[0]]) / np.hypot(*chord)
    inner = np.sort(rng.uniform(0.1, 0.9, extra))
    knots = np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)])
    weights = rng.uniform(0.5, 2.0, len(poles)) if rng.random() < 0.3 else np.ones(len(poles))
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


def _trimmed(rng: np.random.Generator, sides: list[Edge]) -> list[Edge]:
    """Cut some corners between lines, by a chamfer or a fillet of any size over four orders of magnitude."""
    sizes = [_cut_size(rng, sides[k - 1], side) for k, side in enumerate(sides)]
    kept = [
        _shortened(side, front, back) for side, front, back in zip(sides, sizes, [*sizes[1:], sizes[0]], strict=True)
    ]
    out: list[Edge] = []
    for k, side in enumerate(kept):
        if sizes[k] > 0:
            out.append(_blend(rng, kept[k - 1], side))
        out.append(side)
    return out


def _cut_size(rng: np.random.Generator, left: Edge, right: Edge) -> float:
    """How much to take off both sides of a corner; nothing off most."""
    if not (isinstance(left, Line) and isinstance(right, Line)) or rng.random() > 0.5:
        return 0.0
    u, v = left.last - left.first, right.last - right.first
    if abs(u[0] * v[1] - u[1] * v[0]) < 0.1 * np.hypot(*u) * np.hypot(*v):
        return 0.0
    return float(min(np.hypot(*u), np.hypot(*v)) * 10 ** rng.uniform(-4, -0.4))


def _shortened(side: Edge, front: float, back: float) -> Edge:
    if not isinstance(side, Line) or front == back == 0:
        return side
    along = (side.last - side.first) / np.hypot(*(side.last - side.first))
    return Line.of(side.first + front * along, side.last - back * along)


def _blend(rng: np.random.Generator, left: Edge, right: Edge) -> Edge:
    """A chamfer, or an arc tangent to both lines."""
    p, q = left.end, right.start
    if rng.random() < 0.4:
        return Line.of(p, q)
    u, v = left.derivatives([1.0])[0, 1], right.derivatives([0.0])[0, 1]
    return _arc(p, q, math.tan(math.atan2(u[0] * v[1] - u[1] * v[0], u @ v) / 4))


def _holes(rng: np.random.Generator, ring: shapely.Polygon) -> list[Loop]:
    holes: list[Loop] = []
    room = ring
    for _ in range(int(rng.integers(0, 7))):
        x0, y0, x1, y1 = room.bounds
        places = [shapely.Point(rng.uniform(x0, x1), rng.uniform(y0, y1)) for _ in range(40)]
        inside = [(room.boundary.distance(place), place) for place in places if room.contains(place)]
        if not inside:
            break
        clearance, place = max(inside, key=lambda row: row[0]) if rng.random() < 0.5 else inside[0]
        if clearance < 1e-3:
            continue
        near = 1 - 10 ** rng.uniform(-2, -1) if rng.random() < 0.3 else rng.uniform(0.05, 0.8)
        hole = _hole(rng, place.x, place.y, clearance * near)
        holes.append(hole)
        room = room.difference(shapely.Polygon(hole.flattened(64)))
    return holes


def _hole(rng: np.random.Generator, x: float, y: float, radius: float) -> Loop:
    kind = int(rng.integers(0, 5))
    if kind == 0:
        return circle(x, y, radius)
    if kind == 1:
        loop = slot(0.0, 0.0, radius * 0.6, radius * 0.39)
        return loop.transformed(Similarity.of(angle=float(rng.uniform(0, TAU)), offset=(x, y)))
    if kind == 2:
        tilt = rng.uniform(0, TAU)
        a = radius * np.array([np.cos(tilt), np.sin(tilt)])
        b = radius * rng.uniform(0.1, 0.99) * np.array([-np.sin(tilt), np.cos(tilt)])
        return Loop((EllipseArc(frozen([x, y]), frozen(a), frozen(b), 0.0, TAU),))
    count = int(rng.integers(3, 8))
    angle = TAU * (np.arange(count) + rng.uniform(0, 0.5, count)) / count
    reach = radius * rng.uniform(0.4, 1.0, count)
    points = np.column_stack([x + reach * np.cos(angle), y + reach * np.sin(angle)])
    if kind == 3:
        return polygon([(float(px), float(py)) for px, py in points])
    return periodic_spline(points, int(rng.integers(2, 6)))
