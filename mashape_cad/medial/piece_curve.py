"""One piece of a branch as a curve, away from ends where its feet come together: `PieceCurve`."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mashape_cad.geometry.edge import Edge, EllipseArc, Floats
from mashape_cad.medial.branch import discs_on_piece
from mashape_cad.medial.branch_discs import BranchDiscs, Feet, described
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.tour import Ints, site

__all__ = ["NARROW", "PieceCurve"]

# Sine of the object angle below which discs next to an osculating end are interpolated. A disc is known to rounding
# over its square: smaller, digits of the discs that the polynomial rests on are lost; larger, it has to span more.
NARROW = 0.05
# Part of a piece on which its sides are compared next to an osculating end.
_NEAR_END = 0.01
_INSIDE = 1e-13
# Rounding of a coordinate, a few operations deep.
_ROUNDING = 8 * np.finfo(float).eps


@dataclass(frozen=True, eq=False)
class PieceCurve:
    """A piece, evaluated at fractions of its leading side from its disc 0 to its disc 1.

    Attributes
    ----------
    axis : MedialAxis
    edges : tuple of Edge
        Those of the profile.
    number : int
        Of the piece.
    """

    axis: MedialAxis
    edges: tuple[Edge, ...]
    number: int

    @property
    def disc(self) -> Ints:
        """Settled discs at its ends, (2,)."""
        return self.axis.pieces.disc[self.number]

    @property
    def rounding(self) -> float:
        """What coordinates are known to, mm."""
        return float(_ROUNDING * (np.abs(self.axis.frame.middle).max() + self.axis.frame.size))

    def solved(self, along: Floats) -> tuple[Floats, Floats, Floats]:
        """Solve for discs: centres and radii, mm, and the places (n, 2) on both sides."""
        axis, lead = self.axis, self.lead
        low, high = axis.pieces.low[self.number, lead], axis.pieces.high[self.number, lead]
        t = np.empty((len(along), 2))
        t[:, lead] = low + along * (high - low) if lead == 0 else high - along * (high - low)
        rows = discs_on_piece(axis, self.number, t[:, lead], lead)
        t[:, 1 - lead] = rows[:, 3]
        return rows[:, :2] * axis.frame.size + axis.frame.middle, rows[:, 2] * axis.frame.size, t

    def described(self, centre: Floats, radius: Floats, t: Floats, *, forward: bool) -> BranchDiscs:
        """Complete discs whose places are known, as seen in one direction: forward, side 0 is on the right."""
        right, left = (self.feet(side, t[:, side]) for side in ((0, 1) if forward else (1, 0)))
        return described(centre, radius, right, left, self.rounding)

    def outwards(self, end: int, way: Floats) -> tuple[BranchDiscs, Floats]:
        """Discs at fractions from one end, seen in the direction away from it, and their places."""
        centre, radius, t = self.solved(way if end == 0 else 1.0 - way)
        return self.described(centre, radius, t, forward=end == 0), t

    def feet(self, side: int, t: Floats) -> Feet:
        """Feet on the exact edge of a side."""
        tour, element = self.axis.tour, int(self.axis.pieces.element[self.number, side])
        number = int(tour.edge[element])
        edge = self.edges[number]
        start, end = float(tour.edge_from[element]), float(tour.edge_to[element])
        if tour.degree[element] == 0:
            angle = tour.element["cone_angle"][element] + t * tour.element["cone_turn"][element]
            u = np.full(len(t), start)
            normal = np.column_stack([np.cos(angle), np.sin(angle)])
            return Feet(edge.point(u), number, u, normal, np.full(len(t), -np.inf))
        u = start + _fraction(edge, t, end - start) * (end - start)
        point = edge.point(u)
        # Where two spans of a spline meet its curvature may jump: a hair inside, it is that of this span.
        _, first, second = np.moveaxis(edge.derivatives(np.clip(u, start + _INSIDE, end - _INSIDE)), 1, 0)
        speed = np.hypot(first[:, 0], first[:, 1])
        curvature = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / speed**3
        return Feet(point, number, u, np.column_stack([-first[:, 1], first[:, 0]]) / speed[:, None], curvature)

    def settled_error(self, end: int) -> float:
        """Return what the disc at an end is known to, mm."""
        discs, disc = self.axis.discs, self.disc[end]
        return float(discs.tolerance[disc] + abs(discs.clearance[disc] - discs.radius[disc]) + self.rounding)

    def settled_point(self, end: int) -> Floats:
        """Centre and radius of the disc at an end: (3,)."""
        return np.append(self.axis.discs.centre[self.disc[end]], self.axis.discs.radius[self.disc[end]])

    def ends(self, end: int) -> tuple[float, float]:
        """Places of both sides at disc `end`: along side 1 the boundary runs back."""
        low, high = self.axis.pieces.low[self.number], self.axis.pieces.high[self.number]
        return (low[0], high[1]) if end == 0 else (high[0], low[1])

    @cached_property
    def osculating(self) -> tuple[bool, bool]:
        """Whether the feet come together at either end, at a disc that has a radius."""
        return self._osculates(0), self._osculates(1)

    def _osculates(self, end: int) -> bool:
        discs, disc = self.axis.discs, int(self.disc[end])
        if discs.degree[disc] != 1 or discs.radius[disc] == 0.0:
            return False
        n, m = (self.feet(side, np.array([t])).normal[0] for side, t in enumerate(self.ends(end)))
        return bool(np.hypot(*(n - m)) / 2 < NARROW)

    @cached_property
    def lead(self) -> int:
        """The side that is longer, or longer next to an osculating end."""
        pieces, osculating = self.axis.pieces, self.osculating
        part = _NEAR_END if any(osculating) else 1.0
        from_end = 1 if osculating == (False, True) else 0
        lengths = []
        for side in (0, 1):
            element, low, high = int(pieces.element[self.number, side]), *self._range(side)
            first, way = (low, high - low) if side == from_end else (high, low - high)
            points = np.array([site(self.axis.tour, element, first + part * way * k / 3)[:2] for k in range(4)])
            lengths.append(float(np.hypot(*np.diff(points, axis=0).T).sum()))
        return int(lengths[1] > lengths[0])

    def _range(self, side: int) -> tuple[float, float]:
        return float(self.axis.pieces.low[self.number, side]), float(self.axis.pieces.high[self.number, side])

    def slopes(self, end: int, discs: BranchDiscs, t: Floats) -> Floats:
        """Differentiate x, y, r by the fraction of the piece that lies behind, away from an end: (n, 3).

        While the centre moves by ds, a foot moves by sin(theta) / (1 - kappa r) ds.
        """
        lead = self.lead
        element, (low, high) = int(self.axis.pieces.element[self.number, lead]), self._range(lead)
        speed = np.array([site(self.axis.tour, element, place)[5] for place in t[:, lead].tolist()])
        right = lead if end == 0 else 1 - lead
        opening = 1.0 - discs.boundary_curvature[:, right] * discs.radius
        step = (high - low) * self.axis.frame.size * speed * opening / np.sin(discs.object_angle)
        return step[:, None] * np.column_stack([discs.tangent, discs.rate])


def _fraction(edge: Edge, t: Floats, width: float) -> Floats:
    """Fraction of a span's edge parameter at its Bezier parameter; only of arcs they differ, where u is the angle."""
    if not isinstance(edge, EllipseArc):
        return t
    quarter = edge.sweep * width / 4
    return (1.0 + np.arctan((2.0 * t - 1.0) * np.tan(quarter)) / quarter) / 2.0
