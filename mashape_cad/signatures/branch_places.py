"""Where on its branch the disc of a boundary place lies: `branch_places`.

A branch is met from both of its sides. The discs of all places on both, put in order, with the settled discs between
them, are a polygon along the branch; places are given by the length of it.
"""

import math
from dataclasses import dataclass

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.branch import contact_before
from mashape_cad.medial.disc import twin_on_stretch
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.tour import Ints, Tour, site
from mashape_cad.signatures.boundary_steps import BoundarySteps
from mashape_cad.signatures.compiled import compiled

__all__ = ["BranchPlaces", "branch_places"]

# Sine of an object angle below which the feet do not tell the place along the branch; a piece that is as thin at both
# ends is taken for straight, as in `mashape_cad.medial.branch.is_thin`.
_THIN = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class BranchPlaces:
    """All branches as polygons through known discs, and places on them, in the tour's scale.

    Attributes
    ----------
    branch : (n,) array
        Of each boundary place.
    along : (n,) array
        Length from the branch's start to the disc of the place.
    first : (b + 1,) array
        Where each branch starts in the next two.
    point : (m, 3) array
        Centres and radii of the polygons' vertices.
    length : (m,) array
        Length up to each vertex.
    node : (b, 2) array
        Nodes at the start and the end of each branch.
    """

    branch: Ints
    along: Floats
    first: Ints
    point: Floats
    length: Floats
    node: Ints


def branch_places(axis: MedialAxis, steps: BoundarySteps) -> BranchPlaces:
    """Find the discs of boundary places; the axis has at least one branch."""
    contact, on_arc = contact_before(axis, steps.element, steps.t)
    piece, side = axis.contacts.piece[contact], axis.contacts.side[contact]
    low, high = axis.pieces.low, axis.pieces.high
    # The disc that touches along an arc is the one from which the piece behind it starts.
    t = np.where(on_arc, low[piece, side], np.clip(steps.t, low[piece, side], high[piece, side]))
    settled = np.column_stack([axis.discs.centre - axis.frame.middle, axis.discs.radius]) / axis.frame.size
    ends = axis.pieces.disc
    rows = _discs(axis.tour, axis.pieces.element, low, high, settled[ends], piece, side, t)
    owner, number, forward = _order(axis)
    branch = owner[piece]
    place = number[piece] + np.where(forward[piece], rows[:, 3], 1.0 - rows[:, 3])

    counts = np.array([len(each.pieces) for each in axis.branches])
    at = np.concatenate([np.arange(count + 1) for count in counts])
    between = np.concatenate([_settled_along(axis, number) for number in range(len(counts))])
    branches = np.concatenate([branch, np.repeat(np.arange(len(counts)), counts + 1)])
    order = np.lexsort((np.concatenate([place, at]), branches))
    point = np.vstack([rows[:, :3], settled[between]])[order]
    step = np.append(0.0, np.hypot(*np.diff(point[:, :2], axis=0).T))
    first = np.flatnonzero(np.diff(branches[order], prepend=-1))
    step[first] = 0.0
    total = np.cumsum(step)
    length = total - total[first][branches[order]]
    along = np.empty(len(order))
    along[order] = length
    node = np.array([(each.start, each.end) for each in axis.branches], dtype=np.int64)
    return BranchPlaces(branch, along[: len(t)].copy(), np.append(first, len(order)), point, length, node)


def _order(axis: MedialAxis) -> tuple[Ints, Ints, Ints]:
    """Return the branch of each piece, its number there, and whether it is run through from its disc 0."""
    out = np.zeros((3, len(axis.pieces.disc)), dtype=np.int64)
    for number, branch in enumerate(axis.branches):
        for k, (piece, forward) in enumerate(branch.pieces):
            out[:, piece] = number, k, forward
    return out[0], out[1], out[2]


def _settled_along(axis: MedialAxis, number: int) -> list[int]:
    """Return the settled discs of a branch, from its start to its end."""
    pieces, disc = axis.branches[number].pieces, axis.pieces.disc
    last, forward = pieces[-1]
    return [int(disc[piece, 0 if is_forward else 1]) for piece, is_forward in pieces] + [int(disc[last, int(forward)])]


@compiled
def _discs(
    tour: Tour, element: Ints, low: Floats, high: Floats, settled: Floats, piece: Ints, side: Ints, t: Floats
) -> Floats:
    """Return centre, radius, and the share of its piece (from disc 0, by side 0) at each place: (n, 4)."""
    out = np.empty((len(t), 4))
    for k in range(len(t)):
        p, a = piece[k], side[k]
        b = 1 - a
        if _is_thin(tour, element[p], low[p], high[p]):
            share = (t[k] - low[p, a]) / (high[p, a] - low[p, a]) if high[p, a] > low[p, a] else 0.5
            out[k, 3] = share if a == 0 else 1.0 - share
            for j in range(3):
                out[k, j] = (1.0 - out[k, 3]) * settled[p, 0, j] + out[k, 3] * settled[p, 1, j]
            continue
        x, y, r, s = twin_on_stretch(tour, element[p, a], t[k], element[p, b], low[p, b], high[p, b])
        out[k, 0], out[k, 1], out[k, 2] = x, y, r
        u = t[k] if a == 0 else s
        share = (u - low[p, 0]) / (high[p, 0] - low[p, 0]) if high[p, 0] > low[p, 0] else 0.5
        out[k, 3] = min(max(share, 0.0), 1.0)
    return out


@compiled
def _is_thin(tour: Tour, element: Ints, low: Floats, high: Floats) -> bool:
    for end in range(2):
        _, _, nx, ny, _, _ = site(tour, element[0], low[0] if end == 0 else high[0])
        _, _, mx, my, _, _ = site(tour, element[1], high[1] if end == 0 else low[1])
        if math.hypot(nx - mx, ny - my) / 2 > _THIN:
            return False
    return True
