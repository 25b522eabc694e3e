"""Taking away what sticks out little: `retracted`.

Let a fire start at all ends of the axis, at each when it has burnt from the outline to there (after its clearance), run
along the branches at speed one, and pass a junction when all branches but one have arrived. The *erosion thickness* of
a point is the time at which the fire comes by, less its clearance. It is 0 at an end and grows inwards. Where it is
less than a threshold the axis is noise, or the very tip of a corner; a disc there goes to the nearest point of the axis
where it is not. Unlike leaving out whole branches this is continuous: a small change of the outline moves it a little.

References
----------
L. Liu, E. W. Chambers, D. Letscher, T. Ju, Extended grassfire transform on medial axes of 2D shapes, Computer-Aided
Design 43 (2011), 1496-1505. Deviation: a point inside the fire's last branch is reached from both ends; where they meet
below the threshold, the middle between both is kept.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints
from mashape_cad.signatures.branch_places import BranchPlaces
from mashape_cad.signatures.compiled import compiled

__all__ = ["Retracted", "retracted"]


@dataclass(frozen=True, slots=True, eq=False)
class Retracted:
    """Where the discs of boundary places have gone.

    Attributes
    ----------
    branch, along : (n,) arrays
        Their places, as in `BranchPlaces`.
    kept : (b,) array
        The branches that are left, at least in part.
    """

    branch: Ints
    along: Floats
    kept: NDArray[np.bool_]


def retracted(places: BranchPlaces, radius: Floats, thickness: float) -> Retracted:
    """Move discs inwards to where the erosion thickness reaches a threshold.

    Parameters
    ----------
    places : BranchPlaces
    radius : (v,) array
        Of the nodes' discs.
    thickness : float
        The threshold, in the tour's scale.
    """
    low, high, towards = _burnt(places.first, places.point, places.length, places.node, radius, thickness)
    branch, along = places.branch.copy(), places.along.copy()
    _move(low, high, towards, places.length[places.first[1:] - 1], places.node, branch, along)
    return Retracted(branch, along, towards < 0)


@compiled
def _burnt(
    first: Ints, point: Floats, length: Floats, node: Ints, radius: Floats, thickness: float
) -> tuple[Floats, Floats, Ints]:
    """Burn from all ends.

    Returns
    -------
    low, high : (b,) arrays
        What is kept of each branch.
    towards : (b,) array
        The end (0 or 1) towards which the places of a branch that has gone altogether move; -1 if it is kept.
    """
    branches = len(node)
    full = length[first[1:] - 1]
    low, high, towards = np.zeros(branches), full.copy(), np.full(branches, -1)
    start, at = incidence(node, len(radius))
    degree = start[1:] - start[:-1]
    time = radius.copy()
    waiting = np.flatnonzero(degree == 1)
    ends = np.empty(len(radius), np.int64)
    count = len(waiting)
    ends[:count] = waiting
    while count > 0:
        # The one at which the fire starts first; any order gives the same, but for the last branch.
        best = 0
        for i in range(1, count):
            if time[ends[i]] < time[ends[best]]:
                best = i
        v = ends[best]
        count -= 1
        ends[best] = ends[count]
        b = -1
        for i in range(start[v], start[v + 1]):
            if towards[at[i]] < 0:
                b = at[i]
        if b < 0:
            continue
        side = 0 if node[b, 0] == v else 1
        w = node[b, 1 - side]
        reached = _reach(point[first[b] : first[b + 1], 2], length[first[b] : first[b + 1]], side, time[v], thickness)
        if reached >= full[b] and degree[w] > 1:
            towards[b] = 1 - side
            time[w] = max(time[w], time[v] + full[b])
            degree[w] -= 1
            if degree[w] == 1:
                ends[count] = w
                count += 1
        elif side == 0:
            low[b] = reached
        else:
            high[b] = full[b] - reached
    for b in range(branches):
        if low[b] > high[b]:
            low[b] = min(max((low[b] + high[b]) / 2, 0.0), full[b])
            high[b] = low[b]
    return low, high, towards


@compiled
def _reach(radius: Floats, length: Floats, side: int, time: float, thickness: float) -> float:
    """Return how far from an end the erosion thickness reaches the threshold; beyond the branch as if it went on."""
    n = len(radius)
    before, at = time - radius[0 if side == 0 else n - 1], 0.0
    if before >= thickness:
        return 0.0
    for k in range(1, n):
        i = k if side == 0 else n - 1 - k
        s = length[i] if side == 0 else length[n - 1] - length[i]
        here = max(before, time + s - radius[i])
        if here >= thickness:
            return at + (s - at) * (thickness - before) / (here - before)
        before, at = here, s
    return at + thickness - before


@compiled
def incidence(node: Ints, nodes: int) -> tuple[Ints, Ints]:
    """Return the branches at each node, one after the other, and where those of each node start: (v + 1,)."""
    start = np.zeros(nodes + 1, np.int64)
    for b in range(len(node)):
        for end in range(2):
            start[node[b, end] + 1] += 1
    start = np.cumsum(start)
    fill, at = start[:-1].copy(), np.empty(2 * len(node), np.int64)
    for b in range(len(node)):
        for end in range(2):
            at[fill[node[b, end]]] = b
            fill[node[b, end]] += 1
    return start, at


@compiled
def _move(low: Floats, high: Floats, towards: Ints, full: Floats, node: Ints, branch: Ints, along: Floats) -> None:
    """Move places to what is kept: down the branches that have gone, then to the end of what is left."""
    start, at = incidence(node, node.max() + 1)
    for k in range(len(branch)):
        b = branch[k]
        while towards[b] >= 0:
            v = node[b, towards[b]]
            # The branch over which the fire went on, or one that is kept.
            onward = -1
            for i in range(start[v], start[v + 1]):
                c = at[i]
                if towards[c] < 0 or node[c, 1 - towards[c]] == v:
                    onward = c
            b = onward
            along[k] = 0.0 if node[b, 0] == v else full[b]
        branch[k], along[k] = b, min(max(along[k], low[b]), high[b])
