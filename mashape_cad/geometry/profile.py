"""Closed chains of edges and the domains that they bound: `Loop`, `Profile`."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mashape_cad.geometry.edge import Edge, Floats, Similarity

__all__ = ["Loop", "Origin", "Plane", "Profile"]


@dataclass(frozen=True, slots=True)
class Plane:
    """Where a planar face lies in its part: a right-handed frame, mm."""

    origin: tuple[float, float, float]
    x_axis: tuple[float, float, float]
    normal: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Origin:
    """Where in its file a profile comes from: layer and handles (DXF), or face number and plane (STEP, BREP)."""

    layer: str | None = None
    handles: tuple[str, ...] = ()
    face: int | None = None
    plane: Plane | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Loop:
    """Closed chain of edges: each starts where the one before ends (the kernel calls it a wire)."""

    edges: tuple[Edge, ...]

    @property
    def signed_area(self) -> float:
        """Enclosed area, mm2, positive if the loop runs counter-clockwise."""
        return sum(edge.area_integral() for edge in self.edges)

    @property
    def length(self) -> float:
        """Perimeter, mm."""
        return sum(edge.length() for edge in self.edges)

    @property
    def bounds(self) -> Floats:
        """Box ((xmin, ymin), (xmax, ymax)), mm; see `Edge.bounds`."""
        boxes = np.stack([edge.bounds() for edge in self.edges])
        return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])

    def reversed(self) -> "Loop":
        """Return the loop run through the other way."""
        return Loop(tuple(edge.reversed() for edge in reversed(self.edges)))

    def counter_clockwise(self) -> "Loop":
        """Return the loop with its inside on the left."""
        return self if self.signed_area > 0 else self.reversed()

    def transformed(self, similarity: Similarity) -> "Loop":
        """Return the image under a similarity; mirrored, the sense of rotation changes."""
        return Loop(tuple(edge.transformed(similarity) for edge in self.edges))

    def flattened(self, count_per_span: int = 16) -> Floats:
        """Return points along the loop for pictures and coarse tests, the first not repeated: (n, 2)."""
        return np.concatenate([edge.flattened(count_per_span)[:-1] for edge in self.edges])


@dataclass(frozen=True, slots=True, eq=False)
class Profile:
    """One outer loop and its holes, mm: the domain whose medial axis is sought.

    The interior lies on the left of every loop: the outer loop runs counter-clockwise, holes clockwise. Use
    `Profile.of` to have that arranged.

    Attributes
    ----------
    outer : Loop
    holes : tuple of Loop
    origin : Origin
    gap : float
        Widest gap that was bridged to close its loops, mm: where an edge lies is not known to better than that.
    """

    outer: Loop
    holes: tuple[Loop, ...] = ()
    origin: Origin = field(default_factory=Origin)
    gap: float = 0.0

    @classmethod
    def of(cls, outer: Loop, holes: Sequence[Loop] = (), origin: Origin | None = None, gap: float = 0.0) -> "Profile":
        """Make a profile from loops of any orientation."""
        turned = tuple(hole.counter_clockwise().reversed() for hole in holes)
        return cls(outer.counter_clockwise(), turned, origin or Origin(), gap)

    @property
    def loops(self) -> tuple[Loop, ...]:
        """Outer loop first, then the holes."""
        return (self.outer, *self.holes)

    @property
    def edges(self) -> tuple[Edge, ...]:
        """All edges, loop by loop: the numbering that footpoints use."""
        return tuple(edge for loop in self.loops for edge in loop.edges)

    @property
    def area(self) -> float:
        """Area of the domain, mm2."""
        return sum(loop.signed_area for loop in self.loops)

    @property
    def perimeter(self) -> float:
        """Length of all loops, mm."""
        return sum(loop.length for loop in self.loops)

    @property
    def bounds(self) -> Floats:
        """Box of the outer loop ((xmin, ymin), (xmax, ymax)), mm."""
        return self.outer.bounds

    @property
    def diagonal(self) -> float:
        """Length of the bounding box's diagonal, mm."""
        low, high = self.bounds
        return float(np.hypot(*(high - low)))

    def transformed(self, similarity: Similarity) -> "Profile":
        """Return the image under a similarity, again with the interior on the left."""
        outer, *holes = (loop.transformed(similarity) for loop in self.loops)
        if similarity.mirrors:
            outer, holes = outer.reversed(), [hole.reversed() for hole in holes]
        return replace(self, outer=outer, holes=tuple(holes), gap=self.gap * similarity.scale)

    def __iter__(self) -> Iterator[Loop]:
        return iter(self.loops)
