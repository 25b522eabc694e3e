"""From a domain cut into pieces to the graph of nodes and branches."""

import math

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery, clearances
from mashape_cad.medial.compiled import Records, compiled
from mashape_cad.medial.emptiness import spans_near
from mashape_cad.medial.faces import CONTACTS, DISCS, Faces
from mashape_cad.medial.faces import stretch as gap_stretch
from mashape_cad.medial.graph import Branch, Contacts, Discs, MedialAxis, Nodes, Pieces
from mashape_cad.medial.tour import Frame, Ints, Tour, site

__all__ = ["assembled", "foot", "single_disc"]

# Spans that may come this near to a disc (sizes) are shown to the kernel. Where it finds nothing as near, it has
# overlooked something and is asked again, at length.
_NEAR = 1e-9


def assembled(profile: Profile, tour: Tour, frame: Frame, faces: Faces) -> MedialAxis:
    """Make the medial axis of a domain whose faces all have two gaps."""
    element, low, high, ends, piece_of, side_of = _pieces(tour, faces)
    pieces = Pieces(element, low, high, ends)
    contacts = _contacts(faces, piece_of, side_of)
    degree = np.bincount(contacts.disc, minlength=int(faces.used[DISCS]))
    node_discs = np.flatnonzero(degree != 2)
    if not len(node_discs):
        node_discs = np.array([0])  # a branch that closes on itself has no node of its own
    discs = _discs(profile, tour, frame, faces, contacts, degree)
    kinds = tuple({1: "end", 2: "seam"}.get(d, "junction") for d in degree[node_discs].tolist())
    nodes = Nodes(discs.centre[node_discs], discs.radius[node_discs], degree[node_discs], kinds, node_discs)
    return MedialAxis(profile, nodes, _branches(pieces, node_discs), discs, contacts, pieces, tour, frame)


def single_disc(profile: Profile, tour: Tour, frame: Frame, faces: Faces) -> MedialAxis:
    """Make the medial axis of a domain that is one disc: one node, no branch."""
    zero = np.zeros(1, dtype=np.int64)
    around = np.array([[len(tour.element), 0.0]])
    contacts = Contacts(np.zeros((1, 2)), around, zero, zero - 1, zero)
    discs = _discs(profile, tour, frame, faces, contacts, zero)
    nodes = Nodes(discs.centre, discs.radius, zero, ("disc",), zero)
    none, no_index = np.zeros((0, 2)), np.zeros((0, 2), dtype=np.int64)
    return MedialAxis(profile, nodes, (), discs, contacts, Pieces(no_index, none, none, no_index), tour, frame)


def foot(tour: Tour, place: tuple[int, float]) -> tuple[int, float]:
    """Return a place as the number of an edge of the profile and its parameter."""
    e, t = place
    return int(tour.edge[e]), float(_edge_parameter(tour, e, t))


@compiled
def _edge_parameter(tour: Tour, e: int, t: float) -> float:
    """Parameter ``u`` of a place on its edge; a cone lies where the span behind it starts."""
    start, end = tour.element[e].edge_from, tour.element[e].edge_to
    if tour.element[e].angle != 0.0 and 0.0 < t < 1.0:
        t = _angle_fraction(t, tour.element[e].angle)
    return start + t * (end - start)


@compiled
def _angle_fraction(t: float, angle: float) -> float:
    """Fraction of the angle at parameter t of a rational quadratic arc: its parameter is not linear in the angle."""
    half = abs(angle) / 2
    # In the frame of the arc's middle the point is ((1-t)^2 + 2 t (1-t) + t^2) cos, (t^2 - (1-t)^2) sin over the
    # weight.
    s = 1.0 - t
    x = (s * s + t * t) * math.cos(half) + 2 * s * t
    y = (t * t - s * s) * math.sin(half)
    return (math.atan2(y, x) + half) / (2 * half)


@compiled
def _pieces(tour: Tour, faces: Faces) -> tuple[Ints, Floats, Floats, Ints, Ints, Ints]:
    """Return the pieces as arrays (see `Pieces`), and of which piece, and which side, each gap is the boundary."""
    n = faces.used[CONTACTS]
    element, low, high = np.empty((n // 2, 2), np.int64), np.empty((n // 2, 2)), np.empty((n // 2, 2))
    ends, piece_of, side_of = np.empty((n // 2, 2), np.int64), np.full(n, -1), np.zeros(n, np.int64)
    piece = 0
    for gap in range(n):
        if piece_of[gap] >= 0:
            continue
        other = faces.contact[faces.contact[gap].after].clockwise
        _, element[piece, 0], low[piece, 0], high[piece, 0] = gap_stretch(tour, faces, gap)
        _, element[piece, 1], low[piece, 1], high[piece, 1] = gap_stretch(tour, faces, other)
        # Along the first gap the piece runs from the disc where that gap starts to the disc where it ends.
        ends[piece, 0], ends[piece, 1] = faces.contact[gap].disc, faces.contact[faces.contact[gap].after].disc
        piece_of[gap], piece_of[other] = piece, piece
        side_of[other] = 1
        piece += 1
    return element, low, high, ends, piece_of, side_of


def _contacts(faces: Faces, piece_of: Ints, side_of: Ints) -> Contacts:
    n = int(faces.used[CONTACTS])
    contact = faces.contact[:n]
    order = np.lexsort((contact["first_t"], contact["first_e"]))
    contact = contact[order]
    return Contacts(
        np.column_stack([contact["first_e"], contact["first_t"]]),
        np.column_stack([contact["last_e"], contact["last_t"]]),
        contact["disc"],
        piece_of[order],
        side_of[order],
    )


def _branches(pieces: Pieces, node_discs: Ints) -> tuple[Branch, ...]:
    """Chain pieces between nodes."""
    node, first, steps, forward = _chains(pieces.disc, node_discs)
    ends, rows = node.tolist(), list(zip(steps.tolist(), forward.tolist(), strict=True))
    borders = [*first.tolist(), len(rows)]
    return tuple(Branch(a, b, tuple(rows[borders[k] : borders[k + 1]])) for k, (a, b) in enumerate(ends))


@compiled
def _chains(ends: Ints, node_discs: Ints) -> tuple[Ints, Ints, Ints, NDArray[np.bool_]]:
    """Follow pieces from node to node.

    Returns
    -------
    node : (b, 2) array
        Nodes at the ends of each branch.
    first : (b,) array
        Where its pieces start in the next two.
    steps, forward : (p,) arrays
        The pieces, and whether each is run through from its disc 0 to its disc 1.
    """
    p, discs = len(ends), ends.max() + 1
    # Linked lists of half pieces at each disc: half 2 k leaves from disc 0 of piece k, half 2 k + 1 from its disc 1.
    head, following = np.full(discs, -1), np.full(2 * p, -1)
    for half in range(2 * p - 1, -1, -1):
        d = ends[half // 2, half % 2]
        following[half], head[d] = head[d], half
    number_of = np.full(discs, -1)
    for number in range(len(node_discs)):
        number_of[node_discs[number]] = number
    node, first = np.empty((p, 2), np.int64), np.empty(p, np.int64)
    steps, forward, used = np.empty(p, np.int64), np.zeros(p, np.bool_), np.zeros(p, np.bool_)
    branches, count = 0, 0
    for number in range(len(node_discs)):
        start = head[node_discs[number]]
        while start >= 0:
            half = start
            start = following[start]
            if used[half // 2]:
                continue
            node[branches, 0], first[branches] = number, count
            while True:
                piece, side = half // 2, half % 2
                used[piece], steps[count], forward[count] = True, piece, side == 0
                count += 1
                d = ends[piece, 1 - side]
                if number_of[d] >= 0:
                    break
                half = head[d]
                while used[half // 2]:
                    half = following[half]
            node[branches, 1] = number_of[d]
            branches += 1
    return node[:branches], first[:branches], steps, forward


def _discs(profile: Profile, tour: Tour, frame: Frame, faces: Faces, contacts: Contacts, degree: Ints) -> Discs:
    """Scale discs back to mm and have the kernel measure each."""
    n = int(faces.used[DISCS])
    settled = faces.settled[:n]
    centre = np.column_stack([settled["x"], settled["y"]]) * frame.size + frame.middle
    feet, foot_edge, foot_u = _feet(tour, contacts.first, contacts.last, contacts.disc, n)
    return Discs(
        centre,
        settled["r"] * frame.size,
        degree,
        feet * frame.size + frame.middle,
        foot_edge,
        foot_u,
        settled["tol"] * frame.size,
        _clearance(profile, tour, frame, settled, centre),
    )


def _clearance(profile: Profile, tour: Tour, frame: Frame, settled: Records, centre: Floats) -> Floats:
    """Return the kernel's distance from each centre to the boundary, mm."""
    row, element = spans_near(tour, settled, _NEAR)
    spans = np.flatnonzero(tour.degree > 0)
    piece = np.zeros(len(tour.element), dtype=np.int64)
    piece[spans] = np.arange(len(spans))
    breaks: list[list[float]] = [[0.0] for _ in profile.edges]
    for edge, to in zip(tour.edge[spans].tolist(), tour.edge_to[spans].tolist(), strict=True):
        breaks[edge].append(to)
    found = clearances(list(zip(profile.edges, breaks, strict=True)), centre, row, piece[element])
    doubtful = np.flatnonzero(found > (settled["r"] + settled["tol"] + _NEAR) * frame.size)
    if len(doubtful):
        found[doubtful] = DistanceQuery(profile).distances(centre[doubtful])
    return found


@compiled
def _feet(tour: Tour, first: Floats, last: Floats, disc: Ints, discs: int) -> tuple[Floats, Ints, Floats]:
    """Two footpoints of each disc: of its first two contacts, or the two ends of its only one."""
    point, edge, u = np.empty((discs, 2, 2)), np.empty((discs, 2), np.int64), np.empty((discs, 2))
    seen = np.zeros(discs, np.int64)
    for c in range(len(disc)):
        d = disc[c]
        for k in range(seen[d], 2):
            e, t = (int(last[c, 0]), last[c, 1]) if k == 1 and seen[d] == 0 else (int(first[c, 0]), first[c, 1])
            e = e if e < len(tour.element) else 0
            point[d, k, 0], point[d, k, 1], _, _, _, _ = site(tour, e, t)
            edge[d, k], u[d, k] = tour.element[e].edge, _edge_parameter(tour, e, t)
        seen[d] += 1
    return point, edge, u
