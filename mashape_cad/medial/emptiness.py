"""Whether a disc is empty, and where it touches the boundary.

The power of a span's point with respect to a disc is a polynomial; its coefficients in Bernstein form bound it. Spans
that certainly stay away are discarded, stretches with one minimum are settled by Newton, the rest is cut in two. So
the answer is a proof: nothing is sampled.
"""

import math
from typing import cast

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.bezier import evaluate, halve, power_distance
from mashape_cad.medial.compiled import Records, compiled
from mashape_cad.medial.contact import same_foot
from mashape_cad.medial.tour import RUN, Ints, Tour, box_apart, run_apart

__all__ = [
    "EMPTY",
    "NO_SKIP",
    "cone_turn",
    "contact_at_border",
    "distance_minima",
    "holds_sample",
    "nearest_on_stretch",
    "normal_form",
    "spans_near",
    "touching",
]

# A disc is empty when no boundary point lies deeper inside than this (sizes of the shape). Looser is wrong: near an
# osculating contact the boundary enters by a cube law, and 1e-10 would let discs through that miss a short branch.
EMPTY = 1e-13
_SNAP = 1e-9  # parameters this close to a border are the border
_LEVEL = 1e-9  # a slope (radians) of the distance at a border that rounding may have made
_SAME_CIRCLE = 1e-8  # arcs whose centres and radii agree this well lie on one circle
_RESOLUTION = 1e-16  # spacing of numbers near 1
# Minima on a span: a stretch this short is not halved any more, a minimum this near to its end is looked for beyond it
# too, and two this close are one.
_SHORTEST, _NEAR_END, _SAME_MINIMUM = 1e-6, 1e-12, 1e-7
_MAX_STACK = 128
# No circle is left out; nothing has been found. (Typed, since numba compiles a function anew for each literal.)
NO_SKIP, _NONE_YET = cast("int", np.int64(-1)), cast("int", np.int64(0))


@compiled
def distance_minima(
    tour: Tour, cx: float, cy: float, r: float, tol: float, skip: int, floor: float
) -> tuple[int, Ints, Floats, Floats]:
    """Find every place where the boundary comes nearest to c, locally, and lies within r + tol of it.

    Spans that certainly stay away are discarded by the convex hull of their Bernstein coefficients; where the
    coefficients are convex there is one minimum, found by Newton; what is neither is cut in two.

    Parameters
    ----------
    skip : int
        Circle number (see `Tour.element`) of elements to leave out: an element index whose circle's spans are the
        disc's own contact; -1 for none.
    floor : float
        The search ends with the first place deeper inside the disc than this.

    Returns
    -------
    count : int
    element, t : arrays
        Places; only the first `count` rows count.
    depth : array
        ``|q - c| - r``: negative inside the disc.
    """
    n = len(tour.element)
    element, place_t, depth = np.empty(2 * n + 64, np.int64), np.empty(2 * n + 64), np.empty(2 * n + 64)
    count = _NONE_YET
    reach_sq = (r + tol) * (r + tol)
    for run in range(len(tour.run)):
        if run_apart(tour, run, cx, cy) > reach_sq:
            continue
        for e in range(run * RUN, min((run + 1) * RUN, n)):
            if box_apart(tour, e, cx, cy) > reach_sq or tour.element[e].degree == 0:
                continue
            if skip >= 0 and _on_one_circle(tour, e, skip):
                continue
            known = count
            if tour.element[e].degree == 1:
                count = _minimum_on_line(tour, e, cx, cy, r, tol, element, place_t, depth, count)
            else:
                count = _minima_on_span(tour, e, cx, cy, r, tol, element, place_t, depth, count)
            for k in range(known, count):
                if depth[k] < -floor:
                    return count, element, place_t, depth
    return count, element, place_t, depth


@compiled
def _on_one_circle(tour: Tour, e: int, f: int) -> bool:
    return (
        abs(tour.element[e].round_radius - tour.element[f].round_radius) <= _SAME_CIRCLE
        and math.hypot(
            tour.element[e].round_x - tour.element[f].round_x, tour.element[e].round_y - tour.element[f].round_y
        )
        <= _SAME_CIRCLE
    )


@compiled
def holds_sample(tour: Tour, cx: float, cy: float, r: float, tol: float) -> bool:
    """Whether one of the tour's samples lies deeper than `tol` inside a disc: a quick witness that it is not empty."""
    inner = r - tol
    if inner <= 0.0:
        return False
    for run in range(len(tour.run)):
        if run_apart(tour, run, cx, cy) >= inner * inner:
            continue
        for e in range(run * RUN, min((run + 1) * RUN, len(tour.element))):
            if box_apart(tour, e, cx, cy) >= inner * inner:
                continue
            for k in range(tour.element[e].sample_from, tour.element[e].sample_to):
                dx, dy = tour.sample[k, 0] - cx, tour.sample[k, 1] - cy
                if dx * dx + dy * dy < inner * inner:
                    return True
    return False


@compiled
def spans_near(tour: Tour, settled: Records, slack: float) -> tuple[Ints, Ints]:
    """Return for discs all spans with a point that is no further outside than its tolerance and `slack`.

    Parameters
    ----------
    settled : record array
        Discs, see `mashape_cad.medial.faces.Faces`.
    slack : float

    Returns
    -------
    disc, element : arrays
        Pairs, disc by disc.
    """
    n = len(settled)
    disc, element, count = np.empty(64 + 4 * n, np.int64), np.empty(64 + 4 * n, np.int64), 0
    for d in range(n):
        row = settled[d]
        found, near, _, _ = distance_minima(tour, row.x, row.y, row.r, row.tol + slack, NO_SKIP, math.inf)
        for k in range(found):
            if k > 0 and near[k] == near[k - 1]:
                continue
            if count == len(disc):
                disc, element = np.concatenate((disc, disc)), np.concatenate((element, element))
            disc[count], element[count] = d, near[k]
            count += 1
    return disc[:count], element[:count]


@compiled
def _minimum_on_line(
    tour: Tour,
    e: int,
    cx: float,
    cy: float,
    r: float,
    tol: float,
    element: Ints,
    place_t: Floats,
    depth: Floats,
    count: int,
) -> int:
    """Append the nearest place of a straight span; see `distance_minima`."""
    control = tour.control[e]
    t = _span_minimum(tour, e, 0.0, 1.0, cx, cy)
    if control[0, 2] == control[1, 2]:
        ax, ay = control[0, 0] / control[0, 2], control[0, 1] / control[0, 2]
        dx, dy = control[1, 0] / control[1, 2] - ax, control[1, 1] / control[1, 2] - ay
        t = min(max(((cx - ax) * dx + (cy - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
    x, y, _, _, _, _ = evaluate(control, 1, t)
    off = math.hypot(x - cx, y - cy) - r
    if off <= tol:
        element[count], place_t[count], depth[count] = e, t, off
        count += 1
    return count


@compiled
def _minima_on_span(  # noqa: PLR0912  -- the loop over what is left of a span is one argument
    tour: Tour,
    e: int,
    cx: float,
    cy: float,
    r: float,
    tol: float,
    element: Ints,
    place_t: Floats,
    depth: Floats,
    count: int,
) -> int:
    """Append the minima on one span; see `distance_minima`."""
    degree = tour.element[e].degree
    # The power with respect to the grown disc: positive means farther than r + tol.
    coefficients = power_distance(tour.control[e], degree, cx, cy, r + tol)
    if _smallest(coefficients) > 0.0:
        return count
    width = 2 * degree + 1
    stack, ends = np.empty((_MAX_STACK, width)), np.empty((_MAX_STACK, 2))
    for i in range(width):
        stack[0, i] = coefficients[i]
    ends[0, 0], ends[0, 1] = 0.0, 1.0
    top, first = 1, count
    while top > 0:
        top -= 1
        low, high = ends[top]
        for i in range(width):
            coefficients[i] = stack[top, i]
        least = _smallest(coefficients)
        if least > 0.0:
            continue
        most = _largest(coefficients)
        # A stretch that runs inside the disc as a whole is a witness that settles the question.
        inside = most < -4.4 * tol * r
        # One on which the distance varies less than matters (it follows the circle) is as good as one point of it.
        level = most - least < EMPTY / 2 * r
        at_low, at_high, convex = _lowest(coefficients, low == 0.0, high == 1.0)
        settled = inside or level or at_low >= 0 or convex
        if not settled and high - low > _SHORTEST and top + 2 <= _MAX_STACK and count < len(element) - 1:
            # The left half ends up on top, so places come in the order of the span.
            halve(coefficients, stack[top + 1], stack[top])
            middle = (low + high) / 2
            ends[top, 0], ends[top, 1] = middle, high
            ends[top + 1, 0], ends[top + 1, 1] = low, middle
            top += 2
            continue
        if at_low == 0 and at_high == 0:
            continue
        if at_low > 0:
            t = low
        elif at_high > 0:
            t = high
        else:
            t = _span_minimum(tour, e, low, high, cx, cy)
        if t - low < _NEAR_END or high - t < _NEAR_END:
            t = _span_minimum(tour, e, max(t + low - high, 0.0), min(t + high - low, 1.0), cx, cy)
        x, y, _, _, _, _ = evaluate(tour.control[e], degree, t)
        # A negative coefficient is no proof that the curve itself comes near enough.
        off = math.hypot(x - cx, y - cy) - r
        known = off > tol
        for k in range(first, count):
            known = known or abs(place_t[k] - t) < _SAME_MINIMUM
        if not known and count < len(element):
            element[count], place_t[count], depth[count] = e, t, off
            count += 1
        if inside:
            break
    return count


@compiled
def _smallest(values: Floats) -> float:
    least = values[0]
    for value in values:
        least = min(least, value)
    return least


@compiled
def _largest(values: Floats) -> float:
    most = values[0]
    for value in values:
        most = max(most, value)
    return most


@compiled
def _lowest(coefficients: Floats, is_first: bool, is_last: bool) -> tuple[int, int, bool]:
    """Tell from a stretch's coefficients where it can have a local minimum.

    Returns
    -------
    at_low, at_high : int
        1 if at that end, 0 if surely not, both -1 if the stretch neither rises nor falls throughout. An end inside the
        span is a minimum only if the slope vanishes there; otherwise the neighbouring stretch goes on falling.
    convex : bool
        Whether there is just one minimum.
    """
    n = len(coefficients)
    rising, falling, convex, before = True, True, True, -math.inf
    for i in range(n - 1):
        step = coefficients[i + 1] - coefficients[i]
        rising, falling, convex = rising and step >= 0.0, falling and step <= 0.0, convex and step >= before
        before = step
    noise = 1e-16
    if rising:
        return (1 if is_first or coefficients[1] - coefficients[0] <= noise else 0), 0, False
    if falling:
        return 0, (1 if is_last or coefficients[n - 1] - coefficients[n - 2] >= -noise else 0), False
    return -1, -1, convex


@compiled
def _span_minimum(tour: Tour, e: int, low: float, high: float, cx: float, cy: float) -> float:
    """Parameter of the smallest distance to c on [low, high], where the distance has one minimum: safe Newton."""
    t = (low + high) / 2
    a, b = low, high
    for _ in range(60):
        x, y, dx, dy, ddx, ddy = evaluate(tour.control[e], tour.element[e].degree, t)
        g = dx * (x - cx) + dy * (y - cy)
        if g > 0:
            b = t
        else:
            a = t
        slope = dx * dx + dy * dy + ddx * (x - cx) + ddy * (y - cy)
        s = t - g / slope if slope > 0 else math.inf
        if not (a <= s <= b):
            s = (a + b) / 2
        if abs(s - t) < _RESOLUTION or b - a < _RESOLUTION:
            t = s
            break
        t = s
    return t


@compiled
def touching(
    tour: Tour, cx: float, cy: float, r: float, tol: float, skip: int, floor: float = math.inf
) -> tuple[float, int, Ints, Floats]:
    """Contacts of a disc: the places where the boundary touches it within `tol`.

    The search ends with the first boundary point deeper inside than `floor`: whoever asks whether a disc is empty needs
    one witness, not all contacts.

    Returns
    -------
    deepest : float
        Smallest ``|q - c| - r`` over the boundary near the disc; below ``-EMPTY`` the disc is not empty.
    count : int
    element, t : arrays
        Contacts, in normal form; a reflex vertex appears as a place on its cone.
    """
    found, element, t, depth = distance_minima(tour, cx, cy, r, tol, skip, floor)
    deepest = math.inf
    count = 0
    for k in range(found):
        deepest = min(deepest, depth[k])
        e, s = element[k], t[k]
        if s <= _SNAP or s >= 1.0 - _SNAP:
            # The end of a span: a contact only where the boundary beyond it does not come nearer still.
            e, s, keep = contact_at_border(tour, e, s <= _SNAP, cx, cy)
            if not keep:
                continue
        known = False
        for i in range(count):
            known = known or same_foot(tour, element[i], t[i], e, s, cx, cy, r)
        if not known:
            element[count], t[count] = e, s
            count += 1
    return deepest, count, element, t


@compiled
def contact_at_border(tour: Tour, e: int, at_start: bool, cx: float, cy: float) -> tuple[int, float, bool]:
    """Decide whether a disc around c that reaches a span's end touches there, and as which place."""
    other = tour.element[e].before if at_start else tour.element[e].after
    if tour.element[other].degree == 0:
        s = cone_turn(tour, other, cx, cy)
        angle = abs(tour.element[other].cone_turn)
        if -1e-9 / angle <= s <= 1.0 + 1e-9 / angle:
            e, s = normal_form(tour, other, min(max(s, 0.0), 1.0))
            return e, s, True
        return e, 0.0, False
    border = e if at_start else other
    x, y, dx, dy, _, _ = evaluate(tour.control[border], tour.element[border].degree, 0.0)
    left = tour.element[border].before
    _, _, ux, uy, _, _ = evaluate(tour.control[left], tour.element[left].degree, 1.0)
    reach = math.hypot(x - cx, y - cy)
    speed_right, speed_left = math.hypot(dx, dy), math.hypot(ux, uy)
    rising_right = (dx * (x - cx) + dy * (y - cy)) / speed_right > -(_LEVEL * reach + 2 * _SNAP * speed_right)
    falling_left = (ux * (x - cx) + uy * (y - cy)) / speed_left < _LEVEL * reach + 2 * _SNAP * speed_left
    return border, 0.0, rising_right and falling_left


@compiled
def nearest_on_stretch(tour: Tour, e: int, low: float, high: float, cx: float, cy: float) -> tuple[float, float]:
    """Return the place of a stretch that is nearest to c, and its distance."""
    if tour.element[e].degree == 0:
        s = min(max(cone_turn(tour, e, cx, cy), low), high)
        return s, math.hypot(tour.control[e, 0, 0] - cx, tour.control[e, 0, 1] - cy)
    count = 9
    best_k, best = 0, math.inf
    for k in range(count):
        x, y, _, _, _, _ = evaluate(tour.control[e], tour.element[e].degree, low + (high - low) * k / (count - 1))
        d = math.hypot(x - cx, y - cy)
        if d < best:
            best_k, best = k, d
    width = (high - low) / (count - 1)
    t = _span_minimum(tour, e, max(low, low + (best_k - 1) * width), min(high, low + (best_k + 1) * width), cx, cy)
    x, y, _, _, _, _ = evaluate(tour.control[e], tour.element[e].degree, t)
    return t, math.hypot(x - cx, y - cy)


@compiled
def normal_form(tour: Tour, e: int, t: float) -> tuple[int, float]:
    """Snap to borders, which belong to the element that starts there."""
    if t >= 1.0 - _SNAP:
        return tour.element[e].after, 0.0
    return e, 0.0 if t <= _SNAP else t


@compiled
def cone_turn(tour: Tour, e: int, cx: float, cy: float) -> float:
    """Parameter on a cone of the direction from its vertex to a centre; outside [0, 1] if not in the cone."""
    angle = math.atan2(cy - tour.control[e, 0, 1], cx - tour.control[e, 0, 0]) - tour.element[e].cone_angle
    middle = tour.element[e].cone_turn / 2
    turned = angle - middle
    angle = middle + turned - 2 * math.pi * math.floor(turned / (2 * math.pi) + 0.5)
    return angle / tour.element[e].cone_turn
