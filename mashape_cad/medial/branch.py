"""Branches as curves: the maximal disc at any place of the boundary, and points along a branch."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.disc import twin_on_stretch
from mashape_cad.medial.graph import Branch, MedialAxis
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["BranchSamples", "contact_before", "discs_on_piece", "is_thin", "sampled_branches"]

# Halvings of a piece's parameter before a chord longer than the step is left as it is: near an end the centre moves
# with the square of the parameter, never worse.
_ROUNDS = 14
_FIRST = 5
# Sine of an object angle below which a disc's feet are too close together to tell its place along the branch: that is
# known to rounding over the square of this. A piece that is as thin at both ends is as good as straight.
_THIN = 1e-3
# Places this close before a contact (in the tour's parameter) are on it, whatever rounding says.
_ON_CONTACT = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class BranchSamples:
    """Points along a branch, both nodes included.

    Attributes
    ----------
    centre : (n, 2) array
        mm.
    radius : (n,) array
        Clearance, mm.
    """

    centre: Floats
    radius: Floats


def sampled_branches(
    axis: MedialAxis, step: float, branches: Sequence[Branch] | None = None
) -> tuple[BranchSamples, ...]:
    """Sample every branch.

    Parameters
    ----------
    axis : MedialAxis
    step : float
        Largest distance between neighbouring points, mm. Straight pieces are not spared: radii change along them.
    branches : sequence of Branch, optional
        Others than ``axis.branches``: chains of its pieces from node to node.

    Returns
    -------
    tuple of BranchSamples
        In the order of the branches.
    """
    return tuple(
        _sampled(axis, branch, step / axis.frame.size) for branch in (axis.branches if branches is None else branches)
    )


def _sampled(axis: MedialAxis, branch: Branch, step: float) -> BranchSamples:
    start, end = axis.nodes.disc[branch.start], axis.nodes.disc[branch.end]
    rows = [np.append(axis.discs.centre[start], axis.discs.radius[start])[None]]
    for number, (piece, forward) in enumerate(branch.pieces):
        inner = _inner(axis, piece, step)
        rows.append(inner if forward else inner[::-1])
        last = int(axis.pieces.disc[piece, int(forward)]) if number + 1 < len(branch.pieces) else int(end)
        rows.append(np.append(axis.discs.centre[last], axis.discs.radius[last])[None])
    points = np.concatenate(rows)
    return BranchSamples(points[:, :2], points[:, 2])


def _inner(axis: MedialAxis, piece: int, step: float) -> Floats:
    """Points strictly inside a piece, from its disc 0 to its disc 1: (n, 3), mm."""
    low, high = axis.pieces.low[piece, 0], axis.pieces.high[piece, 0]
    ends = np.column_stack(
        [
            (axis.discs.centre[axis.pieces.disc[piece]] - axis.frame.middle) / axis.frame.size,
            axis.discs.radius[axis.pieces.disc[piece]] / axis.frame.size,
        ]
    )
    if is_thin(axis, piece):
        count = max(2, int(np.ceil(np.hypot(*(ends[1] - ends[0])[:2]) / step)) + 1)
        return _scaled(axis, np.linspace(ends[0], ends[1], count)[1:-1])
    t = np.linspace(low, high, _FIRST)
    points = np.vstack([ends[:1], discs_on_piece(axis, piece, t[1:-1])[:, :3], ends[1:]])
    for _ in range(_ROUNDS):
        wide = np.flatnonzero(np.hypot(*np.diff(points[:, :2], axis=0).T) > step)
        if not len(wide):
            break
        middles = (t[wide] + t[wide + 1]) / 2
        t = np.insert(t, wide + 1, middles)
        points = np.insert(points, wide + 1, discs_on_piece(axis, piece, middles)[:, :3], axis=0)
    return _scaled(axis, points[1:-1])


def _scaled(axis: MedialAxis, points: Floats) -> Floats:
    scaled = points * axis.frame.size
    scaled[:, :2] += axis.frame.middle
    return scaled


def is_thin(axis: MedialAxis, piece: int) -> bool:
    """Whether the feet of a piece nearly coincide from end to end, as at a kink that is hardly one."""
    (e, f), low, high = axis.pieces.element[piece], axis.pieces.low[piece], axis.pieces.high[piece]
    for t, s in ((low[0], high[1]), (high[0], low[1])):
        n, m = np.array(site(axis.tour, int(e), t)[2:4]), np.array(site(axis.tour, int(f), s)[2:4])
        if np.hypot(*(n - m)) / 2 > _THIN:
            return False
    return True


def discs_on_piece(axis: MedialAxis, piece: int, t: Floats, side: int = 0) -> Floats:
    """Maximal discs at parameters of one side of a piece.

    Returns
    -------
    (n, 4) array
        Centre x and y, radius, in the tour's scale, and the parameter of the twin on the other side.
    """
    sides, other = axis.pieces, 1 - side
    return _discs_on_stretches(
        axis.tour,
        int(sides.element[piece, side]),
        np.ascontiguousarray(t, dtype=float),
        int(sides.element[piece, other]),
        float(sides.low[piece, other]),
        float(sides.high[piece, other]),
    )


@compiled
def _discs_on_stretches(tour: Tour, e: int, t: Floats, f: int, low: float, high: float) -> Floats:
    out = np.empty((len(t), 4))
    for k in range(len(t)):
        out[k] = twin_on_stretch(tour, e, t[k], f, low, high)
    return out


def contact_before(axis: MedialAxis, element: Ints, t: Floats) -> tuple[Ints, NDArray[np.bool_]]:
    """Find the contact before each place: the boundary of a piece starts behind it.

    A place on a contact belongs to the piece that follows (reading 9).

    Returns
    -------
    contact : (n,) array
        Number of the last contact that starts at or before the place, on the same loop.
    on_arc : (n,) array
        Whether the place lies on that contact's arc, and so on no piece.
    """
    contacts, tour = axis.contacts, axis.tour
    first, last = contacts.first.sum(axis=1), contacts.last.sum(axis=1)
    loop_of_contact = tour.loop[contacts.first[:, 0].astype(np.int64)]
    here, loop = element + t, tour.loop[element]
    contact = np.searchsorted(first, here + _ON_CONTACT, side="right") - 1
    # Before the first contact of a loop stands, going round, its last one.
    last_of_loop = np.searchsorted(loop_of_contact, loop, side="right") - 1
    contact = np.where((contact < 0) | (loop_of_contact[contact] != loop), last_of_loop, contact)
    begin, end = first[contact], last[contact]
    inside = np.where(begin <= end, (here > begin) & (here < end - _ON_CONTACT), (here > begin) | (here < end))
    return contact, inside & (begin != end)
