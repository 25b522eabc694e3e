"""Whether the pieces of an axis pair the whole boundary, stretch by stretch, and the branches are made of them.

Between two consecutive contacts of a loop lies a *gap*. A piece of a branch is a face with two gaps: walking along one
of them to its last contact, and turning clockwise about that contact's disc, one comes to the other gap, and from its
end back to the first. Where that holds of every gap, and about every disc the turns add up to one full turn, the faces
fill the domain without overlap, whatever the tracing did: this is the half-edge structure of the decomposition, checked
from the contacts and their normals.

References
----------
H. I. Choi, S. W. Choi, H. P. Moon, Mathematical theory of medial axis transform, Pacific J. Math. 181 (1997), domain
decomposition lemma.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.graph import Contacts, MedialAxis
from mashape_cad.medial.objection import Objection
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["next_contacts", "pairing_objections", "reference_objections"]

# Parameters of one and the same place, written down twice, agree this well.
_SAME = 1e-12
# Contacts of a cluster, or on both sides of a kink, may stand in an order that their normals tell wrong by so much
# (radians); a wider margin would take a contact on the wrong side of its neighbour.
_ANGLE = 1e-5
_KINDS = {0: "disc", 1: "end", 2: "seam"}


def reference_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Yield arrays whose numbers refer to nothing: with those no other check can be made."""
    contacts, pieces, discs = axis.contacts, axis.pieces, axis.discs
    elements, settled = len(axis.tour.degree), len(discs.radius)
    last = elements + 1 if axis.nodes.kind == ("disc",) else elements  # an arc all round ends behind the last element
    named = (
        ("discs of nodes", axis.nodes.disc, settled),
        ("discs of contacts", contacts.disc, settled),
        ("discs of pieces", pieces.disc, settled),
        ("elements of pieces", pieces.element, elements),
        ("elements of contacts", np.concatenate([contacts.first[:, 0], contacts.last[:, 0]]), last),
        ("edges of footpoints", discs.foot_edge, len(axis.profile.edges)),
        ("ends of branches", np.array([(b.start, b.end) for b in axis.branches]), len(axis.nodes.degree)),
        ("pieces of branches", np.array([p for b in axis.branches for p, _ in b.pieces]), len(pieces.disc)),
    )
    for name, numbers, count in named:
        if np.any((numbers < 0) | (numbers >= count)):
            yield Objection("pairing", f"{name} refer to what is not there")


def pairing_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Yield what is wrong with contacts, pieces, branches and nodes as one structure."""
    yield from _node_objections(axis)
    if axis.nodes.kind == ("disc",):
        yield from _round_objections(axis)
        return
    after = next_contacts(axis.tour, axis.contacts)
    broken = list(_gap_objections(axis, after))
    yield from broken
    if not broken:
        yield from _turn_objections(axis, after)
    yield from _branch_objections(axis)


def next_contacts(tour: Tour, contacts: Contacts) -> Ints:
    """Return the contact that follows each one on its loop, (c,)."""
    loop = tour.loop[contacts.first[:, 0].astype(np.int64)]
    after = np.arange(1, len(loop) + 1)
    last = np.flatnonzero(np.append(loop[1:] != loop[:-1], [True]))
    after[last] = np.append(0, last[:-1] + 1)
    return after


def _node_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Nodes are discs with one contact, or more than two; one more where a branch closes on itself."""
    nodes, discs = axis.nodes, axis.discs
    touched = np.bincount(axis.contacts.disc, minlength=len(discs.radius))
    expected = 0 if nodes.kind == ("disc",) else touched
    for disc in np.flatnonzero(discs.degree != expected):
        text = f"disc {disc} touches {touched[disc]} times, and its degree is {discs.degree[disc]}"
        yield Objection.at("pairing", text, discs.centre[disc])
    for node, disc in enumerate(nodes.disc):
        same = np.array_equal(nodes.centre[node], discs.centre[disc]) and nodes.radius[node] == discs.radius[disc]
        kind = _KINDS.get(int(nodes.degree[node]), "junction")
        if not same or nodes.degree[node] != discs.degree[disc] or nodes.kind[node] != kind:
            text = f"node {node}, a {nodes.kind[node]}, is not what its disc {disc} is"
            yield Objection.at("pairing", text, nodes.centre[node])
    lacking = np.setdiff1d(np.flatnonzero(discs.degree != 2), nodes.disc)
    for disc in lacking:
        text = f"disc {disc}, which touches {touched[disc]} times, is no node"
        yield Objection.at("pairing", text, discs.centre[disc])


def _round_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Yield how one disc that should be the whole domain is not touched all round."""
    contacts, count = axis.contacts, len(axis.tour.degree)
    whole = len(contacts.disc) == 1 and np.array_equal(
        np.concatenate([contacts.first[0], contacts.last[0]]), [0.0, 0.0, count, 0.0]
    )
    if not whole or axis.profile.holes or axis.branches:
        text = "the one disc of the axis does not touch the whole boundary"
        yield Objection.at("pairing", text, axis.nodes.centre[0])


def _gap_objections(axis: MedialAxis, after: Ints) -> Iterator[Objection]:
    """Every gap is the boundary of one side of one piece, between the discs of that piece."""
    contacts, pieces = axis.contacts, axis.pieces
    piece, side = contacts.piece, contacts.side
    known = (piece >= 0) & (piece < len(pieces.disc)) & (side >= 0) & (side <= 1)
    yield from _of_gaps(axis, ~known, "bounds no piece")
    if not known.all():
        return
    element, low, high = pieces.element[piece, side], pieces.low[piece, side], pieces.high[piece, side]
    start, end = contacts.last, _ends_of_gaps(axis.tour, contacts, after)
    fits = (element == start[:, 0]) & (element == end[:, 0]) & (low < high)
    fits &= (np.abs(low - start[:, 1]) <= _SAME) & (np.abs(high - end[:, 1]) <= _SAME)
    yield from _of_gaps(axis, ~fits, "is not the stretch of its piece")
    fits = (pieces.disc[piece, side] == contacts.disc) & (pieces.disc[piece, 1 - side] == contacts.disc[after])
    yield from _of_gaps(axis, ~fits, "runs between other discs than its piece")
    times = np.bincount(2 * piece + side, minlength=2 * len(pieces.disc))
    for number in np.flatnonzero(times != 1) // 2:
        text = f"a side of piece {number} is not bounded once"
        yield Objection.at("pairing", text, axis.discs.centre[pieces.disc[number, 0]])
    yield from _tiling_objections(axis, low, high)


def _of_gaps(axis: MedialAxis, wrong: NDArray[np.bool_], text: str) -> Iterator[Objection]:
    for contact in np.flatnonzero(wrong):
        e, t = axis.contacts.last[contact]
        yield Objection.in_frame(
            "pairing", f"the gap behind contact {contact} {text}", axis, site(axis.tour, int(e), float(t))[:2]
        )


def _ends_of_gaps(tour: Tour, contacts: Contacts, after: Ints) -> Floats:
    """Place at which each gap ends, on the element where it starts if it reaches that element's end: (c, 2)."""
    end = contacts.first[after].copy()
    at_border = (end[:, 1] == 0.0) & (tour.after[contacts.last[:, 0].astype(np.int64)] == end[:, 0])
    end[at_border] = np.column_stack([contacts.last[at_border, 0], np.ones(at_border.sum())])
    return end


def _tiling_objections(axis: MedialAxis, low: Floats, high: Floats) -> Iterator[Objection]:
    """Gaps and arcs together go round every loop once."""
    contacts, tour = axis.contacts, axis.tour
    loop = tour.loop[contacts.first[:, 0].astype(np.int64)]
    count = np.bincount(tour.loop)
    arcs = contacts.last.sum(axis=1) - contacts.first.sum(axis=1)
    arcs = np.where(arcs < 0, arcs + count[loop], arcs)
    round_ = np.bincount(loop, high - low + arcs, minlength=len(count))
    for number in np.flatnonzero(np.abs(round_ - count) > 1e-9 * count):
        e = int(np.flatnonzero(tour.loop == number)[0])
        text = f"contacts and gaps do not go round loop {number} once"
        yield Objection.in_frame("pairing", text, axis, site(tour, e, 0.0)[:2])


def _turn_objections(axis: MedialAxis, after: Ints) -> Iterator[Objection]:
    """Behind each gap one turns clockwise to the other gap of its piece; round each disc that is one full turn."""
    contacts = axis.contacts
    number = 2 * contacts.piece + contacts.side
    of_side = np.empty(len(number), dtype=np.int64)
    of_side[number] = np.arange(len(number))
    partner = of_side[number ^ 1]
    angle = _spoke_angles(axis.tour, contacts.first)
    turn = (angle[after] - angle[partner]) % (2 * np.pi)
    # Next to a whole turn it may be one, about a disc in a thin wedge, or none, less rounding, between contacts that
    # all but coincide.
    none = np.where(turn > 2 * np.pi - _ANGLE, 0.0, turn)
    count = len(axis.discs.radius)
    expected = np.where(np.bincount(contacts.disc, minlength=count) > 1, 2 * np.pi, 0.0)
    off = [np.abs(np.bincount(contacts.disc[after], each, minlength=count) - expected) for each in (turn, none)]
    for disc in np.flatnonzero(np.minimum(*off) > 1):
        text = f"the stretches about disc {disc} do not follow one another clockwise"
        yield Objection.at("pairing", text, axis.discs.centre[disc])


@compiled
def _spoke_angles(tour: Tour, places: Floats) -> Floats:
    """Directions from a disc's centre to its contacts, radians: against the inward normals."""
    angles = np.empty(len(places))
    for k in range(len(places)):
        _, _, nx, ny, _, _ = site(tour, int(places[k, 0]), places[k, 1])
        angles[k] = np.arctan2(-ny, -nx)
    return angles


def _branch_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Branches are chains of pieces from node to node, and every piece lies on one."""
    nodes, discs = axis.nodes, axis.pieces.disc
    inner = np.ones(len(axis.discs.radius), dtype=bool)
    inner[nodes.disc] = False
    for number, branch in enumerate(axis.branches):
        way = [(int(discs[piece, int(not on)]), int(discs[piece, int(on)])) for piece, on in branch.pieces]
        chained = all(a[1] == b[0] and inner[b[0]] for a, b in pairwise(way))
        tips = bool(way) and (way[0][0], way[-1][1]) == (nodes.disc[branch.start], nodes.disc[branch.end])
        if not (chained and tips):
            text = f"branch {number} is no chain of pieces from node {branch.start} to node {branch.end}"
            yield Objection.at("pairing", text, nodes.centre[branch.start])
    times = np.bincount(
        np.array([piece for branch in axis.branches for piece, _ in branch.pieces], dtype=np.int64),
        minlength=len(discs),
    )
    for piece in np.flatnonzero(times != 1):
        text = f"piece {piece} lies on {times[piece]} branches"
        yield Objection.at("pairing", text, axis.discs.centre[discs[piece, 0]])
    meeting = np.bincount(
        np.array([node for branch in axis.branches for node in (branch.start, branch.end)], dtype=np.int64),
        minlength=len(nodes.degree),
    )
    for node in np.flatnonzero(meeting != nodes.degree):
        text = f"at node {node} of degree {nodes.degree[node]} meet {meeting[node]} branches"
        yield Objection.at("pairing", text, nodes.centre[node])
