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
    half-edge structure with the discs as chords.

A face with n gaps holds a tree of the medial axis with n ends (the discs at its corners): n = 2 is one piece of a
branch, n = 3 one junction of degree three. n = 1 cannot be.

References
----------
H. I. Choi, S. W. Choi, H. P. Moon, Mathematical theory of medial axis transform, Pacific J. Math. 181 (1997), domain
decomposition lemma.
"""

import math
from bisect import bisect_right, insort

import numpy as np

from mashape_cad.errors import AxisError
from mashape_cad.medial.ends import Contact, Place, SettledDisc
from mashape_cad.medial.tour import Tour, site

__all__ = ["Face", "Faces"]

Face = tuple[int, ...]  # gaps, each named by its first contact
_Key = tuple[int, float, int]


class Faces:
    """Discs settled so far, their contacts on the loops, and the faces between them.

    Grows only by `insert` and `attach`, each of which splits one face; so it is planar by construction.
    """

    def __init__(self, tour: Tour, discs: list[SettledDisc]) -> None:
        """Lay out the first discs, which must link all loops; whether the faces are simply connected is checked."""
        self.tour = tour
        self.discs: list[SettledDisc] = []
        self.contact: list[Contact] = []
        self.disc_of: list[int] = []
        self.after: list[int] = []
        self._order: list[list[_Key]] = [[] for _ in range(int(tour.loop.max()) + 1)]
        self._face: dict[int, Face] = {}
        around = [self._record(disc) for disc in discs]
        self._link_loops()
        self._trace_faces(around)

    @property
    def faces(self) -> list[Face]:
        """All faces, each once."""
        return list(dict.fromkeys(self._face.values()))

    def gap(self, contact: int) -> tuple[Place, Place]:
        """Return the first and last place of the gap that starts at a contact."""
        return self.contact[contact][1], self.contact[self.after[contact]][0]

    def stretch(self, contact: int) -> tuple[int, float, float] | None:
        """Return a gap as ``(element, low, high)``; None while it spans several elements."""
        (e, low), (f, high) = self.gap(contact)
        if (e, low) == (f, high) or e != f:
            return (e, low, 1.0) if (f, high) == (int(self.tour.after[e]), 0.0) else None
        return (e, low, high) if low < high else None

    def gap_at(self, place: Place) -> int | None:
        """Return the gap that holds a place strictly inside; None if the place is on a contact."""
        order = self._order[int(self.tour.loop[place[0]])]
        if not order:
            return None
        at = bisect_right(order, (*place, len(self.contact)))
        contact = order[at - 1][2]  # at = 0 wraps to the loop's last contact
        first, last = self.contact[contact]
        if place == first or self._inside_arc(first, last, place):
            return None
        return contact

    def face_of(self, gap: int) -> Face:
        """Return the face that a gap bounds."""
        return self._face[gap]

    def corner(self, face: Face, k: int) -> int:
        """Return the disc between gap k and gap k + 1 of a face."""
        return self.disc_of[self.after[face[k]]]

    def insert(self, disc: SettledDisc, face: Face, at: list[tuple[int, Place]]) -> list[Face]:
        """Split a face by a disc.

        Parameters
        ----------
        disc : SettledDisc
            Its contacts are replaced by the places of `at`.
        face : Face
        at : list of (k, place)
            Contacts: position of the gap in the face, and the place strictly inside that gap. All gaps differ.

        Returns
        -------
        list of Face
            The parts, as many as contacts.
        """
        at = sorted(at)
        contacts = tuple((place, place) for _, place in at)
        number = len(self.discs)
        self.discs.append(
            SettledDisc(disc.x, disc.y, disc.r, contacts, disc.kind, disc.tol),
        )
        new = [self._new_contact((place, place), number, face[k]) for k, place in at]
        parts = []
        for i, (k, _) in enumerate(at):
            following, wraps = at[(i + 1) % len(at)][0], i + 1 == len(at)
            rest = face[k + 1 :] + face[: following + 1] if wraps else face[k + 1 : following + 1]
            parts.append((new[i], *rest))
        return self._replace_faces(parts)

    def attach(self, number: int, face: Face, corner: int, k: int, place: Place) -> list[Face]:
        """Give a disc at a face's corner one more contact, in gap k: the face splits in two."""
        old = self.discs[number]
        contacts = (*old.contacts, (place, place))
        self.discs[number] = SettledDisc(old.x, old.y, old.r, contacts, "junction", old.tol)
        new = self._new_contact((place, place), number, face[k])
        turned = face[corner + 1 :] + face[: corner + 1]  # now the disc sits behind the last gap
        at = turned.index(face[k])
        return self._replace_faces([turned[: at + 1], (new, *turned[at + 1 :])])

    def _record(self, disc: SettledDisc) -> list[int]:
        """Add a disc of the first layout; returns its contacts in counter-clockwise order."""
        number = len(self.discs)
        self.discs.append(disc)
        contacts = []
        for contact in sorted(disc.contacts, key=lambda contact: self._angle(disc, contact)):
            contacts.append(len(self.contact))
            self._remember(contact, number)
        return contacts

    def _angle(self, disc: SettledDisc, contact: Contact) -> float:
        x, y, *_ = site(self.tour, *contact[0])
        return math.atan2(y - disc.y, x - disc.x)

    def _remember(self, contact: Contact, number: int) -> None:
        (e, t), _ = contact
        insort(self._order[int(self.tour.loop[e])], (e, t, len(self.contact)))
        self.contact.append(contact)
        self.disc_of.append(number)
        self.after.append(-1)

    def _new_contact(self, contact: Contact, number: int, gap: int) -> int:
        """Put a contact inside a gap."""
        new = len(self.contact)
        self._remember(contact, number)
        self.after[new], self.after[gap] = self.after[gap], new
        return new

    def _link_loops(self) -> None:
        for number, order in enumerate(self._order):
            if not order:
                e = int(np.flatnonzero(self.tour.loop == number)[0])
                x, y, *_ = site(self.tour, e, 0.0)
                raise AxisError(f"no disc touches loop {number}", (x, y))
            for (_, _, a), (_, _, b) in zip(order, order[1:] + order[:1], strict=True):
                self.after[a] = b

    def _trace_faces(self, around: list[list[int]]) -> None:
        """Find the cycles of: go along a gap, turn clockwise to the disc's next contact."""
        clockwise = {c: ring[i - 1] for ring in around for i, c in enumerate(ring)}
        seen: set[int] = set()
        for start in range(len(self.contact)):
            cycle, at = [], start
            while at not in seen:
                seen.add(at)
                cycle.append(at)
                at = clockwise[self.after[at]]
            if cycle:
                self._replace_faces([tuple(cycle)])
        holes = len(self._order) - 1
        expected = 1 - holes + sum(len(ring) - 1 for ring in around)
        if len(self.faces) != expected:
            raise AxisError(f"the first discs cut the domain into {len(self.faces)} faces, not {expected}")

    def _replace_faces(self, parts: list[Face]) -> list[Face]:
        for part in parts:
            for gap in part:
                self._face[gap] = part
        return parts

    def _inside_arc(self, first: Place, last: Place, place: Place) -> bool:
        """Whether a place lies on a contact's arc, ends included."""
        if first == last:
            return False
        if first < last:
            return first <= place <= last
        return place >= first or place <= last
