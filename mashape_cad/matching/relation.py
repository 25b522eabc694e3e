"""What one outline is to another: `Relation`. Plain numbers: whoever shows one needs neither numpy nor kernel."""

from dataclasses import dataclass
from enum import StrEnum

__all__ = ["Kind", "Relation"]

# Of the scale: a factor this close to 25.4 is a drawing read in the wrong unit. 25 and 25.4 differ by 1.6 %.
_NEAR_A_FACTOR = 2e-3
_INCH = 25.4


class Kind(StrEnum):
    """What a hit is to the query; `mashape_cad.matching.relating` decides."""

    IDENTICAL = "identical"  # the same outline, moved and turned
    MIRRORED = "mirrored"  # its mirror image
    SCALED = "scaled"  # the same outline (or its mirror image) in another size
    MODIFIED = "modified"  # most of the outline is the same, something is different
    SIMILAR = "similar"  # no more than a likeness


@dataclass(frozen=True, slots=True)
class Relation:
    """What a hit is to the query, and the numbers that say why.

    Attributes
    ----------
    kind : Kind
    scale : float
        How many times as large the hit is; exactly 1 if laying it over the query took no scaling.
    is_mirrored : bool
        Whether the hit was turned over to be laid over the query.
    deviation_mm : float
        Largest distance between the two outlines laid over one another, at the query's size.
    area_difference : float
        Area in exactly one of the two, as a share of the area in either: 0 for equal ones, 1 for disjoint ones.
    common : float
        Share of the length of both outlines that agrees to within the tolerance.
    tolerance_mm : float
        Deviation up to which the outlines count as the same, at the query's size.
    placement : tuple of float
        (a, b, c, d, x, y): a point (p, q) of the hit's profile lies at (a p + b q + x, c p + d q + y) on the query's.
    """

    kind: Kind
    scale: float
    is_mirrored: bool
    deviation_mm: float
    area_difference: float
    common: float
    tolerance_mm: float
    placement: tuple[float, float, float, float, float, float]

    @property
    def hint(self) -> str | None:
        """What probably went wrong, or None."""
        factor = max(self.scale, 1 / self.scale)
        return "inch/mm?" if abs(factor / _INCH - 1) <= _NEAR_A_FACTOR else None

    def __str__(self) -> str:
        if self.kind in (Kind.IDENTICAL, Kind.MIRRORED, Kind.SIMILAR):
            return str(self.kind)
        scaled = [] if self.scale == 1 else [f"scaled by {self.scale:.6g}" + (f" ({self.hint})" if self.hint else "")]
        said = [*(["modified"] if self.kind is Kind.MODIFIED else []), *scaled]
        return ", ".join([*said, "mirrored"] if self.is_mirrored else said)
