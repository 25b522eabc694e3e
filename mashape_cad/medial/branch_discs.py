"""Discs on a branch with all that their two feet tell: `BranchDiscs`.

Formulas
--------
Seen in the direction of the branch, one foot lies on its right, the other on its left. With their inward unit normals n
and m, and theta the angle between tangent T and spoke (the *object angle*, when folded to at most 90 degrees):

* n - m = 2 sin(theta) N, N being T turned to the left; n + m = 2 cos(theta) T;
* r' = cos(theta) by arc length of the axis;
* curvature of the axis, positive to the left, = sin(theta) (k_right - k_left) / 2, with k = kappa / (1 - kappa r) for a
  foot on a curve of curvature kappa (positive where it bends inwards) and k = -1 / r at a reflex vertex.

They follow from the derivative of a spoke, ``d(foot)/ds = sin(theta) / (1 - kappa r)``.

References
----------
J. Damon, Smoothness and geometry of boundaries associated to skeletal structures I, Annales de l'Institut Fourier 53
(2003): radial curvature.
"""

from dataclasses import dataclass, fields, replace

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints

__all__ = ["NO_TURN", "BranchDiscs", "Feet", "described", "gathered"]

NO_TURN = 1e-9  # sine of an object angle that does not tell whether the branch comes or goes
_OSCULATING = 1e-9  # smallest 1 - kappa r that a bound divides by


@dataclass(frozen=True, slots=True, eq=False)
class BranchDiscs:
    """Maximal discs on a branch, n of them; feet on the right come first, those on the left second.

    Attributes
    ----------
    centre : (n, 2) array
        mm.
    radius : (n,) array
        Clearance, mm.
    foot : (n, 2, 2) array
        Footpoints, on the exact edges, mm.
    foot_edge, foot_u : (n, 2) arrays
        Their edges, counted as in ``profile.edges``, and parameters.
    tangent : (n, 2) array
        Unit tangent of the medial axis in the direction of the branch.
    rate : (n,) array
        Change of the radius by arc length of the axis: between -1 and 1.
    object_angle : (n,) array
        Half the angle between the two spokes, radians: 0 at an osculating end, pi / 2 between parallel walls.
    curvature : (n,) array
        Of the medial axis, 1/mm, positive to the left. At an osculating end it may be infinite; given is its value
        next to it.
    boundary_curvature : (n, 2) array
        Of the boundary at the feet, 1/mm, positive where it bends inwards; -inf at a reflex vertex. Where edges meet,
        of the edge that the disc's piece runs along.
    error : (n,) array
        Bound, mm: centre and radius are within it of a disc that touches the boundary on both sides. Obtained from the
        disc itself: how far it misses the two exact edges, rounding included, over the sine of the object angle, by
        which two nearly equal spokes magnify what is missed. At nodes and other settled discs: their tolerance, and
        what the kernel's distance differs from the radius. Next to an osculating end: four times what the polynomial
        misses discs solved for there; on a thin piece: how far it may be off its chord. As a rule 1e-14 of the size,
        1e-11 at nodes and next to osculating ends. That no third part of the boundary enters a disc is as sure as for
        the settled discs between which it lies, which is to their tolerance.
    """

    centre: Floats
    radius: Floats
    foot: Floats
    foot_edge: Ints
    foot_u: Floats
    tangent: Floats
    rate: Floats
    object_angle: Floats
    curvature: Floats
    boundary_curvature: Floats
    error: Floats

    @property
    def points(self) -> Floats:
        """Centres and radii: (n, 3)."""
        return np.column_stack([self.centre, self.radius])

    def with_rows(self, rows: Ints, others: "BranchDiscs") -> "BranchDiscs":
        """Return the same with some of the discs replaced."""
        arrays = {}
        for each in fields(self):
            array = getattr(self, each.name).copy()
            array[rows] = getattr(others, each.name)
            arrays[each.name] = array
        return replace(self, **arrays)


@dataclass(frozen=True, slots=True, eq=False)
class Feet:
    """Feet on one side of a branch.

    Attributes
    ----------
    point : (n, 2) array
        On the exact edge, mm.
    edge : int
        Its number.
    u : (n,) array
        Its parameters.
    normal : (n, 2) array
        Inward unit normals; at a reflex vertex one of those of its cone.
    curvature : (n,) array
        1/mm, positive where the boundary bends inwards; -inf at a reflex vertex.
    """

    point: Floats
    edge: int
    u: Floats
    normal: Floats
    curvature: Floats


def gathered(parts: list[BranchDiscs], order: Ints) -> BranchDiscs:
    """Return the discs of all parts in an order of their rows, read-only."""
    arrays = []
    for each in fields(BranchDiscs):
        array = np.concatenate([getattr(part, each.name) for part in parts])[order]
        array.setflags(write=False)
        arrays.append(array)
    return BranchDiscs(*arrays)


def described(centre: Floats, radius: Floats, right: Feet, left: Feet, rounding: float) -> BranchDiscs:
    """Complete discs by what the formulas of the module's text say.

    Parameters
    ----------
    centre : (n, 2) array
    radius : (n,) array
    right, left : Feet
        Of n feet each.
    rounding : float
        Of coordinates, mm.
    """
    tangent, sine, cosine = _tangent(right.normal, left.normal)
    rate = np.clip(np.einsum("ij,ij->i", tangent, right.normal + left.normal) / 2, -1.0, 1.0)
    with np.errstate(invalid="ignore"):  # 0 times infinity at an osculating end, where the tip takes over
        curvature = sine * (_bend(right.curvature, radius) - _bend(left.curvature, radius)) / 2
    missed = np.maximum(_missed(right, centre, radius), _missed(left, centre, radius)) + rounding
    return BranchDiscs(
        centre,
        radius,
        np.stack([right.point, left.point], axis=1),
        np.tile(np.array([right.edge, left.edge], dtype=np.int64), (len(radius), 1)),
        np.column_stack([right.u, left.u]),
        tangent,
        rate,
        np.arctan2(sine, cosine),
        curvature,
        np.column_stack([right.curvature, left.curvature]),
        missed / np.maximum(sine, np.finfo(float).tiny),
    )


def _tangent(n: Floats, m: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the unit tangent, and sine and cosine of the object angle, from the normals at the right and left foot.

    The difference of the normals tells the direction, their sum tells it better where they nearly agree.
    """
    apart, together = (n - m) / 2, (n + m) / 2
    sine, cosine = np.hypot(*apart.T), np.hypot(*together.T)
    tangent = np.column_stack([apart[:, 1], -apart[:, 0]])
    # Where the normals agree altogether, only the end itself tells whether the branch comes or goes (`branch_tip`).
    sign = np.where((np.einsum("ij,ij->i", tangent, together) >= 0) | (sine < NO_TURN), 1.0, -1.0)
    tangent = np.where((cosine > sine)[:, None], sign[:, None] * together, tangent)
    return tangent / np.hypot(*tangent.T)[:, None], sine, cosine


def _bend(curvature: Floats, radius: Floats) -> Floats:
    """Curvature of the boundary carried to the centre: kappa / (1 - kappa r); -1 / r at a reflex vertex."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(np.isinf(curvature), -1.0 / radius, curvature / (1.0 - curvature * radius))


def _missed(feet: Feet, centre: Floats, radius: Floats) -> Floats:
    """How far circles are off the boundary near their feet: at the foot, and beside it where the spoke is slanted.

    At a reflex vertex the spoke is slanted against the cone's normal where it leaves the cone, and is beside an edge.
    """
    spoke = feet.point - centre
    off = np.abs(np.hypot(*spoke.T) - radius)
    slant = feet.normal[:, 1] * spoke[:, 0] - feet.normal[:, 0] * spoke[:, 1]
    bend = np.where(np.isinf(feet.curvature), 0.0, feet.curvature)
    opening = np.maximum(1.0 - bend * radius, _OSCULATING)
    return off + np.where(radius == 0.0, 0.0, slant**2 / (2 * np.maximum(radius, np.finfo(float).tiny) * opening))
