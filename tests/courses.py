"""How far points (x, y, r) lie from the branches of an axis, all along their length: `off_branches`.

Branches are taken as curves, whatever pieces they are made of and wherever their parameter stands: so axes of one
domain that were traced from differently drawn boundaries can be compared.
"""

from collections.abc import Iterator

import numpy as np
from scipy.spatial import cKDTree

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.branch_curve import discs_on_branch
from mashape_cad.medial.graph import Branch, MedialAxis

__all__ = ["course", "off_branches", "runs"]

# Samples of each piece from which the search for the nearest disc starts, and its steps: fewer could begin at the wrong
# side of a bend, and end too far away; never too near.
_PER_PIECE, _STEPS = 24, 14
# Samples that are tried for each point: at a junction the nearest may lie on another branch.
_TRIED = 3


def runs(axis: MedialAxis, per_piece: int) -> Iterator[tuple[Branch, Floats, Floats]]:
    """Yield each branch with parameters and discs (x, y, r) from node to node."""
    for branch in axis.branches:
        count = len(branch.pieces)
        s = np.linspace(0.0, count, per_piece * count + 1)
        yield branch, s, course(axis, branch, s)


def course(axis: MedialAxis, branch: Branch, s: Floats) -> Floats:
    """Return the discs of a branch at some parameters: (n, 3)."""
    discs = discs_on_branch(axis, branch, s)
    return np.column_stack([discs.centre, discs.radius])


def off_branches(axis: MedialAxis, points: Floats) -> Floats:
    """Return how far points (n, 3) are from the nearest disc of any branch: the largest of three differences, mm."""
    if not axis.branches:
        return np.abs(points - np.append(axis.nodes.centre[0], axis.nodes.radius[0])).max(axis=1)
    sampled = list(runs(axis, _PER_PIECE))
    rows = np.concatenate([discs for _, _, discs in sampled])
    of_row = np.repeat(np.arange(len(sampled)), [len(s) for _, s, _ in sampled])
    s_of_row = np.concatenate([s for _, s, _ in sampled])
    _, near = cKDTree(rows).query(points, k=min(_TRIED, len(rows)))
    best = np.full(len(points), np.inf)
    for number, (branch, s, _) in enumerate(sampled):
        point, row = np.nonzero(of_row[near] == number)
        if len(point):
            start = s_of_row[near[point, row]]
            step = s[1] - s[0]
            ends = np.maximum(start - step, 0.0), np.minimum(start + step, s[-1])
            np.minimum.at(best, point, _nearest(axis, branch, points[point], ends))
    return best


def _nearest(axis: MedialAxis, branch: Branch, points: Floats, ends: tuple[Floats, Floats]) -> Floats:
    """Return how far each point is from the nearest disc found between two parameters of a branch.

    The nearest one is where the way to the point stands at right angles to the branch, in x, y and r; found by the rule
    of false position, with one value halved when its end stays (the Illinois rule).
    """
    (low, g_low), (high, g_high) = ((s, _before(axis, branch, points, s)[0]) for s in ends)
    best = np.minimum(*(_before(axis, branch, points, s)[1] for s in ends))
    stayed = np.zeros(len(points))
    for step in range(_STEPS):
        with np.errstate(invalid="ignore", divide="ignore"):
            inner = (low * g_high - high * g_low) / (g_high - g_low)
        middle = (low + high) / 2
        # Where a branch ends its centre moves with the square of the parameter, and the rule is slow: halve instead.
        s = np.where((inner > low) & (inner < high), inner, middle) if step % 4 < 3 else middle
        g, off = _before(axis, branch, points, s)
        best = np.minimum(best, off)
        is_low = g < 0
        g_high = np.where(is_low, np.where(stayed < 0, g_high / 2, g_high), g)
        g_low = np.where(is_low, g, np.where(stayed > 0, g_low / 2, g_low))
        low, high = np.where(is_low, s, low), np.where(is_low, high, s)
        stayed = np.where(is_low, -1, 1)
    return best


def _before(axis: MedialAxis, branch: Branch, points: Floats, s: Floats) -> tuple[Floats, Floats]:
    """Return how far discs of a branch lie behind the points, along the branch, and how far from them."""
    discs = discs_on_branch(axis, branch, s)
    way = np.column_stack([discs.centre, discs.radius]) - points
    return np.einsum("ij,ij->i", way[:, :2], discs.tangent) + way[:, 2] * discs.rate, np.abs(way).max(axis=1)
