"""What a way to compute a medial axis gave: points, how they are linked, and what it cost."""

from dataclasses import dataclass, field

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints

__all__ = ["Found"]


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """A medial axis as points.

    Attributes
    ----------
    points : (n, 3) array
        Centre and radius, mm.
    degree : (n,) array
        Branches that meet in each point; 3 and more is a junction.
    parts_ms : dict
        CPU time by part of the work, ms; their sum is the whole.
    """

    points: Floats
    degree: Ints
    parts_ms: dict[str, float] = field(default_factory=dict)

    @classmethod
    def linked(cls, points: Floats, links: Ints) -> "Found":
        """Make it from points and the pairs that are linked; a point without a link is left out."""
        degree = np.bincount(links.ravel(), minlength=len(points))
        return cls(points[degree > 0], degree[degree > 0])

    @property
    def junctions(self) -> Floats:
        """Points where three and more branches meet: (k, 3)."""
        return self.points[self.degree > 2]
