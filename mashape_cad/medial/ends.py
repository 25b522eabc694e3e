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

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numba import njit

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.bezier import curvature_slope, halves, product, value
from mashape_cad.medial.emptiness import EMPTY, TOUCH, same_place, touching
from mashape_cad.medial.tour import ROUND, Tour, site

__all__ = ["Contact", "Place", "SettledDisc", "ends", "one_contact"]

Place = tuple[int, float]
Contact = tuple[Place, Place]  # first and last place; equal but for a disc that touches along an arc

_FULL_LOOP: Place = (-1, 0.0)
# Radii and centres of arcs are rounded in files: an arc that fills a slot's end misses the slot's other wall by up to
# this (sizes), and still touches it. What it misses by is recorded as the disc's tolerance.
_ARC = 1e-8
# A contact this close (sizes) to the end of an arc on the same circle belongs to that arc.
_ARC_END = 1e-6
# Coefficients this small against the largest one are rounding of products of up to eight factors.
_NOISE = 1e-11
_STRAIGHT = 1e-9  # a curvature below this (one over sizes) has no maximum that matters
_SAME_CURVATURE = 1e-9  # curvatures that agree this well, relatively, do not jump
_SHORTEST = 1e-9  # stretches of parameters this short are not halved any more: what changes sign there is one root


@dataclass(frozen=True, slots=True)
class SettledDisc:
    """A maximal disc in the tour's scale.

    Attributes
    ----------
    x, y, r : float
        Centre and radius.
    contacts : tuple of (place, place)
        First and last place of each contact.
    kind : str
        ``corner``, ``osculating``, ``arc``, ``station``, ``junction`` or ``cluster``.
    tol : float
        How far the contacts may lie off the circle.
    """

    x: float
    y: float
    r: float
    contacts: tuple[Contact, ...]
    kind: str
    tol: float = TOUCH

    @property
    def is_full(self) -> bool:
        """Whether the disc is the whole domain."""
        return self.contacts == ((_FULL_LOOP, _FULL_LOOP),)


def ends(tour: Tour) -> list[SettledDisc]:
    """Return the discs of all accepted candidates; some may have more contacts than one.

    A domain that is one disc gives that one alone, with `SettledDisc.is_full`.
    """
    found = [disc for run in _arc_runs(tour) if (disc := _arc_disc(tour, run)) is not None]
    if any(disc.is_full for disc in found):
        return [disc for disc in found if disc.is_full]
    settled = _merged_arcs(tour, found)
    # Where a rounded arc meets its neighbour at a kink, the arc's disc already fills that vertex.
    filled = {place for disc in settled for contact in disc.contacts for place in contact}
    settled += [disc for disc in _corners(tour) if disc.contacts[0][0] not in filled]
    covered = {e for disc in found for (e, _), _ in disc.contacts}
    for e, t in _curvature_candidates(tour):
        disc = _osculating_disc(tour, e, t)
        if disc is not None and e not in covered and not _repeats(tour, disc, settled):
            settled.append(disc)
    return settled


def _corners(tour: Tour) -> list[SettledDisc]:
    """Convex vertices: discs of radius 0."""
    return [
        SettledDisc(
            tour.control[e, 0, 0] / tour.control[e, 0, 2],
            tour.control[e, 0, 1] / tour.control[e, 0, 2],
            0.0,
            (((int(e), 0.0), (int(e), 0.0)),),
            "corner",
        )
        for e in np.flatnonzero(tour.convex)
    ]


def _arc_runs(tour: Tour) -> Iterator[list[int]]:
    """Maximal runs of spans on one circle that bends inwards, in the order of the loop."""
    is_round = ~np.isnan(tour.round_radius)
    joined = [bool(is_round[e] and _continues(tour, int(tour.before[e]), e)) for e in range(len(is_round))]
    for first in np.flatnonzero(is_round):
        if joined[first] and not _is_seam(tour, int(first), joined):
            continue
        run = [int(first)]
        while joined[after := int(tour.after[run[-1]])] and after != first:
            run.append(after)
        yield run


def _is_seam(tour: Tour, first: int, joined: list[bool]) -> bool:
    """Whether a loop is one circle all round and `first` is its lowest element."""
    loop = np.flatnonzero(tour.loop == tour.loop[first])
    return bool(first == loop[0] and all(joined[e] for e in loop))


def _continues(tour: Tour, before: int, e: int) -> bool:
    """Whether two neighbouring spans lie on one circle and join smoothly."""
    if tour.convex[e] or np.isnan(tour.round_radius[before]):
        return False
    shift = np.hypot(*(tour.round_centre[before] - tour.round_centre[e]))
    return bool(shift <= 10 * ROUND and abs(tour.round_radius[before] - tour.round_radius[e]) <= 10 * ROUND)


def _arc_disc(tour: Tour, run: list[int]) -> SettledDisc | None:
    """Return the disc that fills a run of arcs, if it is empty."""
    (x, y), r = tour.round_centre[run].mean(axis=0), float(tour.round_radius[run].mean())
    deepest = touching(tour, x, y, r, _ARC, run[0])[0]
    if deepest < -_ARC:
        return None
    tol = max(TOUCH, float(_off_circle(tour, run, x, y, r)), -deepest)
    _, count, element, t = touching(tour, x, y, r, 2 * tol, run[0])
    if tour.after[run[-1]] == run[0]:
        # An arc all round: the domain's outer loop, or (never empty) the outside of a hole.
        return SettledDisc(x, y, r, ((_FULL_LOOP, _FULL_LOOP),), "arc", tol)
    first, last = (run[0], 0.0), (int(tour.after[run[-1]]), 0.0)
    clear = max(np.sqrt(16 * r * tol), 3e-6 * r)
    others = [
        ((int(element[k]), float(t[k])),) * 2
        for k in range(count)
        if not any(_apart(tour, (element[k], t[k]), place) <= clear for place in (first, last))
    ]
    return SettledDisc(x, y, r, ((first, last), *others), "arc", tol)


def _off_circle(tour: Tour, run: list[int], x: float, y: float, r: float) -> float:
    """Largest distance of a run's spans from a circle, at a few places of each."""
    points = np.array([site(tour, e, t)[:2] for e in run for t in (0.0, 0.25, 0.5, 0.75, 1.0)])
    return float(np.abs(np.hypot(points[:, 0] - x, points[:, 1] - y) - r).max())


def _apart(tour: Tour, a: tuple[int, float], b: tuple[int, float]) -> float:
    (ax, ay), (bx, by) = site(tour, int(a[0]), float(a[1]))[:2], site(tour, int(b[0]), float(b[1]))[:2]
    return float(np.hypot(ax - bx, ay - by))


def _merged_arcs(tour: Tour, discs: list[SettledDisc]) -> list[SettledDisc]:
    """Join the discs of several arcs on one circle into one disc with all contacts."""
    merged: list[SettledDisc] = []
    for disc in discs:
        twin = next((k for k, other in enumerate(merged) if _same_disc(disc, other, 10 * ROUND)), None)
        if twin is None:
            merged.append(disc)
            continue
        other = merged[twin]
        arcs = [contact for each in (other, disc) for contact in each.contacts if contact[0] != contact[1]]
        # What touches one arc's disc at the end of another arc is that arc.
        points = [
            contact
            for contact in other.contacts
            if contact[0] == contact[1] and all(_apart(tour, contact[0], end) > _ARC_END for arc in arcs for end in arc)
        ]
        merged[twin] = SettledDisc(other.x, other.y, other.r, (*arcs, *points), "arc", max(other.tol, disc.tol))
    return merged


def _same_disc(a: SettledDisc, b: SettledDisc, tol: float) -> bool:
    return bool(np.hypot(a.x - b.x, a.y - b.y) <= tol and abs(a.r - b.r) <= tol)


def _repeats(tour: Tour, disc: SettledDisc, settled: list[SettledDisc]) -> bool:
    """Whether a candidate is a disc that was already found, from the other side of a border or of a symmetry."""
    place = disc.contacts[0][0]
    for other in settled:
        if _same_disc(disc, other, 3e-11):
            return True
        if other.kind == "osculating" and _apart(tour, place, other.contacts[0][0]) <= 1e-6 * disc.r:
            # The curves on both sides of a reflex vertex may each have an end there.
            between = _stretch(tour, place, other.contacts[0][0])
            if not any(tour.degree[e] == 0 and high > low for e, low, high in between):
                return True
    return False


def _curvature_candidates(tour: Tour) -> Iterator[Place]:
    """Yield all places where curvature may have a positive local maximum."""
    slopes: dict[int, Floats] = {}
    for e in range(len(tour.degree)):
        if tour.degree[e] < 2 or not np.isnan(tour.round_radius[e]):
            continue
        slopes[e] = curvature_slope(tour.control[e], tour.degree[e])
        if _may_bend_inwards(tour.control[e], int(tour.degree[e])):
            for t in falling_roots(slopes[e]):
                yield e, float(t)
    for e in range(len(tour.degree)):
        place = _border_candidate(tour, e, slopes)
        if place is not None:
            yield place


def _border_candidate(tour: Tour, e: int, slopes: dict[int, Floats]) -> Place | None:
    """Return the border before `e` if curvature may have a maximum there: it jumps, or its slope changes sign."""
    left = int(tour.before[e])
    if tour.convex[e]:
        return None
    k_left, k_right = (site(tour, left, 1.0)[4], site(tour, e, 0.0)[4])
    if max(k_left, k_right) <= _STRAIGHT:
        return None
    same = abs(k_left - k_right) <= _SAME_CURVATURE * max(abs(k_left), abs(k_right))
    for element, curvature in ((left, k_left), (e, k_right)):
        if (same or curvature == max(k_left, k_right)) and not np.isnan(tour.round_radius[element]):
            return None  # the whole arc is a candidate
    rising = left not in slopes or _end_sign(slopes[left][::-1]) >= 0
    falling = e not in slopes or _end_sign(slopes[e]) <= 0
    if (same and rising and falling) or (not same and (rising if k_left > k_right else falling)):
        return e, 0.0
    return None


def _end_sign(coefficients: Floats) -> int:
    """Sign of a polynomial at 0; 0 if it is lost in rounding."""
    return int(np.sign(coefficients[0])) if abs(coefficients[0]) > _NOISE * np.abs(coefficients).max() else 0


def _osculating_disc(tour: Tour, e: int, t: float) -> SettledDisc | None:
    """Return the disc of curvature at a place, if it is empty."""
    x, y, nx, ny, curvature, _ = site(tour, e, t)
    if t == 0.0:
        lx, ly, lnx, lny, left_curvature, _ = site(tour, int(tour.before[e]), 1.0)
        if left_curvature > curvature:
            x, y, nx, ny, curvature = lx, ly, lnx, lny, left_curvature
    if curvature <= _STRAIGHT:
        return None
    r = 1 / curvature
    cx, cy = x + r * nx, y + r * ny
    deepest, count, element, place_t = touching(tour, cx, cy, r, TOUCH, -1)
    if deepest < -EMPTY:
        return None
    here = _contact_across_border(tour, (e, t), cx, cy, r)
    others = [
        ((int(element[k]), float(place_t[k])),) * 2
        for k in range(count)
        if not one_contact(tour, (e, t), (int(element[k]), float(place_t[k])), cx, cy, r)
    ]
    return SettledDisc(cx, cy, r, (here, *others), "osculating")


def _contact_across_border(tour: Tour, place: Place, cx: float, cy: float, r: float) -> Contact:
    """Return the contact of an osculating disc, with the nearest border if the disc follows the boundary so far."""
    e, t = place
    borders = ((e, 0.0), (int(tour.after[e]), 0.0)) if t > 0.0 else ()
    for border in borders:
        smooth = not tour.convex[border[0]] and 0 not in (tour.degree[border[0]], tour.degree[tour.before[border[0]]])
        if smooth and one_contact(tour, place, border, cx, cy, r):
            return (border, place) if border[0] == e else (place, border)
    return place, place


def one_contact(tour: Tour, a: Place, b: Place, cx: float, cy: float, r: float) -> bool:
    """Whether two contacts of an osculating disc are one: near, with the boundary on the circle between them."""
    if same_place(tour, *a, *b, r):
        return True
    if _apart(tour, a, b) > 0.02 * r:
        return False
    stretch = [(e, s) for e, lo, hi in _stretch(tour, a, b) for s in np.linspace(lo, hi, 5)]
    points = np.array([site(tour, e, s)[:2] for e, s in stretch])
    return bool(np.abs(np.hypot(points[:, 0] - cx, points[:, 1] - cy) - r).max() <= TOUCH)


def _stretch(tour: Tour, a: Place, b: Place) -> list[tuple[int, float, float]]:
    """Return the pieces of boundary between two places that are at most a few elements apart, the shorter way."""
    ways = [way for way in (_way(tour, a, b), _way(tour, b, a)) if way]
    return min(ways, key=lambda way: sum(high - low for _, low, high in way), default=[(a[0], 0.0, 1.0)])


def _way(tour: Tour, a: Place, b: Place) -> list[tuple[int, float, float]]:
    """Return the pieces from a forward to b; none if it is further than a few elements."""
    pieces: list[tuple[int, float, float]] = []
    e, t = a
    for _ in range(4):
        if e == b[0] and t <= b[1]:
            return [*pieces, (e, t, b[1])]
        pieces.append((e, t, 1.0))
        e, t = int(tour.after[e]), 0.0
    return []


def _may_bend_inwards(control: Floats, degree: int) -> bool:
    """Whether curvature is positive anywhere on a span, by the signs of det[X, X', X'']."""
    points = control[: degree + 1]
    first = degree * np.diff(points, axis=0)
    second = (degree - 1) * np.diff(first, axis=0)
    total = np.zeros(3 * degree - 2)
    for (i, j, k), sign in (
        ((0, 1, 2), 1),
        ((1, 2, 0), 1),
        ((2, 0, 1), 1),
        ((0, 2, 1), -1),
        ((1, 0, 2), -1),
        ((2, 1, 0), -1),
    ):
        total += sign * product(product(points[:, i].copy(), first[:, j].copy()), second[:, k].copy())
    return bool(total.max() > 0)


@njit(cache=True)
def falling_roots(coefficients: Floats) -> Floats:
    """Isolate the roots in (0, 1) at which a polynomial in Bernstein form falls through zero.

    Stretches without a change of sign hold no root, with one exactly one; others are cut in two.
    """
    degree = len(coefficients) - 1
    noise = 1e-11 * np.abs(coefficients).max()
    stack = np.empty((128, degree + 1))
    ends = np.empty((128, 2))
    stack[0], ends[0], top = coefficients, (0.0, 1.0), 1
    roots = np.empty(4 * degree + 8)
    count = 0
    while top > 0:
        top -= 1
        row = stack[top].copy()
        low, high = ends[top]
        changes, last = 0, 0
        for c in row:
            sign = 0 if abs(c) <= noise else (1 if c > 0 else -1)
            if sign != 0:
                changes += 1 if last not in (0, sign) else 0
                last = sign
        if changes == 0:
            continue
        if changes == 1 or high - low < _SHORTEST or top + 2 > 128:
            if last < 0 and count < len(roots):
                roots[count] = _bisected(coefficients, low, high)
                count += 1
            continue
        left, right = halves(row)
        middle = (low + high) / 2
        # A root right at the cut, as symmetric curves have it, changes the sign in neither half.
        if abs(right[0]) <= noise and _sign(left[::-1], noise) > 0 > _sign(right, noise) and count < len(roots):
            roots[count] = middle
            count += 1
        stack[top], ends[top] = right, (middle, high)
        stack[top + 1], ends[top + 1] = left, (low, middle)
        top += 2
    return roots[:count]


@njit(cache=True)
def _sign(coefficients: Floats, noise: float) -> int:
    """Sign of a polynomial right behind 0: of its first coefficient that is not lost in rounding."""
    for c in coefficients:
        if abs(c) > noise:
            return 1 if c > 0 else -1
    return 0


@njit(cache=True)
def _bisected(coefficients: Floats, low: float, high: float) -> float:
    """Halve an interval in which a polynomial falls through zero."""
    for _ in range(60):
        middle = (low + high) / 2
        if value(coefficients, middle) > 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2
