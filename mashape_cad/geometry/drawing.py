"""Loose edges as a drawing has them, each with where it comes from, and the scale of the whole."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mashape_cad.geometry.edge import Edge, Floats, Line

__all__ = ["Drawing", "Strand"]

# Of the drawing's diagonal: ends and curves this close are the same, edges this short are points. A file's digits
# rarely tell more; wider, a feature of a millionth of the drawing would be lost.
_SAME = 1e-9
# Rounding of the coordinates themselves, far from the origin; a few operations deep.
_ROUNDING = 8 * np.finfo(float).eps


@dataclass(frozen=True, slots=True, eq=False)
class Strand:
    """An edge with where it comes from.

    Attributes
    ----------
    edge : Edge
        mm.
    entity : int
        Number of the entity, counted over the drawing; the segments of one polyline share it and follow one another.
    handle : str
        The entity's name in the file.
    layer : str
    """

    edge: Edge
    entity: int
    handle: str
    layer: str


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """Strands with what is asked of them again and again.

    Attributes
    ----------
    strands : tuple of Strand
    ends : (n, 2, 2) array
        Start and end of each edge, mm.
    lengths : (n,) array
        mm.
    diagonal : float
        Of the box around the whole drawing, mm.
    noise : float
        Distance up to which points are the same, mm.
    """

    strands: tuple[Strand, ...]
    ends: Floats
    lengths: Floats
    diagonal: float
    noise: float

    @classmethod
    def of(cls, strands: Sequence[Strand]) -> "Drawing":
        """Measure strands, of which there must be one at least."""
        ends = np.stack([strand.edge.point([0.0, 1.0]) for strand in strands])
        lengths = np.array([_length(strand.edge) for strand in strands])
        boxes = np.stack([strand.edge.bounds() for strand in strands])
        diagonal = float(np.hypot(*(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0))))
        noise = max(_SAME * diagonal, _ROUNDING * float(np.abs(boxes).max()))
        return cls(tuple(strands), ends, lengths, diagonal, noise)

    def pick(self, numbers: Sequence[int]) -> "Drawing":
        """Return some of the strands, with the scale of the whole."""
        rows = np.array(numbers, int)
        return replace(
            self, strands=tuple(self.strands[i] for i in numbers), ends=self.ends[rows], lengths=self.lengths[rows]
        )


def _length(edge: Edge) -> float:
    return float(np.hypot(*(edge.last - edge.first))) if isinstance(edge, Line) else edge.length()
