"""What two aligned outlines have in common and how they differ: `compared`."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats, Similarity
from mashape_cad.matching.alignment import Alignment, inverse
from mashape_cad.matching.outline import Outline
from mashape_cad.matching.scanlines import symmetric_difference

__all__ = ["Comparison", "compared", "deviations"]


@dataclass(frozen=True, slots=True, eq=False)
class Deviations:
    """How far the stations of two aligned outlines lie from the other outline: those of the source, then the target's.

    Attributes
    ----------
    distance : (n,) array
        mm of the target.
    weight : (n,) array
        Share of its own outline that each stands for; half of all for either.
    slack : (n,) array
        Distance that says nothing, since a tessellated loop leaves open what lies between its vertices, mm.
    """

    distance: Floats
    weight: Floats
    slack: Floats

    @property
    def largest(self) -> float:
        """Largest distance, mm."""
        return float(self.distance.max())

    @property
    def mean(self) -> float:
        """Root of the mean square, mm."""
        return float(np.sqrt(self.weight @ self.distance**2))

    def share(self, tolerance: float) -> float:
        """Share of both outlines that agrees to within a tolerance, mm, or its slack."""
        return float(self.weight[self.within(tolerance)].sum())

    def within(self, tolerance: float) -> NDArray[np.bool_]:
        """Whether each station agrees to within a tolerance, mm, or its slack."""
        return self.distance <= np.maximum(self.slack, tolerance)


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """Two outlines laid over one another.

    Attributes
    ----------
    alignment : Alignment
    deviations : Deviations
    area_difference : float
        Area in exactly one of the two, as a share of the area in either: 0 for equal ones, 1 for disjoint ones.
    """

    alignment: Alignment
    deviations: Deviations
    area_difference: float


def compared(target: Outline, source: Outline, alignment: Alignment, *, by_kernel: bool = True) -> Comparison:
    """Compare two outlines.

    Parameters
    ----------
    target, source : Outline
    alignment : Alignment
        Of the source over the target.
    by_kernel : bool
        Whether the kernel measures the distances; if not, rings do, to 1e-6 of the size.
    """
    found = deviations(target, source, alignment.placement, by_kernel=by_kernel)
    return Comparison(alignment, found, _area_difference(target, source, alignment.placement))


def deviations(target: Outline, source: Outline, placement: Similarity, *, by_kernel: bool) -> Deviations:
    """Return how far either outline's stations lie from the other, by the kernel or by rings (to 1e-6 of the size)."""
    laid, back = placement.apply(source.stations.point), inverse(placement).apply(target.stations.point)
    to_target, to_source = target.nearest(laid), source.nearest(back)
    away, behind = to_target.distance, to_source.distance
    if by_kernel:
        away, behind = target.query.distances(laid), source.query.distances(back)
    scale = placement.scale
    return Deviations(
        np.concatenate([away, scale * behind]),
        np.concatenate([each.weight / each.weight.sum() / 2 for each in (source.stations, target.stations)]),
        np.concatenate([to_target.step, scale * to_source.step]) / 2,
    )


def _area_difference(target: Outline, source: Outline, placement: Similarity) -> float:
    laid = [placement.apply(ring) for ring in source.rings]
    differing = symmetric_difference(target.rings, laid)
    either = (target.area + source.area * placement.scale**2 + differing) / 2
    return differing / either
