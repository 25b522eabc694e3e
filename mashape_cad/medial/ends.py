"""Candidates for the ends of the medial axis, each accepted or rejected by a witness.

An end is a maximal disc with one contact: a convex vertex (radius 0), or a disc that osculates the boundary where its
curvature has a local maximum, possibly along a whole arc. The candidates are complete: interior maxima are isolated as
sign changes of a polynomial, borders are all looked at. A candidate whose disc is empty is a maximal disc; one that
also touches elsewhere counts with all its contacts. A candidate whose disc is not empty is none, and the place where
the boundary enters it is the witness.

References
----------
H. I. Choi, S. W. Choi, H. P. Moon, Mathematical theory of medial axis transform, Pacific J. Math. 181 (1997): ends are
convex vertices and curvature centres.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.bezier import curvature_sign, curvature_slope, halve, value
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.contact import TOUCH, apart, follows_circle, one_contact
from mashape_cad.medial.emptiness import EMPTY, NO_SKIP, holds_sample, touching
from mashape_cad.medial.faces import (
    ARC,
    CONTACTS,
    CORNER,
    DISCS,
    OSCULATING,
    Faces,
    SettledDisc,
    add_contact,
    add_disc,
    blank_faces,
    disc_at,
    on_contact,
    settled_discs,
)
from mashape_cad.medial.tour import ROUND, Ints, Tour, chord_squared, site

__all__ = ["curvature_candidates", "ends", "falling_roots", "settle_ends"]

# Radii and centres of arcs are rounded in files: an arc that fills a slot's end misses the slot's other wall by up to
# this (sizes), and still touches it. What it misses by is recorded as the disc's tolerance.
_ARC = 1e-8
# A kink at the end of an arc is rounding, and the vertex belongs to the arc's disc, where the neighbour enters that
# disc by less than half of this (sizes). A wider one is a vertex with a branch of its own.
_KINK = 1e-12
# A contact this close (sizes) to the end of an arc on the same circle belongs to that arc.
_ARC_END = 1e-6
# Arcs whose centres and radii agree this well (sizes) lie on one circle.
_SAME_CIRCLE = 10 * ROUND
# Discs found twice, from the two sides of a border or of a symmetry, agree this well (sizes).
_SAME_DISC = 3e-11
# Two osculating feet closer than this, times the radius, with no reflex vertex between are one.
_SAME_FOOT = 1e-6
# Coefficients this small against the largest one are rounding of products of up to eight factors.
_NOISE = 1e-11
_STRAIGHT = 1e-9  # a curvature below this (one over sizes) has no maximum that matters
_SAME_CURVATURE = 1e-9  # curvatures that agree this well, relatively, do not jump
# Rounding of a span's control points (sizes), times the square of its degree, tells in second differences: the span's
# curvature is known to so much over the square of its length, the slope of its curvature, as it is computed, to so much
# times the cube. Between knots a ten-thousandth apart curvature has six digits.
_CONTROL_ROUNDING = 4e-16
_STRETCHES = 128  # of parameters that may wait at once
_SHORTEST = 1e-9  # stretches of parameters this short are not halved any more: what changes sign there is one root


def ends(tour: Tour) -> list[SettledDisc]:
    """Return the discs of all accepted candidates; some may have more contacts than one.

    A domain that is one disc gives that one alone, with a contact from its loop's start to its start.
    """
    faces = blank_faces(tour)
    settle_ends(tour, faces)
    return settled_discs(faces)


@compiled
def settle_ends(tour: Tour, faces: Faces) -> bool:
    """Add the discs of all accepted candidates; return whether the domain is one disc, which then is the only one."""
    if _settle_arcs(tour, faces):
        return True
    filled = np.zeros(len(tour.element), np.bool_)
    for c in range(faces.used[CONTACTS]):
        # Where a rounded arc meets its neighbour at a kink, the arc's disc already fills that vertex.
        for e, t in (
            (faces.contact[c].first_e, faces.contact[c].first_t),
            (faces.contact[c].last_e, faces.contact[c].last_t),
        ):
            filled[e] = filled[e] or t == 0.0
    touched = _touched_arcs(tour, faces)
    for e in range(len(tour.element)):
        if tour.element[e].convex and not filled[e]:
            x, y, _, _, _, _ = site(tour, e, 0.0)
            add_contact(faces, add_disc(faces, x, y, 0.0, CORNER, TOUCH), e, 0.0, e, 0.0)
    element, place_t = curvature_candidates(tour, touched)
    for k in range(len(element)):
        _settle_osculating(tour, faces, element[k], place_t[k])
    return False


@compiled
def _touched_arcs(tour: Tour, faces: Faces) -> NDArray[np.bool_]:
    """Tell of each element whether it is an arc that a settled disc touches as a whole."""
    touched = np.zeros(len(tour.element), np.bool_)
    for c in range(faces.used[CONTACTS]):
        e = faces.contact[c].first_e
        while e != faces.contact[c].last_e:
            touched[e] = True
            e = tour.element[e].after
    return touched


@compiled
def _settle_arcs(tour: Tour, faces: Faces) -> bool:
    """Add the empty discs that fill arcs, those of one circle as one; return whether one disc is the whole domain."""
    joined = _joined_arcs(tour)
    for first in range(len(tour.element)):
        if not _starts_run(tour, joined, first):
            continue
        x, y, r, last, all_round = _run(tour, joined, first)
        if holds_sample(tour, x, y, r, _ARC):
            continue
        deepest = touching(tour, x, y, r, _ARC, first, _ARC)[0]
        if deepest < -_ARC or r * _widest_kink(tour, first, last) ** 2 > _KINK:
            continue
        tol = max(TOUCH, _off_circle(tour, first, last, x, y, r), -deepest)
        if all_round:
            # The domain's outer loop. (The outside of a hole is never empty.)
            faces.used[:] = 0
            add_contact(faces, add_disc(faces, x, y, r, ARC, tol), first, 0.0, first, 0.0)
            return True
        number = disc_at(faces, x, y, r, _SAME_CIRCLE)  # of another arc on the circle
        if number >= 0:
            faces.settled[number].tol = max(faces.settled[number].tol, tol)
        else:
            number = add_disc(faces, x, y, r, ARC, tol)
        add_contact(faces, number, first, 0.0, tour.element[last].after, 0.0)
    for number in range(faces.used[DISCS]):
        _add_points(tour, faces, number)
    return False


@compiled
def _widest_kink(tour: Tour, first: int, last: int) -> float:
    """Angle (radians) of the wider one of the convex vertices at the ends of a run of arcs; 0 if there is none."""
    widest = 0.0
    for e in (first, tour.element[last].after):
        if tour.element[e].convex:
            _, _, ax, ay, _, _ = site(tour, tour.element[e].before, 1.0)
            _, _, bx, by, _, _ = site(tour, e, 0.0)
            widest = max(widest, abs(math.atan2(ax * by - ay * bx, ax * bx + ay * by)))
    return widest


@compiled
def _joined_arcs(tour: Tour) -> NDArray[np.bool_]:
    """Tell of each element whether it goes on with the inward arc of the element before it.

    So does a line between two arcs of one circle: it is no longer than their centres are apart.
    """
    joined = np.zeros(len(tour.element), np.bool_)
    for e in range(len(tour.element)):
        before, after = tour.element[e].before, tour.element[e].after
        if _on_one_circle(tour, before, e) and not tour.element[e].convex:
            joined[e] = True
        elif tour.element[e].degree == 1 and before != after and _on_one_circle(tour, before, after):
            ax, ay, _, _, _, _ = site(tour, e, 0.0)
            bx, by, _, _, _, _ = site(tour, e, 1.0)
            if math.hypot(bx - ax, by - ay) <= _SAME_CIRCLE:
                joined[e] = joined[after] = True
    return joined


@compiled
def _on_one_circle(tour: Tour, e: int, f: int) -> bool:
    """Whether two elements are inward arcs with one circle."""
    a, b = tour.element[e], tour.element[f]
    shift = math.hypot(a.round_x - b.round_x, a.round_y - b.round_y)
    return shift <= _SAME_CIRCLE and abs(a.round_radius - b.round_radius) <= _SAME_CIRCLE


@compiled
def _starts_run(tour: Tour, joined: NDArray[np.bool_], e: int) -> bool:
    """Whether a run of arcs on one circle starts at an element; one all round starts at its lowest arc."""
    if math.isnan(tour.element[e].round_radius):
        return False
    if not joined[e]:
        return True
    at = tour.element[e].after
    while joined[at] and (at > e or math.isnan(tour.element[at].round_radius)):
        at = tour.element[at].after
    return at == e


@compiled
def _run(tour: Tour, joined: NDArray[np.bool_], first: int) -> tuple[float, float, float, int, bool]:
    """Return mean centre and radius of a run of arcs, its last element, and whether it goes all round.

    A short arc knows its centre less well than a long one, by the square of its length, and has as much less to say.
    """
    x = y = r = total = 0.0
    last = first
    while True:
        if not math.isnan(tour.element[last].round_radius):
            weight = chord_squared(tour, last)
            x += weight * tour.element[last].round_x
            y += weight * tour.element[last].round_y
            r += weight * tour.element[last].round_radius
            total += weight
        after = tour.element[last].after
        if after == first or not joined[after]:
            break
        last = after
    return x / total, y / total, r / total, last, tour.element[last].after == first and joined[first]


@compiled
def _off_circle(tour: Tour, first: int, last: int, x: float, y: float, r: float) -> float:
    """Largest distance of a run's spans from a circle, at a few places of each."""
    worst, e = 0.0, first
    while True:
        for k in range(5):
            qx, qy, _, _, _, _ = site(tour, e, k / 4)
            worst = max(worst, abs(math.hypot(qx - x, qy - y) - r))
        if e == last:
            return worst
        e = tour.element[e].after


@compiled
def _add_points(tour: Tour, faces: Faces, number: int) -> None:
    """Add the contacts of an arc's disc other than its arcs."""
    x, y, r, tol = faces.settled[number].x, faces.settled[number].y, faces.settled[number].r, faces.settled[number].tol
    arcs = faces.used[CONTACTS]
    first = 0
    while faces.contact[first].disc != number:
        first += 1
    _, count, element, t = touching(tour, x, y, r, 2 * tol, faces.contact[first].first_e, math.inf)
    # What touches at the end of an arc, or further on along its circle, is that arc.
    clear = max(math.sqrt(16 * r * tol), 3e-6 * r, _ARC_END)
    for k in range(count):
        is_new = True
        for c in range(arcs):
            arc = faces.contact[c]
            if arc.disc == number:
                is_new = (
                    is_new
                    and not on_contact(faces, c, element[k], t[k])
                    and apart(tour, element[k], t[k], arc.first_e, arc.first_t) > clear
                    and apart(tour, element[k], t[k], arc.last_e, arc.last_t) > clear
                    and not follows_circle(tour, arc.last_e, arc.last_t, element[k], t[k], x, y, r, 2 * tol)
                    and not follows_circle(tour, element[k], t[k], arc.first_e, arc.first_t, x, y, r, 2 * tol)
                )
        if is_new:
            add_contact(faces, number, element[k], t[k], element[k], t[k])


@compiled
def curvature_candidates(tour: Tour, touched: NDArray[np.bool_]) -> tuple[Ints, Floats]:
    """Return all places where curvature may have a positive local maximum: elements and parameters.

    Elements that are `touched` as a whole by a disc are left out: they are circular, so their maxima are rounding.
    """
    n = len(tour.element)
    most = n * (4 * (8 * tour.control.shape[1]) + 9)
    element, place_t, count = np.empty(most, np.int64), np.empty(most), 0
    rises_at_end, falls_at_start = np.ones(n, np.bool_), np.ones(n, np.bool_)
    for e in range(n):
        if tour.element[e].degree < 2 or touched[e]:
            continue
        slope = curvature_slope(tour.control[e], tour.element[e].degree)
        noise = _NOISE * np.abs(slope).max() + _curvature_rounding(tour, e) * _length_squared(tour, e) ** 2.5
        rises_at_end[e], falls_at_start[e] = slope[-1] >= -noise, slope[0] <= noise
        if curvature_sign(tour.control[e], tour.element[e].degree).max() > 0.0:
            for t in falling_roots(slope):
                element[count], place_t[count] = e, t
                count += 1
    for e in range(n):
        if _may_peak_at_border(tour, e, touched, rises_at_end, falls_at_start):
            element[count], place_t[count] = e, 0.0
            count += 1
    return element[:count].copy(), place_t[:count].copy()


@compiled
def _may_peak_at_border(
    tour: Tour,
    e: int,
    touched: NDArray[np.bool_],
    rises_at_end: NDArray[np.bool_],
    falls_at_start: NDArray[np.bool_],
) -> bool:
    """Whether curvature may have a maximum at the border before `e`: it jumps, or its slope changes sign."""
    left = tour.element[e].before
    if tour.element[e].convex:
        return False
    k_left, k_right = site(tour, left, 1.0)[4], site(tour, e, 0.0)[4]
    most = max(k_left, k_right)
    if most <= _STRAIGHT:
        return False
    rounding = _curvature_rounding(tour, left) + _curvature_rounding(tour, e)
    same = abs(k_left - k_right) <= _SAME_CURVATURE * max(abs(k_left), abs(k_right)) + rounding
    # Of an arc that is touched as a whole no place is a candidate.
    if ((same or k_left == most) and touched[left]) or ((same or k_right == most) and touched[e]):
        return False
    if same:
        return rises_at_end[left] and falls_at_start[e]
    return rises_at_end[left] if k_left > k_right else falls_at_start[e]


@compiled
def _curvature_rounding(tour: Tour, e: int) -> float:
    """Error that rounding of control points may leave in the curvature of a span."""
    degree = tour.element[e].degree
    return _CONTROL_ROUNDING * degree * degree / _length_squared(tour, e) if degree > 1 else 0.0


@compiled
def _length_squared(tour: Tour, e: int) -> float:
    """Square of a span's length, about; the ends of a long one may lie next to one another."""
    return max(chord_squared(tour, e), site(tour, e, 0.5)[5] ** 2)


@compiled
def _settle_osculating(tour: Tour, faces: Faces, e: int, t: float) -> None:
    """Add the disc of curvature at a place if it is empty, and not there yet."""
    x, y, nx, ny, curvature, _ = site(tour, e, t)
    if t == 0.0:
        lx, ly, lnx, lny, left_curvature, _ = site(tour, tour.element[e].before, 1.0)
        if left_curvature > curvature:
            x, y, nx, ny, curvature = lx, ly, lnx, lny, left_curvature
    if curvature <= _STRAIGHT:
        return
    r = 1 / curvature
    cx, cy = x + r * nx, y + r * ny
    if holds_sample(tour, cx, cy, r, EMPTY):
        return
    deepest, count, element, place_t = touching(tour, cx, cy, r, TOUCH, NO_SKIP, EMPTY)
    if deepest < -EMPTY:
        return
    first_e, first_t, last_e, last_t = _contact_across_border(tour, e, t, cx, cy, r)
    if _repeats(tour, faces, cx, cy, r, first_e, first_t):
        return
    # Where the contact reaches on to a border, normals there miss the centre by more than points miss the circle.
    tol = max(TOUCH, _off_normal(tour, first_e, first_t, cx, cy), _off_normal(tour, last_e, last_t, cx, cy))
    number = add_disc(faces, cx, cy, r, OSCULATING, tol)
    add_contact(faces, number, first_e, first_t, last_e, last_t)
    for k in range(count):
        if not one_contact(tour, e, t, element[k], place_t[k], cx, cy, r):
            add_contact(faces, number, element[k], place_t[k], element[k], place_t[k])


@compiled
def _off_normal(tour: Tour, e: int, t: float, x: float, y: float) -> float:
    """Distance of a point from the normal of a place."""
    qx, qy, nx, ny, _, _ = site(tour, e, t)
    return abs((x - qx) * ny - (y - qy) * nx)


@compiled
def _contact_across_border(
    tour: Tour, e: int, t: float, cx: float, cy: float, r: float
) -> tuple[int, float, int, float]:
    """Return the contact of an osculating disc, with the nearest border if the disc follows the boundary so far."""
    if t > 0.0:
        for border in (e, tour.element[e].after):
            row = tour.element[border]
            smooth = not row.convex and row.degree != 0 and tour.element[row.before].degree != 0
            if smooth and one_contact(tour, e, t, border, 0.0, cx, cy, r):
                return (border, 0.0, e, t) if border == e else (e, t, border, 0.0)
    return e, t, e, t


@compiled
def _repeats(tour: Tour, faces: Faces, x: float, y: float, r: float, e: int, t: float) -> bool:
    """Whether a candidate is a disc that was already found, from the other side of a border or of a symmetry."""
    for c in range(faces.used[CONTACTS]):
        k = faces.contact[c].disc
        if (
            abs(faces.settled[k].r - r) <= _SAME_DISC
            and math.hypot(faces.settled[k].x - x, faces.settled[k].y - y) <= _SAME_DISC
        ):
            return True
        if (
            faces.settled[k].kind == OSCULATING
            and (c == 0 or faces.contact[c - 1].disc != k)  # the first contact of a disc is where it osculates
            and apart(tour, e, t, faces.contact[c].first_e, faces.contact[c].first_t) <= _SAME_FOOT * r
            and not _reflex_between(tour, e, t, faces.contact[c].first_e, faces.contact[c].first_t)
        ):
            return True
    return False


@compiled
def _reflex_between(tour: Tour, e: int, t: float, f: int, s: float) -> bool:
    """Whether a reflex vertex lies between two near places: the curves on both its sides may have an end each."""
    there, there_cone = _way(tour, e, t, f, s)
    back, back_cone = _way(tour, f, s, e, t)
    return there_cone if there <= back else back_cone


@compiled
def _way(tour: Tour, e: int, t: float, f: int, s: float) -> tuple[float, bool]:
    """Length in the tour's parameter from one place on to another, infinite beyond some elements; whether by a cone."""
    length, cone = 0.0, False
    for _ in range(4):
        last = e == f and t <= s
        end = s if last else 1.0
        cone = cone or (tour.element[e].degree == 0 and end > t)
        length += end - t
        if last:
            return length, cone
        e, t = tour.element[e].after, 0.0
    return math.inf, False


@compiled
def falling_roots(coefficients: Floats) -> Floats:
    """Isolate the roots in (0, 1) at which a polynomial in Bernstein form falls through zero.

    Stretches without a change of sign hold no root, with one exactly one; others are cut in two.
    """
    n = len(coefficients)
    noise = _NOISE * np.abs(coefficients).max()
    stack, low, high = np.empty((_STRETCHES, n)), np.empty(_STRETCHES), np.empty(_STRETCHES)
    for i in range(n):
        stack[0, i] = coefficients[i]
    low[0], high[0], top = 0.0, 1.0, 1
    roots, count = np.empty(4 * n + 8), 0
    left, right = np.empty(n), np.empty(n)
    while top > 0:
        top -= 1
        changes, last = _sign_changes(stack[top], noise)
        if changes == 0:
            continue
        if changes == 1 or high[top] - low[top] < _SHORTEST or top + 2 > _STRETCHES:
            if last < 0 and count < len(roots):
                roots[count] = _bisected(coefficients, low[top], high[top])
                count += 1
            continue
        halve(stack[top], left, right)
        middle = (low[top] + high[top]) / 2
        # A root right at the cut, as symmetric curves have it, changes the sign in neither half.
        if abs(right[0]) <= noise and _sign(left[::-1], noise) > 0 > _sign(right, noise) and count < len(roots):
            roots[count] = middle
            count += 1
        for i in range(n):
            stack[top, i], stack[top + 1, i] = right[i], left[i]
        low[top + 1], high[top + 1] = low[top], middle
        low[top] = middle
        top += 2
    return roots[:count].copy()


@compiled
def _sign_changes(coefficients: Floats, noise: float) -> tuple[int, int]:
    """Return how often the coefficients change their sign, and their last sign."""
    changes, last = 0, 0
    for c in coefficients:
        sign = 0 if abs(c) <= noise else (1 if c > 0 else -1)
        if sign != 0:
            changes += 1 if last not in (0, sign) else 0
            last = sign
    return changes, last


@compiled
def _sign(coefficients: Floats, noise: float) -> int:
    """Sign of a polynomial right behind 0: of its first coefficient that is not lost in rounding."""
    for c in coefficients:
        if abs(c) > noise:
            return 1 if c > 0 else -1
    return 0


@compiled
def _bisected(coefficients: Floats, low: float, high: float) -> float:
    """Halve an interval in which a polynomial falls through zero."""
    for _ in range(60):
        middle = (low + high) / 2
        if value(coefficients, middle) > 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2
