"""Ranking again by the neighbours of neighbours: `reranked`.

A class is often a chain: its ends have little in common, but each member resembles the next. So a query's relevance is
let flow through the graph that joins each shape with its nearest few, and shapes that much of it reaches rise.

References
----------
D. Zhou, J. Weston, A. Gretton, O. Bousquet, B. Scholkopf, Ranking on data manifolds, NIPS 2003. X. Yang,
S. Koknar-Tezel, L. J. Latecki, Locally constrained diffusion process on locally densified distance spaces with
applications to shape retrieval, CVPR 2009. Deviation: the best plain matches keep their places.
"""

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from mashape_cad.library.ranking import Floats

__all__ = ["SHORTLIST", "neighbour_graph", "relevance", "reranked"]

# Shapes that take part in a search, the nearest ones: what is farther keeps its order. The graph of so many takes some
# tens of milliseconds, that of a large library would take hours.
SHORTLIST = 1000
# Neighbours of each shape: more help large classes and mix small ones. What is farther than the fifth counts little.
_NEIGHBOURS, _REACH, _SHARPNESS = 10, 5, 2.0
# A query starts in its nearest few as well, by at most so much.
_STARTS, _START = 3, 0.5
# Share of the relevance that flows on at each step, and steps: what is left after them is below 1 in 150.
_FLOW, _STEPS = 0.95, 100
# Share of plain distance in the order: it decides among shapes that nothing flows to.
_PLAIN = 0.05
# Best plain matches that keep their places: they are right more often than any diffusion.
_PINNED = 2
_TINY = 1e-9

Ints = NDArray[np.intp]


def reranked(apart: Floats, query: int, graph: sparse.csr_array | None = None) -> Ints:
    """Return the order in which one shape finds all, itself and its two nearest first.

    Parameters
    ----------
    apart : (n, n) array
        Distances of all pairs.
    query : int
        Number of the shape that asks.
    graph : (n, n) sparse array, optional
        The shapes' `neighbour_graph`, if it is known.
    """
    plain, count = apart[query], len(apart)
    flow = relevance(neighbour_graph(apart) if graph is None else graph, plain, query)
    far = max(float(np.median(plain)), _TINY)
    joined = _PLAIN * plain / far - (1 - _PLAIN) * flow / flow.max()
    order = np.lexsort((np.arange(count) != query, plain))
    first, rest = order[: 1 + _PINNED], order[1 + _PINNED :]
    return np.concatenate([first, rest[np.argsort(joined[rest], kind="stable")]])


def neighbour_graph(apart: Floats) -> sparse.csr_array:
    """Return the affinities of shapes that are neighbours, one of the other at least, normalised by degree.

    Parameters
    ----------
    apart : (n, n) array
        Distances of all pairs.
    """
    n = len(apart)
    k = min(_NEIGHBOURS, n - 1)
    if k < 1:
        return sparse.csr_array((n, n))
    others = apart.copy()
    np.fill_diagonal(others, np.inf)
    near = np.argsort(others, axis=1, kind="stable")[:, :k]
    distance = np.take_along_axis(others, near, axis=1)
    scale = np.maximum(distance[:, min(_REACH, k) - 1], _TINY)
    affinity = np.exp(-_SHARPNESS * distance**2 / (scale[:, None] * scale[near]))
    rows = np.repeat(np.arange(n), k)
    one_way = sparse.csr_array((affinity.ravel(), (rows, near.ravel())), shape=(n, n))
    both = (one_way + one_way.T) / 2
    root = sparse.diags_array(1.0 / np.sqrt(np.maximum(both.sum(axis=1), _TINY)))
    return (root @ both @ root).tocsr()


def relevance(graph: sparse.csr_array, plain: Floats, query: int) -> Floats:
    """Return how much of what starts in a query and its nearest reaches each shape: (n,)."""
    start = np.zeros(len(plain))
    near = np.lexsort((np.arange(len(plain)) != query, plain))[1 : 1 + _STARTS]
    if len(near):
        start[near] = _START * np.exp(-((plain[near] / max(plain[near[-1]], _TINY)) ** 2))
    start[query] = 1.0
    flow = start
    for _ in range(_STEPS):
        flow = start + _FLOW * (graph @ flow)
    return flow
