"""Whether a boundary is simple: no two of its spans cross or touch but neighbours at their common end.

Pairs of spans whose boxes meet are cut in two until their boxes part, or until both are so short that what is left is
a contact. Neighbours are compared without the stretches right at their common end, where they meet by right.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mashape_cad.errors import InvalidProfileError
from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.bezier import evaluate, halves, speed_squared
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.tour import Frame, Ints, Tour, loop_count, site

__all__ = ["check_simple", "first_contact"]

# Spans that come this close touch (sizes of the shape): ten times what readers leave between joined ends.
_TOUCH = 1e-9
# Neighbours that part under a small angle are near one another for long: at some distance from their vertex they touch
# only if they are closer than this times the distance.
_PARTING = 1e-7
# Neighbours may run this far from their common end (sizes) before they are looked at: below, corners and tangent joins
# look alike to boxes.
_JOIN = 1e-6
# Control legs shorter than the root of this (sizes of the shape) have no direction.
_NO_LEG_SQ = 1e-24
# Cuts before a pair counts as meeting: overlapping curves would be cut for ever, separate ones take some hundred.
_CUTS = 1_000_000
# A curve stands still where the square of its speed is this small against the largest on its span, which is some
# hundred roundings; so it does where a stretch of parameters this short cannot be told from such a place.
_NO_SPEED, _SHORTEST = 1e-14, 1e-7
# Gauss quadrature on [0, 1]; only the sign of an area is asked for.
_NODES, _WEIGHTS = (np.polynomial.legendre.leggauss(12)[0] + 1) / 2, np.polynomial.legendre.leggauss(12)[1] / 2


def check_simple(tour: Tour, frame: Frame) -> None:
    """Refuse a boundary that crosses or touches itself, or whose holes are not inside.

    Raises
    ------
    InvalidProfileError
        With the kind ``cusp``, ``crossing``, ``hole-outside`` or ``degenerate`` and the place, mm.
    """
    still, x, y = _standstill(tour)
    if still:
        x, y = _in_mm(frame, x, y)
        raise InvalidProfileError(
            "cusp", f"a curve stands still at ({x:.6g}, {y:.6g}): it has a cusp of its own", (x, y)
        )
    place = first_contact(tour)
    if place is not None:
        x, y = _in_mm(frame, *place)
        text = f"the outline crosses or touches itself at ({x:.6g}, {y:.6g}); mend it in the drawing"
        raise InvalidProfileError("crossing", text, (x, y))
    wrong, x, y = _wrong_way_round(tour)
    if wrong:
        x, y = _in_mm(frame, x, y)
        text = f"the loop at ({x:.6g}, {y:.6g}) runs the wrong way round; make the profile by Profile.of"
        raise InvalidProfileError("degenerate", text, (x, y))
    misplaced, in_other = _misplaced_hole(tour)
    if misplaced > 0:
        e = int(np.argmax(tour.loop == misplaced))
        x, y = _in_mm(frame, *site(tour, e, 0.0)[:2])
        where = "inside another hole" if in_other else "outside the outer loop"
        raise InvalidProfileError("hole-outside", f"the hole at ({x:.6g}, {y:.6g}) lies {where}", (x, y))


def _in_mm(frame: Frame, x: float, y: float) -> tuple[float, float]:
    return float(frame.middle[0] + frame.size * x), float(frame.middle[1] + frame.size * y)


@compiled
def _wrong_way_round(tour: Tour) -> tuple[bool, float, float]:
    """Find a loop that does not have the domain on its left: whether there is one, and a point on it.

    By the area that each encloses (Gauss quadrature on each span), positive if it runs counter-clockwise.
    """
    area = np.zeros(loop_count(tour))
    for e in range(len(tour.element)):
        if tour.element[e].degree > 0:
            for k in range(len(_NODES)):
                x, y, dx, dy, _, _ = evaluate(tour.control[e], tour.element[e].degree, _NODES[k])
                area[tour.element[e].loop] += _WEIGHTS[k] * (x * dy - y * dx) / 2
    for e in range(len(tour.element)):
        loop = tour.element[e].loop
        if (area[loop] > 0.0) != (loop == 0):
            return True, tour.control[e, 0, 0] / tour.control[e, 0, 2], tour.control[e, 0, 1] / tour.control[e, 0, 2]
    return False, 0.0, 0.0


@compiled
def _misplaced_hole(tour: Tour) -> tuple[int, bool]:
    """Return a hole that lies outside the outer loop or inside another hole, and which; loop 0 if there is none.

    Loops neither cross nor touch, so one point of a hole settles it.
    """
    loops = loop_count(tour)
    for hole in range(1, loops):
        e = 0
        while tour.element[e].loop != hole:
            e += 1
        x, y, _, _, _, _ = site(tour, e, 0.0)
        inside = _loops_around(tour, x, y, hole)
        if not inside[0]:
            return hole, False
        for other in range(1, loops):
            if inside[other]:
                return hole, True
    return 0, False


@compiled
def _loops_around(tour: Tour, x: float, y: float, own: int) -> NDArray[np.bool_]:
    """Tell of each loop but a point's own whether a ray from the point crosses it an odd number of times."""
    inside = np.zeros(loop_count(tour), np.bool_)
    for e in range(len(tour.element)):
        loop = tour.element[e].loop
        beside = tour.element[e].y0 > y or tour.element[e].y1 < y or tour.element[e].x1 < x
        if loop != own and tour.element[e].degree > 0 and not beside:
            inside[loop] = inside[loop] != _crosses(tour.control[e, : tour.element[e].degree + 1], x, y)
    return inside


@compiled
def _crosses(control: Floats, x: float, y: float) -> bool:
    """Whether a ray from (x, y) to the right crosses a span an odd number of times; pieces are cut till it is plain."""
    odd = False
    pieces = [control.copy()]
    while len(pieces) > 0:
        piece = pieces.pop()
        x0, y0, x1, y1 = _bounds(piece)
        if x1 < x or y0 > y or y1 < y:
            continue
        if x0 > x or max(x1 - x0, y1 - y0) < _TOUCH:
            n = len(piece) - 1
            odd = odd != ((piece[0, 1] > y * piece[0, 2]) != (piece[n, 1] > y * piece[n, 2]))
            continue
        left, right = _split(piece)
        pieces.append(left)
        pieces.append(right)
    return odd


@compiled
def _standstill(tour: Tour) -> tuple[bool, float, float]:
    """Find a place where a curve has no speed: whether there is one, and where."""
    for e in range(len(tour.element)):
        if tour.element[e].degree < 2:
            continue
        stack, ends = [speed_squared(tour.control[e], tour.element[e].degree)], [(0.0, 1.0)]
        floor = _NO_SPEED * stack[0].max()
        while len(stack) > 0:
            coefficients, (low, high) = stack.pop(), ends.pop()
            if coefficients.min() > floor:
                continue
            if high - low < _SHORTEST or min(coefficients[0], coefficients[-1]) <= floor:
                at = low if coefficients[0] <= coefficients[-1] else high
                x, y, _, _, _, _ = evaluate(tour.control[e], tour.element[e].degree, at)
                return True, x, y
            left, right = halves(coefficients)
            stack.append(left)
            stack.append(right)
            ends.append((low, (low + high) / 2))
            ends.append(((low + high) / 2, high))
    return False, 0.0, 0.0


def first_contact(tour: Tour) -> tuple[float, float] | None:
    """Return a place where two spans meet, or one meets itself, though they should not; None if there is none."""
    found, x, y = _first_contact(tour, np.argsort(tour.element["x0"]))
    return (x, y) if found else None


@compiled
def _first_contact(tour: Tour, order: Ints) -> tuple[bool, float, float]:
    n = len(tour.element)
    for e in range(n):
        if tour.element[e].degree > 1:
            found, x, y = _self_contact(tour.control[e, : tour.element[e].degree + 1])
            if found:
                return True, x, y
    # From left to right, in `order`: a box is compared with those that start before it ends.
    for i in range(n):
        a = order[i]
        for j in range(i + 1, n):
            b = order[j]
            if tour.element[b].x0 > tour.element[a].x1 + _TOUCH:
                break
            above = tour.element[b].y0 > tour.element[a].y1 + _TOUCH or tour.element[a].y0 > tour.element[b].y1 + _TOUCH
            if above or tour.element[a].degree == 0 or tour.element[b].degree == 0:
                continue
            found, x, y = pair_contact(
                tour.control[a, : tour.element[a].degree + 1],
                tour.control[b, : tour.element[b].degree + 1],
                _follows(tour, a, b),
                _follows(tour, b, a),
            )
            if found:
                return True, x, y
    return False, 0.0, 0.0


@compiled
def _follows(tour: Tour, a: int, b: int) -> bool:
    """Whether span b starts where span a ends."""
    c = tour.element[a].after
    return b == (tour.element[c].after if tour.element[c].degree == 0 else c)


@compiled
def _self_contact(control: Floats) -> tuple[bool, float, float]:
    """Find a place where one span crosses itself: a piece that turns less than 180 degrees cannot, others are cut."""
    pieces = [control.copy()]
    for _ in range(_CUTS):
        if len(pieces) == 0:
            return False, 0.0, 0.0
        piece = pieces.pop()
        if _turning(piece) < math.pi:
            continue
        left, right = _split(piece)
        found, x, y = pair_contact(left, right, True, False)
        if found:
            return True, x, y
        pieces.append(left)
        pieces.append(right)
    return True, control[0, 0] / control[0, 2], control[0, 1] / control[0, 2]


@compiled
def _split(control: Floats) -> tuple[Floats, Floats]:
    """Cut a span in the middle."""
    n = len(control)
    left, right = np.empty((n, 3)), np.empty((n, 3))
    for c in range(3):
        for i in range(n):
            right[i, c] = control[i, c]
        for k in range(n):
            left[k, c] = right[0, c]
            for i in range(n - 1 - k):
                right[i, c] = (right[i, c] + right[i + 1, c]) / 2
    return left, right


@compiled
def _copy(source: Floats, target: Floats) -> None:
    for i in range(len(source)):
        for c in range(3):
            target[i, c] = source[i, c]


@compiled
def _turning(control: Floats) -> float:
    """Bound on how far the tangent of a span turns: the sum of the angles between control legs."""
    total = 0.0
    px = py = 0.0
    seen = False
    for i in range(len(control) - 1):
        dx = control[i + 1, 0] / control[i + 1, 2] - control[i, 0] / control[i, 2]
        dy = control[i + 1, 1] / control[i + 1, 2] - control[i, 1] / control[i, 2]
        if dx * dx + dy * dy < _NO_LEG_SQ:
            continue
        if seen:
            total += abs(math.atan2(px * dy - py * dx, px * dx + py * dy))
        px, py, seen = dx, dy, True
    return total


@compiled
def pair_contact(first: Floats, second: Floats, head: bool, tail: bool) -> tuple[bool, float, float]:
    """Whether two spans meet, other than where the first's end is the second's start (`head`), or the reverse.

    Returns
    -------
    found : bool
    x, y : float
        The place. A pair that is not decided within the budget counts as meeting.
    """
    if len(first) == len(second) == 2 and head != tail:
        return False, 0.0, 0.0  # straight neighbours that leave their vertex in different directions part for good
    size = 512
    a, b = np.empty((size, len(first), 3)), np.empty((size, len(second), 3))
    flags = np.empty((size, 2), np.bool_)  # whether the pieces still share the common end of head, of tail
    _copy(first, a[0])
    _copy(second, b[0])
    flags[0, 0], flags[0, 1] = head, tail
    top = 1
    for _ in range(_CUTS):
        if top == 0:
            return False, 0.0, 0.0
        top -= 1
        p, q = a[top].copy(), b[top].copy()
        at_head, at_tail = flags[top, 0], flags[top, 1]
        px0, py0, px1, py1 = _bounds(p)
        qx0, qy0, qx1, qy1 = _bounds(q)
        touch = _TOUCH
        for shared, row in ((head, len(first) - 1), (tail, 0)):
            if shared:
                touch = min(touch, _PARTING * _from_box(first, row, px0, py0, px1, py1))
        apart = px0 > qx1 + touch or qx0 > px1 + touch or py0 > qy1 + touch or qy0 > py1 + touch
        if apart or _parted_across(p, q, touch) or _parted_across(q, p, touch):
            continue
        p_size, q_size = max(px1 - px0, py1 - py0), max(qx1 - qx0, qy1 - qy0)
        if (at_head or at_tail) and max(p_size, q_size) < _JOIN:
            continue
        if at_head and not at_tail and _parts_at_once(p, q, p_size, q_size):
            continue
        if at_tail and not at_head and _parts_at_once(q, p, q_size, p_size):
            continue
        if max(p_size, q_size) < touch or top + 4 > size:
            return True, (px0 + px1) / 2, (py0 + py1) / 2
        if p_size >= q_size:
            left, right = _split(p)
            _copy(left, a[top])
            flags[top, 0], flags[top, 1] = False, at_tail
            _copy(right, a[top + 1])
            _copy(q, b[top + 1])
            flags[top + 1, 0], flags[top + 1, 1] = at_head, False
        else:
            left, right = _split(q)
            _copy(left, b[top])
            flags[top, 0], flags[top, 1] = at_head, False
            _copy(p, a[top + 1])
            _copy(right, b[top + 1])
            flags[top + 1, 0], flags[top + 1, 1] = False, at_tail
        top += 2
    return True, (a[0, 0, 0]) / a[0, 0, 2], a[0, 0, 1] / a[0, 0, 2]


@compiled
def _parted_across(p: Floats, q: Floats, touch: float) -> bool:
    """Whether a strip along the chord of piece p holds p and stays away from q; so thin wedges need few cuts."""
    n, m = len(p), len(q)
    x, y = p[0, 0] / p[0, 2], p[0, 1] / p[0, 2]
    dx, dy = p[n - 1, 0] / p[n - 1, 2] - x, p[n - 1, 1] / p[n - 1, 2] - y
    length = math.hypot(dx, dy)
    if length == 0.0:
        return False
    low, high, below, above = 0.0, 0.0, math.inf, -math.inf
    for i in range(n):
        off = (dx * (p[i, 1] / p[i, 2] - y) - dy * (p[i, 0] / p[i, 2] - x)) / length
        low, high = min(low, off), max(high, off)
    for i in range(m):
        off = (dx * (q[i, 1] / q[i, 2] - y) - dy * (q[i, 0] / q[i, 2] - x)) / length
        below, above = min(below, off), max(above, off)
    return below > high + touch or above < low - touch


@compiled
def _from_box(control: Floats, row: int, x0: float, y0: float, x1: float, y1: float) -> float:
    """Distance of a control point from a box."""
    x, y = control[row, 0] / control[row, 2], control[row, 1] / control[row, 2]
    return math.hypot(max(x0 - x, 0.0, x - x1), max(y0 - y, 0.0, y - y1))


@compiled
def _parts_at_once(p: Floats, q: Floats, p_size: float, q_size: float) -> bool:
    """Whether piece q, which starts where p ends, surely runs away from p.

    It does if one direction d has all control legs of both pieces pointing forward along it: then p lies before
    their common point, q behind it.
    """
    n, m = len(p), len(q)
    dx = q[m - 1, 0] / q[m - 1, 2] - p[0, 0] / p[0, 2]
    dy = q[m - 1, 1] / q[m - 1, 2] - p[0, 1] / p[0, 2]
    if dx * dx + dy * dy < 1e-4 * min(p_size, q_size) ** 2:
        return False
    for i in range(n - 1):
        lx = p[i + 1, 0] / p[i + 1, 2] - p[i, 0] / p[i, 2]
        ly = p[i + 1, 1] / p[i + 1, 2] - p[i, 1] / p[i, 2]
        if lx * dx + ly * dy < 0.0:
            return False
    for i in range(m - 1):
        lx = q[i + 1, 0] / q[i + 1, 2] - q[i, 0] / q[i, 2]
        ly = q[i + 1, 1] / q[i + 1, 2] - q[i, 1] / q[i, 2]
        if lx * dx + ly * dy < 0.0:
            return False
    return True


@compiled
def _bounds(control: Floats) -> tuple[float, float, float, float]:
    x0 = x1 = control[0, 0] / control[0, 2]
    y0 = y1 = control[0, 1] / control[0, 2]
    for i in range(1, len(control)):
        x, y = control[i, 0] / control[i, 2], control[i, 1] / control[i, 2]
        x0, x1, y0, y1 = min(x0, x), max(x1, x), min(y0, y), max(y1, y)
    return x0, y0, x1, y1
