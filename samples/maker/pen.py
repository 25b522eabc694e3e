"""A pen that draws closed outlines out of lines, arcs and cubic B-splines, with corners rounded by freeform blends.

Lengths in mm, angles in degrees, as one draws. Where no heading is given, a curve ends freely (no curvature there).
"""

from collections.abc import Sequence
from math import cos, hypot, radians, sin, tan

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.optimize import brentq

from mashape_cad.geometry.edge import Arc, BSpline, Edge, Floats, Line, Similarity
from mashape_cad.geometry.profile import Loop

__all__ = ["Pen", "circle", "closed_curve", "moved", "slot"]

Point = tuple[float, float]
Corner = tuple[Edge, float]  # an edge, and how much of it the rounding at its end may take away

# Knots spaced by chord ** 0.7: between centripetal (0.5, no overshoot) and chord length (1, even speed).
_SPACING = 0.7


class Pen:
    """Draws one loop; every stroke starts where the last one ended.

    A stroke's `rounded` is the size of the blend at its end: it starts and ends that far from the corner.
    """

    def __init__(self, x: float, y: float, rounded: float = 0.0) -> None:
        self._start, self._start_rounded = (x, y), rounded
        self._at: Point = (x, y)
        self._strokes: list[Corner] = []

    def line(self, x: float, y: float, rounded: float = 0.0) -> "Pen":
        """Draw a straight stroke."""
        return self._draw(Line.of(self._at, (x, y)), (x, y), rounded)

    def curve(
        self, *points: Point, leave: float | None = None, arrive: float | None = None, rounded: float = 0.0
    ) -> "Pen":
        """Draw a cubic B-spline through `points`; `leave` and `arrive` are its headings at the two ends."""
        through = np.array([self._at, *points], float)
        return self._draw(_interpolated(through, leave, arrive), points[-1], rounded)

    def arc(self, x: float, y: float, bulge: float, rounded: float = 0.0) -> "Pen":
        """Draw a circular arc; `bulge` is its height over half its chord, positive when it turns left."""
        return self._draw(_arc(self._at, (x, y), bulge), (x, y), rounded)

    def close(self) -> Loop:
        """Return the loop; a last straight stroke is added if the pen is not back at the start."""
        if hypot(self._at[0] - self._start[0], self._at[1] - self._start[1]) > 0:
            self.line(*self._start)
        *strokes, (last, _) = self._strokes
        return _rounded([*strokes, (last, self._start_rounded)])

    def mirror_close(self) -> Loop:
        """Return the loop made of what was drawn, from axis to axis, and its mirror image in the axis x = 0."""
        back = [stroke for stroke, _ in reversed(self._strokes)]
        rounded = [size for _, size in self._strokes]
        mirror_rounded = [*reversed(rounded[:-1]), self._start_rounded]
        image = [(edge.transformed(_MIRROR).reversed(), size) for edge, size in zip(back, mirror_rounded, strict=True)]
        return _rounded([*self._strokes, *image])

    def _draw(self, edge: Edge, end: Point, rounded: float) -> "Pen":
        self._strokes.append((edge, rounded))
        self._at = end
        return self


_MIRROR = Similarity(np.array([[-1.0, 0.0], [0.0, 1.0]]), np.zeros(2))


def circle(x: float, y: float, radius: float) -> Loop:
    """Return a full circle."""
    return Loop((Arc.of((x, y), radius),))


def slot(x: float, y: float, length: float, width: float, angle: float = 0.0) -> Loop:
    """Return a slot with round ends about its centre; `length` is over all."""
    half, radius = (length - width) / 2, width / 2
    pen = Pen(-half, -radius).line(half, -radius).arc(half, radius, 1).line(-half, radius).arc(-half, -radius, 1)
    return moved(pen.close(), x, y, angle)


def closed_curve(*points: Point) -> Loop:
    """Return one smooth closed cubic B-spline through `points`."""
    through = np.array([*points, points[0]], float)
    knots = _spacing(through)
    around = make_interp_spline(knots, through, k=3, bc_type="periodic")
    heading = around(knots[0], nu=1)  # the same curve again, but clamped, as drawing files like it
    return Loop((_clamped_spline(knots, through, [(1, heading)], [(1, heading)]),))


def moved(loop: Loop, x: float, y: float, angle: float = 0.0, scale: float = 1.0) -> Loop:
    """Return the loop scaled, turned by `angle` degrees about the origin, then moved by (x, y)."""
    return loop.transformed(Similarity.of(scale, radians(angle), (x, y)))


def _spacing(points: Floats) -> Floats:
    chords = np.hypot(*np.diff(points, axis=0).T) ** _SPACING
    return np.concatenate([[0.0], np.cumsum(chords)])


def _interpolated(points: Floats, leave: float | None, arrive: float | None) -> BSpline:
    knots = _spacing(points)
    speeds = np.hypot(*np.diff(points, axis=0).T) / np.diff(knots)
    return _clamped_spline(knots, points, _end(leave, speeds[0]), _end(arrive, speeds[-1]))


def _end(heading: float | None, speed: float) -> list[tuple[int, Sequence[float]]]:
    """Condition of an end: given first derivative, or none of the second."""
    if heading is None:
        return [(2, (0.0, 0.0))]
    return [(1, (speed * cos(radians(heading)), speed * sin(radians(heading))))]


def _clamped_spline(
    knots: Floats,
    points: Floats,
    first: list[tuple[int, Sequence[float]]],
    last: list[tuple[int, Sequence[float]]],
) -> BSpline:
    spline = make_interp_spline(knots, points, k=3, bc_type=(first, last))
    poles = np.array(spline.c)
    poles[0], poles[-1] = points[0], points[-1]  # to the last bit, so that loops close
    return BSpline.of(3, spline.t / spline.t[-1], poles)


def _arc(start: Point, end: Point, bulge: float) -> Arc:
    sweep = 4 * np.arctan(bulge)
    chord = np.subtract(end, start)
    normal = np.array([-chord[1], chord[0]])
    centre = np.add(start, end) / 2 + normal / (2 * tan(sweep / 2)) if abs(bulge) != 1 else np.add(start, end) / 2
    angle = np.arctan2(*np.subtract(start, centre)[::-1])
    return Arc.of(centre, float(np.hypot(*np.subtract(start, centre))), angle, sweep)


def _rounded(corners: list[Corner]) -> Loop:
    """Cut every edge back at its rounded ends and put a blend between."""
    sizes = [size for _, size in corners]
    kept = [_cut(edge, sizes[i - 1], sizes[i]) for i, (edge, _) in enumerate(corners)]
    edges: list[Edge] = []
    for edge, following, size in zip(kept, [*kept[1:], kept[0]], sizes, strict=True):
        edges += [edge, _blend(edge, following, size)] if size > 0 else [edge]
    return Loop(tuple(edges))


def _cut(edge: Edge, front: float, back: float) -> Edge:
    """Take `front` mm off the start and `back` mm off the end."""
    if back > 0:
        edge = edge.split(_parameter(edge, edge.length() - back))[0]
    return edge.split(_parameter(edge, front))[1] if front > 0 else edge


def _parameter(edge: Edge, length: float) -> float:
    """Return where `edge` is `length` long."""
    if not 0 < length < edge.length():
        raise ValueError(f"a rounding needs more than the {edge.length():.2f} mm that its edge has")
    return float(brentq(lambda u: edge.length_up_to(u) - length, 0.0, 1.0, xtol=1e-14))


def _blend(edge: Edge, following: Edge, size: float) -> BSpline:
    """One Bezier span, tangent to both edges, as long as the circular arc it resembles."""
    start, leave, _ = edge.derivatives([1.0])[0]
    end, arrive, _ = following.derivatives([0.0])[0]
    leave, arrive = leave / np.hypot(*leave), arrive / np.hypot(*arrive)
    turn = abs(np.arctan2(leave[0] * arrive[1] - leave[1] * arrive[0], leave @ arrive))
    handle = size * 4 / 3 * tan(turn / 4) / tan(turn / 2)
    return BSpline.of(3, [0, 0, 0, 0, 1, 1, 1, 1], [start, start + handle * leave, end - handle * arrive, end])
