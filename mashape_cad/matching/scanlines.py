"""The area by which two outlines differ: `symmetric_difference`.

A point lies in exactly one of two profiles if a ray from it crosses the boundaries of both together an odd number of
times. So the symmetric difference is what the even-odd rule fills when all loops of both are drawn at once. It is
measured along parallel lines: what is integrated is a length that is nowhere negative and zero where the outlines
agree, so that equal outlines give no more than rounding, and small differences a small error in proportion. Nothing can
fail, however often the outlines cross or run on top of one another.
"""

from collections.abc import Sequence

import numpy as np

from mashape_cad.geometry.edge import Floats

__all__ = ["symmetric_difference"]

# Lines across both outlines: one in 2000 of the size. A hole moved by that much is seen by its own width, not by this.
_LINES = 2000
# Direction of the lines, radians: far from 0, 30, 45, 60 and 90 degrees, which edges of parts prefer. Along an edge
# the lines would hit a thin strip in full or miss it.
_DIRECTION = 0.3271


def symmetric_difference(one: Sequence[Floats], other: Sequence[Floats]) -> float:
    """Return the area that lies in exactly one of two sets of closed polygons, filled by the even-odd rule.

    Parameters
    ----------
    one, other : sequence of (n, 2) arrays
        Rings in the same coordinates, the first point not repeated, mm.

    Returns
    -------
    float
        mm2; good to about a thousandth of itself, and to rounding if the sets are equal.
    """
    cos, sin = np.cos(_DIRECTION), np.sin(_DIRECTION)
    rings = [ring @ np.array([[cos, sin], [-sin, cos]]) for ring in (*one, *other)]
    low = min(float(ring[:, 1].min()) for ring in rings)
    high = max(float(ring[:, 1].max()) for ring in rings)
    pitch = (high - low) / _LINES
    crossings = [_crossings(ring, low, pitch) for ring in rings]
    line, place = (np.concatenate(column) for column in zip(*crossings, strict=True))
    place = place[np.lexsort((place, line))]  # an even number on each line, since every ring is closed
    return float(np.sum(place[1::2] - place[::2]) * pitch)


def _crossings(ring: Floats, low: float, pitch: float) -> tuple[Floats, Floats]:
    """Return where a ring crosses the lines, which run through the middle of each step: line number, place on it."""
    start, end = ring, np.roll(ring, -1, axis=0)
    first, last = (np.ceil((each[:, 1] - low) / pitch - 0.5) for each in (start, end))
    from_line = np.minimum(first, last)
    counts = np.abs(last - first).astype(int)
    side = np.repeat(np.arange(len(ring)), counts)
    line = np.repeat(from_line, counts) + np.arange(len(side)) - np.repeat(np.cumsum(counts) - counts, counts)
    y = low + (line + 0.5) * pitch
    share = (y - start[side, 1]) / (end[side, 1] - start[side, 1])
    return line, start[side, 0] + share * (end[side, 0] - start[side, 0])
