"""Which profiles have the outer loop of a query, in any place, size and sense: `OuterLoops`.

A hole more or less changes a medial axis, and so a signature, through and through. Whoever asks for the same part wants
to see the one with another hole all the same. Its outer loop tells, and a few numbers of it that neither place, size
nor sense change are enough to look there first; whether it is the same is for the exact comparison to say.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mashape_cad.library.polylines import outer_loop_of
from mashape_cad.library.record import ProfileRecord

__all__ = ["OuterLoops"]

Floats = NDArray[np.float64]

# Numbers of one outer loop in two drawings differ by at most this, relatively: a polyline cuts corners. Light pictures
# are good to half a step of a grid of 1/5000, and tell the area of what is slender less well: by the product of the
# first two numbers times this.
_SAME, _GRID = 0.005, 2e-4
# Three points of Gauss and Legendre along each side integrate the fourth power of a distance exactly.
_POINTS = np.array([0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)])
_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0


class OuterLoops:
    """The outer loops of a library's profiles.

    Parameters
    ----------
    records : sequence of ProfileRecord
    """

    def __init__(self, records: Sequence[ProfileRecord]) -> None:
        self._numbers = _numbers([outer_loop_of(record.thumbnail) for record in records])

    def same(self, asked: ProfileRecord) -> NDArray[np.bool_]:
        """Tell of each profile whether its outer loop may be that of a query."""
        own = _numbers([outer_loop_of(asked.thumbnail)])
        return np.all(np.abs(self._numbers / own - 1.0) <= _SAME + _GRID * own[:, 0] * own[:, 1], axis=1)


def _numbers(loops: Sequence[Floats]) -> Floats:
    """Return what is invariant of closed polylines: length, mean and higher mean distance from the middle, by the area.

    Returns
    -------
    (n, 3) array
    """
    count = np.array([len(loop) for loop in loops])
    first = np.cumsum(count) - count
    start = np.concatenate(loops)
    onward = np.arange(1, len(start) + 1)
    onward[first + count - 1] = first
    end = start[onward]
    side = np.hypot(*(end - start).T)
    length = np.add.reduceat(side, first)
    area = np.abs(np.add.reduceat(start[:, 0] * end[:, 1] - end[:, 0] * start[:, 1], first)) / 2
    middle = np.add.reduceat(side[:, None] * (start + end) / 2, first) / length[:, None]
    at = start[:, None] + _POINTS[:, None] * (end - start)[:, None] - np.repeat(middle, count, axis=0)[:, None]
    square = (at**2).sum(axis=2)
    # A loop so narrow that its picture has no area is like none.
    size = np.sqrt(np.where(area > 0.0, area, np.nan))[:, None]
    means = [np.add.reduceat(side * (square**power @ _WEIGHTS), first) / length for power in (1, 2)]
    return np.column_stack([length, means[0] ** 0.5, means[1] ** 0.25]) / size
