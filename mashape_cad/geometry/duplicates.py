"""Edges and loops that lie on top of one another, in either direction: drawn twice, meant once."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from mashape_cad.geometry.edge import Edge, Floats
from mashape_cad.geometry.profile import Loop

__all__ = ["repeated_edges", "repeated_loops"]

# Two curves that agree at five places of their own parameter, wherever they come from, are the same curve.
_PLACES = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
# Of the length: a small edge or loop beside another one is no copy of it, however wide the tolerance.
_SMALL = 1e-3
# Of the length: boxes of the same curve, cut differently, have their centres this close.
_BOX = 0.02
# Places along a loop, so that each place of the same curve has one within `_SMALL` of the length.
_ALONG = 2000

Indices = NDArray[np.int64]


def repeated_edges(edges: Sequence[Edge], lengths: Floats, tolerance: float) -> list[int]:
    """Return the numbers of edges that repeat an earlier one.

    Parameters
    ----------
    edges : sequence of Edge
    lengths : (n,) array
        mm.
    tolerance : float
        Distance up to which curves are the same, mm; a thousandth of the edge's length at most.
    """
    if len(edges) < 2:
        return []
    places = np.stack([edge.point(_PLACES) for edge in edges])
    pairs = cKDTree(places[:, 2]).query_pairs(tolerance, output_type="ndarray").reshape(-1, 2)
    first, second = places[pairs[:, 0]], places[pairs[:, 1]]
    forwards = np.linalg.norm(first - second, axis=2).max(axis=1)
    backwards = np.linalg.norm(first - second[:, ::-1], axis=2).max(axis=1)
    limit = np.minimum(tolerance, _SMALL * lengths[pairs].min(axis=1))
    return np.unique(pairs[np.minimum(forwards, backwards) <= limit].max(axis=1)).tolist()


def repeated_loops(loops: Sequence[Loop], tolerance: float) -> list[int]:
    """Return the numbers of loops that repeat an earlier one, wherever each is cut into edges.

    Parameters
    ----------
    loops : sequence of Loop
    tolerance : float
        Distance up to which curves are the same, mm; a thousandth of the loop's length at most.
    """
    lengths = np.array([loop.length for loop in loops])
    repeats: set[int] = set()
    for run in _runs(lengths, tolerance):
        for first, second in _concentric(loops, lengths, run):
            if not repeats & {first, second} and _same(loops[first], loops[second], tolerance):
                repeats.add(second)
    return sorted(repeats)


def _runs(lengths: Floats, tolerance: float) -> list[Indices]:
    """Group loops of the same length."""
    order = np.argsort(lengths, kind="stable")
    return [run for run in np.split(order, np.flatnonzero(np.diff(lengths[order]) > tolerance) + 1) if len(run) > 1]


def _concentric(loops: Sequence[Loop], lengths: Floats, run: Indices) -> list[tuple[int, int]]:
    """Pair loops whose boxes have nearly the same centre; boxes are only tight to a hundredth."""
    centres = np.stack([loops[i].bounds.mean(axis=0) for i in run])
    near = cKDTree(centres).query_pairs(_BOX * lengths[run].max(), output_type="ndarray").reshape(-1, 2)
    return sorted(map(tuple, np.sort(run[near], axis=1).tolist()))


def _same(one: Loop, other: Loop, tolerance: float) -> bool:
    """Compare what does not depend on where a loop is cut: its area, and roughly the place of its curve."""
    length = one.length
    if abs(abs(one.signed_area) - abs(other.signed_area)) > min(tolerance, _SMALL * length) * length:
        return False
    return max(_far(one, other), _far(other, one)) <= _SMALL * length


def _far(one: Loop, other: Loop) -> float:
    """Largest distance of one loop's vertices and edge middles from places along the other, mm."""
    places = np.concatenate([edge.point([0.0, 0.5]) for edge in one.edges])
    along = other.flattened(1 + _ALONG // len(other.edges))
    return float(cKDTree(along).query(places)[0].max())
