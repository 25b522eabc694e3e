"""Medial axes with a fault, as a tracer might have made them: each with the places where its fault is.

A forgotten contact leaves its two gaps as one; the faces are then walked anew, and each with two gaps becomes a piece
again. So an axis that lacks an end along with its junction pairs the boundary without a gap, its discs are all maximal,
and junctions and ends agree in number.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.graph import Branch, Contacts, Discs, MedialAxis, Nodes, Pieces
from mashape_cad.medial.tour import Tour, site, tour

# What an axis is moved by, of its size.
MOVED = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Mutation:
    """An axis with a fault.

    Attributes
    ----------
    name : str
    axis : MedialAxis
    places : (n, 2) array
        Where the fault is, mm: centres and contacts of the discs concerned and of those next to them.
    """

    name: str
    axis: MedialAxis
    places: Floats


def mutations(axis: MedialAxis) -> Iterator[Mutation]:
    """Yield all mutations of an axis that has branches."""
    for node in range(len(axis.nodes.degree)):
        yield from moved(axis, node)
        yield from slid(axis, node)
        yield without_node(axis, node)
        if axis.nodes.kind[node] != "seam":  # without one, a branch that closes on itself is as right
            yield without_disc(axis, node)
    for number in range(len(axis.branches)):
        yield with_other_end(axis, number)
        yield without_branch(axis, number)
        yield from without_end(axis, number)
    for piece in range(len(axis.pieces.disc)):
        yield without_piece(axis, piece)
    for hole in range(len(axis.profile.holes)):
        yield without_hole(axis, hole)


def moved(axis: MedialAxis, node: int) -> Iterator[Mutation]:
    """A node's centre, in four directions, or its radius, is off by a millionth of the size."""
    disc, step = int(axis.nodes.disc[node]), MOVED * axis.frame.size
    for turn in range(4):
        centre = axis.discs.centre.copy()
        centre[disc] += step * np.array([np.cos(0.3 + turn * np.pi / 2), np.sin(0.3 + turn * np.pi / 2)])
        yield _with_discs(axis, f"centre of node {node} moved", [disc], centre=centre)
    for change in (-step, step):
        radius = axis.discs.radius.copy()
        if radius[disc] + change >= 0:
            radius[disc] += change
            yield _with_discs(axis, f"radius of node {node} changed", [disc], radius=radius)


def slid(axis: MedialAxis, node: int) -> Iterator[Mutation]:
    """An osculating end sits beside the maximum of curvature, its centre a millionth of the size away.

    Contacts, pieces and disc agree. The boundary enters the disc by the fourth power of a thousandth: too little for
    any distance. Only for ends inside a span.
    """
    disc = int(axis.nodes.disc[node])
    (contact,) = np.flatnonzero(axis.contacts.disc == disc) if axis.nodes.kind[node] == "end" else (-1,)
    if contact < 0 or axis.nodes.radius[node] == 0 or not np.array_equal(*_ends_of(axis, contact)):
        return
    e, t = int(axis.contacts.first[contact, 0]), float(axis.contacts.first[contact, 1])
    if not 0.0 < t < 1.0:
        return
    low, high = 0.0, min(t, 1 - t) / 2
    here = _osculating(axis, e, t)
    for _ in range(60):
        middle = (low + high) / 2
        far = np.hypot(*(_osculating(axis, e, t + middle) - here)[:2]) > MOVED
        low, high = (low, middle) if far else (middle, high)
    x, y, r = _osculating(axis, e, t + high)
    yield _slid_to(axis, node, int(contact), t + high, np.array([x, y, r]) * axis.frame.size)


def _slid_to(axis: MedialAxis, node: int, contact: int, t: float, circle: Floats) -> Mutation:
    disc, e, old = int(axis.nodes.disc[node]), int(axis.contacts.first[contact, 0]), axis.contacts.first[contact, 1]
    place = np.array([[e, t]])
    first, low, high = axis.contacts.first.copy(), axis.pieces.low.copy(), axis.pieces.high.copy()
    first[contact] = place
    for array in (low, high):
        array[(axis.pieces.element == e) & (array == old)] = t
    arrays = {name: getattr(axis.discs, name).copy() for name in ("centre", "radius", "foot", "foot_u")}
    arrays["centre"][disc], arrays["radius"][disc] = circle[:2] + axis.frame.middle, circle[2]
    arrays["foot"][disc] = _points(axis, axis.tour, place)
    arrays["foot_u"][disc] = foot(axis.tour, (e, t))[1]
    last = axis.contacts.last.copy()
    last[contact] = place
    moved_along = replace(
        axis,
        contacts=replace(axis.contacts, first=first, last=last),
        pieces=replace(axis.pieces, low=low, high=high),
    )
    clearance = DistanceQuery(axis.profile).distances(arrays["centre"])
    beside = _with_discs(moved_along, f"end {node} slid", [disc], **arrays, clearance=clearance)
    return replace(beside, places=np.concatenate([beside.places, _around(axis, [disc])]))


def _ends_of(axis: MedialAxis, contact: int) -> tuple[Floats, Floats]:
    return axis.contacts.first[contact], axis.contacts.last[contact]


def _osculating(axis: MedialAxis, e: int, t: float) -> Floats:
    """The circle of curvature, in the tour's scale."""
    x, y, nx, ny, curvature, _ = site(axis.tour, e, t)
    return np.array([x + nx / curvature, y + ny / curvature, 1 / curvature])


def without_node(axis: MedialAxis, node: int) -> Mutation:
    """A node and its branches are forgotten by the graph; degrees of the others shrink, so that they agree again."""
    branches = [b for b in axis.branches if node not in {b.start, b.end}]
    kept = np.delete(np.arange(len(axis.nodes.degree)), node)
    new = {int(old): number for number, old in enumerate(kept)}
    ends = np.array([n for b in branches for n in (b.start, b.end)], dtype=np.int64)
    meeting = np.bincount(ends, minlength=len(axis.nodes.degree))
    nodes = _nodes(axis.discs, axis.nodes.disc[kept], meeting[kept])
    renumbered = tuple(Branch(new[b.start], new[b.end], b.pieces) for b in branches)
    gone = [axis.nodes.disc[n] for b in axis.branches if node in {b.start, b.end} for n in (b.start, b.end)]
    gone += [d for b in axis.branches if node in {b.start, b.end} for p, _ in b.pieces for d in axis.pieces.disc[p]]
    return Mutation(
        f"node {node} and its branches gone",
        replace(axis, nodes=nodes, branches=renumbered),
        _around(axis, [int(axis.nodes.disc[node]), *map(int, gone)]),
    )


def without_disc(axis: MedialAxis, node: int) -> Mutation:
    """A node's disc is forgotten with all of its contacts, and what is left is paired along."""
    disc = int(axis.nodes.disc[node])
    gone = np.flatnonzero(axis.contacts.disc == disc).tolist()
    return Mutation(f"disc of node {node} gone", without_contacts(axis, gone), _around(axis, [disc]))


def without_end(axis: MedialAxis, number: int) -> Iterator[Mutation]:
    """An end is forgotten with its branch and one contact of its junction, of either side: in the sum that cancels.

    None for a branch without end or junction.
    """
    branch = axis.branches[number]
    tip, junction = branch.start, branch.end
    if axis.nodes.degree[tip] != 1:
        tip, junction = junction, tip
    if axis.nodes.degree[tip] != 1 or axis.nodes.degree[junction] < 3:
        return
    inner = {int(d) for p, _ in branch.pieces for d in axis.pieces.disc[p]} - {int(axis.nodes.disc[junction])}
    last = branch.pieces[-1][0] if junction == branch.end else branch.pieces[0][0]
    for side in (0, 1):
        # The junction's two contacts that bound the branch: where the piece next to it starts, or ends.
        contact = _contact_of(axis, last, side, int(axis.nodes.disc[junction]))
        gone = [c for c, d in enumerate(axis.contacts.disc.tolist()) if d in inner] + [contact]
        name = f"end {tip} gone with contact {contact} of junction {junction}"
        yield Mutation(name, without_contacts(axis, gone), _around(axis, [int(axis.nodes.disc[tip]), *inner]))


def with_other_end(axis: MedialAxis, number: int) -> Mutation:
    """A branch ends in another node, of the same degree if there is one."""
    branch, degree = axis.branches[number], axis.nodes.degree
    others = [n for n in range(len(degree)) if n not in {branch.start, branch.end}] or [branch.start]
    other = max(others, key=lambda n: degree[n] == degree[branch.end])
    if other == branch.end:
        branches = (*axis.branches[:number], replace(branch, pieces=branch.pieces[:-1]), *axis.branches[number + 1 :])
    else:
        branches = (*axis.branches[:number], replace(branch, end=other), *axis.branches[number + 1 :])
    discs = axis.nodes.disc[[branch.start, branch.end, other]].tolist()
    discs += [int(d) for p, _ in branch.pieces for d in axis.pieces.disc[p]]
    return Mutation(f"end of branch {number} swapped", replace(axis, branches=branches), _around(axis, discs))


def without_branch(axis: MedialAxis, number: int) -> Mutation:
    """A branch is forgotten by the graph."""
    branch = axis.branches[number]
    discs = [int(d) for p, _ in branch.pieces for d in axis.pieces.disc[p]]
    left = replace(axis, branches=axis.branches[:number] + axis.branches[number + 1 :])
    return Mutation(f"branch {number} gone", left, _around(axis, discs))


def without_piece(axis: MedialAxis, piece: int) -> Mutation:
    """A piece is forgotten, by its branch as by the contacts that bound it."""
    pieces, contacts = axis.pieces, axis.contacts
    kept = np.delete(np.arange(len(pieces.disc)), piece)
    new = np.full(len(pieces.disc), -1)
    new[kept] = np.arange(len(kept))
    branches = tuple(
        replace(b, pieces=tuple((int(new[p]), on) for p, on in b.pieces if p != piece)) for b in axis.branches
    )
    left = replace(
        axis,
        pieces=Pieces(pieces.element[kept], pieces.low[kept], pieces.high[kept], pieces.disc[kept]),
        contacts=replace(contacts, piece=new[contacts.piece]),
        branches=tuple(b for b in branches if b.pieces),
    )
    return Mutation(f"piece {piece} gone", left, _around(axis, [int(d) for d in pieces.disc[piece]]))


def without_hole(axis: MedialAxis, hole: int) -> Mutation:
    """A hole is overlooked: the axis is that of the profile without it, on the tour with it."""
    profile = axis.profile
    order = [*profile.holes[:hole], *profile.holes[hole + 1 :], profile.holes[hole]]
    whole, less = Profile(profile.outer, tuple(order)), Profile(profile.outer, tuple(order[:-1]))
    elements, frame = tour(whole)
    overlooked = replace(medial_axis(less), profile=whole, tour=elements, frame=frame)
    # Anything is at fault that lies in the hole, or in a disc that reaches into it.
    discs = overlooked.discs
    points = order[-1].flattened(64)
    apart = np.linalg.norm(discs.centre[:, None] - points[None], axis=2).min(axis=1)
    return Mutation(f"hole {hole} overlooked", overlooked, np.concatenate([points, discs.centre[apart < discs.radius]]))


def without_contacts(axis: MedialAxis, gone: list[int]) -> MedialAxis:
    """Forget contacts, and discs that have none left; walk the faces anew and make pieces and branches of them."""
    contacts, after, partner = axis.contacts, _after(axis), _partner(axis)
    kept = np.delete(np.arange(len(contacts.disc)), gone)
    alive = np.zeros(len(contacts.disc), dtype=bool)
    alive[kept] = True

    def following(contact: int) -> int:
        """The next gap of a face: along this one, then clockwise to the disc's next contact that is left."""
        end = _next_alive(after, alive, contact)
        turned = partner[int(np.flatnonzero(after == end)[0])]
        while not alive[turned]:
            turned = partner[int(np.flatnonzero(after == turned)[0])]
        return int(turned)

    pairs, seen = [], set()
    for start in kept.tolist():
        cycle, at = [], start
        while at not in seen:
            seen.add(at)
            cycle.append(at)
            at = following(at)
        # A face with more gaps than two holds a junction; whoever overlooks that pairs them as they come.
        pairs += [(cycle[k], cycle[k + 1]) for k in range(0, len(cycle) - 1, 2)]
        if len(cycle) % 2:
            pairs.append((cycle[-1], cycle[-1]))
    return _rebuilt(axis, kept, pairs, after, alive)


def _rebuilt(axis: MedialAxis, kept: Floats, pairs: list[tuple[int, int]], after: Floats, alive: Floats) -> MedialAxis:
    contacts = axis.contacts
    discs_left = np.unique(contacts.disc[kept])
    new_disc = np.full(len(axis.discs.radius), -1)
    new_disc[discs_left] = np.arange(len(discs_left))
    piece, side = np.full(len(alive), -1), np.zeros(len(alive), dtype=np.int64)
    rows = []
    for number, pair in enumerate(pairs):
        stretches = [_stretch(axis, contact, _next_alive(after, alive, contact)) for contact in pair]
        ends = [new_disc[contacts.disc[c]] for c in (pair[0], _next_alive(after, alive, pair[0]))]
        rows.append((*stretches, ends))
        for number_of_side, contact in enumerate(pair):
            piece[contact], side[contact] = number, number_of_side
    pieces = Pieces(
        np.array([(a[0], b[0]) for a, b, _ in rows], dtype=np.int64),
        np.array([(a[1], b[1]) for a, b, _ in rows]),
        np.array([(a[2], b[2]) for a, b, _ in rows]),
        np.array([ends for _, _, ends in rows], dtype=np.int64),
    )
    degree = np.bincount(new_disc[contacts.disc[kept]], minlength=len(discs_left))
    discs = Discs(
        *(getattr(axis.discs, name)[discs_left] for name in ("centre", "radius")),
        degree,
        *(getattr(axis.discs, name)[discs_left] for name in ("foot", "foot_edge", "foot_u", "tolerance", "clearance")),
    )
    where = np.flatnonzero(degree != 2)
    where = where if len(where) else np.array([0])
    left = Contacts(contacts.first[kept], contacts.last[kept], new_disc[contacts.disc[kept]], piece[kept], side[kept])
    branches = _chains(pieces, where)
    return replace(
        axis, nodes=_nodes(discs, where, degree[where]), branches=branches, discs=discs, contacts=left, pieces=pieces
    )


def _chains(pieces: Pieces, where: Floats) -> tuple[Branch, ...]:
    """Chain pieces between nodes as far as they go."""
    node_of = {int(disc): node for node, disc in enumerate(where)}
    used, branches = set(), []
    for disc, node in node_of.items():
        for first in np.flatnonzero((pieces.disc == disc).any(axis=1)).tolist():
            chain, at = [], disc
            step = first
            while step is not None and step not in used:
                used.add(step)
                onward = bool(pieces.disc[step, 0] == at)
                chain.append((step, onward))
                at = int(pieces.disc[step, int(onward)])
                here = np.flatnonzero((pieces.disc == at).any(axis=1)).tolist()
                step = None if at in node_of else next((p for p in here if p not in used), None)
            if chain:
                branches.append(Branch(node, node_of.get(at, node), tuple(chain)))
    return tuple(branches)


def _nodes(discs: Discs, where: Floats, degree: Floats) -> Nodes:
    kinds = tuple({0: "disc", 1: "end", 2: "seam"}.get(int(d), "junction") for d in degree)
    return Nodes(discs.centre[where], discs.radius[where], degree, kinds, where)


def _stretch(axis: MedialAxis, contact: int, end: int) -> tuple[int, float, float]:
    """The gap between two contacts, cut off where its first element ends."""
    (e, low), (f, high) = axis.contacts.last[contact], axis.contacts.first[end]
    return (int(e), float(low), float(high)) if e == f and low < high else (int(e), float(low), 1.0)


def _after(axis: MedialAxis) -> Floats:
    """The contact that follows each one on its loop."""
    loop = axis.tour.loop[axis.contacts.first[:, 0].astype(int)]
    after = np.empty(len(loop), dtype=np.int64)
    for number in np.unique(loop):
        here = np.flatnonzero(loop == number)
        after[here] = np.roll(here, -1)
    return after


def _partner(axis: MedialAxis) -> Floats:
    """The contact where the other side of the piece starts that starts at each one."""
    contacts = axis.contacts
    of_side = {(int(p), int(s)): c for c, (p, s) in enumerate(zip(contacts.piece, contacts.side, strict=True))}
    return np.array([of_side[int(p), 1 - int(s)] for p, s in zip(contacts.piece, contacts.side, strict=True)])


def _next_alive(after: Floats, alive: Floats, contact: int) -> int:
    at = int(after[contact])
    while not alive[at]:
        at = int(after[at])
    return at


def _contact_of(axis: MedialAxis, piece: int, side: int, disc: int) -> int:
    """The contact of a disc at the end of a side of a piece."""
    contacts, after = axis.contacts, _after(axis)
    start = int(np.flatnonzero((contacts.piece == piece) & (contacts.side == side))[0])
    return start if contacts.disc[start] == disc else int(after[start])


def _with_discs(axis: MedialAxis, name: str, discs: list[int], **arrays: Floats) -> Mutation:
    changed = replace(axis.discs, **arrays)
    nodes = replace(axis.nodes, centre=changed.centre[axis.nodes.disc], radius=changed.radius[axis.nodes.disc])
    return Mutation(name, replace(axis, discs=changed, nodes=nodes), _around(axis, discs))


def _around(axis: MedialAxis, discs: list[int]) -> Floats:
    """Centres and contacts of some discs, and of those at the other end of pieces that begin there."""
    beside = np.isin(axis.pieces.disc, discs).any(axis=1)
    concerned = np.union1d(discs, axis.pieces.disc[beside].ravel()).astype(np.int64)
    at = np.flatnonzero(np.isin(axis.contacts.disc, concerned))
    places = np.concatenate([axis.contacts.first[at], axis.contacts.last[at]])
    return np.concatenate([axis.discs.centre[concerned], _points(axis, axis.tour, places)])


def _points(axis: MedialAxis, elements: Tour, places: Floats) -> Floats:
    inside = places[places[:, 0] < len(elements.degree)]
    points = np.array([site(elements, int(e), float(t))[:2] for e, t in inside])
    return points * axis.frame.size + axis.frame.middle
