"""Which ends of loose edges are the same point: ends are joined into nodes, the nearest first.

Terminology
-----------
end
    End ``2 i`` is the start of edge i, end ``2 i + 1`` its end.
node
    Ends that are taken for one point. Its degree is the number of its ends: 1 is loose, 2 a joint of a chain, more a
    branch.
gap
    Distance of two ends that are joined.
component
    Edges that hang together through nodes.

Ends that agree to rounding are joined first, whatever comes of it. After that only *loose* ends are joined, at a
reach that rises step by step: two edges that meet with a gap find each other before the reach is as wide as a small
edge beside them, and a small edge never collapses, because a gap has to be short beside what it joins.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from mashape_cad.geometry.edge import Floats

__all__ = ["Nodes", "bridged_ends", "coincident_ends"]

Nodes = NDArray[np.int64]

# Factor from one reach to the next. Smaller tells two gaps apart that are nearly alike, at the cost of more rounds.
_RISE = 2.0
# Of the length of either component: a gap that is longer than this would change what it joins.
_LONGEST_GAP = 0.5
# Of a component's own length, if the gap closes it: a C shape is closed, a short line is not bent into a point.
_LONGEST_CLOSING_GAP = 0.25


def coincident_ends(ends: Floats, noise: float) -> Nodes:
    """Find the node of each end, where only ends at the same place are joined.

    Parameters
    ----------
    ends : (n, 2, 2) array
        Start and end of each edge, mm.
    noise : float
        Distance up to which ends are at the same place, mm.

    Returns
    -------
    (n, 2) array of int
        Numbers of the nodes.
    """
    points = ends.reshape(-1, 2)
    return _clusters(len(points), cKDTree(points).query_pairs(noise, output_type="ndarray")).reshape(-1, 2)


def bridged_ends(nodes: Nodes, ends: Floats, lengths: Floats, narrow: float, wide: float) -> Nodes:
    """Join nodes across gaps.

    Parameters
    ----------
    nodes : (n, 2) array of int
        Node of each end so far.
    ends : (n, 2, 2) array
        Start and end of each edge, mm.
    lengths : (n,) array
        Of the edges, mm; a percent does not matter.
    narrow, wide : float
        Gaps up to `narrow` are bridged already; up to `wide` they are now. mm.

    Returns
    -------
    (n, 2) array of int
        Numbers of the nodes.
    """
    points, label, reach = ends.reshape(-1, 2), nodes.ravel(), narrow
    while reach < wide and _loose(label).size > 1:
        reach = min(_RISE * reach, wide)
        label = _join_loose(label, points, lengths, reach)
    return label.reshape(-1, 2)


def _join_loose(label: Nodes, points: Floats, lengths: Floats, reach: float) -> Nodes:
    """Join loose ends that are within reach of each other."""
    component = _components(label)
    pairs = _short_gaps(_loose_pairs(label, points, reach), points, component, lengths)
    if len(pairs) == 0:
        return label
    pairs = _without_collapse(pairs, component)
    return _clusters(len(label), label[pairs])[label]


def _loose(label: Nodes) -> Nodes:
    """Return the ends that are alone at their node."""
    return np.flatnonzero(np.bincount(label)[label] == 1)


def _loose_pairs(label: Nodes, points: Floats, reach: float) -> Nodes:
    loose = _loose(label)
    return loose[cKDTree(points[loose]).query_pairs(reach, output_type="ndarray").reshape(-1, 2)]


def _short_gaps(pairs: Nodes, points: Floats, component: Nodes, lengths: Floats) -> Nodes:
    """Keep the pairs whose gap is short beside what it joins, the nearest first."""
    of_pair = component[pairs // 2]
    length = np.bincount(component, weights=lengths)[of_pair].min(axis=1)
    share = np.where(of_pair[:, 0] == of_pair[:, 1], _LONGEST_CLOSING_GAP, _LONGEST_GAP)
    gap = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    order = np.argsort(gap, kind="stable")
    return pairs[order][(gap <= share * length)[order]]


def _without_collapse(pairs: Nodes, component: Nodes) -> Nodes:
    """Keep all pairs around a branch, but only the nearest ones where both ends of a component would be joined."""
    cluster = _clusters(2 * len(component), pairs)
    kept: list[Nodes] = []
    for name in np.unique(cluster[pairs[:, 0]]):
        here = pairs[cluster[pairs[:, 0]] == name]
        members = np.unique(here)
        is_branch = len(np.unique(component[members // 2])) == len(members)
        kept.append(here if is_branch else _nearest_first(here))
    return np.concatenate(kept)


def _nearest_first(pairs: Nodes) -> Nodes:
    """Pick pairs in their order, each end once."""
    used: set[int] = set()
    kept = []
    for first, second in pairs.tolist():
        if first not in used and second not in used:
            used |= {first, second}
            kept.append((first, second))
    return np.array(kept, np.int64)


def _clusters(count: int, pairs: Nodes) -> Nodes:
    """Return numbers of what hangs together through pairs of 0..count - 1."""
    ones = np.ones(len(pairs), np.int8)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def _components(label: Nodes) -> Nodes:
    """Return the number of each edge's component."""
    return _clusters(int(label.max()) + 1, label.reshape(-1, 2))[label[::2]]
