"""What compiled functions keep in the arrays of `Faces`, in tuples for tests: read and walked here independently."""

from collections.abc import Iterable

from mashape_cad.medial.ends import settle_ends
from mashape_cad.medial.faces import CONTACTS, Contact, Faces, SettledDisc, add_contact, add_disc, blank_faces, lay_out
from mashape_cad.medial.faces import stretch as gap_stretch
from mashape_cad.medial.links import settle_links
from mashape_cad.medial.tour import Tour

Face = tuple[int, ...]


def faces_of_ends(tour: Tour, extra: Iterable[SettledDisc] = ()) -> tuple[Faces, tuple[int, int]]:
    """Lay a domain out by the discs of its ends and some more; also return what `lay_out` says."""
    faces = blank_faces(tour)
    settle_ends(tour, faces)
    for disc in extra:
        settle(faces, disc)
    return faces, lay_out(tour, faces)


def faces_of_ends_and_links(tour: Tour) -> tuple[Faces, tuple[int, int]]:
    """Lay a domain out as `cut` does before it cuts; also return what `lay_out` says."""
    faces = blank_faces(tour)
    settle_ends(tour, faces)
    settle_links(tour, faces)
    return faces, lay_out(tour, faces)


def settle(faces: Faces, disc: SettledDisc) -> int:
    """Add a disc with its contacts; return its number."""
    number = add_disc(faces, disc.x, disc.y, disc.r, _kind(disc.kind), disc.tol)
    for (e, t), (f, s) in disc.contacts:
        add_contact(faces, number, e, t, f, s)
    return number


def _kind(name: str) -> int:
    return ("corner", "osculating", "arc", "station", "junction", "cluster").index(name)


def gaps_of(faces: Faces) -> range:
    """Return all gaps."""
    return range(int(faces.used[CONTACTS]))


def walked(faces: Faces, gap: int) -> Face:
    """Return the gaps of a face by the rule: along a gap, then clockwise round the disc at its end."""
    face = [gap]
    while (following := int(faces.contact[faces.contact[face[-1]]["after"]]["clockwise"])) != gap:
        assert following not in face, "a walk round a face comes back to its start"
        face.append(following)
    return tuple(face)


def all_faces(faces: Faces) -> list[Face]:
    """Return each face once, its lowest gap first."""
    return [face for gap in gaps_of(faces) if min(face := walked(faces, gap)) == gap]


def contact_of(faces: Faces, gap: int) -> Contact:
    """Return first and last place of the contact at which a gap starts."""
    first, last = (
        (faces.contact[gap]["first_e"], faces.contact[gap]["first_t"]),
        (faces.contact[gap]["last_e"], faces.contact[gap]["last_t"]),
    )
    return (int(first[0]), float(first[1])), (int(last[0]), float(last[1]))


def stretch_of(tour: Tour, faces: Faces, gap: int) -> tuple[int, float, float] | None:
    """Return element, low and high of a gap on one element; None if it spans several."""
    on_one, e, low, high = gap_stretch(tour, faces, gap)
    return (int(e), float(low), float(high)) if on_one else None
