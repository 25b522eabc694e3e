"""Whether the settled discs of an axis are what they claim: measured by the kernel, and from each of their contacts.

The kernel's distance from a centre to the whole boundary is the radius: no other point of the boundary is nearer. Each
contact lies one radius away, on the normal that leads to the centre; at a reflex vertex the normal is one of its cone.
Both components are looked at, along the normal and across it, since a centre that slides along a corridor keeps its
distance.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.objection import Objection
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["ACCURACY", "Confirmation", "confirmation"]

# Largest error, relative to the diagonal, at which a disc counts as maximal; what a disc has on record comes on top.
ACCURACY = 1e-7
# Feet of discs that follow the boundary closely are known to the root of the distance's rounding, and so is where the
# boundary's tour, from which kinks of rounded files were taken out, passes by the edge itself (sizes).
_ON_EDGE = 3e-8


@dataclass(frozen=True, slots=True, eq=False)
class Confirmation:
    """Errors of the settled discs, mm, and what stands against them.

    Attributes
    ----------
    disc : (m,) array
        Difference between radius and the kernel's distance.
    foot : (m,) array
        Largest difference between radius and the distance to a contact or footpoint.
    slant : (m,) array
        Largest distance of the centre from the normal of a contact.
    objections : tuple of Objection
    """

    disc: Floats
    foot: Floats
    slant: Floats
    objections: tuple[Objection, ...]


def confirmation(axis: MedialAxis, diagonal: float) -> Confirmation:
    """Measure all settled discs of an axis anew, in a profile of that diagonal, mm."""
    discs, contacts, size = axis.discs, axis.contacts, axis.frame.size
    measured = DistanceQuery(axis.profile).distances(discs.centre)
    disc = np.maximum(np.abs(measured - discs.radius), np.abs(measured - discs.clearance))
    centre = (discs.centre - axis.frame.middle) / size
    off, slant = _contact_errors(axis.tour, contacts.first, contacts.last, contacts.disc, centre, discs.radius / size)
    spokes = np.linalg.norm(discs.foot - discs.centre[:, None], axis=2)
    foot = np.maximum(off * size, np.abs(spokes - discs.radius[:, None]).max(axis=1))
    limit = ACCURACY * diagonal + discs.tolerance
    found = (
        *_too_large(axis, "disc", disc - limit, disc, "is off the kernel's distance to the boundary by"),
        *_too_large(axis, "foot", foot - limit, foot, "misses one of its contacts by"),
        *_too_large(axis, "foot", slant * size - limit, slant * size, "has its centre off the normal of a contact by"),
        *_stray_feet(axis),
    )
    return Confirmation(disc, foot, slant * size, found)


def _too_large(axis: MedialAxis, check: str, excess: Floats, error: Floats, text: str) -> Iterator[Objection]:
    for k in np.flatnonzero(~(excess <= 0.0)):
        at = f"disc {k} of radius {axis.discs.radius[k]:.6g} {text} {error[k]:.2g} mm"
        yield Objection.at(check, at, axis.discs.centre[k])


def _stray_feet(axis: MedialAxis) -> Iterator[Objection]:
    """Footpoints lie on their edges, where edge and parameter say."""
    discs, edges = axis.discs, axis.profile.edges
    numbers, u = discs.foot_edge.ravel(), discs.foot_u.ravel()
    points = np.empty((len(numbers), 2))
    for number in np.unique(numbers):
        here = numbers == number
        points[here] = edges[number].point(u[here])
    off = np.linalg.norm(points - discs.foot.reshape(-1, 2), axis=1).reshape(-1, 2).max(axis=1)
    for k in np.flatnonzero(off > _ON_EDGE * axis.frame.size + discs.tolerance):
        yield Objection.at("foot", f"a footpoint of disc {k} lies {off[k]:.2g} mm off its edge", discs.foot[k, 0])


@compiled
def _contact_errors(
    tour: Tour, first: Floats, last: Floats, disc: Ints, centre: Floats, radius: Floats
) -> tuple[Floats, Floats]:
    """Return the largest errors of each disc's contacts along and across their normals, in the tour's scale."""
    off, slant = np.zeros(len(radius)), np.zeros(len(radius))
    for k in range(len(disc)):
        d = disc[k]
        e, t = int(first[k, 0]), first[k, 1]
        f, s = int(last[k, 0]), last[k, 1]
        x, y, r = centre[d, 0], centre[d, 1], radius[d]
        if e == f and t == s:
            along, across = _off_normal(tour, e, t, x, y, r)
            off[d], slant[d] = max(off[d], along), max(slant[d], across)
            continue
        for _ in range(len(tour.element)):
            # An arc: the ends and the middle of each of its elements, up to the border where it ends.
            to = s if e == f and s > t else 1.0
            for place in (t, (t + to) / 2, to):
                along, across = _off_normal(tour, e, place, x, y, r)
                off[d], slant[d] = max(off[d], along), max(slant[d], across)
            if (
                to < 1.0
                or (tour.element[e].after == f and s == 0.0)
                or (f == len(tour.element) and tour.element[e].after == 0)
            ):
                break
            e, t = tour.element[e].after, 0.0
    return off, slant


@compiled
def _off_normal(tour: Tour, e: int, t: float, x: float, y: float, r: float) -> tuple[float, float]:
    """Return how far a centre is from lying a radius up the normal of a place: along it and across it.

    At a border the spans of both sides have a say: their normals differ by a kink of 1e-7, or by the angle of a convex
    vertex whose disc has radius 0.
    """
    along, across = _beside(tour, e, t, x, y, r)
    if t == 0.0 and tour.element[e].degree > 0 and tour.element[tour.element[e].before].degree > 0:
        other_along, other_across = _beside(tour, tour.element[e].before, 1.0, x, y, r)
        if max(other_along, other_across) < max(along, across):
            return other_along, other_across
    return along, across


@compiled
def _beside(tour: Tour, e: int, t: float, x: float, y: float, r: float) -> tuple[float, float]:
    qx, qy, nx, ny, _, _ = site(tour, e, t)
    return abs((x - qx) * nx + (y - qy) * ny - r), abs((x - qx) * ny - (y - qy) * nx)
