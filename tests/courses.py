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

__all__ = ["course", "doubt", "off_branches", "runs"]

# Samples of each piece from which the search for the nearest disc starts, and its steps: a piece may go almost all of
# its way in a thousandth of its parameter. Fewer could end too far away; never too near.
_PER_PIECE, _STEPS = 16, 90


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


def doubt(axis: MedialAxis, branch: Branch, s: Floats) -> Floats:
    """Return the bounds of their errors that the discs of a branch state, (n,), mm."""
    return discs_on_branch(axis, branch, s).error


def off_branches(axis: MedialAxis, points: Floats, enough: Floats | float) -> Floats:
    """Return how far points (n, 3) are from a disc of any branch: the largest of three differences, mm.

    The nearest disc, or one that is no further than `enough`, one for all or (n,).
    """
    enough = np.broadcast_to(enough, len(points))
    if not axis.branches:
        return np.abs(points - np.append(axis.nodes.centre[0], axis.nodes.radius[0])).max(axis=1)
    sampled = list(runs(axis, _PER_PIECE))
    # Two, since a branch that closes on itself has its seam at both of its ends.
    near = [cKDTree(discs).query(points, k=2) for _, _, discs in sampled]
    order = np.argsort([apart[:, 0] for apart, _ in near], axis=0)
    best = np.full(len(points), np.inf)
    for row in order:
        if np.all(best <= enough):
            break
        for number, (branch, s, _) in enumerate(sampled):
            for start in s[near[number][1].T]:
                here = np.flatnonzero((row == number) & (best > enough))
                ends = np.maximum(start[here] - s[1], 0.0), np.minimum(start[here] + s[1], s[-1])
                if len(here):
                    best[here] = np.minimum(best[here], _nearest(axis, branch, points[here], ends, enough[here]))
    return best


def _nearest(axis: MedialAxis, branch: Branch, points: Floats, ends: tuple[Floats, Floats], enough: Floats) -> Floats:
    """Return how far each point is from the nearest disc found between two parameters of a branch.

    The nearest one is where the way to the point stands at right angles to the branch, in x, y and r; found by the rule
    of false position, with one value halved when its end stays (the Illinois rule).
    """
    (low, (g_low, best)), (high, (g_high, off)) = ((s, _before(axis, branch, points, s)) for s in ends)
    best, stayed = np.minimum(best, off), np.zeros(len(points))
    for step in range(_STEPS):
        going = np.flatnonzero(best > enough)
        if not len(going):
            break
        a, b, g_a, g_b = low[going], high[going], g_low[going], g_high[going]
        with np.errstate(invalid="ignore", divide="ignore"):
            inner = (a * g_b - b * g_a) / (g_b - g_a)
        # Where a branch ends its centre moves with the square of the parameter, and the rule is slow: halve instead.
        s = np.where((inner > a) & (inner < b), inner, (a + b) / 2) if step % 3 < 2 else (a + b) / 2
        g, off = _before(axis, branch, points[going], s)
        best[going] = np.minimum(best[going], off)
        is_low = g < 0
        g_high[going] = np.where(is_low, np.where(stayed[going] < 0, g_b / 2, g_b), g)
        g_low[going] = np.where(is_low, g, np.where(stayed[going] > 0, g_a / 2, g_a))
        low[going], high[going] = np.where(is_low, s, a), np.where(is_low, b, s)
        stayed[going] = np.where(is_low, -1, 1)
    return best


def _before(axis: MedialAxis, branch: Branch, points: Floats, s: Floats) -> tuple[Floats, Floats]:
    """Return how far discs of a branch lie behind the points, along the branch, and how far from them."""
    discs = discs_on_branch(axis, branch, s)
    way = np.column_stack([discs.centre, discs.radius]) - points
    return np.einsum("ij,ij->i", way[:, :2], discs.tangent) + way[:, 2] * discs.rate, np.abs(way).max(axis=1)
