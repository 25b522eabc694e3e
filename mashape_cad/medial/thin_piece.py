"""Pieces whose feet nearly coincide from end to end: `thin_discs`.

A kink of 1e-7 radians is a vertex, with a true branch as long as any. Both its feet run over a stretch 1e-7 long, from
which no disc's place along the branch can be told. But its ends are settled discs and its direction is that of the
normals, so that it is known by them: a cubic in x, y and r from end to end.
"""

from dataclasses import replace

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.branch_discs import BranchDiscs
from mashape_cad.medial.piece_curve import PieceCurve

__all__ = ["thin_discs"]


def thin_discs(curve: PieceCurve, along: Floats, *, forward: bool) -> BranchDiscs:
    """Return discs at fractions of a thin piece from its disc 0 to its disc 1.

    Parameters
    ----------
    curve : PieceCurve
    along : (n,) array
    forward : bool
        Whether they are seen in that direction.
    """
    ends = np.array([curve.settled_point(end) for end in (0, 1)])
    slopes = _slopes(curve, ends)
    turn = float(slopes[0, 0] * slopes[1, 1] - slopes[0, 1] * slopes[1, 0])
    length = float(np.hypot(*(ends[1] - ends[0])[:2]))
    points, directions = _cubic(ends, slopes * length, along)
    settled = [along == 0.0, along == 1.0]
    error = np.full(len(along), length * (abs(turn) + abs(slopes[1, 2] - slopes[0, 2])))
    error += max(curve.settled_error(end) for end in (0, 1))
    for end in (0, 1):
        points[settled[end]], error[settled[end]] = ends[end], curve.settled_error(end)
    sign = 1.0 if forward else -1.0
    return replace(
        curve.described(points[:, :2], np.maximum(points[:, 2], 0.0), _places(curve, along), forward=forward),
        tangent=sign * directions[:, :2] / np.hypot(*directions[:, :2].T)[:, None],
        rate=sign * np.clip(directions[:, 2], -1.0, 1.0),
        curvature=np.full(len(along), sign * turn / length if length > 0 else 0.0),
        error=error,
    )


def _slopes(curve: PieceCurve, ends: Floats) -> Floats:
    """Return directions, and rates of the radius, at both ends: (2, 3)."""
    rows = []
    for end in (0, 1):
        n, m = (curve.feet(side, np.array([t])).normal[0] for side, t in enumerate(curve.ends(end)))
        cosine = float(np.hypot(*(n + m))) / 2
        rows.append([*(n + m) / (2 * cosine), cosine])
    # The normals point the way in which the radius grows.
    return np.array(rows) * (1.0 if ends[1, 2] >= ends[0, 2] else -1.0)


def _cubic(ends: Floats, slopes: Floats, along: Floats) -> tuple[Floats, Floats]:
    """Evaluate the cubic, and its direction by the length of the piece."""
    (a, b), (da, db), x = ends, slopes, along[:, None]
    p, q = 3 * (b - a) - 2 * da - db, 2 * (a - b) + da + db
    length = max(float(np.hypot(*da[:2])), np.finfo(float).tiny)
    return a + x * (da + x * (p + x * q)), (da + x * (2 * p + 3 * x * q)) / length


def _places(curve: PieceCurve, along: Floats) -> Floats:
    """Places on both sides, in proportion."""
    first, last = np.array(curve.ends(0)), np.array(curve.ends(1))
    return first + along[:, None] * (last - first)
