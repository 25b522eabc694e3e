"""Whether the discs of an axis cover the profile, exactly.

From a boundary place the *spoke* leads along the normal to the centre of its disc. By the definition of the axis the
spokes of all places fill the domain without overlap: a point lies on the spoke of the boundary place nearest to it.
So the area swept by spokes of length r along the boundary, ``integral of (r - curvature r^2 / 2) ds``, and ``r^2 / 2``
for each radian at a reflex vertex, is the area of the domain. In the same way the spokes of a piece fill the region
between its two stretches of boundary and the spokes of its two end discs; Green's theorem gives its area from its
outline.

That is no tautology. A piece claims, for each place of one side, that its twin lies on the other side. The radius that
follows is the smallest over that stretch alone, at most the radius of curvature: never smaller than that of the maximal
disc, and larger wherever the true twin lies elsewhere. So the area swept is at least that of the domain, and equal only
if the discs are maximal at almost all places: faults cannot cancel. (Outlines would: those of all regions add up to the
profile whatever the discs are. They serve to tell at which piece a fault lies.)

Radii between the settled discs are found anew here, by Gauss-Kronrod quadrature that halves where it is not sure. What
rounding may do to a radius is integrated along: two feet a distance h apart tell it to about ``r^2 / h^2`` roundings
only. That is nothing, save in the thin branches of kinks of 1e-7 radians, whose stretches are as short.

Where two edges meet at a kink that is rounding, one disc touches both, and the spokes on either side of it overlap by
``kink r^2 / 2``, or leave as much out: that is taken off the whole, and allowed at the pieces beside it.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.candidates import turns
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.objection import Objection
from mashape_cad.medial.sweep import swept_by_arcs, swept_by_pieces

__all__ = ["Coverage", "coverage"]

# Largest difference, relative to the profile's area, between what discs sweep and the region that they should: a
# hundred times what quadrature leaves. A looser one lets features be left out that measure its root of the size.
_AREA = 1e-8


@dataclass(frozen=True, slots=True, eq=False)
class Coverage:
    """What the discs of an axis cover.

    Attributes
    ----------
    area : float
        Swept by the spokes of all boundary places, mm2.
    excess, uncertain : (p,) arrays
        Of each piece: area swept less area of its region, and what rounding may have done to that, mm2.
    objections : tuple of Objection
    """

    area: float
    excess: Floats
    uncertain: Floats
    objections: tuple[Objection, ...]


def coverage(axis: MedialAxis, whole: float) -> Coverage:
    """Measure what the discs cover of the profile's area `whole`, mm2."""
    tour, pieces, contacts, size = axis.tour, axis.pieces, axis.contacts, axis.frame.size
    centre, radius = (axis.discs.centre - axis.frame.middle) / size, axis.discs.radius / size
    swept, region, uncertain = swept_by_pieces(
        tour, pieces.element, pieces.low, pieces.high, pieces.disc, centre, radius
    )
    arcs = swept_by_arcs(tour, contacts.first, contacts.last, radius[contacts.disc])
    overlap = _overlap_at_kinks(axis)
    excess = (swept - region) * size**2
    uncertain = (uncertain + np.abs(overlap)[pieces.disc].sum(axis=1)) * size**2
    area = float(swept.sum() + arcs.sum() - overlap.sum()) * size**2
    return Coverage(area, excess, uncertain, tuple(_objections(axis, whole, area, excess, uncertain)))


def _overlap_at_kinks(axis: MedialAxis) -> Floats:
    """By how much spokes overlap where a disc touches at kinks, in the tour's scale: (n,) for the discs."""
    contacts, turned = axis.contacts, np.append(turns(axis.tour), 0.0)
    first, last = contacts.first[:, 0].astype(int), contacts.last[:, 0].astype(int)
    turn = np.where(contacts.first[:, 1] == 0.0, turned[first], 0.0)
    is_arc = (contacts.first != contacts.last).any(axis=1)
    turn += np.where(is_arc & (contacts.last[:, 1] == 0.0), turned[last], 0.0)
    radius = axis.discs.radius / axis.frame.size
    return np.bincount(contacts.disc, turn, minlength=len(radius)) * radius**2 / 2


def _objections(axis: MedialAxis, whole: float, area: float, excess: Floats, uncertain: Floats) -> Iterator[Objection]:
    pieces = axis.pieces
    for piece in np.flatnonzero(~(np.abs(excess) <= _AREA * whole + uncertain)):
        sides = " and ".join(str(axis.tour.edge[e]) for e in pieces.element[piece])
        text = f"the discs of piece {piece}, between edges {sides}, cover {excess[piece]:+.2g} mm2 beyond its region"
        yield Objection.at("area", text, axis.discs.centre[pieces.disc[piece]].mean(axis=0))
    if not abs(area - whole) <= _AREA * whole + uncertain.sum():
        yield Objection("area", f"all discs cover {area:.9g} mm2 of {whole:.9g} mm2")
