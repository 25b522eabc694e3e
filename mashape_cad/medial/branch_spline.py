"""A branch as one cubic spline in x, y and radius, for files that hold curves: `branch_spline`."""

from dataclasses import dataclass

import numpy as np

from mashape_cad.geometry.edge import Floats, frozen
from mashape_cad.medial.branch_curve import discs_on_branch
from mashape_cad.medial.graph import Branch, MedialAxis

__all__ = ["BranchSpline", "branch_spline"]

# Halvings of a stretch of the parameter. Cubics gain a factor of 16 by each; what is left after so many is a branch
# that turns within a billionth of a piece.
_ROUNDS = 30
# Where between two of its points the spline is held against the branch.
_CHECKS = np.array([0.25, 0.5, 0.75])
# Points closer than this (sizes) are one: between them there is nothing to fit.
_SAME = 1e-10
# A spline whose poles are this close to its chord (of its length) is a straight line.
_STRAIGHT = 1e-10


@dataclass(frozen=True, slots=True, eq=False)
class BranchSpline:
    """Cubic B-spline of points (x, y, r), mm, by about the arc length of the branch; once differentiable at its knots.

    Attributes
    ----------
    knots : (m + 4,) array
        Inner knots occur twice, the end knots four times.
    poles : (m, 3) array
    """

    knots: Floats
    poles: Floats

    @property
    def is_straight(self) -> bool:
        """Whether x, y and r all change in proportion."""
        way = self.poles[-1] - self.poles[0]
        length = float(np.linalg.norm(way))
        if length == 0.0:
            return False
        share = (self.poles - self.poles[0]) @ way / length**2
        off = self.poles - self.poles[0] - share[:, None] * way
        return bool(np.linalg.norm(off, axis=1).max() <= _STRAIGHT * length)


def branch_spline(axis: MedialAxis, branch: Branch, accuracy: float) -> BranchSpline:
    """Fit a spline to a branch: through discs of it in their directions, more of them until it is close enough.

    Parameters
    ----------
    axis : MedialAxis
    branch : Branch
        One of ``axis.branches``, or a chain of its pieces.
    accuracy : float
        mm. Exact discs at three places between any two points of the spline are this close to it, in the distance of
        (x, y, r); elsewhere it may be off by a little more, by theory 5 % at most where the branch is smooth.

    References
    ----------
    G. Farin, Curves and Surfaces for CAGD, 5th ed., sections 6.5 and 8.3: cubic Hermite pieces as one B-spline.
    """
    s = np.arange(len(branch.pieces) + 1.0)
    points, slopes = _points(axis, branch, s)
    fits = np.zeros(len(s) - 1, dtype=bool)
    for _ in range(_ROUNDS):
        open_ = np.flatnonzero(~fits)
        checks = (s[open_, None] + _CHECKS * np.diff(s)[open_, None]).ravel()
        exact = _points(axis, branch, checks)[0].reshape(len(open_), len(_CHECKS), 3)
        off = np.array(
            [_off(*_piece(points, slopes, k), discs) for k, discs in zip(open_.tolist(), exact, strict=True)]
        )
        fits[open_] = off <= accuracy
        wide = open_[~fits[open_]]
        if not len(wide):
            break
        middles = (s[wide] + s[wide + 1]) / 2
        more = _points(axis, branch, middles)
        s = np.insert(s, wide + 1, middles)
        points, slopes = (
            np.insert(old, wide + 1, new, axis=0) for old, new in zip((points, slopes), more, strict=True)
        )
        fits = np.insert(fits, wide + 1, values=False)
    return _joined(points, slopes, _SAME * axis.frame.size)


def _points(axis: MedialAxis, branch: Branch, s: Floats) -> tuple[Floats, Floats]:
    """Return x, y, r and their derivatives by arc length: (n, 3) each."""
    discs = discs_on_branch(axis, branch, s)
    return np.column_stack([discs.centre, discs.radius]), np.column_stack([discs.tangent, discs.rate])


def _piece(points: Floats, slopes: Floats, k: int) -> tuple[Floats, Floats]:
    """Return the ends (2, 3) of piece k, and the derivatives there by a parameter from 0 to 1."""
    return points[k : k + 2], slopes[k : k + 2] * _length(points[k : k + 2], slopes[k : k + 2])


def _length(ends: Floats, slopes: Floats) -> float:
    """Length of the arc with this chord and this turn, in x and y."""
    turn = np.arccos(np.clip(slopes[0, :2] @ slopes[1, :2], -1.0, 1.0))
    return float(np.hypot(*(ends[1] - ends[0])[:2]) / np.sinc(turn / (2 * np.pi)))


def _off(ends: Floats, slopes: Floats, discs: Floats) -> float:
    """Largest distance of discs (n, 3) from a piece, by Newton's method from their share of the way."""
    (a, b), (da, db) = ends, slopes
    p, q = 3 * (b - a) - 2 * da - db, 2 * (a - b) + da + db
    way = b - a
    x = np.clip((discs - a) @ way / max(float(way @ way), np.finfo(float).tiny), 0.0, 1.0)[:, None]
    for _ in range(6):
        away = a + x * (da + x * (p + x * q)) - discs
        first, second = da + x * (2 * p + 3 * x * q), 2 * p + 6 * x * q
        bend = np.sum(first * first + away * second, axis=1, keepdims=True)
        step = np.sum(away * first, axis=1, keepdims=True) / np.where(bend > 0, bend, np.inf)
        x = np.clip(x - step, 0.0, 1.0)
    return float(np.linalg.norm(a + x * (da + x * (p + x * q)) - discs, axis=1).max())


def _joined(points: Floats, slopes: Floats, same: float) -> BranchSpline:
    """Make one B-spline of the pieces: two poles for each point, and the knots twice, at the lengths so far."""
    kept = np.append(True, np.hypot(*np.diff(points, axis=0)[:, :2].T) > same)
    kept[-1] = True
    rows = np.flatnonzero(kept)
    if len(rows) > 2 and np.hypot(*(points[rows[-1]] - points[rows[-2]])[:2]) <= same:
        rows = np.delete(rows, -2)
    points, slopes = points[rows], slopes[rows]
    lengths = np.array([_length(points[k : k + 2], slopes[k : k + 2]) for k in range(len(points) - 1)])
    before = points[1:] - slopes[1:] * lengths[:, None] / 3
    behind = points[:-1] + slopes[:-1] * lengths[:, None] / 3
    inner = np.stack([behind, before], axis=1).reshape(-1, 3)
    knots = np.concatenate([[0.0], np.cumsum(lengths)])
    return BranchSpline(
        frozen(np.concatenate([knots[:1], knots[:1], np.repeat(knots, 2), knots[-1:], knots[-1:]])),
        frozen(np.concatenate([points[:1], inner, points[-1:]])),
    )
