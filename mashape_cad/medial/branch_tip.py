"""The part of a piece next to an end where its feet come together: `with_tip`.

Ends that osculate
------------------
At such an end both feet come together, and a disc near it is known the less the nearer it is: its two equations become
the same. There x, y, r and the other foot are polynomials in the boundary parameter of the leading side, from the end,
whose disc is exact, to the first disc whose object angle is above `NARROW`. They are smooth in it as far as the
boundary is. By the arc length of the axis they need not be: where curvature, or its slope, jumps at the end, the feet
leave it unequally fast, and the axis may turn with the root of its length.

Convex vertices
---------------
Very close to one the feet come together too, and the same is done. Tangents and curvatures stay those of the feet.

References
----------
G. Farin, Curves and Surfaces for CAGD, 5th ed., section 6.5 (Hermite interpolation).
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import KroghInterpolator

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.branch_discs import BranchDiscs
from mashape_cad.medial.piece_curve import NARROW, PieceCurve

__all__ = ["with_tip"]

# Halvings of a piece in search of the narrow part: the object angle falls in proportion, so it is found at the fifth.
_HALVINGS = 30
# Part of a piece next to a convex vertex that is interpolated; doubled until the discs that it rests on are known this
# well (sizes): of two feet closer than rounding nothing can be told.
_NEAR_VERTEX, _KNOWN = 2.0**-10, 1e-12
# Where in the narrow part discs are solved for after all, to see how far the polynomial is off.
_CHECKS = np.array([0.12, 0.25, 0.6])
# Where in the narrow part its discs are solved for: further in, they are known less well.
_KNOTS = np.array([0.5, 0.75, 1.0])
_PLACES = np.array([0.35, 0.5, 0.65, 0.8, 1.0])
# Between the checks the polynomial may be off by some times more: three is what was seen.
_MARGIN = 4.0
# A tip that is off by more (sizes) is tried smaller, down to this part of a piece: where the boundary is not smooth, as
# at the knots of a spline, polynomials gain little by their degree, and smaller ones lose digits of their discs.
_GOAL, _LEAST = 1e-12, 1e-5
# Closer to the end (fraction of the narrow part) the curvature of the axis is given as constant: it is a quotient of
# two differences there, and may grow beyond all bounds.
_NEAREST = 0.2


def with_tip(curve: PieceCurve, end: int, way: Floats, found: BranchDiscs, *, forward: bool) -> BranchDiscs:
    """Replace discs next to an end whose feet come together.

    Parameters
    ----------
    curve : PieceCurve
    end : int
        Which of its discs, 0 or 1.
    way : (n,) array
        Fractions of the piece, from that end.
    found : BranchDiscs
        n discs there.
    forward : bool
        Whether they are seen from disc 0 to disc 1.
    """
    osculates = curve.osculating[end]
    if not osculates and (curve.axis.discs.radius[curve.disc[end]] > 0.0 or np.all(_are_known(curve, found))):
        return found
    tip = _osculating_tip(curve, end) if osculates else _Tip.of(curve, end, _vertex_width(curve, end))
    rows = np.flatnonzero(way < tip.width)
    if not len(rows):
        return found
    share = way[rows] / tip.width
    points = np.where((share == 0.0)[:, None], found.points[rows], tip.discs(share))
    radius = np.maximum(points[:, 2], 0.0)
    narrow = curve.described(points[:, :2], radius, tip.places(share), forward=forward)
    if osculates:
        narrow = _opened(narrow, tip, share, sign=1.0 if (end == 0) == forward else -1.0)
    error = np.where(share == 0.0, found.error[rows], narrow.error)
    return found.with_rows(rows, replace(narrow, error=error))


def _opened(narrow: BranchDiscs, tip: "_Tip", share: Floats, sign: float) -> BranchDiscs:
    """Take from the tip what two spokes that nearly agree do not tell; `sign` is -1 where the branch comes in."""
    return replace(
        narrow,
        # Away from such an end the radius grows, also right at it, where the normals do not tell.
        tangent=(sign * np.sign(narrow.rate))[:, None] * narrow.tangent,
        rate=sign * np.abs(narrow.rate),
        curvature=sign * tip.curvature(np.maximum(share, _NEAREST)),
        error=np.full(len(share), tip.error),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Tip:
    """The part of a piece next to an end whose feet come together, from the end (0) on (1), by the leading side.

    Attributes
    ----------
    width : float
        The part of the piece that it takes, as a fraction from the end.
    discs : callable
        x, y, r, mm: a polynomial through the end, and through three discs in their directions.
    places : callable
        Places on both sides: a polynomial through the same.
    error : float
        What discs solved for in between are off, mm, with a margin.
    """

    width: float
    discs: KroghInterpolator
    places: KroghInterpolator
    error: float

    @classmethod
    def of(cls, curve: PieceCurve, end: int, width: float) -> "_Tip":
        """Lay the polynomials through a part of a piece at one of its ends."""
        discs, t = curve.outwards(end, width * _KNOTS)
        slopes = width * curve.slopes(end, discs, t)
        first = curve.settled_point(end)[None]
        polynomial = KroghInterpolator(
            np.append(0.0, np.repeat(_KNOTS, 2)),
            np.concatenate([first, np.stack([discs.points, slopes], axis=1).reshape(-1, 3)]),
        )
        _, t = curve.outwards(end, width * _PLACES)
        places = KroghInterpolator(np.append(0.0, _PLACES), np.concatenate([[curve.ends(end)], t]))
        tip = cls(width, polynomial, places, 0.0)
        checks, _ = curve.outwards(end, width * _CHECKS)
        return replace(tip, error=_MARGIN * float(np.max(tip.off(checks) + checks.error)))

    def curvature(self, share: Floats) -> Floats:
        """Of the axis, positive to the left when seen away from the end."""
        first, second = self.discs.derivative(share, 1), self.discs.derivative(share, 2)
        return (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / np.hypot(first[:, 0], first[:, 1]) ** 3

    def off(self, discs: BranchDiscs) -> Floats:
        """How far the discs at `_CHECKS` are off, mm: not along the branch, where they are known less well."""
        away = self.discs(_CHECKS) - discs.points
        along = self.discs.derivative(_CHECKS, 1)
        along /= np.linalg.norm(along, axis=1)[:, None]
        return np.linalg.norm(away - np.einsum("ij,ij->i", away, along)[:, None] * along, axis=1)


def _osculating_tip(curve: PieceCurve, end: int) -> _Tip:
    """Lay the tip through the narrow part, or through less of it while that makes it better."""
    width = _narrow_width(curve, end)
    tip = _Tip.of(curve, end, width)
    while tip.error > _GOAL * curve.axis.frame.size and width > _LEAST:
        width /= 2
        smaller = _Tip.of(curve, end, width)
        if smaller.error >= tip.error:
            break
        tip = smaller
    return tip


def _narrow_width(curve: PieceCurve, end: int) -> float:
    width = 1.0
    for _ in range(_HALVINGS):
        discs, _ = curve.outwards(end, np.array([width / 2]))
        if np.sin(discs.object_angle[0]) < NARROW:
            break
        width /= 2
    return width


def _vertex_width(curve: PieceCurve, end: int) -> float:
    width = _NEAR_VERTEX
    while width < 1.0 and not np.all(_are_known(curve, curve.outwards(end, width * _PLACES)[0])):
        width *= 2
    return width


def _are_known(curve: PieceCurve, discs: BranchDiscs) -> NDArray[np.bool_]:
    """Whether discs are known as well as rounding allows; those of convex vertices are."""
    rounding = 2 * curve.rounding / np.maximum(np.sin(discs.object_angle), np.finfo(float).tiny)
    return (discs.radius == 0.0) | (discs.error <= _KNOWN * curve.axis.frame.size + rounding)
