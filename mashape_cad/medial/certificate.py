"""What is proven of a medial axis: `Certificate`.

Found from the finished axis: the kernel's distance from every settled centre to the whole boundary, the distance from
centre to footpoints, and the graph's counts. For a domain with h holes the axis is connected, has h independent cycles,
and fulfils ``sum over junctions of (degree - 2) = ends + 2 h - 2``.
"""

from dataclasses import dataclass

import numpy as np

from mashape_cad.medial.graph import MedialAxis

__all__ = ["Certificate", "certificate"]

# Largest error, relative to the diagonal, at which a disc counts as maximal.
_ACCURACY = 1e-7


@dataclass(frozen=True, slots=True)
class Certificate:
    """Figures of one profile's medial axis; errors are relative to the bounding box's diagonal.

    Attributes
    ----------
    edges, holes : int
    area_mm2, perimeter_mm, max_radius_mm : float
    branches, junctions, ends, cycles : int
    connected : bool
    max_disc_error : float
        Largest difference between a disc's radius and the kernel's distance from its centre to the boundary.
    max_foot_error : float
        Largest difference between a disc's radius and the distance from its centre to a footpoint.
    ok : bool
        Both errors at most 1e-7, connected, as many cycles as holes, the counting identity holds, and the branches
        account for the whole boundary.
    """

    edges: int
    holes: int
    area_mm2: float
    perimeter_mm: float
    max_radius_mm: float
    branches: int
    junctions: int
    ends: int
    cycles: int
    connected: bool
    max_disc_error: float
    max_foot_error: float
    ok: bool


def certificate(axis: MedialAxis) -> Certificate:
    """Return the figures of a medial axis."""
    profile, discs, nodes = axis.profile, axis.discs, axis.nodes
    diagonal = profile.diagonal
    disc_error = float(np.max(np.abs(discs.clearance - discs.radius)) / diagonal)
    spokes = np.linalg.norm(discs.foot - discs.centre[:, None], axis=2)
    foot_error = float(np.max(np.abs(spokes - discs.radius[:, None])) / diagonal)
    holes = len(profile.holes)
    ends = sum(kind == "end" for kind in nodes.kind)
    connected = axis.components == 1
    accurate = max(disc_error, foot_error) <= _ACCURACY
    return Certificate(
        edges=len(profile.edges),
        holes=holes,
        area_mm2=profile.area,
        perimeter_mm=profile.perimeter,
        max_radius_mm=float(discs.radius.max()),
        branches=len(axis.branches),
        junctions=sum(kind == "junction" for kind in nodes.kind),
        ends=ends,
        cycles=axis.cycles,
        connected=connected,
        max_disc_error=disc_error,
        max_foot_error=foot_error,
        ok=bool(
            accurate
            and connected
            and axis.cycles == holes
            and _counts_agree(axis, ends, holes)
            and _covers_boundary(axis)
        ),
    )


def _counts_agree(axis: MedialAxis, ends: int, holes: int) -> bool:
    """Check the counting identity of the module's text; a disc has neither ends nor junctions."""
    if axis.nodes.kind == ("disc",):
        return holes == 0
    degree = axis.nodes.degree
    return int((degree[degree > 2] - 2).sum()) == ends + 2 * holes - 2


def _covers_boundary(axis: MedialAxis) -> bool:
    """Whether every stretch of boundary bounds one piece, every piece lies on one branch, and all degrees agree."""
    contacts, nodes = axis.contacts, axis.nodes
    bounded = {
        (piece, side) for piece, side in zip(contacts.piece.tolist(), contacts.side.tolist(), strict=True) if piece >= 0
    }
    pieces = [piece for branch in axis.branches for piece, _ in branch.pieces]
    meeting = np.bincount(
        np.array([node for branch in axis.branches for node in (branch.start, branch.end)], dtype=np.int64),
        minlength=len(nodes.degree),
    )
    return (
        bounded == {(piece, side) for piece in pieces for side in (0, 1)}
        and sorted(pieces) == list(range(len(axis.pieces.disc)))
        and np.array_equal(meeting, nodes.degree)
        and np.array_equal(axis.discs.degree[nodes.disc], nodes.degree)
    )
