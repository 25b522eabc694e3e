"""Cut a domain by maximal discs until each face holds one piece of a branch.

The steps, in order: the discs of all ends and of the links between loops; a station at every border, after which each
gap lies on one element; in each face with three or more gaps a junction, found by Newton on three consecutive gaps (a
tree with n ends has two neighbouring ends that share a junction, so some triple is one); where none is found, more
stations.
"""

import math
from collections import deque
from collections.abc import Iterator

import numpy as np

from mashape_cad.errors import AxisError
from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.disc import maximal_disc
from mashape_cad.medial.emptiness import EMPTY, TOUCH, nearest_on_stretch, same_place, touching
from mashape_cad.medial.ends import Place, SettledDisc, ends, one_contact
from mashape_cad.medial.faces import Face, Faces
from mashape_cad.medial.junction import junction_disc
from mashape_cad.medial.links import links
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["cut"]

# Two discs with centre and radius this close are one (sizes of the shape).
_SAME_DISC = 1e-9
# A disc that touches all n gaps of a face within this is one vertex of degree n, its tolerance on record. Tighter
# splits symmetric junctions into chains that rounding invents; looser merges true ones.
_CLUSTER = 1e-8
# A face whose gaps are all shorter than this may be contracted to one vertex as a last resort.
_STAR = 1e-6
# Feet this far outside their gap (parameter) are put back inside; farther ones belong elsewhere.
_SLACK = 1e-6
# Where a gap is cut when a face has to be made smaller: off the middle, since drawings like symmetry.
_CUT_AT = 0.487
_ROUNDS = 30


def cut(tour: Tour) -> Faces | SettledDisc:
    """Cut a valid domain into faces of two gaps; a domain that is one disc gives that disc.

    Raises
    ------
    AxisError
        If a face is left that neither a junction nor more stations resolve; with its place.
    """
    first = ends(tour)
    if first and first[0].is_full:
        return first[0]
    faces = Faces(tour, _united(first, links(tour)))
    for e in range(len(tour.degree)):
        _add_station(tour, faces, (e, 0.0))
    pending = deque((face, 0) for face in faces.faces)
    budget = 40 * len(tour.degree) + 400
    while pending:
        face, age = pending.popleft()
        if len(face) == 2 and all(faces.stretch(gap) for gap in face):
            continue
        if len(face) < 2 or age > _ROUNDS or len(faces.discs) > budget:
            raise AxisError("a face of the domain could not be resolved", _place_of(faces, face))
        pending.extend(_resolved(tour, faces, face, age))
    return faces


def _united(first: list[SettledDisc], more: list[SettledDisc]) -> list[SettledDisc]:
    """Join discs that are the same, with the contacts of both."""
    united = list(first)
    for disc in more:
        k = next((k for k, other in enumerate(united) if other.r > 0 and _same(other, disc)), None)
        if k is None:
            united.append(disc)
        else:
            other = united[k]
            contacts = tuple(dict.fromkeys((*other.contacts, *disc.contacts)))
            united[k] = SettledDisc(other.x, other.y, other.r, contacts, other.kind, other.tol)
    return united


def _resolved(tour: Tour, faces: Faces, face: Face, age: int) -> list[tuple[Face, int]]:
    """Split a face by a junction, else by a cluster, else by stations."""
    for disc, at in _vertices(tour, faces, face):
        parts = _inserted(faces, disc, face, at)
        if len(parts) > 1:
            return [(part, 0) for part in parts]
    known = len(faces.contact)
    for gap in face:
        _add_station(tour, faces, _inside(tour, faces, gap))
    if len(faces.contact) > known:
        parts = list(dict.fromkeys(faces.face_of(gap) for gap in (*face, *range(known, len(faces.contact)))))
        return [(part, age + 1) for part in parts]
    if len(face) > 2 and _extent(faces, face) < _STAR and (star := _cluster(tour, faces, face, _STAR)):
        return [(part, 0) for part in _inserted(faces, star[0], face, star[1])]
    raise AxisError("a face of the domain could not be cut further", _place_of(faces, face))


def _vertices(tour: Tour, faces: Faces, face: Face) -> Iterator[tuple[SettledDisc, list[tuple[int, Place]]]]:
    """Yield what may be a vertex in a face: its junctions, then one disc for all of its gaps."""
    if len(face) > 2:
        yield from _junctions(tour, faces, face)
    if len(face) > 3 and (found := _cluster(tour, faces, face, _CLUSTER)) is not None:
        yield found


def _inside(tour: Tour, faces: Faces, gap: int) -> Place:
    """Return a place inside a gap: a border if it spans several elements."""
    stretch = faces.stretch(gap)
    if stretch is None:
        (e, _), _ = faces.gap(gap)
        return int(tour.after[e]), 0.0
    e, low, high = stretch
    return e, low + _CUT_AT * (high - low)


def _add_station(tour: Tour, faces: Faces, place: Place) -> None:
    """Settle the maximal disc at a place, unless the place is a contact already."""
    gap = faces.gap_at(place)
    if gap is None:
        return
    face = faces.face_of(gap)
    x, y, r, ok, count, element, t = maximal_disc(tour, *place)
    if not ok or r <= 0.0:
        return
    disc = SettledDisc(x, y, r, (), "station")
    at = {face.index(gap): place}
    for k in range(count):
        fit = _fit(tour, faces, face, (int(element[k]), float(t[k])))
        if fit is not None:
            at.setdefault(*fit)
    _inserted(faces, disc, face, sorted(at.items()))


def _fit(tour: Tour, faces: Faces, face: Face, place: Place) -> tuple[int, Place] | None:
    """Find the gap of a face that holds a contact; one just outside is put back inside."""
    gap = faces.gap_at(place)
    if gap is not None and gap in face:
        return face.index(gap), place
    for k, other in enumerate(face):
        stretch = faces.stretch(other)
        if stretch is None:
            continue
        e, low, high = stretch
        for f, s in (place, (int(tour.before[place[0]]), 1.0) if place[1] == 0.0 else place):
            if f == e and low - _SLACK <= s <= high + _SLACK:
                margin = min(1e-12, (high - low) / 4)
                return k, (e, min(max(s, low + margin), high - margin))
    return None


def _inserted(faces: Faces, disc: SettledDisc, face: Face, at: list[tuple[int, Place]]) -> list[Face]:
    """Insert a disc; if a corner of the face is that disc already, and lacks contacts, give that one the new ones."""
    for corner in range(len(face)):
        number = faces.corner(face, corner)
        lacking = [(k, place) for k, place in at if not _touches(faces, number, place)]
        if lacking and _same(faces.discs[number], disc):
            return _attached(faces, number, face, lacking)
    return faces.insert(disc, face, at) if len(at) > 1 else [face]


def _touches(faces: Faces, number: int, place: Place) -> bool:
    """Whether a place is a contact of a disc already."""
    disc = faces.discs[number]
    return any(
        one_contact(faces.tour, place, known, disc.x, disc.y, disc.r) for contact in disc.contacts for known in contact
    )


def _attached(faces: Faces, number: int, face: Face, at: list[tuple[int, Place]]) -> list[Face]:
    """Give a disc that is a corner of a face the contacts it lacks."""
    parts = [face]
    for k, place in at:
        gap = face[k]
        part = next(part for part in parts if gap in part)
        corner = next((i for i in range(len(part)) if faces.corner(part, i) == number), None)
        if corner is not None and len(part) > 2:
            parts.remove(part)
            parts += faces.attach(number, part, corner, part.index(gap), place)
    return parts


def _junctions(tour: Tour, faces: Faces, face: Face) -> Iterator[tuple[SettledDisc, list[tuple[int, Place]]]]:
    """Yield true junctions of a face: (disc, contacts), from its triples of consecutive gaps."""
    stretches = [faces.stretch(gap) for gap in face]
    n = len(face)
    for i in range(1 if n == 3 else n):
        triple = [i, (i + 1) % n, (i + 2) % n]
        if any(stretches[k] is None for k in triple):
            continue
        found = _triple_disc(tour, faces, face, triple)
        if found is not None:
            yield found


def _triple_disc(
    tour: Tour, faces: Faces, face: Face, triple: list[int]
) -> tuple[SettledDisc, list[tuple[int, Place]]] | None:
    """Return the disc that touches three gaps of a face, if there is one and it is empty."""
    disc, feet = _newton(tour, faces, face, triple)
    if disc is None:
        return None
    deepest, count, element, t = touching(tour, disc.x, disc.y, disc.r, TOUCH, -1)
    if deepest < -max(EMPTY, 1e-3 * disc.tol):
        return None
    at = dict(feet)
    for k in range(count):
        place = (int(element[k]), float(t[k]))
        if any(same_place(tour, *place, *foot, disc.r) for foot in at.values()):
            continue
        fit = _fit(tour, faces, face, place)
        if fit is not None:
            at.setdefault(*fit)
    return disc, sorted(at.items())


def _newton(
    tour: Tour, faces: Faces, face: Face, triple: list[int]
) -> tuple[SettledDisc | None, list[tuple[int, Place]]]:
    """Newton on three gaps, from their middles; the feet must be separate."""
    stretches = [s for k in triple if (s := faces.stretch(face[k])) is not None]
    element = np.array([s[0] for s in stretches], dtype=np.int64)
    low, high = np.array([s[1] for s in stretches]), np.array([s[2] for s in stretches])
    for start in _starts(tour, faces, face, element, low, high):
        found, x, y, r, t = junction_disc(tour, element, low, high, start)
        if found:
            break
    else:
        return None, []
    margin = np.minimum(1e-12, (high - low) / 4)
    t = np.clip(t, low + margin, high - margin)
    feet = [(int(e), float(s)) for e, s in zip(element, t, strict=True)]
    if any(
        same_place(tour, *feet[i], *feet[i - 1], r) and not _kink_between(tour, feet[i - 1], feet[i]) for i in range(3)
    ):
        return None, []
    return SettledDisc(x, y, r, (), "junction"), list(zip(triple, feet, strict=True))


def _starts(tour: Tour, faces: Faces, face: Face, element: Ints, low: Floats, high: Floats) -> Iterator[Floats]:
    """First guesses for the feet of a junction on three consecutive gaps.

    At a vertex that turns by a small angle the feet lie near it, at r times half the angle. (Where curvature jumps too
    there is a second, false root farther away, which the middle of the gaps would find.)
    """
    middle = (low + high) / 2
    radii = {disc.r for disc in _corner_discs(faces, face) if disc.r > 0.0}
    for i, j in ((0, 1), (1, 2)):
        if not (tour.convex[element[j]] and tour.after[element[i]] == element[j] and (high[i], low[j]) == (1.0, 0.0)):
            continue
        _, _, ax, ay, _, speed = site(tour, int(element[i]), 1.0)
        _, _, bx, by, _, next_speed = site(tour, int(element[j]), 0.0)
        half = math.atan2(ax * by - ay * bx, ax * bx + ay * by) / 2
        for r in (factor * radius for factor in (1.0, 0.5, 0.25) for radius in sorted(radii)):
            start = middle.copy()
            start[i], start[j] = max(middle[i], 1.0 - r * half / speed), min(middle[j], r * half / next_speed)
            yield start
    yield middle


def _kink_between(tour: Tour, a: Place, b: Place) -> bool:
    """Whether a convex vertex separates two feet on neighbouring elements: then they may be very near."""
    return bool((tour.after[a[0]] == b[0] and tour.convex[b[0]]) or (tour.after[b[0]] == a[0] and tour.convex[a[0]]))


def _cluster(tour: Tour, faces: Faces, face: Face, tol: float) -> tuple[SettledDisc, list[tuple[int, Place]]] | None:
    """Return a disc that touches all gaps of a face within `tol`, if there is one."""
    stretches = [faces.stretch(gap) for gap in face]
    if any(s is None for s in stretches):
        return None
    n = len(face)
    for i in range(n):
        disc, _ = _newton(tour, faces, face, [i, (i + 1) % n, (i + 2) % n])
        if disc is None or touching(tour, disc.x, disc.y, disc.r, tol, -1)[0] < -tol:
            continue
        feet, error = _feet_on(tour, disc, stretches)
        if error <= tol:
            return SettledDisc(disc.x, disc.y, disc.r, (), "cluster", max(error, TOUCH)), list(enumerate(feet))
    return None


def _feet_on(
    tour: Tour, disc: SettledDisc, stretches: list[tuple[int, float, float] | None]
) -> tuple[list[Place], float]:
    """Nearest places of some stretches to a centre, and how far at most they lie off the circle."""
    feet, error = [], 0.0
    for e, low, high in (s for s in stretches if s is not None):
        t, distance = nearest_on_stretch(tour, e, low, high, disc.x, disc.y)
        margin = min(1e-12, (high - low) / 4)
        feet.append((e, min(max(t, low + margin), high - margin)))
        error = max(error, abs(distance - disc.r))
    return feet, error


def _same(a: SettledDisc, b: SettledDisc) -> bool:
    return bool(math.hypot(a.x - b.x, a.y - b.y) <= _SAME_DISC and abs(a.r - b.r) <= _SAME_DISC)


def _corner_discs(faces: Faces, face: Face) -> list[SettledDisc]:
    return [faces.discs[faces.corner(face, k)] for k in range(len(face))]


def _extent(faces: Faces, face: Face) -> float:
    """Largest distance between the centres at a face's corners: how big its part of the axis can be."""
    centres: Floats = np.array([(disc.x, disc.y) for disc in _corner_discs(faces, face)])
    return float(np.ptp(centres, axis=0).max())


def _place_of(faces: Faces, face: Face) -> tuple[float, float]:
    centres = np.array([(disc.x, disc.y) for disc in _corner_discs(faces, face)])
    x, y = centres.mean(axis=0)
    return float(x), float(y)
