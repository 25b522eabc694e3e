"""Random valid profiles for Hypothesis, biased to the almost degenerate.

Every profile is valid by construction: stars are drawn round a centre, holes lie in cells of their own. What is nearly
degenerate is so by a power of ten that is drawn, so that a failure shrinks to the first power that fails.
"""

from collections.abc import Callable

import numpy as np
import shapely
from catalogue import box, circle, periodic_spline, polygon, rounded, slot
from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy
from mixed import mixed_outline, straightened, with_holes

from mashape_cad.geometry.edge import Arc, EllipseArc, Floats, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile

TAU = 2 * np.pi


def _numbers(low: float, high: float) -> SearchStrategy[float]:
    """Numbers of few digits: they shrink well, and coincide now and then."""
    return st.integers(0, 1000).map(lambda k: low + (high - low) * k / 1000)


def _powers(first: int, last: int) -> SearchStrategy[float]:
    return st.integers(first, last).map(lambda k: 10.0**-k)


@st.composite
def similarities(draw: DrawFn) -> Similarity:
    """Any move, turn, scale and mirror."""
    scale = 10.0 ** draw(_numbers(-3, 4))
    offset = (draw(_numbers(-50, 50)) * scale, draw(_numbers(-50, 50)) * scale)
    return Similarity.of(scale, draw(_numbers(-np.pi, np.pi)), offset, mirror=draw(st.booleans()))


def _star(draw: DrawFn, count: int, low: float, high: float) -> Floats:
    """Points round the origin at equal angles, their distance between two bounds."""
    radius = np.array([draw(_numbers(low, high)) for _ in range(count)])
    angle = TAU * np.arange(count) / count + draw(_numbers(0, 1))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


@st.composite
def star_splines(draw: DrawFn) -> Profile:
    """Closed splines of degree 2 to 5 round a centre, with up to three holes inside the circle that they leave free."""
    degree = draw(st.integers(2, 5))
    poles = _star(draw, draw(st.integers(6, 12)), 1.0, 2.0)
    outer = periodic_spline(poles, degree)
    # The curve stays in the convex hulls of neighbouring poles, all of them beyond half of the smallest distance.
    return Profile.of(outer, _holes(draw, 0.45))


@st.composite
def symmetric_splines(draw: DrawFn) -> Profile:
    """Closed splines that are their own mirror image, some turned into themselves too: events coincide."""
    quarter = [draw(_numbers(0.8, 2.0)) for _ in range(draw(st.integers(2, 4)))]
    radius = np.array((quarter + quarter[::-1]) * draw(st.integers(2, 4)))
    angle = TAU * (np.arange(len(radius)) + draw(st.sampled_from([0.0, 0.5]))) / len(radius)
    poles = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    hole = [circle(0, 0, 0.3)] if draw(st.booleans()) else []
    return Profile.of(periodic_spline(poles, draw(st.integers(2, 4))), hole)


def _holes(draw: DrawFn, reach: float) -> list[Loop]:
    """Up to three holes in sectors of a circle about the origin."""
    count = draw(st.integers(0, 3))
    if count == 1:
        return [_hole(draw, 0.0, 0.0, reach * draw(_numbers(0.2, 0.9)))]
    angle = draw(_numbers(0, TAU)) + TAU * np.arange(count) / max(count, 1)
    middle = reach * 0.55
    return [
        _hole(draw, middle * np.cos(t), middle * np.sin(t), reach * draw(_numbers(0.1, 0.4))) for t in angle.tolist()
    ]


def _hole(draw: DrawFn, x: float, y: float, radius: float) -> Loop:
    """A hole within a circle: round, a polygon, a slot or a spline."""
    kind = draw(st.sampled_from(["round", "polygon", "slot", "spline"]))
    if kind == "round":
        return circle(x, y, radius)
    if kind == "slot":
        return slot(x, y, radius * 0.6, radius * 0.4)
    star = _star(draw, draw(st.integers(3, 6)), 0.4 * radius, radius) + np.array([x, y])
    return polygon([(float(a), float(b)) for a, b in star]) if kind == "polygon" else periodic_spline(star)


@st.composite
def rectilinear(draw: DrawFn) -> Profile:
    """Polygons with sides along the axes and whole coordinates: columns side by side, each overlapping the next."""
    count = draw(st.integers(1, 6))
    columns = [(draw(st.integers(-4, 0)), draw(st.integers(1, 5))) for _ in range(count)]
    bottom = [(x + dx, low) for x, (low, _) in enumerate(columns) for dx in (0, 1)]
    top = [(x + dx, high) for x, (_, high) in reversed(list(enumerate(columns))) for dx in (1, 0)]
    corners = list(dict.fromkeys(bottom + top))  # equal neighbours leave a vertex in the middle of a straight side
    holes = [box(x + 0.25, 0.25, 0.5, 0.5) for x in range(count) if draw(st.booleans())]
    return Profile.of(polygon(corners), holes)


@st.composite
def rounded_polygons(draw: DrawFn) -> Profile:
    """Star-shaped polygons, some of their vertices rounded, with holes."""
    corners = _star(draw, draw(st.integers(4, 8)), 1.0, 2.0)
    sides = np.linalg.norm(corners - np.roll(corners, -1, axis=0), axis=1)
    room = np.minimum(sides, np.roll(sides, 1)) * 0.45
    radii = []
    for k, corner in enumerate(corners):
        u, v = corners[k - 1] - corner, corners[(k + 1) % len(corners)] - corner
        half = np.arccos(np.clip(u @ v / np.linalg.norm(u) / np.linalg.norm(v), -1, 1)) / 2
        largest = min(room[k] * np.tan(half), 5.0)
        radii.append(draw(st.sampled_from([0.0, 0.2, 0.5, 1.0])) * float(largest))
    straight = [np.pi - 1e-3 < _angle(corners, k) < np.pi + 1e-3 for k in range(len(corners))]
    assume(not any(straight))  # a fillet of next to no angle is no edge
    return Profile.of(rounded([(float(x), float(y)) for x, y in corners], radii), _holes(draw, 0.3))


def _angle(corners: Floats, k: int) -> float:
    u, v = corners[k] - corners[k - 1], corners[(k + 1) % len(corners)] - corners[k]
    return float(np.pi - np.arctan2(u[0] * v[1] - u[1] * v[0], u @ v))


@st.composite
def plates(draw: DrawFn) -> Profile:
    """Rectangles with slots, round and square holes in cells of a grid: equal parts, many symmetric junctions."""
    columns, rows = draw(st.integers(1, 3)), draw(st.integers(1, 3))
    holes = []
    for x in range(columns):
        for y in range(rows):
            kind = draw(st.sampled_from(["none", "slot", "round", "square"]))
            if kind == "slot":
                holes.append(slot(x + 0.5, y + 0.5, 0.2, draw(st.sampled_from([0.1, 0.2]))))
            if kind == "round":
                holes.append(circle(x + 0.5, y + 0.5, draw(st.sampled_from([0.1, 0.2, 0.4]))))
            if kind == "square":
                holes.append(box(x + 0.3, y + 0.3, 0.4, 0.4))
    return Profile.of(box(0, 0, columns, rows), holes)


@st.composite
def nearly_square(draw: DrawFn) -> Profile:
    """Rectangles whose two junctions nearly meet."""
    return Profile.of(box(0, 0, 1, 1 + draw(_powers(1, 12))))


@st.composite
def nearly_concentric(draw: DrawFn) -> Profile:
    """Rings, and squares with a round hole, out of centre by a power of ten."""
    shift = draw(_powers(1, 14))
    outer = draw(st.sampled_from([circle(0, 0, 1), box(-1, -1, 2, 2)]))
    return Profile.of(outer, [circle(shift, shift * draw(_numbers(-1, 1)), draw(_numbers(0.2, 0.8)))])


@st.composite
def nearly_round(draw: DrawFn) -> Profile:
    """Ellipses that are nearly circles: a short branch."""
    half = EllipseArc(frozen([0, 0]), frozen([1, 0]), frozen([0, 1 - draw(_powers(1, 6))]), 0.0, TAU)
    return Profile.of(Loop((half,)))


@st.composite
def nearly_touching(draw: DrawFn) -> Profile:
    """A hole close to a wall, or two holes close to one another."""
    gap = draw(_powers(1, 7))
    if draw(st.booleans()):
        return Profile.of(box(-2, -1, 4, 2), [circle(0.3, 0, 1 - gap)])
    return Profile.of(box(-2, -1, 4, 2), [circle(-0.5, 0, 0.5 - gap / 2), circle(0.5, 0.0, 0.5 - gap / 2)])


@st.composite
def slightly_cut(draw: DrawFn) -> Profile:
    """A rectangle with a tiny chamfer, fillet, notch or kink."""
    size = draw(_powers(1, 5))
    kind = draw(st.sampled_from(["chamfer", "fillet", "notch", "kink"]))
    if kind == "fillet":
        return Profile.of(rounded([(0, 0), (3, 0), (3, 2), (0, 2)], [0, size, 0, 0]))
    corners = {
        "chamfer": [(0, 0), (3 - size, 0), (3, size), (3, 2), (0, 2)],
        "notch": [(0, 0), (1, 0), (1, size), (1 + size, size), (1 + size, 0), (3, 0), (3, 2), (0, 2)],
        "kink": [(0, 0), (1, draw(st.sampled_from([-1, 1])) * size), (3, 0), (3, 2), (0, 2)],
    }[kind]
    return Profile.of(polygon([(float(x), float(y)) for x, y in corners]))


@st.composite
def nearly_stadium(draw: DrawFn) -> Profile:
    """Slots whose sides are nearly parallel: two arcs of nearly one radius, joined by their common tangents."""
    apart, big = 3.0, 1.0
    small = big - draw(_powers(1, 7))
    tilt = float(np.arcsin((big - small) / apart))
    # On the upper tangent both radii stand at the same angle.
    up = np.pi / 2 - tilt
    at = [(big * np.cos(up), big * np.sin(up)), (apart + small * np.cos(up), small * np.sin(up))]
    (x0, y0), (x1, y1) = at
    return Profile.of(
        Loop(
            (
                Arc.of((0, 0), big, up, TAU - 2 * up),
                Line.of((x0, -y0), (x1, -y1)),
                Arc.of((apart, 0), small, -up, 2 * up),
                Line.of((x1, y1), (x0, y0)),
            )
        )
    )


class _Drawn:
    """Choices of a mixed profile, see `mixed.Chance`; they shrink to lines, no holes, and numbers in the middle."""

    # Numbers of this many steps, few digits to read: what differs, differs by a ten-thousandth, so that sizes reach
    # over four orders of magnitude. Hypothesis likes numbers next to one another; with a million steps it makes knots
    # that are a millionth apart, see `test_knots_a_millionth_apart`.
    _STEPS = 10**4
    # Points all over a box: multiples of these, less their whole part, fill it evenly (golden section in the plane).
    _EVENLY = np.array([0.7548776662466927, 0.5698402909980532])

    def __init__(self, draw: DrawFn) -> None:
        self._draw = draw

    def uniform(self, low: float, high: float) -> float:
        """See `Chance.uniform`."""
        half = self._STEPS // 2
        return low + (high - low) * (half + self._draw(st.integers(-half, half))) / self._STEPS

    def uniforms(self, low: float, high: float, count: int) -> Floats:
        """See `Chance.uniforms`."""
        return np.array([self.uniform(low, high) for _ in range(count)])

    def whole(self, low: int, high: int) -> int:
        """See `Chance.whole`."""
        return self._draw(st.integers(low, high - 1))

    def likely(self, share: float) -> bool:
        """See `Chance.likely`."""
        return self._draw(st.integers(0, 999)) >= 1000 * (1 - share)

    def places(self, bounds: tuple[float, float, float, float]) -> list[shapely.Point]:
        """See `Chance.places`: one place is drawn, the others are spread from there."""
        first = [self.uniform(0, 1), self.uniform(0, 1)]
        shares = (first + np.arange(40)[:, None] * self._EVENLY) % 1.0
        low, high = np.array(bounds[:2]), np.array(bounds[2:])
        return [shapely.Point(*place) for place in (low + shares * (high - low)).tolist()]


@st.composite
def profiles(draw: DrawFn) -> Profile:
    """Profiles of everything: stars and winding bands, lines, arcs, splines of degree 2 to 5, rational ones, holes.

    Where sides cross one another they are drawn straight; how close they come otherwise is left to chance.
    """
    chance = _Drawn(draw)
    return with_holes(chance, straightened(mixed_outline(chance)))


@st.composite
def crossing_profiles(draw: DrawFn) -> Profile:
    """The same as they are drawn: about a quarter of them cross themselves."""
    chance = _Drawn(draw)
    return with_holes(chance, mixed_outline(chance))


EVERYDAY: dict[str, Callable[[], SearchStrategy[Profile]]] = {
    make.__name__.replace("_", " "): make
    for make in (star_splines, symmetric_splines, rectilinear, rounded_polygons, plates)
}
ALMOST_DEGENERATE: dict[str, Callable[[], SearchStrategy[Profile]]] = {
    make.__name__.replace("_", " "): make
    for make in (
        nearly_square,
        nearly_concentric,
        nearly_round,
        nearly_touching,
        slightly_cut,
        nearly_stadium,
    )
}
