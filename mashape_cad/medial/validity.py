"""Whether a boundary is simple: no two of its spans cross or touch but neighbours at their common end.

Pairs of spans whose boxes meet are cut in two until their boxes part, or until both are so short that what is left is
a contact. Neighbours are compared without the stretches right at their common end, where they meet by right.
"""

import numpy as np
from numba import njit

from mashape_cad.errors import InvalidProfileError
from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Frame, Ints, Tour, site

__all__ = ["check_simple", "first_contact"]

# Spans that come this close touch (sizes of the shape): ten times what readers leave between joined ends.
_TOUCH = 1e-9
# Neighbours may run this far from their common end (sizes) before they are looked at: below, corners and tangent joins
# look alike to boxes.
_JOIN = 1e-6
# Control legs shorter than the root of this (sizes of the shape) have no direction.
_NO_LEG_SQ = 1e-24
# Cuts before a pair counts as meeting: overlapping curves would be cut for ever, separate ones take some hundred.
_CUTS = 100_000


def check_simple(tour: Tour, frame: Frame) -> None:
    """Refuse a boundary that crosses or touches itself, or whose holes are not inside.

    Raises
    ------
    InvalidProfileError
        With the kind ``crossing`` or ``hole-outside`` and the place, mm.
    """
    place = first_contact(tour)
    if place is not None:
        px, py = frame.middle + frame.size * np.array(place)
        text = f"the outline crosses or touches itself at ({px:.6g}, {py:.6g}); mend it in the drawing"
        raise InvalidProfileError("crossing", text, (float(px), float(py)))
    polygons = [_polygon(tour, loop) for loop in range(int(tour.loop.max()) + 1)]
    for hole in polygons[1:]:
        # Loops do not cross, so one point inside settles it; points near the other loop may seem to lie elsewhere.
        inside = any(_winding(polygons[0], point) == 1 for point in hole)
        in_other = any(_in_box(hole, other) and _all_inside(hole, other) for other in polygons[1:] if other is not hole)
        if not inside or in_other:
            px, py = hole[0] * frame.size + frame.middle
            where = "inside another hole" if in_other else "outside the outer loop"
            raise InvalidProfileError(
                "hole-outside", f"the hole at ({px:.6g}, {py:.6g}) lies {where}", (float(px), float(py))
            )


def _in_box(points: Floats, polygon: Floats) -> bool:
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    return bool(np.all((points >= low) & (points <= high)))


def _all_inside(points: Floats, polygon: Floats) -> bool:
    """Whether all points lie inside a polygon of either orientation."""
    return all(_winding(polygon, point) != 0 for point in points)


def _polygon(tour: Tour, loop: int) -> Floats:
    """Points along a loop, in order."""
    places = [
        (int(e), t)
        for e in np.flatnonzero((tour.loop == loop) & (tour.degree > 0))
        for t in _steps(int(tour.degree[e]))
    ]
    return np.array([site(tour, e, t)[:2] for e, t in places])


def _steps(degree: int) -> Floats:
    return np.linspace(0.0, 1.0, 1 if degree == 1 else 16, endpoint=False)


def _winding(polygon: Floats, point: Floats) -> int:
    """How often a closed polygon winds round a point, counter-clockwise positive."""
    angle = np.unwrap(np.arctan2(polygon[:, 1] - point[1], polygon[:, 0] - point[0]))
    turns = (np.unwrap([angle[-1], angle[0]])[1] - angle[0]) / (2 * np.pi)
    return round(float(turns))


def first_contact(tour: Tour) -> tuple[float, float] | None:
    """Return a place where two spans meet, or one meets itself, though they should not; None if there is none."""
    spans = np.flatnonzero(tour.degree > 0)
    for e in spans[tour.degree[spans] > 1]:
        place = _self_contact(tour.control[e, : tour.degree[e] + 1])
        if place is not None:
            return place
    for i, j in _near_pairs(tour.box[spans]):
        a, b = int(spans[i]), int(spans[j])
        p, q = tour.control[a, : tour.degree[a] + 1], tour.control[b, : tour.degree[b] + 1]
        found, x, y = pair_contact(p, q, _follows(tour, a, b), _follows(tour, b, a))
        if found:
            return x, y
    return None


def _near_pairs(box: Floats) -> Ints:
    """Pairs of boxes that meet: (k, 2), each pair once."""
    low, high = box[:, :2] - _TOUCH, box[:, 2:] + _TOUCH
    meet = np.ones((len(box), len(box)), dtype=bool)
    for axis in (0, 1):
        meet &= low[:, None, axis] <= high[None, :, axis]
        meet &= low[None, :, axis] <= high[:, None, axis]
    return np.argwhere(np.triu(meet, 1))


def _follows(tour: Tour, a: int, b: int) -> bool:
    """Whether span b starts where span a ends."""
    c = int(tour.after[a])
    return b == (int(tour.after[c]) if tour.degree[c] == 0 else c)


def _self_contact(control: Floats) -> tuple[float, float] | None:
    """Return a place where one span crosses itself: a piece that turns less than 180 degrees cannot, others are cut."""
    pieces = [control]
    for _ in range(_CUTS):
        if not pieces:
            return None
        piece = pieces.pop()
        if _turning(piece) < np.pi:
            continue
        left, right = _split(piece)
        found, x, y = pair_contact(left, right, True, False)
        if found:
            return x, y
        pieces += [left, right]
    return float(control[0, 0] / control[0, 2]), float(control[0, 1] / control[0, 2])


@njit(cache=True)
def _split(control: Floats) -> tuple[Floats, Floats]:
    """Cut a span in the middle."""
    degree = len(control) - 1
    left, right = control.copy(), control.copy()
    for k in range(degree + 1):
        left[k] = right[0]
        for i in range(degree - k):
            for c in range(3):
                right[i, c] = (right[i, c] + right[i + 1, c]) / 2
    return left, right


@njit(cache=True)
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
            total += abs(np.arctan2(px * dy - py * dx, px * dx + py * dy))
        px, py, seen = dx, dy, True
    return total


@njit(cache=True)
def pair_contact(first: Floats, second: Floats, head: bool, tail: bool) -> tuple[bool, float, float]:
    """Whether two spans meet, other than where the first's end is the second's start (`head`), or the reverse.

    Returns
    -------
    found : bool
    x, y : float
        The place. A pair that is not decided within the budget counts as meeting.
    """
    size = 512
    a = np.empty((size, len(first), 3))
    b = np.empty((size, len(second), 3))
    flags = np.empty((size, 2), np.bool_)  # whether the pieces still share the common end of head, of tail
    a[0], b[0] = first, second
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
        if px0 > qx1 + _TOUCH or qx0 > px1 + _TOUCH or py0 > qy1 + _TOUCH or qy0 > py1 + _TOUCH:
            continue
        p_size, q_size = max(px1 - px0, py1 - py0), max(qx1 - qx0, qy1 - qy0)
        if (at_head or at_tail) and max(p_size, q_size) < _JOIN:
            continue
        if at_head and not at_tail and _parts_at_once(p, q, p_size, q_size):
            continue
        if at_tail and not at_head and _parts_at_once(q, p, q_size, p_size):
            continue
        if max(p_size, q_size) < _TOUCH or top + 4 > size:
            return True, (px0 + px1) / 2, (py0 + py1) / 2
        if p_size >= q_size:
            left, right = _split(p)
            a[top], b[top] = left, q
            flags[top, 0], flags[top, 1] = False, at_tail
            a[top + 1], b[top + 1] = right, q
            flags[top + 1, 0], flags[top + 1, 1] = at_head, False
        else:
            left, right = _split(q)
            a[top], b[top] = p, left
            flags[top, 0], flags[top, 1] = at_head, False
            a[top + 1], b[top + 1] = p, right
            flags[top + 1, 0], flags[top + 1, 1] = False, at_tail
        top += 2
    return True, (a[0, 0, 0]) / a[0, 0, 2], a[0, 0, 1] / a[0, 0, 2]


@njit(cache=True)
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


@njit(cache=True)
def _bounds(control: Floats) -> tuple[float, float, float, float]:
    x0 = x1 = control[0, 0] / control[0, 2]
    y0 = y1 = control[0, 1] / control[0, 2]
    for i in range(1, len(control)):
        x, y = control[i, 0] / control[i, 2], control[i, 1] / control[i, 2]
        x0, x1, y0, y1 = min(x0, x), max(x1, x), min(y0, y), max(y1, y)
    return x0, y0, x1, y1
