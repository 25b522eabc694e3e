"""The domain cut by maximal discs into faces: contacts, gaps, and which gaps bound which face.

Terminology
-----------
contact
    Where a disc touches the boundary: a place, or an interval for a disc that touches along an arc.
gap
    The stretch of boundary from one contact to the next on the same loop; named by the contact where it starts.
face
    A part of the domain between discs, as the cycle of gaps around it. Walking along a gap to its last contact, the
    face goes on with the gap that starts at the clockwise next contact of the same disc. Contacts and gaps are a
    half-edge structure with the discs as chords; a face is not stored, it is walked.

A face with n gaps holds a tree of the medial axis with n ends (the discs at its corners): n = 2 is one piece of a
branch, n = 3 one junction of degree three. n = 1 cannot be.

References
----------
H. I. Choi, S. W. Choi, H. P. Moon, Mathematical theory of medial axis transform, Pacific J. Math. 181 (1997), domain
decomposition lemma.
"""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple, cast

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import Records, compiled, records
from mashape_cad.medial.contact import TOUCH
from mashape_cad.medial.tour import Ints, Tour, loop_count, site

__all__ = [
    "ARC",
    "CLUSTER",
    "CONTACTS",
    "CORNER",
    "DISCS",
    "JUNCTION",
    "LAID_OUT",
    "LOOSE_LOOP",
    "OSCULATING",
    "SETTLED",
    "STATION",
    "WRONG_COUNT",
    "Contact",
    "Faces",
    "Place",
    "SettledDisc",
    "add_contact",
    "add_disc",
    "attach",
    "blank_faces",
    "corner",
    "cycle",
    "disc_at",
    "distinct_faces",
    "gap_at",
    "insert",
    "is_laid_out",
    "lay_out",
    "on_contact",
    "settled_discs",
    "stretch",
]

Place = tuple[int, float]
Contact = tuple[Place, Place]  # first and last place; equal but for a disc that touches along an arc

# What a disc was settled as. (Typed, since numba compiles a function anew for each literal.)
CORNER, OSCULATING, ARC, STATION, JUNCTION, CLUSTER = (cast("int", np.int64(kind)) for kind in range(6))
_KINDS = ("corner", "osculating", "arc", "station", "junction", "cluster")
# How many discs may be settled: many more for each element than any shape has needed, so that a search that does not
# end is ended.
_DISCS_PER_ELEMENT, _DISCS_AT_LEAST = 40, 400
# Rows of `Faces.used`.
CONTACTS, DISCS, _STAMP = range(3)
# What `lay_out` may find.
LAID_OUT, LOOSE_LOOP, WRONG_COUNT = range(3)


CONTACT = np.dtype(
    [
        ("first_e", np.int64),
        ("first_t", np.float64),
        ("last_e", np.int64),
        ("last_t", np.float64),
        ("disc", np.int64),
        ("after", np.int64),
        ("clockwise", np.int64),
        ("mark", np.int64),
    ]
)
SETTLED = np.dtype([("x", np.float64), ("y", np.float64), ("r", np.float64), ("tol", np.float64), ("kind", np.int64)])


class Faces(NamedTuple):
    """Discs settled so far, their contacts on the loops, and the faces between them.

    All arrays are as long as may be needed; ``used`` says how many rows count. Once laid out it grows only by `insert`
    and `attach`, each of which splits one face; so it is planar by construction.

    Attributes
    ----------
    used : (3,) array
        Number of contacts, number of discs, and a stamp for marks.
    contact : record array
        ``first_e``, ``first_t``, ``last_e``, ``last_t``: places at which a contact starts and ends. ``disc``: the disc
        that touches here. ``after``: the next contact on the loop, where the contact's gap ends. ``clockwise``: the
        next contact on the disc, clockwise, where a face goes on that has come to this one along a gap. ``mark``: for
        walks over many faces; a contact is marked if it bears the present stamp.
    settled : record array
        Discs: ``x``, ``y``, ``r``: centre and radius in the tour's scale. ``tol``: how far the contacts may lie off the
        circle. ``kind``: what it was settled as, `CORNER` and so on.
    head : (n,) array
        The first contact on each element; -1 if there is none.
    """

    used: Ints
    contact: Records
    settled: Records
    head: Ints


@dataclass(frozen=True, slots=True)
class SettledDisc:
    """A maximal disc in the tour's scale, for whoever looks at one.

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


def settled_discs(faces: Faces) -> list[SettledDisc]:
    """Return the discs of `faces` with their contacts."""
    settled = faces.settled[: int(faces.used[DISCS])]
    contacts: list[list[Contact]] = [[] for _ in settled]
    for row in _rows(faces.contact[: int(faces.used[CONTACTS])]):
        contacts[row["disc"]].append(((row["first_e"], row["first_t"]), (row["last_e"], row["last_t"])))
    return [
        SettledDisc(d["x"], d["y"], d["r"], tuple(touched), _KINDS[d["kind"]], d["tol"])
        for d, touched in zip(_rows(settled), contacts, strict=True)
    ]


def _rows(rows: Records) -> list[dict[str, Any]]:
    return [dict(zip(rows.dtype.names, row, strict=True)) for row in rows.tolist()]


def blank_faces(tour: Tour) -> Faces:
    """Return the domain before any cut."""
    n = len(tour.element)
    discs = _DISCS_PER_ELEMENT * n + _DISCS_AT_LEAST
    contact, settled = np.zeros(3 * discs, CONTACT), np.empty(discs, SETTLED)
    return Faces(np.zeros(3, np.int64), records(contact), records(settled), np.full(n, -1))


@compiled
def add_disc(faces: Faces, x: float, y: float, r: float, kind: int, tol: float) -> int:
    """Append a disc, as yet without contacts; return its number."""
    number = faces.used[DISCS]
    faces.settled[number].x, faces.settled[number].y, faces.settled[number].r = x, y, r
    faces.settled[number].kind, faces.settled[number].tol = kind, tol
    faces.used[DISCS] = number + 1
    return number


@compiled
def disc_at(faces: Faces, x: float, y: float, r: float, near: float) -> int:
    """Return the first disc whose centre and radius are as near as that to these; -1 if there is none."""
    for k in range(faces.used[DISCS]):
        if math.hypot(faces.settled[k].x - x, faces.settled[k].y - y) <= near and abs(faces.settled[k].r - r) <= near:
            return k
    return -1


@compiled
def add_contact(faces: Faces, number: int, e: int, t: float, f: int, s: float) -> int:
    """Append a contact of a disc, from place (e, t) to place (f, s), as yet tied to no other; return its number."""
    contact = faces.used[CONTACTS]
    faces.contact[contact].first_e, faces.contact[contact].first_t = e, t
    faces.contact[contact].last_e, faces.contact[contact].last_t = f, s
    faces.contact[contact].disc = number
    faces.used[CONTACTS] = contact + 1
    return contact


@compiled
def lay_out(tour: Tour, faces: Faces) -> tuple[int, int]:
    """Tie the first contacts together round their loops and their discs.

    Returns
    -------
    outcome : int
        `LAID_OUT`, or `LOOSE_LOOP` where no disc touches a loop, or `WRONG_COUNT` if the discs do not make all faces
        simply connected.
    loop_or_faces : int
        The loose loop, or how many faces there are.
    """
    following = _sort_on_elements(faces)
    for loop in range(loop_count(tour)):
        if not _tie_loop(tour, faces, following, loop):
            return LOOSE_LOOP, loop
    _tie_discs(tour, faces)
    found = _face_count(faces)
    if found != 2 - loop_count(tour) + faces.used[CONTACTS] - faces.used[DISCS]:
        return WRONG_COUNT, found
    return LAID_OUT, found


@compiled
def _sort_on_elements(faces: Faces) -> Ints:
    """Set `head`; return for each contact the next one on its element, -1 behind the last."""
    following = np.full(faces.used[CONTACTS], -1)
    for c in range(faces.used[CONTACTS]):
        e, t = faces.contact[c].first_e, faces.contact[c].first_t
        before, at = -1, faces.head[e]
        while at >= 0 and faces.contact[at].first_t <= t:
            before, at = at, following[at]
        following[c] = at
        if before < 0:
            faces.head[e] = c
        else:
            following[before] = c
    return following


@compiled
def _tie_loop(tour: Tour, faces: Faces, following: Ints, loop: int) -> bool:
    """Set `after` round a loop; False if it has no contact."""
    first, last = -1, -1
    for e in range(len(tour.element)):
        if tour.element[e].loop != loop:
            continue
        c = faces.head[e]
        while c >= 0:
            if first < 0:
                first = c
            else:
                faces.contact[last].after = c
            last = c
            c = following[c]
    if first >= 0:
        faces.contact[last].after = first
    return first >= 0


@compiled
def _tie_discs(tour: Tour, faces: Faces) -> None:
    """Set `clockwise` round each disc."""
    n = faces.used[CONTACTS]
    angle = np.empty(n)
    largest, next_of_disc = np.full(faces.used[DISCS], -1), np.full(n, -1)
    for c in range(n):
        d = faces.contact[c].disc
        x, y, _, _, _, _ = site(tour, faces.contact[c].first_e, faces.contact[c].first_t)
        angle[c] = math.atan2(y - faces.settled[d].y, x - faces.settled[d].x)
        before, at = -1, largest[d]
        while at >= 0 and angle[at] >= angle[c]:
            before, at = at, next_of_disc[at]
        next_of_disc[c] = at
        if before < 0:
            largest[d] = c
        else:
            next_of_disc[before] = c
    for c in range(n):
        faces.contact[c].clockwise = next_of_disc[c] if next_of_disc[c] >= 0 else largest[faces.contact[c].disc]


@compiled
def _face_count(faces: Faces) -> int:
    stamp = _new_stamp(faces)
    found = 0
    for c in range(faces.used[CONTACTS]):
        if faces.contact[c].mark != stamp:
            found += 1
            _mark_cycle(faces, c, stamp)
    return found


@compiled
def _new_stamp(faces: Faces) -> int:
    faces.used[_STAMP] += 1
    return faces.used[_STAMP]


@compiled
def _mark_cycle(faces: Faces, gap: int, stamp: int) -> None:
    at = gap
    while faces.contact[at].mark != stamp:
        faces.contact[at].mark = stamp
        at = faces.contact[faces.contact[at].after].clockwise


@compiled
def distinct_faces(faces: Faces, gaps: Ints) -> Ints:
    """Keep of some gaps one for each face."""
    stamp = _new_stamp(faces)
    kept, count = np.empty(len(gaps), np.int64), 0
    for gap in gaps:
        if faces.contact[gap].mark != stamp:
            _mark_cycle(faces, gap, stamp)
            kept[count] = gap
            count += 1
    return kept[:count]


@compiled
def cycle(faces: Faces, gap: int) -> Ints:
    """Return the gaps of the face that a gap bounds, in order, this one first."""
    n, at = 1, faces.contact[faces.contact[gap].after].clockwise
    while at != gap:
        n += 1
        at = faces.contact[faces.contact[at].after].clockwise
    found = np.empty(n, np.int64)
    for k in range(n):
        found[k] = at
        at = faces.contact[faces.contact[at].after].clockwise
    return found


@compiled
def corner(faces: Faces, gap: int) -> int:
    """Return the disc at the end of a gap: the corner between it and the face's next gap."""
    return faces.contact[faces.contact[gap].after].disc


@compiled
def stretch(tour: Tour, faces: Faces, gap: int) -> tuple[bool, int, float, float]:
    """Return a gap as part of one element: ``(on one, element, low, high)``; not while it spans several elements."""
    end = faces.contact[gap].after
    e, low = faces.contact[gap].last_e, faces.contact[gap].last_t
    f, high = faces.contact[end].first_e, faces.contact[end].first_t
    if f == tour.element[e].after and high == 0.0:
        return True, e, low, 1.0
    return e == f and low < high, e, low, high


@compiled
def is_laid_out(tour: Tour, faces: Faces, gap: int) -> bool:
    """Whether a face is one piece of a branch: two gaps, each on one element."""
    other = faces.contact[faces.contact[gap].after].clockwise
    if other == gap or faces.contact[faces.contact[other].after].clockwise != gap:
        return False
    return stretch(tour, faces, gap)[0] and stretch(tour, faces, other)[0]


@compiled
def gap_at(tour: Tour, faces: Faces, e: int, t: float) -> int:
    """Return the gap that holds a place strictly inside; -1 if the place is on a contact."""
    at, f = faces.head[e], e
    if at < 0 or faces.contact[at].first_t > t:
        f = tour.element[e].before
        while faces.head[f] < 0:
            f = tour.element[f].before
        at, t_most = faces.head[f], math.inf
    else:
        t_most = t
    while True:
        following = faces.contact[at].after
        if (
            following == faces.head[f]
            or faces.contact[following].first_e != f
            or faces.contact[following].first_t > t_most
        ):
            break
        at = following
    return -1 if on_contact(faces, at, e, t) else at


@compiled
def on_contact(faces: Faces, c: int, e: int, t: float) -> bool:
    """Whether a place is a contact's, or lies on its arc, ends included."""
    a, s, b, u = faces.contact[c].first_e, faces.contact[c].first_t, faces.contact[c].last_e, faces.contact[c].last_t
    if a == b and s == u:
        return e == a and t == s
    from_first = e > a or (e == a and t >= s)
    to_last = e < b or (e == b and t <= u)
    if a < b or (a == b and s < u):
        return from_first and to_last
    return from_first or to_last  # the arc runs over the start of the loop


@compiled
def insert(faces: Faces, number: int, gaps: Ints, e: Ints, t: Floats) -> Ints:
    """Split a face by a disc.

    Parameters
    ----------
    number : int
        The disc, as yet without contacts.
    gaps : (m,) array
        Different gaps of one face, in its order.
    e, t : (m,) arrays
        The contacts: a place strictly inside each gap.

    Returns
    -------
    (m,) array
        The new contacts; the gap behind each bounds one of the m parts.
    """
    m = len(gaps)
    new = np.empty(m, np.int64)
    for i in range(m):
        new[i] = _put_contact(faces, number, gaps[i], e[i], t[i])
    for i in range(m):
        faces.contact[new[i]].clockwise = new[i - 1]
    return new


@compiled
def attach(faces: Faces, before: int, gap: int, e: int, t: float) -> int:
    """Give the disc at a face's corner one more contact, in another gap of that face, which splits in two.

    Parameters
    ----------
    before : int
        The gap that ends at the corner.
    gap, e, t
        The other gap, and the place strictly inside it.

    Returns
    -------
    int
        The new contact.
    """
    here = faces.contact[before].after
    number = faces.contact[here].disc
    new = _put_contact(faces, number, gap, e, t)
    faces.contact[new].clockwise, faces.contact[here].clockwise = faces.contact[here].clockwise, new
    faces.settled[number].kind = JUNCTION
    return new


@compiled
def _put_contact(faces: Faces, number: int, gap: int, e: int, t: float) -> int:
    """Put a contact inside a gap."""
    new = add_contact(faces, number, e, t, e, t)
    faces.contact[new].after, faces.contact[gap].after = faces.contact[gap].after, new
    if faces.head[e] < 0 or t < faces.contact[faces.head[e]].first_t:
        faces.head[e] = new
    return new
