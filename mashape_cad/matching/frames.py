"""Where portions of an outline are recognised: the branches of a medial axis, each in a frame of its own.

A signature of the whole cannot find a hook that hangs on another body. A branch can: the disc of the node it leaves
gives a place and a unit of length, its first steps give a direction. What the branch does in this frame depends on the
two stretches of boundary beside it alone, and is the same wherever these occur, moved, turned or scaled.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mashape_cad.geometry.edge import Floats

__all__ = ["Frames", "frames"]

# Distances along a branch, in radii of the node's disc, at which its course is put on record.
_STEPS = np.array([0.5, 1.0, 1.5, 2.25, 3.25])
# Which of them gives the frame's direction.
_AHEAD = 1
# A node whose disc is smaller than this share of the largest has no unit of length to speak of.
_SMALLEST = 0.02
# A node where two branches meet is no node: there a ring was cut open.
_CUT_OPEN = 2
# A branch that ends before this many radii are gone says nothing.
_SHORTEST = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Frames:
    """Branches as seen from the nodes that they leave.

    Attributes
    ----------
    origin : (n, 2) array
        Centres of the nodes, mm.
    direction : (n, 2) array
        Unit vectors.
    radius : (n,) array
        Of the nodes' discs, mm.
    signature : (n, 17) array
        Without unit: the places x, y of five discs along the branch and their radii, in the frame and by its radius;
        then the angles to the next branch on the left and on the right, in half turns.
    """

    origin: Floats
    direction: Floats
    radius: Floats
    signature: Floats

    @property
    def mirrored(self) -> Floats:
        """The signatures of the mirror image, (n, 17)."""
        steps = len(_STEPS)
        seen = self.signature.copy()
        seen[:, steps : 2 * steps] *= -1
        seen[:, -2:] = self.signature[:, :-3:-1]
        return seen


def frames(branches: Sequence[Floats]) -> Frames:
    """Return the frames of all branches, from both of their ends.

    Parameters
    ----------
    branches : sequence of (m, 3) arrays
        x, y and radius from node to node, mm; branches that meet share their end point exactly.
    """
    largest = max((float(branch[:, 2].max()) for branch in branches), default=0.0)
    runs = [run for branch in branches if len(branch) > 1 for run in (branch, branch[::-1])]
    leaving: dict[tuple[float, float], list[_Leaving]] = {}
    for run in runs:
        if run[0, 2] > _SMALLEST * largest:
            leaving.setdefault((float(run[0, 0]), float(run[0, 1])), []).append(_Leaving.of(run))
    rows = [
        each.row([other.angle for other in met if other is not each])
        for met in leaving.values()
        for each in met
        if len(met) != _CUT_OPEN and each.length >= _SHORTEST
    ]
    if not rows:
        return Frames(np.empty((0, 2)), np.empty((0, 2)), np.empty(0), np.empty((0, 3 * len(_STEPS) + 2)))
    origin, direction, radius, signature = (np.array(column) for column in zip(*rows, strict=True))
    return Frames(origin, direction, radius, signature)


class _Leaving(NamedTuple):
    """A branch where it leaves a node: the node's disc, discs at `_STEPS` (the last one where it is shorter)."""

    disc: Floats
    places: Floats
    length: float
    angle: float

    @classmethod
    def of(cls, run: Floats) -> "_Leaving":
        x, y, r = run.T
        along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))]) / r[0]
        places = np.array([np.interp(_STEPS, along, column) for column in (x, y, r)]).T
        ahead = places[_AHEAD] - run[0]
        return cls(run[0], places, float(along[-1]), float(np.arctan2(ahead[1], ahead[0])))

    def row(self, others: list[float]) -> tuple[Floats, Floats, float, Floats]:
        """Return origin, direction, radius and signature; `others` are the angles of the node's other branches."""
        direction = np.array([np.cos(self.angle), np.sin(self.angle)])
        offset = (self.places[:, :2] - self.disc[:2]) / self.disc[2]
        ahead, aside = offset @ direction, offset @ (-direction[1], direction[0])
        turns = sorted((other - self.angle) % (2 * np.pi) for other in others) or [np.pi]
        sides = turns[0] / np.pi, (2 * np.pi - turns[-1]) / np.pi
        return (
            self.disc[:2],
            direction,
            self.disc[2],
            np.concatenate([ahead, aside, self.places[:, 2] / self.disc[2], sides]),
        )
