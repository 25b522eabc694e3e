"""A branch as a curve: its discs anywhere, with feet, tangent, curvatures and a stated error: `discs_on_branch`.

Parameter
---------
A branch of n pieces is run through by ``s`` from 0 (its start node) to n (its end node); whole numbers are its settled
discs. Inside a piece the fraction of ``s`` counts along the boundary parameter of the *leading* side: the one whose
boundary is longer (next to an osculating end: longer there), never a reflex vertex where the other side is an edge. The
centre moves forward throughout, but not evenly.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.branch import is_thin
from mashape_cad.medial.branch_discs import BranchDiscs, gathered
from mashape_cad.medial.branch_tip import with_tip
from mashape_cad.medial.graph import Branch, MedialAxis
from mashape_cad.medial.piece_curve import PieceCurve
from mashape_cad.medial.thin_piece import thin_discs

__all__ = ["BranchDiscs", "discs_on_branch"]


def discs_on_branch(axis: MedialAxis, branch: Branch, s: ArrayLike) -> BranchDiscs:
    """Evaluate a branch.

    Parameters
    ----------
    axis : MedialAxis
    branch : Branch
        One of ``axis.branches``, or a chain of its pieces.
    s : array_like
        n parameters from 0, the start node, to ``len(branch.pieces)``, the end node, in any order. A whole number in
        between is the settled disc there, seen from the piece that follows.

    Raises
    ------
    ValueError
        If a parameter is outside.
    """
    s = np.atleast_1d(np.asarray(s, float))
    count = len(branch.pieces)
    outside = s[~((s >= 0) & (s <= count))]
    if len(outside):
        raise ValueError(f"a parameter of this branch lies between 0 and {count}, not {outside[0]}")
    number = np.minimum(s.astype(np.int64), count - 1)
    if not len(s):
        return gathered([discs_on_branch(axis, branch, 0.0)], np.zeros(0, dtype=np.int64))
    edges = axis.profile.edges
    found = [(np.flatnonzero(number == k), k) for k in np.unique(number).tolist()]
    parts = []
    for rows, k in found:
        piece, forward = branch.pieces[k]
        fraction = s[rows] - k
        curve = PieceCurve(axis, edges, piece)
        parts.append(_on_piece(curve, fraction if forward else 1.0 - fraction, forward=forward))
    return gathered(parts, np.argsort(np.concatenate([rows for rows, _ in found])))


def _on_piece(curve: PieceCurve, along: Floats, *, forward: bool) -> BranchDiscs:
    """Evaluate a piece at fractions from its disc 0 to its disc 1, settled discs and tips included."""
    if is_thin(curve.axis, curve.number):
        return thin_discs(curve, along, forward=forward)
    centre, radius, t = curve.solved(along)
    settled = [along == 0.0, along == 1.0]
    for end in (0, 1):
        centre[settled[end]], radius[settled[end]] = curve.settled_point(end)[:2], curve.settled_point(end)[2]
        t[settled[end]] = curve.ends(end)
    found = curve.described(centre, radius, t, forward=forward)
    for end in (0, 1):
        found = replace(found, error=np.where(settled[end], curve.settled_error(end), found.error))
    for end, way in enumerate((along, 1.0 - along)):
        found = with_tip(curve, end, way, found, forward=forward)
    return found
