"""Leaving out end branches that say little of the shape: `simplify`.

Terminology
-----------
end branch
    A branch with a node of degree 1. Taking it away, with that node, leaves a graph of the same homotopy type: as
    connected as before, with the same cycles.
object angle
    Half the angle between the spokes of a disc. It is small where the two feet lie on one side of the shape, as they do
    where a branch was caused by a bump of the outline; on a branch into a vertex it is what the interior angle lacks to
    180 degrees, halved.
erosion thickness
    Let a fire start at all ends, at each when it has burnt from the outline to there (after its clearance), run along
    the branches at speed one, and pass a junction when all branches but one have arrived. Where it comes by a point at
    time b, the point's erosion thickness is b less its clearance: how much longer the way out is along the branch than
    straight to the outline, and so how far the branch's part of the shape sticks out.

Erosion thickness only grows inwards, so that what it takes away is the same in whatever order. It is measured at a
branch's inner node, the object angle where it is largest.

References
----------
P. Dimitrov, J. N. Damon, K. Siddiqi, Flux invariants for shape, CVPR 2003: object angle. D. Shaked, A. M. Bruckstein,
Pruning medial axes, Computer Vision and Image Understanding 69 (1998), 156-169: what the outline loses as significance.
L. Liu, E. W. Chambers, D. Letscher, T. Ju, Extended grassfire transform on medial axes of 2D shapes, Computer-Aided
Design 43 (2011), 1496-1505: burning, erosion thickness. Deviations: whole branches are kept or left out, and where the
fire meets itself nothing is kept of the last branch but its larger disc.
"""

import heapq
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from mashape_cad.medial.branch_curve import BranchDiscs, discs_on_branch
from mashape_cad.medial.graph import Branch, MedialAxis
from mashape_cad.medial.tour import Ints

__all__ = ["PrunedAxis", "simplify"]

# Places on each piece at which its object angle is taken and its length is measured. Lengths come out good to about
# 1e-6 relative: only a branch so close to the threshold may fall on its other side.
_PLACES = 17


@dataclass(frozen=True, slots=True, eq=False)
class PrunedAxis:
    """What is left of a medial axis: no medial axis itself, since its discs no longer restore the profile.

    Attributes
    ----------
    axis : MedialAxis
        The whole of it, unchanged.
    nodes : (v,) array
        Its nodes that are kept as nodes, by their numbers.
    degree : (v,) array
        How many kept branches meet there.
    kind : tuple of str
        ``junction``, ``end``, ``seam`` or ``disc``, by that degree.
    branches : tuple of Branch
        From node to node, as the exact axis numbers them. Where a node has been left with two branches they are one
        here; its pieces are those of the exact axis, and `discs_on_branch` evaluates it.
    removed : tuple of int
        Branches of the exact axis that are left out, in the order in which they went.
    """

    axis: MedialAxis
    nodes: Ints
    degree: Ints
    kind: tuple[str, ...]
    branches: tuple[Branch, ...]
    removed: tuple[int, ...]


def simplify(axis: MedialAxis, min_angle: float = 0.0, min_thickness: float = 0.0) -> PrunedAxis:
    """Leave out end branches, from the ends inwards, until all that are left are significant.

    Cycles are never touched and the axis never becomes empty: the least that is left of a profile without holes is one
    node.

    Parameters
    ----------
    axis : MedialAxis
    min_angle : float
        Radians. End branches on which the object angle nowhere reaches it go.
    min_thickness : float
        mm. End branches whose erosion thickness is below it go.

    Returns
    -------
    PrunedAxis
        With both thresholds 0 all of the axis.

    Raises
    ------
    ValueError
        If a threshold is negative or no number.
    """
    for name, value in (("min_angle", min_angle), ("min_thickness", min_thickness)):
        if not value >= 0.0:
            raise ValueError(f"{name} must be 0 or more, not {value}")
    if min_angle == min_thickness == 0.0:
        return _whole(axis)
    fire = _Fire(axis, min_angle, min_thickness)
    fire.burn()
    return _pruned(axis, fire)


def _whole(axis: MedialAxis) -> PrunedAxis:
    """Return an axis of which nothing is left out."""
    nodes = axis.nodes
    return PrunedAxis(axis, np.arange(len(nodes.kind)), nodes.degree, nodes.kind, axis.branches, ())


class _Fire:
    """The branches that are left, and when the fire reaches their nodes, mm."""

    def __init__(self, axis: MedialAxis, min_angle: float, min_thickness: float) -> None:
        self.axis, self.min_angle, self.min_thickness = axis, min_angle, min_thickness
        self.left = dict(enumerate(axis.branches))
        self.burnt: list[int] = []
        self.last = 0
        self.degree = axis.nodes.degree.copy()
        self.time = axis.nodes.radius.copy()
        self.at: dict[int, list[int]] = {}
        for number, branch in self.left.items():
            for node in {branch.start, branch.end}:
                self.at.setdefault(node, []).append(number)
        sampled = [_sampled(axis, branch) for branch in axis.branches]
        self.length = [_length(discs) for discs in sampled]
        self.angle = [_largest_angle(discs) for discs in sampled]

    def burn(self) -> None:
        """Leave out insignificant end branches, the one over which the fire arrives first first."""
        queue = list(self._ends(np.flatnonzero(self.degree == 1).tolist()))
        heapq.heapify(queue)
        while queue:
            arrival, number, outer, inner = heapq.heappop(queue)
            if number not in self.left or self._is_last_but_larger(outer, inner):
                continue
            self.time[inner] = max(self.time[inner], arrival)
            self.degree[[outer, inner]] -= 1
            del self.left[number]
            self.burnt.append(number)
            self.last = inner
            if self.degree[inner] == 1:
                for each in self._ends([inner]):
                    heapq.heappush(queue, each)

    def _ends(self, outers: Iterable[int]) -> Iterator[tuple[float, int, int, int]]:
        """Yield insignificant end branches at nodes of degree 1: arrival at the inner node, number, both nodes."""
        for outer in outers:
            number = next(each for each in self.at[outer] if each in self.left)
            branch = self.left[number]
            inner = branch.end if branch.start == outer else branch.start
            arrival = float(self.time[outer] + self.length[number])
            thickness = arrival - float(self.axis.nodes.radius[inner])
            if self.angle[number] < self.min_angle or thickness < self.min_thickness:
                yield arrival, number, outer, inner

    def _is_last_but_larger(self, outer: int, inner: int) -> bool:
        """Whether a branch between two ends would lose the larger of its two discs."""
        radius = self.axis.nodes.radius
        return bool(self.degree[inner] == 1 and radius[outer] > radius[inner])


def _sampled(axis: MedialAxis, branch: Branch) -> BranchDiscs:
    count = len(branch.pieces)
    return discs_on_branch(axis, branch, np.linspace(0, count, count * (_PLACES - 1) + 1))


def _length(discs: BranchDiscs) -> float:
    """Length of a branch, mm: between neighbours that of the arc with their chord and their turn."""
    chord = np.hypot(*np.diff(discs.centre, axis=0).T)
    turn = np.arccos(np.clip(np.einsum("ij,ij->i", discs.tangent[:-1], discs.tangent[1:]), -1.0, 1.0))
    return float(np.sum(chord / np.sinc(turn / (2 * np.pi))))


def _largest_angle(discs: BranchDiscs) -> float:
    """Return the largest object angle; where the radius turns from growing to falling it is a right one."""
    turns = np.any(discs.rate[:-1] * discs.rate[1:] < 0)
    return float(np.pi / 2 if turns else discs.object_angle.max())


def _pruned(axis: MedialAxis, fire: _Fire) -> PrunedAxis:
    branches = tuple(_merged(list(fire.left.values()), fire.degree))
    ends = np.array([node for branch in branches for node in (branch.start, branch.end)], dtype=np.int64)
    nodes = np.unique(ends) if len(ends) else np.array([fire.last])
    degree = np.bincount(ends, minlength=len(axis.nodes.degree))[nodes]
    for array in (nodes, degree):
        array.setflags(write=False)
    kinds = tuple({0: "disc", 1: "end", 2: "seam"}.get(int(d), "junction") for d in degree)
    return PrunedAxis(axis, nodes, degree, kinds, branches, tuple(fire.burnt))


def _merged(branches: list[Branch], degree: Ints) -> Iterator[Branch]:
    """Yield chains of branches through nodes of degree 2; one that closes on itself keeps the node where it starts."""
    at: dict[int, list[tuple[int, Branch]]] = {}
    for number, branch in enumerate(branches):
        at.setdefault(branch.start, []).append((number, branch))
        at.setdefault(branch.end, []).append((number, _turned(branch)))
    used: set[int] = set()
    starts = sorted(at, key=lambda node: (degree[node] == 2, node))
    for number, branch in (each for node in starts for each in at[node]):
        if number in used:
            continue
        used.add(number)
        chain = branch
        while degree[chain.end] == 2 and chain.end != chain.start:
            step, onward = next((k, each) for k, each in at[chain.end] if k not in used)
            used.add(step)
            chain = Branch(chain.start, onward.end, chain.pieces + onward.pieces)
        yield chain


def _turned(branch: Branch) -> Branch:
    return Branch(branch.end, branch.start, tuple((piece, not forward) for piece, forward in branch.pieces[::-1]))
