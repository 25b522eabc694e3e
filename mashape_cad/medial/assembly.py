"""From a domain cut into pieces to the graph of nodes and branches."""

import math

import numpy as np

from mashape_cad.errors import AxisError
from mashape_cad.geometry.edge import EllipseArc, Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.ends import Place, SettledDisc
from mashape_cad.medial.faces import Faces
from mashape_cad.medial.graph import Branch, Contacts, Discs, MedialAxis, Nodes, Pieces
from mashape_cad.medial.tour import Frame, Ints, Tour, site

__all__ = ["assembled", "foot", "single_disc"]


def assembled(profile: Profile, tour: Tour, frame: Frame, faces: Faces) -> MedialAxis:
    """Make the medial axis of a domain whose faces all have two gaps."""
    pieces, side_of_gap = _pieces(faces)
    degree = np.bincount(faces.disc_of, minlength=len(faces.discs))
    node_discs = np.flatnonzero(degree != 2)
    if not len(node_discs):
        node_discs = np.array([0])  # a branch that closes on itself has no node of its own
    nodes_of = {int(disc): node for node, disc in enumerate(node_discs)}
    branches = _branches(pieces, nodes_of)
    discs = _discs(profile, tour, frame, faces.discs, degree)
    kinds = tuple({1: "end", 2: "seam"}.get(int(degree[d]), "junction") for d in node_discs)
    nodes = Nodes(discs.centre[node_discs], discs.radius[node_discs], degree[node_discs], kinds, node_discs)
    return MedialAxis(profile, nodes, branches, discs, _contacts(faces, side_of_gap), pieces, tour, frame)


def single_disc(profile: Profile, tour: Tour, frame: Frame, disc: SettledDisc) -> MedialAxis:
    """Make the medial axis of a domain that is one disc: one node, no branch."""
    whole = SettledDisc(disc.x, disc.y, disc.r, (((0, 0.0), (0, 0.0)),), disc.kind, disc.tol)
    discs = _discs(profile, tour, frame, [whole], np.zeros(1, dtype=np.int64))
    nodes = Nodes(discs.centre, discs.radius, np.zeros(1, dtype=np.int64), ("disc",), np.zeros(1, dtype=np.int64))
    none = np.zeros((0, 2))
    no_index = np.zeros((0, 2), dtype=np.int64)
    zero = np.zeros(1, dtype=np.int64)
    around = np.array([[len(tour.degree), 0.0]])
    contacts = Contacts(np.zeros((1, 2)), around, zero, zero - 1, zero)
    return MedialAxis(profile, nodes, (), discs, contacts, Pieces(no_index, none, none, no_index), tour, frame)


def foot(profile: Profile, tour: Tour, place: Place) -> tuple[int, float]:
    """Return a place as an edge of the profile and its parameter."""
    e, t = place
    start, end = float(tour.edge_from[e]), float(tour.edge_to[e])
    edge = profile.edges[int(tour.edge[e])]
    if tour.degree[e] > 0 and isinstance(edge, EllipseArc) and 0.0 < t < 1.0:
        t = _angle_fraction(t, (end - start) * edge.sweep)
    return int(tour.edge[e]), start + t * (end - start)  # a cone lies at the start of its edge


def _angle_fraction(t: float, angle: float) -> float:
    """Fraction of the angle at parameter t of a rational quadratic arc: its parameter is not linear in the angle."""
    half = abs(angle) / 2
    # In the frame of the arc's middle the point is ((1-t)^2 + 2 t (1-t) + t^2) cos, (t^2 - (1-t)^2) sin over the
    # weight.
    s = 1.0 - t
    x = (s * s + t * t) * math.cos(half) + 2 * s * t
    y = (t * t - s * s) * math.sin(half)
    return (math.atan2(y, x) + half) / (2 * half)


def _pieces(faces: Faces) -> tuple[Pieces, dict[int, tuple[int, int]]]:
    """Return the pieces, and of which piece, and which side of it, each gap is the boundary."""
    rows = []
    side_of_gap: dict[int, tuple[int, int]] = {}
    for number, face in enumerate(faces.faces):
        sides = [faces.stretch(gap) for gap in face]
        if len(face) != 2 or sides[0] is None or sides[1] is None:
            raise AxisError("a face was left unresolved")
        side_of_gap |= {gap: (number, side) for side, gap in enumerate(face)}
        # Along the first gap the piece runs from the disc where that gap starts to the disc where it ends.
        rows.append((sides[0], sides[1], faces.disc_of[face[0]], faces.disc_of[faces.after[face[0]]]))
    pieces = Pieces(
        np.array([[a[0], b[0]] for a, b, _, _ in rows], dtype=np.int64),
        np.array([[a[1], b[1]] for a, b, _, _ in rows]),
        np.array([[a[2], b[2]] for a, b, _, _ in rows]),
        np.array([[c, d] for _, _, c, d in rows], dtype=np.int64),
    )
    return pieces, side_of_gap


def _branches(pieces: Pieces, node_of: dict[int, int]) -> tuple[Branch, ...]:
    """Chain pieces between nodes."""
    at_disc: dict[int, list[tuple[int, bool]]] = {}
    for piece, (a, b) in enumerate(pieces.disc):
        at_disc.setdefault(int(a), []).append((piece, True))
        at_disc.setdefault(int(b), []).append((piece, False))
    used: set[int] = set()
    branches = []
    for disc, node in node_of.items():
        for piece, forward in at_disc.get(disc, []):
            if piece in used:
                continue
            chain = _chain(pieces, at_disc, node_of, used, (piece, forward))
            last, onward = chain[-1]
            branches.append(Branch(node, node_of[int(pieces.disc[last, int(onward)])], tuple(chain)))
    return tuple(branches)


def _chain(
    pieces: Pieces,
    at_disc: dict[int, list[tuple[int, bool]]],
    node_of: dict[int, int],
    used: set[int],
    step: tuple[int, bool],
) -> list[tuple[int, bool]]:
    """Follow pieces from a node to the next one."""
    chain = [step]
    used.add(step[0])
    while (disc := int(pieces.disc[step[0], int(step[1])])) not in node_of:
        step = next(other for other in at_disc[disc] if other[0] not in used)
        used.add(step[0])
        chain.append(step)
    return chain


def _discs(profile: Profile, tour: Tour, frame: Frame, settled: list[SettledDisc], degree: Ints) -> Discs:
    """Scale discs back to mm and have the kernel measure each."""
    centre: Floats = np.array([(d.x, d.y) for d in settled]) * frame.size + frame.middle
    radius: Floats = np.array([d.r for d in settled]) * frame.size
    places = [(d.contacts[0][0], d.contacts[1][0] if len(d.contacts) > 1 else d.contacts[0][1]) for d in settled]
    feet = [[foot(profile, tour, place) for place in pair] for pair in places]
    points: Floats = np.array([[site(tour, *place)[:2] for place in pair] for pair in places])
    return Discs(
        centre,
        radius,
        degree,
        points * frame.size + frame.middle,
        np.array([[edge for edge, _ in pair] for pair in feet], dtype=np.int64),
        np.array([[u for _, u in pair] for pair in feet]),
        np.array([d.tol for d in settled]) * frame.size,
        DistanceQuery(profile).distances(centre),
    )


def _contacts(faces: Faces, side_of_gap: dict[int, tuple[int, int]]) -> Contacts:
    order = sorted(range(len(faces.contact)), key=lambda c: faces.contact[c][0])
    return Contacts(
        np.array([faces.contact[c][0] for c in order], dtype=float),
        np.array([faces.contact[c][1] for c in order], dtype=float),
        np.array([faces.disc_of[c] for c in order], dtype=np.int64),
        np.array([side_of_gap[c][0] for c in order], dtype=np.int64),
        np.array([side_of_gap[c][1] for c in order], dtype=np.int64),
    )
