"""A branch as a curve: its discs anywhere, with feet, tangent, curvatures and a stated error: `discs_on_branch`.

Parameter
---------
A branch of n pieces is run through by ``s`` from 0 (its start node) to n (its end node); whole numbers are its settled
discs. Inside a piece the fraction of ``s`` counts along the boundary parameter of the *leading* side: the one whose
boundary is longer (next to an osculating end: longer there), never a reflex vertex where the other side is an edge. The
centre moves forward throughout, but not evenly.

Formulas
--------
Seen in the direction of the branch, one foot lies on its right, the other on its left. With their inward unit normals n
and m, and theta the angle between tangent T and spoke (the *object angle*, when folded to at most 90 degrees):

* n - m = 2 sin(theta) N, N being T turned to the left; n + m = 2 cos(theta) T;
* r' = cos(theta) by arc length of the axis;
* curvature of the axis, positive to the left, = sin(theta) (k_right - k_left) / 2, with k = kappa / (1 - kappa r) for a
  foot on a curve of curvature kappa (positive where it bends inwards) and k = -1 / r at a reflex vertex.

They follow from the derivative of a spoke, ``d(foot)/ds = sin(theta) / (1 - kappa r)``.

Ends that osculate
------------------
At such an end both feet come together, and a disc near it is known the less the nearer it is: its two equations become
the same. There x, y, r and the other foot are polynomials in the boundary parameter of the leading side, from the end,
whose disc is exact, to the first disc whose object angle is above `_NARROW`. They are smooth in it as far as the
boundary is. By the arc length of the axis they need not be: where curvature, or its slope, jumps at the end, the feet
leave it unequally fast, and the axis may turn with the root of its length. Very close to a convex vertex the feet come
together too, and the same is done.

References
----------
J. Damon, Smoothness and geometry of boundaries associated to skeletal structures I, Annales de l'Institut Fourier 53
(2003): radial curvature. G. Farin, Curves and Surfaces for CAGD, 5th ed., section 6.5 (Hermite interpolation).
"""

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import KroghInterpolator

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.branch import discs_on_piece
from mashape_cad.medial.graph import Branch, MedialAxis
from mashape_cad.medial.tour import Ints, site

__all__ = ["BranchDiscs", "discs_on_branch"]

# Sine of the object angle below which discs next to an osculating end are interpolated. A disc is known to rounding
# over its square: smaller, digits of the discs that the polynomial rests on are lost; larger, it has to span more.
_NARROW = 0.05
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
# Closer to the end (fraction of the narrow part) the curvature of the axis is given as constant: it is a quotient of
# two differences there, and may grow beyond all bounds.
_NEAREST = 0.2
# Rounding of a coordinate, a few operations deep.
_ROUNDING = 8 * np.finfo(float).eps
# Part of a piece on which its sides are compared next to an osculating end.
_NEAR_END = 0.01
_NO_TURN = 1e-9  # sine of an object angle that does not tell whether the branch comes or goes
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
        what the kernel's distance differs from the radius. Next to an osculating end: four times what the
        polynomial misses discs solved for there. As a rule 1e-14 of the size, 1e-11 at nodes and
        next to osculating ends.
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
    found = [(np.flatnonzero(number == k), k) for k in np.unique(number)]
    parts = [_on_piece(axis, branch.pieces[k], s[rows] - k) for rows, k in found]
    order = np.argsort(np.concatenate([rows for rows, _ in found]))
    return _gathered(parts, order)


def _gathered(parts: list[BranchDiscs], order: Ints) -> BranchDiscs:
    arrays = []
    for each in fields(BranchDiscs):
        array = np.concatenate([getattr(part, each.name) for part in parts])[order]
        array.setflags(write=False)
        arrays.append(array)
    return BranchDiscs(*arrays)


def _on_piece(axis: MedialAxis, step: tuple[int, bool], fraction: Floats) -> BranchDiscs:
    """Evaluate a piece at fractions of its leading side, in the direction of its branch."""
    piece, forward = step
    along = fraction if forward else 1.0 - fraction
    centre, radius, t = _solved(axis, piece, along)
    settled = [along == 0.0, along == 1.0]
    for end in (0, 1):
        disc = axis.pieces.disc[piece, end]
        centre[settled[end]], radius[settled[end]] = axis.discs.centre[disc], axis.discs.radius[disc]
        t[settled[end]] = _ends(axis, piece, end)
    found = _described(axis, piece, forward, centre, radius, t)
    for end in (0, 1):
        disc = axis.pieces.disc[piece, end]
        off = abs(axis.discs.clearance[disc] - axis.discs.radius[disc])
        found.error[settled[end]] = axis.discs.tolerance[disc] + off + _rounding(axis)
        found = _with_tip(axis, piece, forward, end, along if end == 0 else 1.0 - along, found)
    return found


def _solved(axis: MedialAxis, piece: int, along: Floats) -> tuple[Floats, Floats, Floats]:
    """Return centres and radii, mm, and the places (n, 2) of both sides, at fractions from disc 0 to disc 1."""
    lead = _leading_side(axis, piece)
    low, high = axis.pieces.low[piece, lead], axis.pieces.high[piece, lead]
    t = np.empty((len(along), 2))
    t[:, lead] = low + along * (high - low) if lead == 0 else high - along * (high - low)
    rows = discs_on_piece(axis, piece, t[:, lead], lead)
    t[:, 1 - lead] = rows[:, 3]
    return rows[:, :2] * axis.frame.size + axis.frame.middle, rows[:, 2] * axis.frame.size, t


def _leading_side(axis: MedialAxis, piece: int) -> int:
    pieces = axis.pieces
    part = 1.0
    at_low = True
    for end in (0, 1):
        if _osculates(axis, piece, end):
            part, at_low = _NEAR_END, end == 0
            break
    lengths = []
    for side in (0, 1):
        element, low, high = int(pieces.element[piece, side]), pieces.low[piece, side], pieces.high[piece, side]
        first, way = (low, high - low) if at_low == (side == 0) else (high, low - high)
        points = np.array([site(axis.tour, element, first + part * way * k / 3)[:2] for k in range(4)])
        lengths.append(float(np.hypot(*np.diff(points, axis=0).T).sum()))
    return int(lengths[1] > lengths[0])


def _ends(axis: MedialAxis, piece: int, end: int) -> tuple[float, float]:
    """Places of both sides at one of the discs of a piece: along side 1 the boundary runs back."""
    low, high = axis.pieces.low[piece], axis.pieces.high[piece]
    return (low[0], high[1]) if end == 0 else (high[0], low[1])


@dataclass(frozen=True, slots=True, eq=False)
class _Feet:
    """Feet on one side: positions, edge parameters, inward normals, tangents and curvatures."""

    point: Floats
    u: Floats
    normal: Floats
    curvature: Floats


def _feet(axis: MedialAxis, element: int, t: Floats) -> _Feet:
    tour = axis.tour
    edge = axis.profile.edges[int(tour.edge[element])]
    if tour.degree[element] == 0:
        angle = tour.cone[element, 0] + t * tour.cone[element, 1]
        point = np.repeat(edge.start[None], len(t), axis=0)
        normal = np.column_stack([np.cos(angle), np.sin(angle)])
        return _Feet(point, np.zeros(len(t)), normal, np.full(len(t), -np.inf))
    u = np.array([foot(axis.profile, tour, (element, place))[1] for place in t.tolist()])
    point, first, second = np.moveaxis(edge.derivatives(u), 1, 0)
    speed = np.hypot(first[:, 0], first[:, 1])
    normal = np.column_stack([-first[:, 1], first[:, 0]]) / speed[:, None]
    return _Feet(point, u, normal, (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / speed**3)


def _described(axis: MedialAxis, piece: int, forward: bool, centre: Floats, radius: Floats, t: Floats) -> BranchDiscs:
    """Complete discs whose places are known by what the formulas of the module's text say."""
    sides = (0, 1) if forward else (1, 0)
    elements = axis.pieces.element[piece, list(sides)]
    feet = [_feet(axis, int(e), t[:, side]) for e, side in zip(elements, sides, strict=True)]
    n, m = feet[0].normal, feet[1].normal
    tangent, sine, cosine = _tangent(n, m)
    rate = np.clip(np.einsum("ij,ij->i", tangent, n + m) / 2, -1.0, 1.0)
    bends = np.column_stack([_bend(each.curvature, radius) for each in feet])
    with np.errstate(invalid="ignore"):  # 0 times infinity at an osculating end, where the polynomial takes over
        curvature = sine * (bends[:, 0] - bends[:, 1]) / 2
    missed = np.max([_missed(each, centre, radius) for each in feet], axis=0) + _rounding(axis)
    return BranchDiscs(
        centre,
        radius,
        np.stack([each.point for each in feet], axis=1),
        np.tile(axis.tour.edge[elements], (len(radius), 1)),
        np.column_stack([each.u for each in feet]),
        tangent,
        rate,
        np.arctan2(sine, cosine),
        curvature,
        np.column_stack([each.curvature for each in feet]),
        missed / np.maximum(sine, np.finfo(float).tiny),
    )


def _tangent(n: Floats, m: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the unit tangent, and sine and cosine of the object angle, from the normals at the right and left foot.

    The difference of the normals tells the direction, their sum tells it better where they nearly agree.
    """
    apart, together = (n - m) / 2, (n + m) / 2
    sine, cosine = np.hypot(*apart.T), np.hypot(*together.T)
    tangent = np.column_stack([apart[:, 1], -apart[:, 0]])
    # Where the normals agree altogether, only the end itself tells whether the branch comes or goes (`_with_tip`).
    sign = np.where((np.einsum("ij,ij->i", tangent, together) >= 0) | (sine < _NO_TURN), 1.0, -1.0)
    tangent = np.where((cosine > sine)[:, None], sign[:, None] * together, tangent)
    return tangent / np.hypot(*tangent.T)[:, None], sine, cosine


def _bend(curvature: Floats, radius: Floats) -> Floats:
    """Curvature of the boundary carried to the centre: kappa / (1 - kappa r); -1 / r at a reflex vertex."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(np.isinf(curvature), -1.0 / radius, curvature / (1.0 - curvature * radius))


def _missed(feet: _Feet, centre: Floats, radius: Floats) -> Floats:
    """How far circles are off the boundary near their feet: at the foot, and beside it where the spoke is slanted.

    At a reflex vertex the spoke is slanted against the cone's normal where it leaves the cone, and is beside an edge.
    """
    spoke = feet.point - centre
    off = np.abs(np.hypot(*spoke.T) - radius)
    slant = feet.normal[:, 1] * spoke[:, 0] - feet.normal[:, 0] * spoke[:, 1]
    bend = np.where(np.isinf(feet.curvature), 0.0, feet.curvature)
    opening = np.maximum(1.0 - bend * radius, _OSCULATING)
    return off + np.where(radius == 0.0, 0.0, slant**2 / (2 * np.maximum(radius, np.finfo(float).tiny) * opening))


def _rounding(axis: MedialAxis) -> float:
    return float(_ROUNDING * (np.abs(axis.frame.middle).max() + axis.frame.size))


# Osculating ends


def _osculates(axis: MedialAxis, piece: int, end: int) -> bool:
    """Whether a piece ends, at its disc `end`, in a disc whose feet come together."""
    disc = int(axis.pieces.disc[piece, end])
    if axis.discs.degree[disc] != 1 or axis.discs.radius[disc] == 0.0:
        return False
    t = np.array([_ends(axis, piece, end)])
    n, m = (_feet(axis, int(axis.pieces.element[piece, side]), t[:, side]).normal for side in (0, 1))
    return bool(_tangent(n, m)[1][0] < _NARROW)


def _with_tip(axis: MedialAxis, piece: int, forward: bool, end: int, way: Floats, found: BranchDiscs) -> BranchDiscs:
    """Replace what lies next to an end whose feet come together; `way` counts from that end."""
    osculates = _osculates(axis, piece, end)
    if not osculates and axis.discs.radius[axis.pieces.disc[piece, end]] > 0.0:
        return found
    tip = _Tip.of(axis, piece, end, _narrow_width(axis, piece, end) if osculates else _vertex_width(axis, piece, end))
    rows = np.flatnonzero(way < tip.width)
    if not len(rows):
        return found
    share = way[rows] / tip.width
    discs = tip.discs(share)
    discs[share == 0.0] = np.column_stack([found.centre, found.radius])[rows[share == 0.0]]
    narrow = _described(axis, piece, forward, discs[:, :2], np.maximum(discs[:, 2], 0.0), tip.places(share))
    if osculates:
        narrow = _opened(narrow, tip, share, sign=1.0 if (end == 0) == forward else -1.0)
    narrow.error[share == 0.0] = found.error[rows[share == 0.0]]
    for each in fields(BranchDiscs):
        getattr(found, each.name)[rows] = getattr(narrow, each.name)
    return found


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
    def of(cls, axis: MedialAxis, piece: int, end: int, width: float) -> "_Tip":
        """Lay the polynomials through a part of a piece at one of its ends."""
        node = axis.pieces.disc[piece, end]
        discs, t = _outwards(axis, piece, end, width * _KNOTS)
        values = np.column_stack([discs.centre, discs.radius])
        slopes = width * _by_fraction(axis, piece, end, discs, t)
        first = [[*axis.discs.centre[node], axis.discs.radius[node]]]
        curve = KroghInterpolator(
            np.append(0.0, np.repeat(_KNOTS, 2)),
            np.concatenate([first, np.stack([values, slopes], axis=1).reshape(-1, 3)]),
        )
        _, t = _outwards(axis, piece, end, width * _PLACES)
        places = KroghInterpolator(np.append(0.0, _PLACES), np.concatenate([[_ends(axis, piece, end)], t]))
        tip = cls(width, curve, places, 0.0)
        checks, _ = _outwards(axis, piece, end, width * _CHECKS)
        return replace(tip, error=_MARGIN * float(np.max(tip.off(checks) + checks.error)))

    def curvature(self, share: Floats) -> Floats:
        """Of the axis, positive to the left when seen away from the end."""
        first, second = self.discs.derivative(share, 1), self.discs.derivative(share, 2)
        return (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / np.hypot(first[:, 0], first[:, 1]) ** 3

    def off(self, discs: BranchDiscs) -> Floats:
        """How far the discs at `_CHECKS` are off, mm: not along the branch, where they are known less well."""
        away = self.discs(_CHECKS) - np.column_stack([discs.centre, discs.radius])
        along = self.discs.derivative(_CHECKS, 1)
        along /= np.linalg.norm(along, axis=1)[:, None]
        return np.linalg.norm(away - np.einsum("ij,ij->i", away, along)[:, None] * along, axis=1)


def _narrow_width(axis: MedialAxis, piece: int, end: int) -> float:
    width = 1.0
    for _ in range(_HALVINGS):
        discs, _ = _outwards(axis, piece, end, np.array([width / 2]))
        if np.sin(discs.object_angle[0]) < _NARROW:
            break
        width /= 2
    return width


def _vertex_width(axis: MedialAxis, piece: int, end: int) -> float:
    width = _NEAR_VERTEX
    while width < 1.0 and not _are_known(axis, piece, end, width):
        width *= 2
    return width


def _are_known(axis: MedialAxis, piece: int, end: int, width: float) -> bool:
    discs, _ = _outwards(axis, piece, end, width * _PLACES)
    return bool(np.all(discs.error <= _KNOWN * axis.frame.size + 2 * _rounding(axis) / np.sin(discs.object_angle)))


def _outwards(axis: MedialAxis, piece: int, end: int, way: Floats) -> tuple[BranchDiscs, Floats]:
    """Discs solved for at fractions from one end of a piece, seen in the direction away from that end; their places."""
    centre, radius, t = _solved(axis, piece, way if end == 0 else 1.0 - way)
    return _described(axis, piece, end == 0, centre, radius, t), t


def _by_fraction(axis: MedialAxis, piece: int, end: int, discs: BranchDiscs, t: Floats) -> Floats:
    """Differentiate x, y, r by the fraction of the piece that lies behind, away from an end: (n, 3).

    While the centre moves by ds, a foot moves by sin(theta) / (1 - kappa r) ds.
    """
    lead = _leading_side(axis, piece)
    element = int(axis.pieces.element[piece, lead])
    width = axis.pieces.high[piece, lead] - axis.pieces.low[piece, lead]
    speed = np.array([site(axis.tour, element, place)[5] for place in t[:, lead].tolist()]) * axis.frame.size
    right = lead if end == 0 else 1 - lead
    opening = 1.0 - discs.boundary_curvature[:, right] * discs.radius
    step = width * speed * opening / np.sin(discs.object_angle)
    return step[:, None] * np.column_stack([discs.tangent, discs.rate])
