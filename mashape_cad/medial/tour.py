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
from numpy.typing import NDArray

from mashape_cad.errors import InvalidProfileError
from mashape_cad.geometry.edge import EllipseArc, Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.bezier import evaluate, halve, power_distance
from mashape_cad.medial.compiled import Records, compiled, records

__all__ = [
    "ROUND",
    "RUN",
    "Frame",
    "Ints",
    "Tour",
    "box_apart",
    "chord_squared",
    "loop_count",
    "run_apart",
    "site",
    "tour",
]

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
# As near as rounding lets an arc come to its circle (sizes).
_TO_ROUNDING = 1e-14
# A circle of more than this radius (sizes) is as good as a straight line: its centre would be noise.
_FLAT = 1e4
# Spacing of numbers at a profile's place, in its sizes, beyond which its shape is lost in rounding.
_FAR = 1e-9
# Loops are closed by moving ends at most this far (sizes); readers join edges far closer. An edge shorter than this has
# no length.
_JOINED = 1e-9
# Samples that seed the search for a touching place. Fewer cost a restart of that search, never an answer.
_SAMPLES_CURVED, _SAMPLES_STRAIGHT = 12, 5
# So many consecutive elements have a box in common: who looks for what is near passes by those far off at once.
RUN = 16
# Parts into which a span is cut for the frame's box; a power of two.
_BOX_PARTS = 8
# What may be wrong with a boundary.
_SOUND, _OPEN, _NO_LENGTH, _IS_CUSP = range(4)


# One row for each element. A record array and not an array for each field: compiled functions hand a tour on at every
# call, and what is handed on piece by piece costs most of the time that compiling takes.
ELEMENT = np.dtype(
    [
        ("degree", np.int64),
        ("after", np.int64),
        ("before", np.int64),
        ("loop", np.int64),
        ("edge", np.int64),
        ("edge_from", np.float64),
        ("edge_to", np.float64),
        ("angle", np.float64),
        ("cone_angle", np.float64),
        ("cone_turn", np.float64),
        ("x0", np.float64),
        ("y0", np.float64),
        ("x1", np.float64),
        ("y1", np.float64),
        ("round_x", np.float64),
        ("round_y", np.float64),
        ("round_radius", np.float64),
        ("sample_from", np.int64),
        ("sample_to", np.int64),
        ("convex", np.bool_),
    ],
    align=True,
)


class Tour(NamedTuple):
    """All elements of a profile's boundary (a named tuple, so that compiled code takes it).

    Attributes
    ----------
    control : (n, d + 1, 3) array
        Homogeneous control points of spans; row 0 of a cone is its vertex.
    element : (n,) record array
        Of each element:

        * ``degree``: of a span; 0 marks a cone;
        * ``after``, ``before``: neighbours on the loop;
        * ``loop``, ``edge``: numbers of the loop, and of the edge in ``profile.edges`` (of a cone: that which starts
          there); ``edge_from``, ``edge_to``: the edge's parameter at the ends;
        * ``angle``: signed angle over which an elliptic arc's span runs, radians; 0 on others;
        * ``cone_angle``, ``cone_turn``: angle of a cone's first normal and the (negative) angle over which it turns;
        * ``x0``, ``y0``, ``x1``, ``y1``: box of the control points;
        * ``round_x``, ``round_y``, ``round_radius``: the span's circle, where it is circular and bends inwards, else
          NaN;
        * ``sample_from``, ``sample_to``: its rows of `sample`;
        * ``convex``: whether the border at its start is a convex vertex.
    sample : (k, 3) array
        Points on the spans with their parameters: x, y, t.
    run : (ceil(n / RUN), 4) array
        Boxes of consecutive elements, `RUN` to each: x0, y0, x1, y1; cones lie at the ends of spans.
    """

    control: Floats
    element: Records
    sample: Floats
    run: Floats

    @property
    def degree(self) -> Ints:
        """Degree of each element, (n,)."""
        return self.element["degree"]

    @property
    def loop(self) -> Ints:
        """Number of the loop, (n,)."""
        return self.element["loop"]

    @property
    def edge(self) -> Ints:
        """Number of the edge, (n,)."""
        return self.element["edge"]

    @property
    def after(self) -> Ints:
        """The next element, (n,)."""
        return self.element["after"]

    @property
    def before(self) -> Ints:
        """The element before, (n,)."""
        return self.element["before"]

    @property
    def convex(self) -> NDArray[np.bool_]:
        """Whether a convex vertex starts it, (n,)."""
        return self.element["convex"]

    @property
    def edge_from(self) -> Floats:
        """Edge parameter at the start, (n,)."""
        return self.element["edge_from"]

    @property
    def edge_to(self) -> Floats:
        """Edge parameter at the end, (n,)."""
        return self.element["edge_to"]

    @property
    def round_radius(self) -> Floats:
        """Radius of the circle, (n,)."""
        return self.element["round_radius"]

    @property
    def cone(self) -> Floats:
        """First angle and turn of cones, (n, 2)."""
        return np.column_stack([self.element[name] for name in ("cone_angle", "cone_turn")])

    @property
    def box(self) -> Floats:
        """Boxes, (n, 4)."""
        return np.column_stack([self.element[name] for name in ("x0", "y0", "x1", "y1")])

    @property
    def round_centre(self) -> Floats:
        """Centres of circles, (n, 2)."""
        return np.column_stack([self.element[name] for name in ("round_x", "round_y")])


class Frame(NamedTuple):
    """Where the scaled tour lies in the profile's coordinates: ``profile point = middle + size * point``."""

    middle: Floats
    size: float


@compiled
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
    if tour.element[e].degree == 0:
        angle = tour.element[e].cone_angle + t * tour.element[e].cone_turn
        return tour.control[e, 0, 0], tour.control[e, 0, 1], math.cos(angle), math.sin(angle), -math.inf, 0.0
    x, y, dx, dy, ddx, ddy = evaluate(tour.control[e], tour.element[e].degree, t)
    speed = math.hypot(dx, dy)
    return x, y, -dy / speed, dx / speed, (dx * ddy - dy * ddx) / speed**3, speed


class _Spans(NamedTuple):
    """The edges as rational Bezier pieces in the order of the boundary; names as in `Tour`."""

    control: Floats
    degree: Ints
    loop: Ints
    edge: Ints
    edge_from: Floats
    edge_to: Floats
    angle: Floats


def tour(profile: Profile) -> tuple[Tour, Frame]:
    """Lay a profile's boundary out as a tour.

    Raises
    ------
    InvalidProfileError
        If an edge has no length, a loop does not close, or two edges leave a vertex in the same direction.
    """
    spans = _spans(profile)
    outer = int(np.count_nonzero(spans.loop == 0))
    x0, y0, x1, y1 = _box_of(spans.control[:outer], spans.degree[:outer])
    frame = Frame(np.array([(x0 + x1) / 2, (y0 + y1) / 2]), max(x1 - x0, y1 - y0))
    if not (math.isfinite(frame.size) and frame.size > 0):
        raise InvalidProfileError("degenerate", "the profile has no extent")
    far = float(np.abs(frame.middle).max())
    if far * np.finfo(float).eps > _FAR * frame.size:
        text = f"a profile of {frame.size:.3g} mm lies {far:.3g} mm from the origin, where its digits are lost; move it"
        raise InvalidProfileError("far-off", text, (float(frame.middle[0]), float(frame.middle[1])))
    flaw, x, y = _prepare(spans, frame.middle[0], frame.middle[1], frame.size)
    if flaw != _SOUND:
        raise _refusal(flaw, x * frame.size + float(frame.middle[0]), y * frame.size + float(frame.middle[1]))
    out = _blank(*_extent(spans), spans.control.shape[1])
    _lay_out(spans, out)
    return out, frame


def _blank(elements: int, samples: int, rows: int) -> Tour:
    element = np.zeros(elements, ELEMENT)
    for name in ("cone_angle", "cone_turn", "round_x", "round_y", "round_radius"):
        element[name] = np.nan
    runs = -(-elements // RUN)
    return Tour(np.zeros((elements, rows, 3)), records(element), np.empty((samples, 3)), np.empty((runs, 4)))


@compiled
def loop_count(tour: Tour) -> int:
    """Return how many loops there are; they follow one another."""
    return tour.element[len(tour.element) - 1].loop + 1


def _spans(profile: Profile) -> _Spans:
    """Collect the Bezier pieces of all edges."""
    pieces = [(loop, edge, *edge.spans()) for loop, part in enumerate(profile.loops) for edge in part.edges]
    counts = [len(control) for _, _, control, _ in pieces]
    total, widest = sum(counts), max(control.shape[1] for _, _, control, _ in pieces)
    low = np.concatenate([breaks[:-1] for *_, breaks in pieces])
    high = np.concatenate([breaks[1:] for *_, breaks in pieces])
    sweeps = np.repeat([edge.sweep if isinstance(edge, EllipseArc) else 0.0 for _, edge, _, _ in pieces], counts)
    spans = _Spans(
        np.zeros((total, max(widest, 2), 3)),
        np.repeat([control.shape[1] - 1 for _, _, control, _ in pieces], counts),
        np.repeat([loop for loop, _, _, _ in pieces], counts),
        np.repeat(np.arange(len(pieces)), counts),
        low,
        high,
        (high - low) * sweeps,
    )
    at = 0
    for _, _, control, _ in pieces:
        spans.control[at : at + len(control), : control.shape[1]] = control
        at += len(control)
    return spans


def _refusal(flaw: int, x: float, y: float) -> InvalidProfileError:
    kind, text = {
        _OPEN: ("open", f"the loop is open at ({x:.6g}, {y:.6g})"),
        _NO_LENGTH: ("zero-length", f"an edge at ({x:.6g}, {y:.6g}) has no length"),
        _IS_CUSP: ("cusp", f"two edges leave the vertex ({x:.6g}, {y:.6g}) in the same direction"),
    }[flaw]
    return InvalidProfileError(kind, text, (x, y))


@compiled
def _box_of(control: Floats, degree: Ints) -> tuple[float, float, float, float]:
    """Return a box that surely holds some spans: that of their control points of its eighths."""
    x0, x1, y0, y1 = math.inf, -math.inf, math.inf, -math.inf
    rows = control.shape[1]
    parts = np.empty((_BOX_PARTS, rows, 3))
    for e in range(len(control)):
        n = degree[e] + 1
        for j in range(3):
            for i in range(n):
                parts[0, i, j] = control[e, i, j]
        count = 1
        while count < _BOX_PARTS and n > 2:
            for k in range(count - 1, -1, -1):
                for j in range(3):
                    halve(parts[k, :n, j], parts[2 * k, :n, j], parts[2 * k + 1, :n, j])
            count *= 2
        for k in range(count):
            a, b, c, d = _control_box(parts[k], degree[e])
            x0, y0, x1, y1 = min(x0, a), min(y0, b), max(x1, c), max(y1, d)
    return x0, y0, x1, y1


@compiled
def _prepare(spans: _Spans, middle_x: float, middle_y: float, size: float) -> tuple[int, float, float]:
    """Scale the spans, close the loops to the last bit and take out kinks that are rounding.

    Returns
    -------
    flaw : int
        `_SOUND`, or what is wrong.
    x, y : float
        Where, scaled.
    """
    control = spans.control
    for e in range(len(control)):
        for i in range(spans.degree[e] + 1):
            control[e, i, 0] = (control[e, i, 0] - middle_x * control[e, i, 2]) / size
            control[e, i, 1] = (control[e, i, 1] - middle_y * control[e, i, 2]) / size
    before = _before(spans.loop)
    for e in range(len(control)):
        flaw, x, y = _joined(spans, before[e], e)
        if flaw != _SOUND:
            return flaw, x, y
    for e in range(len(control)):
        if before[e] != e:
            _straighten(spans, before[e], e)
    for e in range(len(control)):
        if abs(_turn_between(spans, before[e], e)[0]) > math.pi - _CUSP:
            return _IS_CUSP, control[e, 0, 0] / control[e, 0, 2], control[e, 0, 1] / control[e, 0, 2]
    return _SOUND, 0.0, 0.0


@compiled
def _before(loop: Ints) -> Ints:
    """For elements in the order of their loops: the one before each."""
    n = len(loop)
    before = np.empty(n, np.int64)
    first = 0
    for e in range(n):
        if loop[e] != loop[first]:
            first = e
        before[e] = e - 1
        if e == n - 1 or loop[e + 1] != loop[e]:
            before[first] = e
    return before


@compiled
def _joined(spans: _Spans, left: int, right: int) -> tuple[int, float, float]:
    """Make two consecutive spans share their common point to the last bit; tell if they cannot."""
    a, b = spans.control[left, spans.degree[left]], spans.control[right, 0]
    ax, ay, bx, by = a[0] / a[2], a[1] / a[2], b[0] / b[2], b[1] / b[2]
    if not math.hypot(ax - bx, ay - by) <= _JOINED:
        return _OPEN, bx, by
    x, y = (ax + bx) / 2, (ay + by) / 2
    a[0], a[1], b[0], b[1] = x * a[2], y * a[2], x * b[2], y * b[2]
    x0, y0, x1, y1 = _control_box(spans.control[right], spans.degree[right])
    return (_NO_LENGTH if max(x1 - x0, y1 - y0) <= _JOINED else _SOUND), x, y


@compiled
def _control_box(control: Floats, degree: int) -> tuple[float, float, float, float]:
    x0 = x1 = control[0, 0] / control[0, 2]
    y0 = y1 = control[0, 1] / control[0, 2]
    for i in range(1, degree + 1):
        x, y = control[i, 0] / control[i, 2], control[i, 1] / control[i, 2]
        x0, x1, y0, y1 = min(x0, x), max(x1, x), min(y0, y), max(y1, y)
    return x0, y0, x1, y1


@compiled
def _leg(control: Floats, degree: int, at_end: bool) -> tuple[float, float]:
    """Direction in which a span leaves one of its ends: the first control leg from there that has a length."""
    end, step = (degree, -1) if at_end else (0, 1)
    ex, ey = control[end, 0] / control[end, 2], control[end, 1] / control[end, 2]
    longest = 0.0
    for i in range(1, degree + 1):
        row = end + step * i
        x, y = control[row, 0] / control[row, 2] - ex, control[row, 1] / control[row, 2] - ey
        longest = max(longest, math.hypot(x, y))
    for i in range(1, degree + 1):
        row = end + step * i
        x, y = control[row, 0] / control[row, 2] - ex, control[row, 1] / control[row, 2] - ey
        if math.hypot(x, y) > 1e-9 * longest:
            return x, y
    return 0.0, 0.0


@compiled
def _turn_between(spans: _Spans, left: int, right: int) -> tuple[float, float, float]:
    """Return the angle by which the boundary turns between two spans, and the heading before, not of unit length."""
    ux, uy = _leg(spans.control[left], spans.degree[left], True)
    vx, vy = _leg(spans.control[right], spans.degree[right], False)
    return math.atan2(uy * vx - ux * vy, -ux * vx - uy * vy), -ux, -uy


@compiled
def _straighten(spans: _Spans, left: int, right: int) -> None:
    """Take out a kink that is the rounding of the file's digits, by turning the control legs next to it."""
    turn, _, _ = _turn_between(spans, left, right)
    # Lines and quadratics share their legs with the other end.
    left_free, right_free = spans.degree[left] > 2, spans.degree[right] > 2
    if turn == 0.0 or not (left_free or right_free):
        return
    share = turn / 2 if left_free and right_free else turn
    ux, uy = _leg(spans.control[left], spans.degree[left], True)
    vx, vy = _leg(spans.control[right], spans.degree[right], False)
    if abs(share) * max(math.hypot(ux, uy), math.hypot(vx, vy)) > _DIGITS:
        return
    if left_free:
        _turn_leg(spans.control[left], spans.degree[left], spans.degree[left] - 1, share)
    if right_free:
        _turn_leg(spans.control[right], 0, 1, -share)


@compiled
def _turn_leg(control: Floats, end: int, row: int, angle: float) -> None:
    """Turn a control leg about a span's end point."""
    ex, ey = control[end, 0] / control[end, 2], control[end, 1] / control[end, 2]
    x, y = control[row, 0] / control[row, 2] - ex, control[row, 1] / control[row, 2] - ey
    cos, sin = math.cos(angle), math.sin(angle)
    control[row, 0] = (ex + cos * x - sin * y) * control[row, 2]
    control[row, 1] = (ey + sin * x + cos * y) * control[row, 2]


@compiled
def _extent(spans: _Spans) -> tuple[int, int]:
    """Return the number of elements, cones included, and of samples."""
    before, elements, samples = _before(spans.loop), 0, 0
    for e in range(len(spans.degree)):
        elements += 2 if _turn_between(spans, before[e], e)[0] < -_SMOOTH else 1
        samples += _sample_count(spans.degree[e])
    return elements, samples


@compiled
def _lay_out(spans: _Spans, out: Tour) -> None:
    """Put a cone at each reflex vertex between the spans, and collect what the search asks for of each element."""
    before_span = _before(spans.loop)
    at = 0
    for e in range(len(spans.degree)):
        turn, ux, uy = _turn_between(spans, before_span[e], e)
        if turn < -_SMOOTH:
            for j in range(3):
                out.control[at, 0, j] = spans.control[e, 0, j] / spans.control[e, 0, 2]
            out.element[at].cone_angle, out.element[at].cone_turn = math.atan2(uy, ux) + math.pi / 2, turn
            out.element[at].loop, out.element[at].edge = spans.loop[e], spans.edge[e]
            out.element[at].edge_from = out.element[at].edge_to = spans.edge_from[e]
            at += 1
        _copy_span(spans, e, out, at)
        out.element[at].convex = turn > _SMOOTH
        at += 1
    _tie_loops(out)
    _share_circles(out)
    _fill_samples(out)
    _fill_runs(out)


@compiled
def _copy_span(spans: _Spans, e: int, out: Tour, at: int) -> None:
    """Fill in one span, with its box and its circle."""
    degree = spans.degree[e]
    for i in range(degree + 1):
        for j in range(3):
            out.control[at, i, j] = spans.control[e, i, j]
    row = out.element[at]
    row.degree, row.loop, row.edge, row.angle = degree, spans.loop[e], spans.edge[e], spans.angle[e]
    row.edge_from, row.edge_to = spans.edge_from[e], spans.edge_to[e]
    row.x0, row.y0, row.x1, row.y1 = _control_box(spans.control[e], degree)
    if degree > 1:
        row.round_x, row.round_y, row.round_radius = _circle(spans.control[e], degree)


@compiled
def _tie_loops(out: Tour) -> None:
    """Fill in the neighbours of all elements."""
    first, n = 0, len(out.element)
    for e in range(n):
        if out.element[e].loop != out.element[first].loop:
            first = e
        is_last = e == n - 1 or out.element[e + 1].loop != out.element[e].loop
        after = first if is_last else e + 1
        out.element[e].after, out.element[after].before = after, e


@compiled
def _share_circles(out: Tour) -> None:
    """Give spans the circle of a longer neighbour, which knows it better, where they follow that to rounding."""
    for e in range(len(out.element)):
        _share_circle(out, out.element[e].before, e)
    for e in range(len(out.element) - 1, -1, -1):
        _share_circle(out, out.element[e].after, e)


@compiled
def _share_circle(out: Tour, giver: int, e: int) -> None:
    row, other = out.element[e], out.element[giver]
    x, y, r = other.round_x, other.round_y, other.round_radius
    if math.isnan(r) or row.degree < 2 or chord_squared(out, giver) < chord_squared(out, e):
        return
    if _follows(out.control[e], row.degree, x, y, r, _TO_ROUNDING):
        row.round_x, row.round_y, row.round_radius = x, y, r


@compiled
def chord_squared(tour: Tour, e: int) -> float:
    """Square of the distance between the ends of a span."""
    ax, ay, _, _, _, _ = site(tour, e, 0.0)
    bx, by, _, _, _, _ = site(tour, e, 1.0)
    return (bx - ax) ** 2 + (by - ay) ** 2


@compiled
def _sample_count(degree: int) -> int:
    return 0 if degree == 0 else _SAMPLES_STRAIGHT if degree == 1 else _SAMPLES_CURVED


@compiled
def _fill_samples(tour: Tour) -> None:
    """Fill in points on the spans, in the middle of equal parameter steps."""
    at = 0
    for e in range(len(tour.element)):
        count = _sample_count(tour.element[e].degree)
        tour.element[e].sample_from, tour.element[e].sample_to = at, at + count
        for k in range(count):
            t = (k + 0.5) / count
            x, y, _, _, _, _ = evaluate(tour.control[e], tour.element[e].degree, t)
            tour.sample[at, 0], tour.sample[at, 1], tour.sample[at, 2] = x, y, t
            at += 1


@compiled
def _fill_runs(tour: Tour) -> None:
    """Fill in the boxes of runs; one of cones alone is empty, far from everything."""
    for k in range(len(tour.run)):
        x0, y0, x1, y1 = math.inf, math.inf, -math.inf, -math.inf
        for e in range(k * RUN, min((k + 1) * RUN, len(tour.element))):
            if tour.element[e].degree > 0:
                x0, y0 = min(x0, tour.element[e].x0), min(y0, tour.element[e].y0)
                x1, y1 = max(x1, tour.element[e].x1), max(y1, tour.element[e].y1)
        tour.run[k, 0], tour.run[k, 1], tour.run[k, 2], tour.run[k, 3] = x0, y0, x1, y1


@compiled
def box_apart(tour: Tour, e: int, x: float, y: float) -> float:
    """Square of the distance from a point to the box of an element; 0 inside."""
    row = tour.element[e]
    bx, by = max(row.x0 - x, 0.0, x - row.x1), max(row.y0 - y, 0.0, y - row.y1)
    return bx * bx + by * by


@compiled
def run_apart(tour: Tour, k: int, x: float, y: float) -> float:
    """Square of the distance from a point to the box of a run of elements; 0 inside."""
    bx, by = max(tour.run[k, 0] - x, 0.0, x - tour.run[k, 2]), max(tour.run[k, 1] - y, 0.0, y - tour.run[k, 3])
    return bx * bx + by * by


@compiled
def _circle(control: Floats, degree: int) -> tuple[float, float, float]:
    """Centre and radius of the circle that a span follows within `ROUND`, bending inwards; NaN if there is none.

    A short span tells its centre by the square of its angle less well, and has to follow the circle as much better.
    """
    px, py, _, _, _, _ = evaluate(control, degree, 0.0)
    mx, my, _, _, _, _ = evaluate(control, degree, 0.5)
    qx, qy, _, _, _, _ = evaluate(control, degree, 1.0)
    ux, uy, vx, vy = mx - px, my - py, qx - px, qy - py
    u_sq, v_sq = ux * ux + uy * uy, vx * vx + vy * vy
    cross = ux * vy - uy * vx
    if cross <= math.sqrt(u_sq * v_sq) * math.hypot(qx - mx, qy - my) / (2 * _FLAT):
        return math.nan, math.nan, math.nan
    x, y = px + (vy * u_sq - uy * v_sq) / (2 * cross), py + (ux * v_sq - vx * u_sq) / (2 * cross)
    r = math.hypot(px - x, py - y)
    if not _follows(control, degree, x, y, r, ROUND * min(1.0, 4 * u_sq / (r * r))):
        return math.nan, math.nan, math.nan
    return x, y, r


@compiled
def _follows(control: Floats, degree: int, x: float, y: float, r: float, near: float) -> bool:
    """Whether a span is nowhere further than `near` from a circle."""
    heaviest = 0.0
    for i in range(degree + 1):
        heaviest = max(heaviest, control[i, 2])
    limit = 2 * r * near * heaviest * heaviest
    return bool(np.abs(power_distance(control, degree, x, y, r)).max() <= limit)
