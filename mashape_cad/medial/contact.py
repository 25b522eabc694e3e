"""When two contacts of a disc are one.

A circle leaves its tangent by s^2 / 2 r only, so footpoints are known to about the root of the distance's rounding; and
near an osculating foot the boundary stays on the circle for longer still. Two contacts are one if the boundary between
them does not leave the circle. However near they are, a notch between them makes them two.
"""

import math

from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.tour import Tour, site

__all__ = ["TOUCH", "apart", "follows_circle", "one_contact", "same_foot"]

# A boundary point this close to the circle touches it (sizes of the shape).
TOUCH = 1e-11
# Contacts closer than this (sizes) are one: edges so short are none.
_SAME = 1e-9
# Feet of one contact that were found in two ways lie no further apart than this, absolutely or times the radius.
_FOUND_TWICE, _FOUND_TWICE_RELATIVE = 3e-9, 3e-6
# Contacts further apart than this, times the radius, are two, whatever lies between them.
_NEAR = 0.02
# Elements that a stretch between two contacts may run over, and places looked at on each.
_ELEMENTS, _PLACES = 5, 5


@compiled
def apart(tour: Tour, e: int, t: float, f: int, s: float) -> float:
    """Distance between two places."""
    ax, ay, _, _, _, _ = site(tour, e, t)
    bx, by, _, _, _, _ = site(tour, f, s)
    return math.hypot(ax - bx, ay - by)


@compiled
def same_foot(tour: Tour, e: int, t: float, f: int, s: float, cx: float, cy: float, r: float) -> bool:
    """Whether two places are one foot of a disc, found in two ways."""
    reach = max(_FOUND_TWICE, _FOUND_TWICE_RELATIVE * r)
    return _is_one(tour, e, t, f, s, cx, cy, r, reach)


@compiled
def one_contact(tour: Tour, e: int, t: float, f: int, s: float, cx: float, cy: float, r: float) -> bool:
    """Whether two places are one contact of a disc that may osculate there."""
    return _is_one(tour, e, t, f, s, cx, cy, r, max(_FOUND_TWICE, _NEAR * r))


@compiled
def _is_one(tour: Tour, e: int, t: float, f: int, s: float, cx: float, cy: float, r: float, reach: float) -> bool:
    """Whether two places coincide, or are within reach of one another with the boundary on the circle between."""
    distance = apart(tour, e, t, f, s)
    if distance <= _SAME:
        return True
    if distance > reach:
        return False
    return follows_circle(tour, e, t, f, s, cx, cy, r, TOUCH) or follows_circle(tour, f, s, e, t, cx, cy, r, TOUCH)


@compiled
def follows_circle(tour: Tour, e: int, t: float, f: int, s: float, cx: float, cy: float, r: float, tol: float) -> bool:
    """Whether the boundary from one place on to the other, a few elements at most, stays this near to a circle."""
    for _ in range(_ELEMENTS):
        last = e == f and t <= s
        end = s if last else 1.0
        for k in range(_PLACES):
            x, y, _, _, _, _ = site(tour, e, t + (end - t) * k / (_PLACES - 1))
            if abs(math.hypot(x - cx, y - cy) - r) > tol:
                return False
        if last:
            return True
        e, t = tour.element[e].after, 0.0
    return False
