"""What a hit has of a query's outline: `Portion`. A value: whoever shows one need not look for any."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # it loads scipy
    from mashape_cad.geometry.edge import Floats, Similarity

__all__ = ["Portion"]


@dataclass(frozen=True, slots=True, eq=False)
class Portion:
    """The portion of a query's outline that occurs in a hit.

    Attributes
    ----------
    share : float
        How much of the query it is, 0 to 1: half of it by length, half by how much the outline turns there.
    placement : Similarity
        From the query's coordinates to the hit's.
    stretches : tuple of (n, 2) arrays
        Where it lies in the hit, mm.
    """

    share: float
    placement: "Similarity"
    stretches: "tuple[Floats, ...]"
