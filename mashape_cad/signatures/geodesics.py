"""Distances along the axis between places on it: `geodesics`."""

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints
from mashape_cad.signatures.branch_places import BranchPlaces
from mashape_cad.signatures.compiled import compiled
from mashape_cad.signatures.retraction import Retracted, incidence

__all__ = ["geodesics"]


def geodesics(places: BranchPlaces, discs: Retracted) -> Floats:
    """Return the length of the shortest way along the kept branches between all pairs of discs: (n, n) array."""
    kept = np.flatnonzero(discs.kept)
    used, node = np.unique(places.node[kept], return_inverse=True)
    number = np.zeros(len(discs.kept), dtype=np.int64)
    number[kept] = np.arange(len(kept))
    full = places.length[places.first[kept + 1] - 1]
    node = node.reshape(-1, 2).astype(np.int64)
    between = _between_nodes(node, full, len(used))
    return _between_places(number[discs.branch], discs.along, full, node, between)


@compiled
def _between_nodes(node: Ints, length: Floats, nodes: int) -> Floats:
    """Return the distances of all nodes: corrections spread until nothing changes, soon on what is almost a tree."""
    start, at = incidence(node, nodes)
    out = np.full((nodes, nodes), np.inf)
    ring, is_waiting = np.empty(nodes, np.int64), np.zeros(nodes, np.bool_)
    for source in range(nodes):
        d = out[source]
        d[source] = 0.0
        ring[0], first, count = source, 0, 1
        while count > 0:
            v = ring[first]
            first, count = (first + 1) % nodes, count - 1
            is_waiting[v] = False
            for i in range(start[v], start[v + 1]):
                b = at[i]
                w = node[b, 1] if node[b, 0] == v else node[b, 0]
                if d[v] + length[b] < d[w]:
                    d[w] = d[v] + length[b]
                    if not is_waiting[w]:
                        ring[(first + count) % nodes] = w
                        is_waiting[w] = True
                        count += 1
    return out


@compiled
def _between_places(branch: Ints, along: Floats, length: Floats, node: Ints, between: Floats) -> Floats:
    n = len(branch)
    out, to = np.zeros((n, n)), np.empty(len(between))
    for i in range(n):
        b = branch[i]
        for v in range(len(between)):
            to[v] = min(along[i] + between[node[b, 0], v], length[b] - along[i] + between[node[b, 1], v])
        for j in range(i):
            c = branch[j]
            d = min(to[node[c, 0]] + along[j], to[node[c, 1]] + length[c] - along[j])
            if b == c:
                d = min(d, abs(along[i] - along[j]))
            out[i, j] = out[j, i] = d
    return out
