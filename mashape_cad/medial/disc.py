"""The maximal disc at one boundary place, and whether a disc is empty.

The disc through the place p (inward normal n) and another boundary point q has radius

    f(p, q) = |q - p|^2 / (2 n.(q - p));

the maximal disc at p has the smallest of them all, at most the radius of curvature at p. Its other contact, the *twin*,
is found by descending f from the best of some samples; then every span near the disc is asked, by bounds on a
polynomial, whether it enters it. One that does gives a better start; when none does the disc is maximal.

References
----------
J. Ma, S. W. Bae, S. Choi, 3D medial axis point approximation using nearest neighbors and the normal field, Visual
Computer 28 (2012): the shrinking ball. The emptiness proof by Bernstein bounds is ours.
"""

import math

import numpy as np
from numba import njit

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.bezier import evaluate, halves, power_distance
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = [
    "EMPTY",
    "TOUCH",
    "cone_turn",
    "distance_minima",
    "maximal_disc",
    "nearest_on_stretch",
    "same_place",
    "touching",
    "twin_on_stretch",
]

# A disc is empty when no boundary point lies deeper inside than this (sizes of the shape). Looser is wrong: near an
# osculating contact the boundary enters by a cube law, and 1e-10 would let discs through that miss a short branch.
EMPTY = 1e-13
# A boundary point this close to the circle touches it: one more contact of a junction.
TOUCH = 1e-11
# Two contacts closer than this, absolutely or times the radius, cannot be told apart: a disc of curvature radius r
# leaves the boundary by s^2 / r only, so feet are known to about the root of the distance's rounding.
_SAME_ABSOLUTE, _SAME_RELATIVE = 3e-9, 3e-6
_SNAP = 1e-9  # parameters this close to a border are the border
_TINY = 1e-300  # a height below this counts as none: a quotient by it would overflow
_STRAIGHT = 1e-9  # a curvature below this bounds no disc; _WIDEST does
_WIDEST = 4.0  # radius that no disc inside a shape of size 1 has
_SAME_CIRCLE = 1e-8  # arcs whose centres and radii agree this well lie on one circle
# Steps of the descent: below the first f is flat to rounding and G alone tells whether a step helps; below the second
# the parameter has settled; the third is the spacing of numbers near 1.
_FLAT_STEP, _SETTLED_STEP, _RESOLUTION = 1e-6, 1e-15, 1e-16
# Minima on a span: a stretch this short is not halved any more, a minimum this near to its end is looked for beyond it
# too, and two this close are one.
_SHORTEST, _NEAR_END, _SAME_MINIMUM = 1e-6, 1e-12, 1e-7
_MAX_STACK = 256
_MAX_FOUND = 512


@njit(cache=True)
def _radius(px: float, py: float, nx: float, ny: float, qx: float, qy: float) -> float:
    """Radius of the disc that touches p along n and passes through q; infinite if q lies behind p."""
    dx, dy = qx - px, qy - py
    height = nx * dx + ny * dy
    if height <= _TINY:
        return math.inf
    return (dx * dx + dy * dy) / (2.0 * height)


@njit(cache=True)
def _descent(
    tour: Tour, px: float, py: float, nx: float, ny: float, e: int, t: float
) -> tuple[float, float, float, float, float]:
    """Return f(p, q), its slope's sign function G = q'.(q - c), an estimate of G', and the speed at q = (e, t)."""
    qx, qy, tx, ty, sx, sy = evaluate(tour.control[e], tour.degree[e], t)
    f = _radius(px, py, nx, ny, qx, qy)
    if f == math.inf:
        return f, 0.0, 1.0, 1.0, 0.0
    cx, cy = px + f * nx, py + f * ny
    g = tx * (qx - cx) + ty * (qy - cy)
    height = nx * (qx - px) + ny * (qy - py)
    slope = tx * tx + ty * ty + sx * (qx - cx) + sy * (qy - cy) - g / height * (nx * tx + ny * ty)
    return f, g, slope, math.hypot(tx, ty), height


@njit(cache=True)
def cone_turn(tour: Tour, e: int, cx: float, cy: float) -> float:
    """Parameter on a cone of the direction from its vertex to a centre; outside [0, 1] if not in the cone."""
    angle = math.atan2(cy - tour.control[e, 0, 1], cx - tour.control[e, 0, 0]) - tour.cone[e, 0]
    middle = tour.cone[e, 1] / 2
    turned = angle - middle
    angle = middle + turned - 2 * math.pi * math.floor(turned / (2 * math.pi) + 0.5)
    return angle / tour.cone[e, 1]


@njit(cache=True)
def _neighbour(
    tour: Tour, px: float, py: float, nx: float, ny: float, e: int, forward: bool
) -> tuple[bool, int, float]:
    """Step over the end of a span while f still falls there.

    Returns
    -------
    moved : bool
        Whether the descent goes on, on the span returned; if not, the place returned is the minimum.
    """
    other = tour.after[e] if forward else tour.before[e]
    cone = -1
    if tour.degree[other] == 0:
        cone = other
        other = tour.after[other] if forward else tour.before[other]
    start = 0.0 if forward else 1.0
    f, g, _, _, _ = _descent(tour, px, py, nx, ny, other, start)
    if f < math.inf and (g < 0.0 if forward else g > 0.0):
        return True, other, start
    if cone >= 0:
        s = cone_turn(tour, cone, px + f * nx, py + f * ny)
        return False, cone, min(max(s, 0.0), 1.0)
    return False, e, 1.0 if forward else 0.0


@njit(cache=True)
def _polish(tour: Tour, px: float, py: float, nx: float, ny: float, e: int, t: float) -> tuple[float, int, float]:
    """Descend f(p, q) from q = (e, t) to a local minimum; Newton on G, halved while f does not fall."""
    if tour.degree[e] == 0:
        other = tour.after[e]
        f, g, _, _, _ = _descent(tour, px, py, nx, ny, other, 0.0)
        if f < math.inf and g < 0.0:
            e, t = other, 0.0
        else:
            e, t = tour.before[e], 1.0
    f, g, slope, speed, _ = _descent(tour, px, py, nx, ny, e, t)
    for k in range(200):
        if f == math.inf:
            break
        if (t == 0.0 and g > 0.0) or (t == 1.0 and g < 0.0):
            moved, e, t = _neighbour(tour, px, py, nx, ny, e, t == 1.0)
            if not moved:
                return f, e, t
            f, g, slope, speed, _ = _descent(tour, px, py, nx, ny, e, t)
            continue
        # Where G does not rise f is not convex: a small fixed step downhill leaves such stretches.
        step = -g / slope if slope > 1e-6 * speed * speed else -math.copysign(0.05, g)
        bound = 0.3 * 0.97**k
        step = min(max(step, -bound), bound)
        accepted = False
        s, f_new, g_new, slope_new, speed_new = t, f, g, slope, speed
        for _ in range(40):
            s = min(max(t + step, 0.0), 1.0)
            f_new, g_new, slope_new, speed_new, _ = _descent(tour, px, py, nx, ny, e, s)
            if f_new <= f or (abs(step) < _FLAT_STEP and abs(g_new) < abs(g)):
                accepted = True
                break
            step /= 2
        if not accepted:
            break
        done = abs(s - t) < _SETTLED_STEP
        t, f, g, slope, speed = s, f_new, g_new, slope_new, speed_new
        if done and 0.0 < t < 1.0:
            break
        if done and g == 0.0:
            break
    return f, e, t


@njit(cache=True)
def _span_minimum(tour: Tour, e: int, low: float, high: float, cx: float, cy: float) -> float:
    """Parameter of the smallest distance to c on [low, high], where the distance has one minimum: safe Newton."""
    t = (low + high) / 2
    a, b = low, high
    for _ in range(60):
        x, y, dx, dy, ddx, ddy = evaluate(tour.control[e], tour.degree[e], t)
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


@njit(cache=True)
def distance_minima(
    tour: Tour, cx: float, cy: float, r: float, tol: float, skip: int
) -> tuple[int, Ints, Floats, Floats]:
    """Find every place where the boundary comes nearest to c, locally, and lies within r + tol of it.

    Spans that certainly stay away are discarded by the convex hull of their Bernstein coefficients; where the
    coefficients are convex there is one minimum, found by Newton; what is neither is cut in two.

    Parameters
    ----------
    skip : int
        Circle number (see `Tour.round_centre`) of elements to leave out: an element index whose circle's spans are the
        disc's own contact; -1 for none.

    Returns
    -------
    count : int
    element, t : arrays
        Places; only the first `count` rows count.
    depth : array
        ``|q - c| - r``: negative inside the disc.
    """
    element = np.empty(_MAX_FOUND, np.int64)
    place_t = np.empty(_MAX_FOUND)
    depth = np.empty(_MAX_FOUND)
    count = 0
    reach = r + tol
    for e in range(len(tour.degree)):
        if tour.degree[e] == 0:
            continue
        bx = max(tour.box[e, 0] - cx, 0.0, cx - tour.box[e, 2])
        by = max(tour.box[e, 1] - cy, 0.0, cy - tour.box[e, 3])
        if bx * bx + by * by > reach * reach:
            continue
        if (
            skip >= 0
            and abs(tour.round_radius[e] - tour.round_radius[skip]) <= _SAME_CIRCLE
            and (
                math.hypot(
                    tour.round_centre[e, 0] - tour.round_centre[skip, 0],
                    tour.round_centre[e, 1] - tour.round_centre[skip, 1],
                )
                <= _SAME_CIRCLE
            )
        ):
            continue
        count = _minima_on_span(tour, e, cx, cy, r, tol, element, place_t, depth, count)
    return count, element, place_t, depth


@njit(cache=True)
def _minima_on_span(
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
    degree = tour.degree[e]
    reach = r + tol
    stack = np.empty((_MAX_STACK, 2 * degree + 1))
    ends = np.empty((_MAX_STACK, 2))
    # The power with respect to the grown disc: positive means farther than r + tol.
    stack[0] = power_distance(tour.control[e], degree, cx, cy, reach)
    ends[0] = 0.0, 1.0
    top = 1
    first = count
    while top > 0:
        top -= 1
        coefficients = stack[top].copy()
        low, high = ends[top]
        if coefficients.min() > 0.0:
            continue
        # A stretch that runs inside the disc as a whole is a witness that settles the question.
        inside = coefficients.max() < -4.4 * tol * r
        # One on which the distance varies less than matters (it follows the circle) is as good as one point of it.
        level = coefficients.max() - coefficients.min() < EMPTY / 2 * r
        at_low, at_high, convex = _lowest(coefficients, low == 0.0, high == 1.0)
        settled = inside or level or at_low >= 0 or convex
        if not settled and high - low > _SHORTEST and top + 2 <= _MAX_STACK:
            left, right = halves(coefficients)
            middle = (low + high) / 2
            stack[top], stack[top + 1] = right, left
            ends[top] = middle, high
            ends[top + 1] = low, middle
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
            width = high - low
            t = _span_minimum(tour, e, max(t - width, 0.0), min(t + width, 1.0), cx, cy)
        x, y, _, _, _, _ = evaluate(tour.control[e], degree, t)
        # A negative coefficient is no proof that the curve itself comes near enough.
        off = math.hypot(x - cx, y - cy) - r
        known = off > tol
        for k in range(first, count):
            known = known or abs(place_t[k] - t) < _SAME_MINIMUM
        if not known and count < _MAX_FOUND:
            element[count], place_t[count], depth[count] = e, t, off
            count += 1
        if inside:
            break
    return count


@njit(cache=True)
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
    steps = np.diff(coefficients)
    noise = 1e-16
    if steps.min() >= 0.0:
        return (1 if is_first or steps[0] <= noise else 0), 0, False
    if steps.max() <= 0.0:
        return 0, (1 if is_last or steps[-1] >= -noise else 0), False
    return -1, -1, bool(np.diff(steps).min() >= 0.0)


@njit(cache=True)
def same_place(tour: Tour, e: int, t: float, f: int, s: float, r: float) -> bool:
    """Whether two contacts of a disc of radius r are one and the same."""
    ax, ay, _, _, _, _ = site(tour, e, t)
    bx, by, _, _, _, _ = site(tour, f, s)
    return math.hypot(ax - bx, ay - by) <= max(_SAME_ABSOLUTE, _SAME_RELATIVE * r)


@njit(cache=True)
def _same_contact(tour: Tour, e: int, t: float, f: int, s: float, cx: float, cy: float, r: float) -> bool:
    """Whether two places are one contact: they coincide, or the span between them stays on the circle."""
    if same_place(tour, e, t, f, s, r):
        return True
    if e != f and tour.before[f] == e and s == 0.0:
        f, s = e, 1.0
    elif e != f and tour.before[e] == f and t == 0.0:
        e, t = f, 1.0
    if e != f or tour.degree[e] == 0:
        return False
    for k in range(1, 8):
        x, y, _, _, _, _ = site(tour, e, t + (s - t) * k / 8)
        if abs(math.hypot(x - cx, y - cy) - r) > TOUCH:
            return False
    return True


@njit(cache=True)
def _normal_form(tour: Tour, e: int, t: float) -> tuple[int, float]:
    """Snap to borders, which belong to the element that starts there."""
    if t >= 1.0 - _SNAP:
        return tour.after[e], 0.0
    return e, 0.0 if t <= _SNAP else t


@njit(cache=True)
def touching(tour: Tour, cx: float, cy: float, r: float, tol: float, skip: int) -> tuple[float, int, Ints, Floats]:
    """Contacts of a disc: the places where the boundary touches it within `tol`.

    Returns
    -------
    deepest : float
        Smallest ``|q - c| - r`` over the boundary near the disc; below ``-EMPTY`` the disc is not empty.
    count : int
    element, t : arrays
        Contacts, in normal form; a reflex vertex appears as a place on its cone.
    """
    found, element, t, depth = distance_minima(tour, cx, cy, r, tol, skip)
    deepest = math.inf
    count = 0
    for k in range(found):
        deepest = min(deepest, depth[k])
        e, s = element[k], t[k]
        if s <= _SNAP or s >= 1.0 - _SNAP:
            # The end of a span: a contact only where the boundary beyond it does not come nearer still.
            e, s, keep = _contact_at_border(tour, e, s <= _SNAP, cx, cy)
            if not keep:
                continue
        known = False
        for i in range(count):
            known = known or same_place(tour, element[i], t[i], e, s, r)
        if not known:
            element[count], t[count] = e, s
            count += 1
    return deepest, count, element, t


@njit(cache=True)
def _contact_at_border(tour: Tour, e: int, at_start: bool, cx: float, cy: float) -> tuple[int, float, bool]:
    """Decide whether a disc around c that reaches a span's end touches there, and as which place."""
    other = tour.before[e] if at_start else tour.after[e]
    if tour.degree[other] == 0:
        s = cone_turn(tour, other, cx, cy)
        angle = abs(tour.cone[other, 1])
        if -1e-9 / angle <= s <= 1.0 + 1e-9 / angle:
            e, s = _normal_form(tour, other, min(max(s, 0.0), 1.0))
            return e, s, True
        return e, 0.0, False
    border = e if at_start else other
    x, y, dx, dy, _, _ = evaluate(tour.control[border], tour.degree[border], 0.0)
    left = tour.before[border]
    _, _, ux, uy, _, _ = evaluate(tour.control[left], tour.degree[left], 1.0)
    reach = math.hypot(x - cx, y - cy)
    rising_right = (dx * (x - cx) + dy * (y - cy)) / math.hypot(dx, dy) > -1e-6 * reach
    falling_left = (ux * (x - cx) + uy * (y - cy)) / math.hypot(ux, uy) < 1e-6 * reach
    return border, 0.0, rising_right and falling_left


@njit(cache=True)
def maximal_disc(tour: Tour, e: int, t: float) -> tuple[float, float, float, bool, int, Ints, Floats]:
    """Find the maximal disc that touches the boundary at a place.

    Returns
    -------
    cx, cy, r : float
        Centre and radius.
    ok : bool
        False if the search did not end in an empty disc.
    count : int
    element, t : arrays
        The other contacts, the twin first; none if the disc osculates at the place and touches nothing else.
    """
    px, py, nx, ny, curvature, _ = site(tour, e, t)
    if t == 0.0 and tour.degree[e] > 0:
        left = tour.before[e]
        if tour.degree[left] > 0:
            curvature = max(curvature, site(tour, left, 1.0)[4])
    limit = 1.0 / curvature if curvature > _STRAIGHT else _WIDEST
    start_e, start_t, best = -1, 0.0, math.inf
    for k in range(len(tour.sample)):
        f = _radius(px, py, nx, ny, tour.sample[k, 0], tour.sample[k, 1])
        if f < best:
            best, start_e, start_t = f, tour.sample_element[k], tour.sample_t[k]
    r, twin_e, twin_t = limit, -1, 0.0
    for _ in range(60):
        if start_e >= 0:
            f, f_e, f_t = _polish(tour, px, py, nx, ny, start_e, start_t)
            if f < r:
                r, twin_e, twin_t = f, f_e, f_t
        cx, cy = px + r * nx, py + r * ny
        found, element, place_t, depth = distance_minima(tour, cx, cy, r, TOUCH, -1)
        deepest, start_e = -EMPTY, -1
        for k in range(found):
            # Right at p the circle follows the boundary by construction; what is deeper there is rounding.
            if depth[k] < deepest and _radius(px, py, nx, ny, *site(tour, element[k], place_t[k])[:2]) < r:
                deepest, start_e, start_t = depth[k], element[k], place_t[k]
        if start_e < 0:
            return _with_contacts(tour, e, t, cx, cy, r, twin_e, twin_t)
    none = np.empty(0, np.int64), np.empty(0)
    return px, py, 0.0, False, 0, none[0], none[1]


@njit(cache=True)
def _with_contacts(
    tour: Tour, e: int, t: float, cx: float, cy: float, r: float, twin_e: int, twin_t: float
) -> tuple[float, float, float, bool, int, Ints, Floats]:
    """Collect the contacts other than the place itself, the twin first."""
    _, found, element, place_t = touching(tour, cx, cy, r, TOUCH, -1)
    out_e, out_t = np.empty(found + 1, np.int64), np.empty(found + 1)
    count = 0
    if twin_e >= 0:
        twin_e, twin_t = _normal_form(tour, twin_e, twin_t)
        if not same_place(tour, twin_e, twin_t, e, t, r):
            out_e[0], out_t[0], count = twin_e, twin_t, 1
    twins = count
    for k in range(found):
        known = _same_contact(tour, element[k], place_t[k], e, t, cx, cy, r)
        for i in range(twins):
            known = known or _same_contact(tour, element[k], place_t[k], out_e[i], out_t[i], cx, cy, r)
        for i in range(twins, count):
            known = known or same_place(tour, element[k], place_t[k], out_e[i], out_t[i], r)
        if not known:
            out_e[count], out_t[count] = element[k], place_t[k]
            count += 1
    return cx, cy, r, True, count, out_e, out_t


@njit(cache=True)
def nearest_on_stretch(tour: Tour, e: int, low: float, high: float, cx: float, cy: float) -> tuple[float, float]:
    """Return the place of a stretch that is nearest to c, and its distance."""
    if tour.degree[e] == 0:
        s = min(max(cone_turn(tour, e, cx, cy), low), high)
        return s, math.hypot(tour.control[e, 0, 0] - cx, tour.control[e, 0, 1] - cy)
    count = 9
    best_k, best = 0, math.inf
    for k in range(count):
        x, y, _, _, _, _ = evaluate(tour.control[e], tour.degree[e], low + (high - low) * k / (count - 1))
        d = math.hypot(x - cx, y - cy)
        if d < best:
            best_k, best = k, d
    width = (high - low) / (count - 1)
    t = _span_minimum(tour, e, max(low, low + (best_k - 1) * width), min(high, low + (best_k + 1) * width), cx, cy)
    x, y, _, _, _, _ = evaluate(tour.control[e], tour.degree[e], t)
    return t, math.hypot(x - cx, y - cy)


@njit(cache=True)
def twin_on_stretch(tour: Tour, e: int, t: float, f: int, low: float, high: float) -> tuple[float, float, float, float]:
    """Return the disc at (e, t) whose twin is known to lie on a stretch: x, y, r and the twin's parameter.

    f(p, .) is sampled on the stretch and descended to a root of G between the neighbours of the best sample.
    """
    px, py, nx, ny, curvature, _ = site(tour, e, t)
    limit = 1.0 / curvature if curvature > _STRAIGHT else _WIDEST
    if tour.degree[f] == 0:
        r = min(limit, _radius(px, py, nx, ny, tour.control[f, 0, 0], tour.control[f, 0, 1]))
        x, y = px + r * nx, py + r * ny
        return x, y, r, min(max(cone_turn(tour, f, x, y), low), high)
    count = 12
    best_k, best = 0, math.inf
    for k in range(count + 1):
        radius = _descent(tour, px, py, nx, ny, f, low + (high - low) * k / count)[0]
        if radius < best:
            best_k, best = k, radius
    width = (high - low) / count
    a, b = max(low, low + (best_k - 1) * width), min(high, low + (best_k + 1) * width)
    s = min(max(low + best_k * width, a), b)
    for _ in range(80):
        radius, g, slope, _, _ = _descent(tour, px, py, nx, ny, f, s)
        if radius == math.inf:
            break
        if g > 0.0:
            b = s
        else:
            a = s
        step = s - g / slope if slope > 0.0 else math.inf
        if not (a <= step <= b):
            step = (a + b) / 2
        done = abs(step - s) < _RESOLUTION
        s = step
        if done or b - a < _RESOLUTION:
            break
    r = min(limit, _descent(tour, px, py, nx, ny, f, s)[0])
    return px + r * nx, py + r * ny, r, s
