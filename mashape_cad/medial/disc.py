"""The maximal disc at one boundary place.

The disc through the place p (inward normal n) and another boundary point q has radius

    f(p, q) = |q - p|^2 / (2 n.(q - p));

the maximal disc at p has the smallest of them all, at most the radius of curvature at p. Its other contact, the *twin*,
is found by descending f from the best of some samples; then every span near the disc is asked whether it enters it
(`emptiness`). One that does gives a better start; when none does the disc is maximal.

References
----------
J. Ma, S. W. Bae, S. Choi, 3D medial axis point approximation using nearest neighbors and the normal field, Visual
Computer 28 (2012): the shrinking ball. The emptiness proof by Bernstein bounds is ours.
"""

import math

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.bezier import evaluate
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.contact import TOUCH, same_foot
from mashape_cad.medial.emptiness import (
    EMPTY,
    NO_SKIP,
    cone_turn,
    contact_at_border,
    distance_minima,
    normal_form,
    touching,
)
from mashape_cad.medial.tour import RUN, Ints, Tour, box_apart, run_apart, site

__all__ = ["maximal_disc", "twin_on_stretch"]

# Samples on a stretch, the lowest of which start the search for a twin. Towards a vertex they crowd by this factor from
# one to the next, down to a millionth of a millionth of the stretch.
_SAMPLES, _SAMPLES_CROWDED, _CROWDING = 12, 48, 0.25
_TINY = 1e-300  # a height below this counts as none: a quotient by it would overflow
_STRAIGHT = 1e-9  # a curvature below this bounds no disc; _WIDEST does
# A sample whose square distance is less than this, times its radius, lies no higher above the tangent than rounding may
# lift it: a quotient of roundings, as next to the place itself.
_LOST = 4e-15
# Rounding takes so much of a radius, times the radius over the square of how far its two feet are apart.
_QUOTIENT = 1e-14
_WIDEST = 4.0  # radius that no disc inside a shape of size 1 has
# Steps of the descent: below the first f is flat to rounding and G alone tells whether a step helps; below the second
# the parameter has settled; the third is the spacing of numbers near 1.
_FLAT_STEP, _SETTLED_STEP, _RESOLUTION = 1e-6, 1e-15, 1e-16


@compiled
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
    if t == 0.0 and tour.element[e].degree > 0:
        left = tour.element[e].before
        if tour.element[left].degree > 0:
            curvature = max(curvature, site(tour, left, 1.0)[4])
    r = 1.0 / curvature if curvature > _STRAIGHT else _WIDEST
    start_e, start_t = _best_sample(tour, e, px, py, nx, ny, r)
    twin_e, twin_t = -1, 0.0
    for _ in range(60):
        if start_e >= 0:
            f, f_e, f_t = _polish(tour, px, py, nx, ny, start_e, start_t)
            if f < r:
                r, twin_e, twin_t = f, f_e, f_t
        cx, cy = px + r * nx, py + r * ny
        found, element, place_t, depth = distance_minima(tour, cx, cy, r, TOUCH, NO_SKIP, math.inf)
        deepest, start_e = -EMPTY, -1
        for k in range(found):
            # Right at p the circle follows the boundary by construction; what is deeper there is rounding.
            if depth[k] < deepest and _radius(px, py, nx, ny, *site(tour, element[k], place_t[k])[:2]) < r:
                deepest, start_e, start_t = depth[k], element[k], place_t[k]
        if start_e < 0:
            return _with_contacts(tour, e, t, cx, cy, r, twin_e, twin_t)
    none = np.empty(0, np.int64), np.empty(0)
    return px, py, 0.0, False, 0, none[0], none[1]


@compiled
def _best_sample(tour: Tour, e: int, px: float, py: float, nx: float, ny: float, r: float) -> tuple[int, float]:
    """Return the sample with the smallest f(p, .) for p on `e`, if one has less than r; element -1 if none has.

    An element whose box the disc found so far does not meet cannot make it smaller. So we begin beside p, where the
    boundary's bends soon bring the disc down to their size.
    """
    best_e, best_t = -1, 0.0
    for step in range(len(tour.run)):
        run = (e // RUN + step) % len(tour.run)
        if run_apart(tour, run, px + r * nx, py + r * ny) > r * r:
            continue
        for q in range(run * RUN, min((run + 1) * RUN, len(tour.element))):
            if box_apart(tour, q, px + r * nx, py + r * ny) > r * r:
                continue
            for k in range(tour.element[q].sample_from, tour.element[q].sample_to):
                f = _radius(px, py, nx, ny, tour.sample[k, 0], tour.sample[k, 1])
                if f < r:
                    r, best_e, best_t = f, q, tour.sample[k, 2]
    return best_e, best_t


@compiled
def _with_contacts(
    tour: Tour, e: int, t: float, cx: float, cy: float, r: float, twin_e: int, twin_t: float
) -> tuple[float, float, float, bool, int, Ints, Floats]:
    """Collect the contacts other than the place itself, the twin first."""
    _, found, element, place_t = touching(tour, cx, cy, r, TOUCH, NO_SKIP, math.inf)
    out_e, out_t = np.empty(found + 1, np.int64), np.empty(found + 1)
    count = 0
    if twin_e >= 0:
        twin_e, twin_t = normal_form(tour, twin_e, twin_t)
        if twin_t == 0.0 and tour.element[twin_e].degree > 0:
            # The descent may end on a span beside a cone, where the twin is the cone.
            at_e, at_t, is_contact = contact_at_border(tour, twin_e, True, cx, cy)
            if is_contact:
                twin_e, twin_t = at_e, at_t
        if not same_foot(tour, twin_e, twin_t, e, t, cx, cy, r):
            out_e[0], out_t[0], count = twin_e, twin_t, 1
    twins = count
    for k in range(found):
        known = _same_contact(tour, element[k], place_t[k], e, t, cx, cy, r)
        for i in range(twins):
            known = known or _same_contact(tour, element[k], place_t[k], out_e[i], out_t[i], cx, cy, r)
        for i in range(twins, count):
            known = known or same_foot(tour, element[k], place_t[k], out_e[i], out_t[i], cx, cy, r)
        if not known:
            out_e[count], out_t[count] = element[k], place_t[k]
            count += 1
    return cx, cy, r, True, count, out_e, out_t


@compiled
def _same_contact(tour: Tour, e: int, t: float, f: int, s: float, cx: float, cy: float, r: float) -> bool:
    """Whether two places are one contact: they coincide, or the span between them stays on the circle."""
    if same_foot(tour, e, t, f, s, cx, cy, r):
        return True
    if e != f and tour.element[f].before == e and s == 0.0:
        f, s = e, 1.0
    elif e != f and tour.element[e].before == f and t == 0.0:
        e, t = f, 1.0
    if e != f or tour.element[e].degree == 0:
        return False
    for k in range(1, 8):
        x, y, _, _, _, _ = site(tour, e, t + (s - t) * k / 8)
        if abs(math.hypot(x - cx, y - cy) - r) > TOUCH:
            return False
    return True


@compiled
def _polish(tour: Tour, px: float, py: float, nx: float, ny: float, e: int, t: float) -> tuple[float, int, float]:
    """Descend f(p, q) from q = (e, t) to a local minimum; Newton on G, halved while f does not fall."""
    if tour.element[e].degree == 0:
        other = tour.element[e].after
        f, g, _, _, _ = _descent(tour, px, py, nx, ny, other, 0.0)
        if f < math.inf and g < 0.0:
            e, t = other, 0.0
        else:
            e, t = tour.element[e].before, 1.0
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


@compiled
def _descent(
    tour: Tour, px: float, py: float, nx: float, ny: float, e: int, t: float
) -> tuple[float, float, float, float, float]:
    """Return f(p, q), its slope's sign function G = q'.(q - c), an estimate of G', and the speed at q = (e, t)."""
    qx, qy, tx, ty, sx, sy = evaluate(tour.control[e], tour.element[e].degree, t)
    f = _radius(px, py, nx, ny, qx, qy)
    if f == math.inf:
        return f, 0.0, 1.0, 1.0, 0.0
    cx, cy = px + f * nx, py + f * ny
    g = tx * (qx - cx) + ty * (qy - cy)
    height = nx * (qx - px) + ny * (qy - py)
    slope = tx * tx + ty * ty + sx * (qx - cx) + sy * (qy - cy) - g / height * (nx * tx + ny * ty)
    return f, g, slope, math.hypot(tx, ty), height


@compiled
def _neighbour(
    tour: Tour, px: float, py: float, nx: float, ny: float, e: int, forward: bool
) -> tuple[bool, int, float]:
    """Step over the end of a span while f still falls there.

    Returns
    -------
    moved : bool
        Whether the descent goes on, on the span returned; if not, the place returned is the minimum.
    """
    other = tour.element[e].after if forward else tour.element[e].before
    cone = -1
    if tour.element[other].degree == 0:
        cone = other
        other = tour.element[other].after if forward else tour.element[other].before
    start = 0.0 if forward else 1.0
    f, g, _, _, _ = _descent(tour, px, py, nx, ny, other, start)
    if f < math.inf and (g < 0.0 if forward else g > 0.0):
        return True, other, start
    if cone >= 0:
        s = cone_turn(tour, cone, px + f * nx, py + f * ny)
        return False, cone, min(max(s, 0.0), 1.0)
    return False, e, 1.0 if forward else 0.0


@compiled
def _radius(px: float, py: float, nx: float, ny: float, qx: float, qy: float) -> float:
    """Radius of the disc that touches p along n and passes through q; infinite if q lies behind p."""
    dx, dy = qx - px, qy - py
    height = nx * dx + ny * dy
    if height <= _TINY:
        return math.inf
    return (dx * dx + dy * dy) / (2.0 * height)


@compiled
def _share(k: int, crowded: bool) -> float:
    """Share of a stretch at which sample k lies: at equal steps, or crowded towards both ends by powers."""
    if not crowded:
        return k / _SAMPLES
    half = _SAMPLES_CROWDED // 2
    steps = half - 4
    j = k if k <= half else _SAMPLES_CROWDED - k
    share = 0.0 if j == 0 else 0.25 * _CROWDING ** (steps - j) if j <= steps else 0.25 + 0.25 * (j - steps) / 4
    return share if k <= half else 1.0 - share


@compiled
def twin_on_stretch(tour: Tour, e: int, t: float, f: int, low: float, high: float) -> tuple[float, float, float, float]:
    """Return the disc at (e, t) whose twin is known to lie on a stretch: x, y, r and the twin's parameter.

    f(p, .) is sampled on the stretch and descended to a root of G between the neighbours of the lowest sample. So it is
    from any other that is below both of its neighbours: a narrow valley between samples may be deeper than what looks
    deepest, by more than rounding.
    """
    px, py, nx, ny, curvature, _ = site(tour, e, t)
    limit = 1.0 / curvature if curvature > _STRAIGHT else _WIDEST
    if tour.element[f].degree == 0:
        r = min(limit, _radius(px, py, nx, ny, tour.control[f, 0, 0], tour.control[f, 0, 1]))
        x, y = px + r * nx, py + r * ny
        return x, y, r, min(max(cone_turn(tour, f, x, y), low), high)
    # Next to a convex vertex, and to an end where curvature jumps at the border of two spans, the twin is as near to
    # that as the place is: samples crowd there.
    crowded = (low == 0.0 and (tour.element[f].convex or tour.element[f].before == e)) or (
        high == 1.0 and (tour.element[tour.element[f].after].convex or tour.element[f].after == e)
    )
    count = _SAMPLES_CROWDED if crowded else _SAMPLES
    values, best = np.empty(count + 1), 0
    for k in range(count + 1):
        values[k] = _sampled(tour, px, py, nx, ny, f, low + (high - low) * _share(k, crowded))
        if values[k] < values[best]:
            best = k
    least, twin, _ = _valley(tour, px, py, nx, ny, f, low, high, best, crowded)
    for k in range(count + 1):
        before, after = values[k - 1] if k > 0 else math.inf, values[k + 1] if k < count else math.inf
        if k != best and values[k] <= before and values[k] < after:
            radius, s, doubt = _valley(tour, px, py, nx, ny, f, low, high, k, crowded)
            if radius + doubt < least:
                least, twin = radius, s
    r = min(limit, least)
    return px + r * nx, py + r * ny, r, twin


@compiled
def _valley(
    tour: Tour, px: float, py: float, nx: float, ny: float, f: int, low: float, high: float, k: int, crowded: bool
) -> tuple[float, float, float]:
    """Descend f(p, .) from a sample of a stretch: the radius, its place, and what rounding may do to the radius.

    Next to p itself valleys are quotients of roundings.
    """
    last = _SAMPLES_CROWDED if crowded else _SAMPLES
    a = low + (high - low) * _share(max(k - 1, 0), crowded)
    b = low + (high - low) * _share(min(k + 1, last), crowded)
    s = _lowest(tour, px, py, nx, ny, f, a, b, min(max(low + (high - low) * _share(k, crowded), a), b))
    radius = _descent(tour, px, py, nx, ny, f, s)[0]
    qx, qy, _, _, _, _ = evaluate(tour.control[f], tour.element[f].degree, s)
    apart_sq = (qx - px) ** 2 + (qy - py) ** 2
    return radius, s, _QUOTIENT * radius * radius / apart_sq if apart_sq > 0.0 else math.inf


@compiled
def _sampled(tour: Tour, px: float, py: float, nx: float, ny: float, f: int, t: float) -> float:
    """Radius of the disc through a sample; infinite where rounding alone may lift it above the tangent."""
    qx, qy, _, _, _, _ = evaluate(tour.control[f], tour.element[f].degree, t)
    radius = _radius(px, py, nx, ny, qx, qy)
    return radius if (qx - px) ** 2 + (qy - py) ** 2 > _LOST * radius else math.inf


@compiled
def _lowest(
    tour: Tour, px: float, py: float, nx: float, ny: float, f: int, a: float, b: float, sampled: float
) -> float:
    """Descend f(p, .) from the best sample of a bracket [a, b] to a root of G."""
    s = sampled
    for _ in range(80):
        radius, g, slope, _, _ = _descent(tour, px, py, nx, ny, f, s)
        if radius == math.inf:
            # A step to where the boundary lies behind p: the minimum is on the side of the best sample.
            if s == sampled:
                break
            a, b = (a, s) if s > sampled else (s, b)
            s = (a + b) / 2
            continue
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
    return s
