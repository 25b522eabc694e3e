"""The boundary as a tour of elements: rational Bezier spans, and a cone at each reflex vertex.

Terminology
-----------
element
    A *span* (one rational Bezier piece of an edge) or a *cone* (a reflex vertex, whose inward normals fill an angle).
place
    ``(element, t)`` with ``0 <= t < 1``: a point of the boundary together with one inward normal. On a cone ``t``
    turns the normal from that of the span before to that of the span after.
border
    The start ``(element, 0)`` of an element: smooth, or a convex vertex.

A tour is scaled: its larger side has length 1 and its middle lies in the origin, so that tolerances are pure numbers.
The interior lies on the left; the inward normal is the tangent turned by +90 degrees; curvature is positive where the
boundary bends inwards.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from mashape_cad.errors import InvalidProfileError
from mashape_cad.geometry.edge import Edge, Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.bezier import evaluate, power_distance

__all__ = ["ROUND", "Frame", "Ints", "Tour", "site", "tour"]

Ints = NDArray[np.int64]

# Tangents that differ by less (radians) join smoothly: the disc that touches at such a kink is entered by no more than
# r * kink^2 / 2, which is below `EMPTY`. A wider convex kink is a vertex with a branch of its own, however thin.
_SMOOTH = 1e-7
# Files keep about nine digits, so splines that were smooth meet at kinks of 1e-9 to 1e-6 radians. Where the control
# points next to a kink have to move by no more than this (sizes of the shape) to take it out, they are moved.
_DIGITS = 1e-8
# A turn this close to 180 degrees (radians) is a cusp: the two edges leave the vertex in the same direction.
_CUSP = 1e-7
# A span is circular if it stays this close to a circle (sizes of the shape): exporters write round holes as splines,
# and the curvature of such a span has maxima that are noise. Recorded as the tolerance of the disc that fills the
# circle.
ROUND = 1e-9
# A circle of more than this radius (sizes) is as good as a straight line: its centre would be noise.
_FLAT = 1e4
# Samples that seed the search for a touching place. Fewer cost a restart of that search, never an answer.
_SAMPLES_CURVED, _SAMPLES_STRAIGHT = 12, 5


class Tour(NamedTuple):
    """All elements of a profile's boundary as arrays (a named tuple, so that compiled code takes it).

    Attributes
    ----------
    control : (n, d + 1, 3) array
        Homogeneous control points of spans; row 0 of a cone is its vertex.
    degree : (n,) array
        Degree of a span; 0 marks a cone.
    cone : (n, 2) array
        Of a cone: angle of its first normal and the (negative) angle over which it turns, radians.
    after, before : (n,) arrays
        Neighbouring elements on the loop.
    convex : (n,) bool array
        Whether the border at the element's start is a convex vertex.
    loop : (n,) array
        Number of the loop.
    edge : (n,) array
        Number of the edge in ``profile.edges`` (of a cone: the edge that starts there).
    edge_from, edge_to : (n,) arrays
        Edge parameter at the element's ends.
    box : (n, 4) array
        xmin, ymin, xmax, ymax of the control points.
    sample : (k, 2) array
        Points on the spans, with `sample_element` and `sample_t`.
    round_centre : (n, 2) array
        Centre of the span's circle, where it is circular and bends inwards, else NaN; `round_radius` likewise.
    """

    control: Floats
    degree: Ints
    cone: Floats
    after: Ints
    before: Ints
    convex: NDArray[np.bool_]
    loop: Ints
    edge: Ints
    edge_from: Floats
    edge_to: Floats
    box: Floats
    sample: Floats
    sample_element: Ints
    sample_t: Floats
    round_centre: Floats
    round_radius: Floats


class Frame(NamedTuple):
    """Where the scaled tour lies in the profile's coordinates: ``profile point = middle + size * point``."""

    middle: Floats
    size: float


@njit(cache=True)
def site(tour: Tour, e: int, t: float) -> tuple[float, float, float, float, float, float]:
    """Return what a maximal disc sees of a place.

    Returns
    -------
    x, y : float
        Position.
    nx, ny : float
        Inward unit normal.
    curvature : float
        Of the boundary; -inf on a cone.
    speed : float
        Length of the derivative by ``t``; 0 on a cone.
    """
    if tour.degree[e] == 0:
        angle = tour.cone[e, 0] + t * tour.cone[e, 1]
        return tour.control[e, 0, 0], tour.control[e, 0, 1], math.cos(angle), math.sin(angle), -math.inf, 0.0
    x, y, dx, dy, ddx, ddy = evaluate(tour.control[e], tour.degree[e], t)
    speed = math.hypot(dx, dy)
    return x, y, -dy / speed, dx / speed, (dx * ddy - dy * ddx) / speed**3, speed


def tour(profile: Profile) -> tuple[Tour, Frame]:
    """Lay a profile's boundary out as a tour.

    Raises
    ------
    InvalidProfileError
        If an edge has no length, a loop does not close, or two edges leave a vertex in the same direction.
    """
    low, high = profile.bounds
    frame = Frame((low + high) / 2, float(np.max(high - low)))
    if not (np.isfinite(frame.size) and frame.size > 0):
        raise InvalidProfileError("degenerate", "the profile has no extent")
    builder = _Builder(frame)
    number = 0
    for index, loop in enumerate(profile.loops):
        builder.add_loop(index, loop.edges, number)
        number += len(loop.edges)
    return builder.tour(), frame


_Span = tuple[Floats, int, float, float]  # control points, edge number, edge parameter at both ends


class _Builder:
    """Collects elements loop by loop."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.control: list[Floats] = []
        self.rows: list[tuple[int, int, int, float, float]] = []  # degree, loop, edge, edge_from, edge_to
        self.cone: list[tuple[float, float]] = []
        self.convex: list[bool] = []
        self.after: list[int] = []
        self.round: list[tuple[float, float, float]] = []

    def add_loop(self, index: int, edges: tuple[Edge, ...], number: int) -> None:
        """Append the elements of one loop."""
        spans = [span for k, edge in enumerate(edges) for span in self._spans(edge, number + k)]
        _close(spans, self.frame)
        _straighten(spans)
        first = len(self.rows)
        for k, (control, edge, start, end) in enumerate(spans):
            self._add_border(spans[k - 1][0], control, index, edge)
            self._append(control, (len(control) - 1, index, edge, start, end))
        count = len(self.rows) - first
        self.after += [first + (k + 1) % count for k in range(count)]

    def _spans(self, edge: Edge, number: int) -> list["_Span"]:
        """Scale an edge's Bezier pieces into the tour's frame."""
        controls, breaks = edge.spans()
        controls = controls.copy()
        controls[..., :2] = (controls[..., :2] - self.frame.middle * controls[..., 2:]) / self.frame.size
        return [(control, number, float(breaks[k]), float(breaks[k + 1])) for k, control in enumerate(controls)]

    def _add_border(self, left: Floats, right: Floats, loop: int, edge: int) -> None:
        """Classify the vertex between two spans; a reflex one becomes a cone."""
        (ux, uy), (vx, vy) = _leg(left[::-1]), _leg(right)
        ux, uy = -ux, -uy
        turn = _turn((ux, uy), (vx, vy))
        if turn > math.pi - _CUSP:
            place = right[0, :2] / right[0, 2] * self.frame.size + self.frame.middle
            text = f"two edges leave the vertex ({place[0]:.6g}, {place[1]:.6g}) in the same direction"
            raise InvalidProfileError("cusp", text, (float(place[0]), float(place[1])))
        self.convex.append(turn > _SMOOTH)
        if turn < -_SMOOTH:
            vertex = np.zeros_like(right)
            vertex[0] = right[0] / right[0, 2]
            self.cone.append((math.atan2(uy, ux) + math.pi / 2, turn))
            self.control.append(vertex)
            self.rows.append((0, loop, edge, 0.0, 0.0))
            self.round.append((math.nan, math.nan, math.nan))
            self.convex.append(False)

    def _append(self, control: Floats, row: tuple[int, int, int, float, float]) -> None:
        self.control.append(control)
        self.rows.append(row)
        self.cone.append((math.nan, math.nan))
        self.round.append(_circle(control))

    def tour(self) -> Tour:
        """Stack what was collected."""
        degree, loop, edge = (np.array([row[k] for row in self.rows], dtype=np.int64) for k in range(3))
        control = np.zeros((len(self.rows), max(int(degree.max()), 1) + 1, 3))
        for k, points in enumerate(self.control):
            control[k, : len(points)] = points
        after = np.array(self.after, dtype=np.int64)
        before = np.empty_like(after)
        before[after] = np.arange(len(after))
        rounds = np.array(self.round)
        sample, sample_element, sample_t = _samples(control, degree)
        return Tour(
            control,
            degree,
            np.array(self.cone),
            after,
            before,
            np.array(self.convex),
            loop,
            edge,
            np.array([row[3] for row in self.rows]),
            np.array([row[4] for row in self.rows]),
            np.array([_box(points, d) for points, d in zip(control, degree, strict=True)]),
            sample,
            sample_element,
            sample_t,
            rounds[:, :2].copy(),
            rounds[:, 2].copy(),
        )


def _close(spans: list["_Span"], frame: Frame, tol: float = 1e-9) -> None:
    """Make consecutive spans share their end point to the last bit.

    Readers join edges far closer than `tol`; a wider gap means that the profile was not closed.
    """
    for k, (right, *_) in enumerate(spans):
        left = spans[k - 1][0]
        p, q = left[-1, :2] / left[-1, 2], right[0, :2] / right[0, 2]
        if not np.hypot(*(p - q)) <= tol:
            place = q * frame.size + frame.middle
            text = f"the loop is open at ({place[0]:.6g}, {place[1]:.6g})"
            raise InvalidProfileError("open", text, (float(place[0]), float(place[1])))
        middle = (p + q) / 2
        left[-1, :2], right[0, :2] = middle * left[-1, 2], middle * right[0, 2]
        if np.ptp(right[:, :2] / right[:, 2:], axis=0).max() <= tol:
            place = q * frame.size + frame.middle
            text = f"an edge at ({place[0]:.6g}, {place[1]:.6g}) has no length"
            raise InvalidProfileError("zero-length", text, (float(place[0]), float(place[1])))


def _straighten(spans: list["_Span"]) -> None:
    """Take out kinks that are the rounding of the file's digits, by turning the control legs next to them."""
    for k, (right, *_) in enumerate(spans):
        left = spans[k - 1][0]
        legs = [_leg(left[::-1]), _leg(right)]
        turn = _turn((-legs[0][0], -legs[0][1]), legs[1])
        free = [len(span) > 3 and len(spans) > 1 for span in (left, right)]  # lines and quadratics share their legs
        share = abs(turn) / max(1, sum(free))
        if turn == 0.0 or not any(free) or share * max(np.hypot(*leg) for leg in legs) > _DIGITS:
            continue
        for span, movable, sign in ((left[::-1], free[0], 1.0), (right, free[1], -1.0)):
            if movable:
                _turn_leg(span, sign * math.copysign(share, turn))


def _turn(u: tuple[float, float], v: tuple[float, float]) -> float:
    """Angle from one direction to another, radians."""
    return math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])


def _turn_leg(control: Floats, angle: float) -> None:
    """Turn a span's first control leg about its first point."""
    x, y = control[1, :2] / control[1, 2] - control[0, :2] / control[0, 2]
    cos, sin = math.cos(angle), math.sin(angle)
    control[1, :2] = (control[0, :2] / control[0, 2] + (cos * x - sin * y, sin * x + cos * y)) * control[1, 2]


def _circle(control: Floats) -> tuple[float, float, float]:
    """Centre and radius of the circle that a span follows within `ROUND`, bending inwards; NaN if there is none."""
    none = (math.nan, math.nan, math.nan)
    degree = len(control) - 1
    if degree < 2:
        return none
    p, m, q = (np.array(evaluate(control, degree, t)[:2]) for t in (0.0, 0.5, 1.0))
    u, v = m - p, q - p
    cross = float(u[0] * v[1] - u[1] * v[0])
    if cross <= np.hypot(*u) * np.hypot(*v) * np.hypot(*(q - m)) / (2 * _FLAT):
        return none
    centre = p + np.array([v[1] * (u @ u) - u[1] * (v @ v), u[0] * (v @ v) - v[0] * (u @ u)]) / (2 * cross)
    radius = float(np.hypot(*(p - centre)))
    power = power_distance(control, degree, centre[0], centre[1], radius)
    if np.abs(power).max() > 2 * radius * ROUND * control[:, 2].max() ** 2:
        return none
    return float(centre[0]), float(centre[1]), radius


def _leg(control: Floats) -> tuple[float, float]:
    """Direction in which a span leaves its first point: the first control leg that has a length."""
    points = control[:, :2] / control[:, 2:]
    legs = points[1:] - points[0]
    lengths = np.hypot(legs[:, 0], legs[:, 1])
    leg = legs[np.argmax(lengths > 1e-9 * lengths.max())]
    return float(leg[0]), float(leg[1])


def _box(control: Floats, degree: int) -> tuple[float, float, float, float]:
    points = control[: degree + 1, :2] / control[: degree + 1, 2:]
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    return float(x0), float(y0), float(x1), float(y1)


def _samples(control: Floats, degree: Ints) -> tuple[Floats, Ints, Floats]:
    """Points that seed the search, in the middle of equal parameter steps."""
    element: list[int] = []
    t: list[float] = []
    for e, d in enumerate(degree):
        count = 0 if d == 0 else _SAMPLES_STRAIGHT if d == 1 else _SAMPLES_CURVED
        element += [e] * count
        t += [(k + 0.5) / count for k in range(count)]
    points = np.array([evaluate(control[e], degree[e], s)[:2] for e, s in zip(element, t, strict=True)])
    return points, np.array(element, dtype=np.int64), np.array(t)
