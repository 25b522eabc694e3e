"""Cut a domain by maximal discs until each face holds one piece of a branch.

The steps, in order: the discs of all ends and of the links between loops; a station at every border, after which each
gap lies on one element; in each face with three or more gaps a junction, found by Newton on three consecutive gaps (a
tree with n ends has two neighbouring ends that share a junction, so some triple is one); where none is found, a disc
that touches all gaps of the face within a tolerance that is put on record; else more stations.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mashape_cad.errors import AxisError
from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.contact import TOUCH, one_contact, same_foot
from mashape_cad.medial.disc import maximal_disc, twin_on_stretch
from mashape_cad.medial.emptiness import EMPTY, NO_SKIP, nearest_on_stretch, touching
from mashape_cad.medial.ends import settle_ends
from mashape_cad.medial.faces import (
    CLUSTER,
    CONTACTS,
    DISCS,
    JUNCTION,
    LAID_OUT,
    LOOSE_LOOP,
    STATION,
    Faces,
    add_disc,
    attach,
    blank_faces,
    corner,
    cycle,
    distinct_faces,
    gap_at,
    insert,
    is_laid_out,
    lay_out,
    stretch,
)
from mashape_cad.medial.junction import junction_disc
from mashape_cad.medial.links import settle_links
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["cut"]

# Two discs with centre and radius this close are one (sizes of the shape).
_SAME_DISC = 1e-9
# A disc that touches all n gaps of a face within this is one vertex of degree n, its tolerance on record. Tighter
# splits symmetric junctions into chains that rounding invents; looser merges true ones.
_CLUSTER = 1e-8
# A face whose centres are all within this may be contracted to one vertex as a last resort.
_STAR = 1e-6
# Feet this far outside their gap (parameter) are put back inside; farther ones belong elsewhere.
_SLACK = 1e-6
# Feet put back inside a gap lie this far (parameter) from its ends, or a quarter of a shorter gap.
_INSIDE = 1e-12
# Where a gap is cut when a face has to be made smaller: off the middle, since drawings like symmetry.
_CUT_AT = 0.487
# How often a face is cut by stations before it is given up.
_ROUNDS = 30
# First guesses for a junction near a vertex that turns by a small angle: shares of a neighbouring disc's radius.
_SHARES = (1.0, 0.5, 0.25)

# How cutting may end.
_DONE, _STUCK = 0, 1


def cut(tour: Tour) -> tuple[Faces, bool]:
    """Cut a valid domain into faces of two gaps.

    Returns
    -------
    faces : Faces
    is_disc : bool
        Whether the domain is one disc: then that is all there is, and nothing was cut.

    Raises
    ------
    AxisError
        If a face is left that neither a junction nor more stations resolve; with its place.
    """
    faces = blank_faces(tour)
    if settle_ends(tour, faces):
        return faces, True
    settle_links(tour, faces)
    outcome, number = lay_out(tour, faces)
    if outcome == LOOSE_LOOP:
        x, y, *_ = site(tour, int(np.argmax(tour.loop == number)), 0.0)
        raise AxisError(f"no disc touches loop {number}", (x, y))
    if outcome != LAID_OUT:
        raise AxisError(f"the first discs cut the domain into {number} faces, which are not simply connected")
    outcome, x, y = _cut_on(tour, faces)
    if outcome == _STUCK:
        raise AxisError("a face of the domain could not be cut further", (x, y))
    return faces, False


class _Feet(NamedTuple):
    """What a disc touches of a face: for each of its gaps at most one place."""

    known: NDArray[np.bool_]
    e: Ints
    t: Floats


@compiled
def _no_feet(n: int) -> _Feet:
    return _Feet(np.zeros(n, np.bool_), np.empty(n, np.int64), np.empty(n))


@compiled
def _cut_on(tour: Tour, faces: Faces) -> tuple[int, float, float]:
    """Cut from the first discs to the last; where a face resists, its place is returned."""
    for e in range(len(tour.element)):
        _add_station(tour, faces, e, 0.0)
    most = len(faces.settled) - 2
    pending, age = np.empty(len(faces.contact), np.int64), np.empty(len(faces.contact), np.int64)
    top = 0
    for gap in distinct_faces(faces, np.arange(faces.used[CONTACTS])):
        pending[top], age[top] = gap, 0
        top += 1
    while top > 0:
        top -= 1
        gap, rounds = pending[top], age[top]
        if is_laid_out(tour, faces, gap):
            continue
        face = cycle(faces, gap)
        progress, next_rounds, parts = False, rounds, face
        if len(face) > 1 and rounds <= _ROUNDS and faces.used[DISCS] + 2 * len(face) < most:
            progress, next_rounds, parts = _resolved(tour, faces, face, rounds)
        if not progress:
            x, y = _middle(faces, face)
            return _STUCK, x, y
        for part in distinct_faces(faces, parts):
            pending[top], age[top] = part, next_rounds
            top += 1
    return _DONE, 0.0, 0.0


@compiled
def _resolved(tour: Tour, faces: Faces, face: Ints, rounds: int) -> tuple[bool, int, Ints]:
    """Split a face by a junction, else by a cluster, else by stations.

    Returns
    -------
    progress : bool
        Whether it was split, or its gaps were.
    rounds : int
        Rounds of stations that the parts have behind them.
    parts : (k,) array
        At least one gap of every part.
    """
    if len(face) > 2:
        parts = _split_by_junction(tour, faces, face)
        if len(parts) > 1:
            return True, 0, parts
    if len(face) > 3:
        parts = _split_by_cluster(tour, faces, face, _CLUSTER)
        if len(parts) > 1:
            return True, 0, parts
    if rounds == _ROUNDS or _extent(faces, face) < _CLUSTER:
        parts = _contracted(tour, faces, face)
        if len(parts) > 1:
            return True, 0, parts
    known = faces.used[CONTACTS]
    for gap in face:
        on_one, e, low, high = stretch(tour, faces, gap)
        if on_one:
            _add_station(tour, faces, e, low + _CUT_AT * (high - low))
        else:
            _add_station(tour, faces, tour.element[e].after, 0.0)
    if faces.used[CONTACTS] > known:
        return True, rounds + 1, np.concatenate((face, np.arange(known, faces.used[CONTACTS])))
    parts = _contracted(tour, faces, face)
    return len(parts) > 1, 0, parts


@compiled
def _add_station(tour: Tour, faces: Faces, e: int, t: float) -> None:
    """Settle the maximal disc at a place, unless the place is a contact already."""
    gap = gap_at(tour, faces, e, t)
    if gap < 0:
        return
    x, y, r, ok, count, element, place_t = maximal_disc(tour, e, t)
    if not ok or r <= 0.0 or count == 0:
        return
    face = cycle(faces, gap)
    feet = _no_feet(len(face))
    feet.known[0], feet.e[0], feet.t[0] = True, e, t
    for k in range(count):
        _fit(tour, faces, face, element[k], place_t[k], feet)
    _split(tour, faces, face, feet, x, y, r, STATION, TOUCH)


@compiled
def _fit(tour: Tour, faces: Faces, face: Ints, e: int, t: float, feet: _Feet) -> None:
    """Put a contact into the gap of the face that holds it; one just outside is put back inside, others are dropped.

    So rounding cannot tangle the faces.
    """
    gap = gap_at(tour, faces, e, t)
    for k in range(len(face)):
        if face[k] == gap:
            if not feet.known[k]:
                feet.known[k], feet.e[k], feet.t[k] = True, e, t
            return
    for k in range(len(face)):
        on_one, f, low, high = stretch(tour, faces, face[k])
        if not on_one:
            continue
        s = 1.0 if t == 0.0 and f == tour.element[e].before and f != e else t
        if (f == e or s == 1.0) and low - _SLACK <= s <= high + _SLACK:
            if not feet.known[k]:
                feet.known[k], feet.e[k], feet.t[k] = True, f, _inside(s, low, high)
            return


@compiled
def _inside(t: float, low: float, high: float) -> float:
    """Put a parameter strictly inside a stretch."""
    margin = min(_INSIDE, (high - low) / 4)
    return min(max(t, low + margin), high - margin)


@compiled
def _split(
    tour: Tour, faces: Faces, face: Ints, feet: _Feet, x: float, y: float, r: float, kind: int, tol: float
) -> Ints:
    """Split a face by a disc, or give a corner of it that is the same disc the contacts that it lacks.

    Returns
    -------
    (k,) array
        At least one gap of every part; none if nothing was split.
    """
    for gap in face:
        number = corner(faces, gap)
        if (
            math.hypot(faces.settled[number].x - x, faces.settled[number].y - y) + abs(faces.settled[number].r - r)
            <= _SAME_DISC
        ):
            parts = _completed(tour, faces, face, gap, feet)
            if len(parts) > 0:
                return parts
    at = np.flatnonzero(feet.known)
    if len(at) < 2:
        return at[:0]
    return insert(faces, add_disc(faces, x, y, r, kind, tol), face[at], feet.e[at], feet.t[at])


@compiled
def _completed(tour: Tour, faces: Faces, face: Ints, before: int, feet: _Feet) -> Ints:
    """Give the disc at the end of a gap the contacts that it lacks."""
    number = corner(faces, before)
    parts, count = np.empty(2 * len(face), np.int64), 0
    for k in range(len(face)):
        if not feet.known[k] or _touches(tour, faces, faces.contact[before].after, feet.e[k], feet.t[k]):
            continue
        part = cycle(faces, face[k])
        n = len(part)
        for i in range(1, n - 1):
            # Gaps beside the corner touch the disc already.
            if corner(faces, part[i]) == number and corner(faces, part[0]) != number != faces.contact[part[0]].disc:
                parts[count], parts[count + 1] = face[k], attach(faces, part[i], face[k], feet.e[k], feet.t[k])
                count += 2
                x, y, _, _, _, _ = site(tour, feet.e[k], feet.t[k])
                off = abs(
                    math.hypot(x - faces.settled[number].x, y - faces.settled[number].y) - faces.settled[number].r
                )
                faces.settled[number].tol = max(faces.settled[number].tol, off)
                break
    return parts[:count]


@compiled
def _touches(tour: Tour, faces: Faces, contact: int, e: int, t: float) -> bool:
    """Whether a place is a contact already of the disc that touches at `contact`."""
    d, c = faces.contact[contact].disc, contact
    while True:
        for f, s in (
            (faces.contact[c].first_e, faces.contact[c].first_t),
            (faces.contact[c].last_e, faces.contact[c].last_t),
        ):
            if one_contact(tour, e, t, f, s, faces.settled[d].x, faces.settled[d].y, faces.settled[d].r):
                return True
        c = faces.contact[c].clockwise
        if c == contact:
            return False


@compiled
def _split_by_junction(tour: Tour, faces: Faces, face: Ints) -> Ints:
    """Split a face by the first junction that three consecutive gaps give; returns a gap of every part."""
    n = len(face)
    for i in range(1 if n == 3 else n):
        triple = np.array([i, (i + 1) % n, (i + 2) % n])
        found, x, y, r, e, t = _triple_disc(tour, faces, face, triple)
        if not found:
            continue
        deepest, count, element, place_t = touching(tour, x, y, r, TOUCH, NO_SKIP, EMPTY)
        if deepest < -EMPTY:
            continue
        feet = _no_feet(n)
        for k in range(3):
            feet.known[triple[k]], feet.e[triple[k]], feet.t[triple[k]] = True, e[k], t[k]
        for k in range(count):
            if not _is_foot(tour, e, t, element[k], place_t[k], x, y, r):
                _fit(tour, faces, face, element[k], place_t[k], feet)
        parts = _split(tour, faces, face, feet, x, y, r, JUNCTION, TOUCH)
        if len(parts) > 1:
            return parts
    return face[:0]


@compiled
def _is_foot(tour: Tour, e: Ints, t: Floats, f: int, s: float, x: float, y: float, r: float) -> bool:
    """Whether a place is one of some feet of a disc."""
    for k in range(len(e)):  # noqa: SIM110  -- compiled code knows no generators
        if same_foot(tour, f, s, e[k], t[k], x, y, r):
            return True
    return False


@compiled
def _triple_disc(tour: Tour, faces: Faces, face: Ints, triple: Ints) -> tuple[bool, float, float, float, Ints, Floats]:
    """Find the disc that touches three gaps of a face, each on one element, with separate feet: the last two values."""
    e, low, high = np.empty(3, np.int64), np.empty(3), np.empty(3)
    for i in range(3):
        on_one, e[i], low[i], high[i] = stretch(tour, faces, face[triple[i]])
        if not on_one:
            return False, 0.0, 0.0, 0.0, e, low
    found, x, y, r, t = _disc_near_kink(tour, faces, face, triple, e, low, high)
    if not found:
        found, x, y, r, t = junction_disc(tour, e, low, high, (low + high) / 2)
    if not found:
        return False, x, y, r, e, t
    for i in range(3):
        t[i] = _inside(t[i], low[i], high[i])
    for i in range(3):
        if same_foot(tour, e[i], t[i], e[i - 1], t[i - 1], x, y, r) and not _kink_between(tour, e[i], e[i - 1]):
            return False, x, y, r, e, t
    return True, x, y, r, e, t


@compiled
def _disc_near_kink(
    tour: Tour, faces: Faces, face: Ints, triple: Ints, e: Ints, low: Floats, high: Floats
) -> tuple[bool, float, float, float, Floats]:
    """Find a junction two of whose feet lie either side of a vertex that turns by a small angle.

    The feet lie near the vertex, at r times half the angle. (Where curvature jumps too there is a second, false root
    farther away, which the middle of the gaps would find.)
    """
    start = (low + high) / 2
    n = len(face)
    for i in range(3):
        j = (i + 1) % 3
        if not (tour.element[e[j]].convex and tour.element[e[i]].after == e[j] and high[i] == 1.0 and low[j] == 0.0):
            continue
        _, _, ax, ay, _, speed = site(tour, e[i], 1.0)
        _, _, bx, by, _, next_speed = site(tour, e[j], 0.0)
        half = math.atan2(ax * by - ay * bx, ax * bx + ay * by) / 2
        for k in range(min(n, 8)):
            radius = faces.settled[corner(faces, face[(triple[0] - 1 + k) % n])].r
            for share in _SHARES:
                step = share * radius * half
                if step <= 0.0:
                    continue
                t = start.copy()
                t[i], t[j] = max(start[i], 1.0 - step / speed), min(start[j], step / next_speed)
                found, x, y, r, t = junction_disc(tour, e, low, high, t)
                if found:
                    return True, x, y, r, t
    return False, 0.0, 0.0, 0.0, start


@compiled
def _kink_between(tour: Tour, e: int, f: int) -> bool:
    """Whether a convex vertex separates two neighbouring elements: then feet on them may be very near."""
    return (tour.element[e].after == f and tour.element[f].convex) or (
        tour.element[f].after == e and tour.element[e].convex
    )


@compiled
def _split_by_cluster(tour: Tour, faces: Faces, face: Ints, tol: float) -> Ints:
    """Split a face by a disc that touches all of its gaps within `tol`, if there is one."""
    n = len(face)
    for i in range(n):
        triple = np.array([i, (i + 1) % n, (i + 2) % n])
        found, x, y, r, _, _ = _triple_disc(tour, faces, face, triple)
        if not found:
            continue
        feet, error = _feet_on_all(tour, faces, face, x, y, r, tol)
        if error > tol or touching(tour, x, y, r, tol, NO_SKIP, tol)[0] < -tol:
            continue
        return _split(tour, faces, face, feet, x, y, r, CLUSTER, max(error, TOUCH))
    return face[:0]


@compiled
def _contracted(tour: Tour, faces: Faces, face: Ints) -> Ints:
    """Split a face of which stations no longer tell one place from another, as that of one disc or of a known twin."""
    return _split_strip(tour, faces, face) if len(face) == 2 else _split_by_corner(tour, faces, face)


@compiled
def _split_by_corner(tour: Tour, faces: Faces, face: Ints) -> Ints:
    """Contract a face whose centres all but coincide to the one of its corners that touches all gaps best."""
    least, best = _STAR, -1
    for gap in face:
        d = corner(faces, gap)
        error = _feet_on_all(tour, faces, face, faces.settled[d].x, faces.settled[d].y, faces.settled[d].r, least)[1]
        if error < least and faces.settled[d].r > 0.0 and _extent(faces, face) < _STAR:
            least, best = error, d
    if best < 0:
        return face[:0]
    x, y, r = faces.settled[best].x, faces.settled[best].y, faces.settled[best].r
    feet, error = _feet_on_all(tour, faces, face, x, y, r, _STAR)
    tol = max(error, TOUCH, -touching(tour, x, y, r, TOUCH, NO_SKIP, math.inf)[0])
    return insert(faces, add_disc(faces, x, y, r, CLUSTER, tol), face, feet.e, feet.t)


@compiled
def _split_strip(tour: Tour, faces: Faces, face: Ints) -> Ints:
    """Settle a disc at a border inside a gap of a face with two, whose twin is known to lie in the other gap.

    Next to an osculating end feet are so badly determined that the search over the whole boundary may not see that the
    twin is another place.
    """
    for k in range(2):
        on_one, e, _, _ = stretch(tour, faces, face[k])
        is_one, f, low, high = stretch(tour, faces, face[1 - k])
        if on_one or not is_one or gap_at(tour, faces, tour.element[e].after, 0.0) != face[k]:
            continue
        e = tour.element[e].after
        x, y, r, t = twin_on_stretch(tour, e, 0.0, f, low, high)
        tol = max(TOUCH, -touching(tour, x, y, r, TOUCH, NO_SKIP, math.inf)[0])
        if tol > _CLUSTER or r <= 0.0:
            continue
        feet = _no_feet(2)
        feet.e[k], feet.t[k] = e, 0.0
        feet.e[1 - k], feet.t[1 - k] = f, _inside(t, low, high)
        return insert(faces, add_disc(faces, x, y, r, STATION, tol), face, feet.e, feet.t)
    return face[:0]


@compiled
def _feet_on_all(tour: Tour, faces: Faces, face: Ints, x: float, y: float, r: float, tol: float) -> tuple[_Feet, float]:
    """Nearest places of all gaps of a face to a centre, and how far at most they lie off the circle."""
    feet, error = _no_feet(len(face)), 0.0
    for k in range(len(face)):
        on_one, e, low, high = stretch(tour, faces, face[k])
        if not on_one or error > tol:
            return feet, math.inf
        t, distance = nearest_on_stretch(tour, e, low, high, x, y)
        feet.known[k], feet.e[k], feet.t[k] = True, e, _inside(t, low, high)
        error = max(error, abs(distance - r))
    return feet, error


@compiled
def _extent(faces: Faces, face: Ints) -> float:
    """Largest distance between the centres at a face's corners: how big its part of the axis can be."""
    x0, x1, y0, y1 = math.inf, -math.inf, math.inf, -math.inf
    for gap in face:
        x, y = faces.settled[corner(faces, gap)].x, faces.settled[corner(faces, gap)].y
        x0, x1, y0, y1 = min(x0, x), max(x1, x), min(y0, y), max(y1, y)
    return max(x1 - x0, y1 - y0)


@compiled
def _middle(faces: Faces, face: Ints) -> tuple[float, float]:
    """Mean of the centres at a face's corners."""
    x = y = 0.0
    for gap in face:
        x += faces.settled[corner(faces, gap)].x / len(face)
        y += faces.settled[corner(faces, gap)].y / len(face)
    return x, y
