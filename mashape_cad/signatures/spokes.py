"""Spokes: what each step of the boundary sees of the significant part of the medial axis."""

import math
from dataclasses import dataclass

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.tour import Ints
from mashape_cad.signatures.boundary_steps import BoundarySteps, equal_steps
from mashape_cad.signatures.branch_places import branch_places
from mashape_cad.signatures.compiled import compiled
from mashape_cad.signatures.geodesics import geodesics
from mashape_cad.signatures.retraction import retracted

__all__ = ["STEPS", "Spokes", "spokes"]

# Steps along the boundary. Fewer cost accuracy, more cost time by their square.
STEPS = 256
# Erosion thickness below which the axis is taken for noise, in square roots of the area: wider loses small features,
# narrower lets noise of the outline turn the spokes.
THICKNESS = 0.01
# A spoke this short (sizes) has no direction: the boundary's normal stands for it.
_NO_LENGTH = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Spokes:
    """Boundary points, each with the significant disc that belongs to it, in the tour's scale.

    Attributes
    ----------
    foot : (n, 2) array
        Boundary points at equal steps.
    weight : (n,) array
        Share of the perimeter; the sum is 1.
    centre : (n, 2) array
    radius : (n,) array
        Of the disc that touches there, or of the one it has been retracted to.
    direction : (n, 2) array
        Unit vector from foot to centre: the inward normal, but for what has been retracted.
    geodesic : (n, n) array
        Distances of the centres along the axis.
    area : float
        Of the domain.
    """

    foot: Floats
    weight: Floats
    centre: Floats
    radius: Floats
    direction: Floats
    geodesic: Floats
    area: float


def spokes(axis: MedialAxis, steps: int = STEPS, thickness: float = THICKNESS) -> Spokes:
    """Take spokes at equal steps along the boundary.

    Parameters
    ----------
    axis : MedialAxis
    steps : int
        How many on all loops together, about.
    thickness : float
        Erosion thickness below which the axis is left out, in square roots of the area.
    """
    boundary = equal_steps(axis, steps)
    if not axis.branches:
        return _of_disc(axis, boundary)
    places = branch_places(axis, boundary)
    discs = retracted(places, axis.nodes.radius / axis.frame.size, thickness * math.sqrt(boundary.area))
    point = _at(places.first, places.length, places.point, discs.branch, discs.along)
    spoke = point[:, :2] - boundary.point
    length = np.hypot(*spoke.T)[:, None]
    direction = np.where(length > _NO_LENGTH, spoke / np.maximum(length, _NO_LENGTH), boundary.normal)
    return Spokes(
        boundary.point,
        boundary.weight,
        point[:, :2].copy(),
        point[:, 2].copy(),
        direction,
        geodesics(places, discs),
        boundary.area,
    )


def _of_disc(axis: MedialAxis, boundary: BoundarySteps) -> Spokes:
    n = len(boundary.t)
    centre = np.tile((axis.discs.centre[0] - axis.frame.middle) / axis.frame.size, (n, 1))
    radius = np.full(n, axis.discs.radius[0] / axis.frame.size)
    return Spokes(boundary.point, boundary.weight, centre, radius, boundary.normal, np.zeros((n, n)), boundary.area)


@compiled
def _at(first: Ints, length: Floats, point: Floats, branch: Ints, along: Floats) -> Floats:
    """Return centre and radius at places of branches: (n, 3)."""
    out = np.empty((len(branch), 3))
    for k in range(len(branch)):
        low, high = first[branch[k]], first[branch[k] + 1] - 1
        while high - low > 1:
            middle = (low + high) // 2
            if length[middle] <= along[k]:
                low = middle
            else:
                high = middle
        width = length[high] - length[low]
        share = (along[k] - length[low]) / width if width > 0.0 else 0.0
        for j in range(3):
            out[k, j] = (1.0 - share) * point[low, j] + share * point[high, j]
    return out
