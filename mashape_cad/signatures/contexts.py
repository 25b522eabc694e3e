"""Local contexts: how the rest of the shape lies, seen from one place of it.

Around each spoke the others are counted in a soft histogram over distance, in logarithmic steps and in units of the
mean distance, over direction, against the spoke, and (seen from the boundary) over how their spokes are turned against
it.
So neither position nor orientation nor size matters, and a change of the shape moves a little from bin to bin.

* The *boundary context* sees feet from feet, by straight distance.
* The *axis context* sees centres from centres, by the distance along the axis: it bends with the shape's limbs.

References
----------
S. Belongie, J. Malik, J. Puzicha, Shape matching and object recognition using shape contexts, IEEE PAMI 24 (2002),
509-522. H. Ling, D. W. Jacobs, Shape classification using the inner-distance, IEEE PAMI 29 (2007), 286-299. Deviations:
distances along the medial axis, turns of the spokes, soft bins, boundary measured by its length.
"""

import math
from dataclasses import dataclass

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints
from mashape_cad.signatures.compiled import compiled
from mashape_cad.signatures.spokes import Spokes

__all__ = ["AXIS", "BOUNDARY", "ContextKind", "axis_context", "boundary_context", "mirror"]

# Directions from this distance inwards fade away, in mean distances; bins start here too. A near neighbour's direction
# is noise.
_NEAR, _FAR = 0.06, 2.2


@dataclass(frozen=True, slots=True)
class ContextKind:
    """Numbers of bins: of distance, of direction, and of the turn of spokes."""

    distances: int
    directions: int
    turns: int

    @property
    def size(self) -> int:
        """Length of the histogram."""
        return self.distances * self.directions * self.turns


BOUNDARY = ContextKind(6, 12, 4)
AXIS = ContextKind(6, 12, 1)


def boundary_context(shape: Spokes) -> Floats:
    """Return the contexts seen from the feet: (n, 288), square roots of shares, rows of norm 1."""
    x, y = shape.foot.T
    apart = np.sqrt((x[:, None] - x) ** 2 + (y[:, None] - y) ** 2)
    return _context(shape.foot, apart, shape, BOUNDARY)


def axis_context(shape: Spokes) -> Floats:
    """Return the contexts seen from the centres: (n, 72), square roots of shares, rows of norm 1."""
    return _context(shape.centre, shape.geodesic, shape, AXIS)


def mirror(kind: ContextKind) -> Ints:
    """Return the order of bins in which the mirrored shape has the same context."""
    bins = np.arange(kind.size).reshape(kind.distances, kind.directions, kind.turns)
    return bins[:, -np.arange(kind.directions)][:, :, -np.arange(kind.turns)].ravel()


def _context(place: Floats, apart: Floats, shape: Spokes, kind: ContextKind) -> Floats:
    mean = float(shape.weight @ apart @ shape.weight)
    scaled = apart / (mean if mean > 0.0 else 1.0)
    heading = np.arctan2(shape.direction[:, 1], shape.direction[:, 0]) / (2 * np.pi)
    return np.sqrt(_histograms(scaled, place, heading, shape.weight, kind.distances, kind.directions, kind.turns))


@compiled
def _histograms(
    apart: Floats, place: Floats, heading: Floats, weight: Floats, distances: int, directions: int, turns: int
) -> Floats:
    """Count all around each place, bilinearly; each row sums to 1.

    Parameters
    ----------
    apart : (n, n) array
        Distances, in mean distances.
    place : (n, 2) array
    heading : (n,) array
        Directions of the spokes, in full turns.
    """
    n = len(weight)
    per_ring = (distances - 1) / math.log(_FAR / _NEAR)
    out = np.zeros((n, distances, directions, turns))
    near = np.zeros((n, turns))
    for s in range(n):
        _count_near(near[s], 0.0, weight[s])
        for t in range(s):
            seen = min(apart[s, t] / _NEAR, 1.0)
            turn = heading[t] - heading[s]
            if seen < 1.0:
                _count_near(near[s], turn, weight[t] * (1.0 - seen))
                _count_near(near[t], -turn, weight[s] * (1.0 - seen))
                if seen == 0.0:
                    continue
            way = _direction(place[t, 0] - place[s, 0], place[t, 1] - place[s, 1])
            ring = min(math.log(max(apart[s, t] / _NEAR, 1.0)) * per_ring, distances - 1.0)
            _count(out[s], ring, way - heading[s], turn, weight[t] * seen)
            _count(out[t], ring, way + 0.5 - heading[t], -turn, weight[s] * seen)
    # What is too near to be seen in a direction is seen in all.
    for s in range(n):
        for k in range(directions):
            for m in range(turns):
                out[s, 0, k, m] += near[s, m] / directions
    return out.reshape(n, distances * directions * turns)


@compiled
def _count(bins: Floats, ring: float, way: float, turn: float, weight: float) -> None:
    """Share a weight among the eight bins next to a place of the histogram; `way` and `turn` in full turns."""
    distances, directions, turns = bins.shape
    u0 = min(int(ring), distances - 2)
    b = weight * (ring - u0)
    a = weight - b
    x = (way - math.floor(way)) * directions
    x0 = int(x)
    x, x0 = x - x0, x0 % directions
    x1 = x0 + 1 if x0 + 1 < directions else 0
    y = (turn - math.floor(turn)) * turns
    y0 = int(y)
    y, y0 = y - y0, y0 % turns
    y1 = y0 + 1 if y0 + 1 < turns else 0
    bins[u0, x0, y0] += a * (1.0 - x) * (1.0 - y)
    bins[u0, x0, y1] += a * (1.0 - x) * y
    bins[u0, x1, y0] += a * x * (1.0 - y)
    bins[u0, x1, y1] += a * x * y
    bins[u0 + 1, x0, y0] += b * (1.0 - x) * (1.0 - y)
    bins[u0 + 1, x0, y1] += b * (1.0 - x) * y
    bins[u0 + 1, x1, y0] += b * x * (1.0 - y)
    bins[u0 + 1, x1, y1] += b * x * y


@compiled
def _count_near(bins: Floats, turn: float, weight: float) -> None:
    """Share a weight between two turns."""
    turns = len(bins)
    y = (turn - math.floor(turn)) * turns
    y0 = int(y)
    y, y0 = y - y0, y0 % turns
    bins[y0] += weight * (1.0 - y)
    bins[(y0 + 1) % turns] += weight * y


@compiled
def _direction(x: float, y: float) -> float:
    """Return the direction of a vector in full turns, good to 2e-6; several times as fast as the arc tangent.

    References
    ----------
    M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, formula 4.4.49.
    """
    a, b = abs(x), abs(y)
    if a == b == 0.0:
        return 0.0
    q = min(a, b) / max(a, b)
    z = q * q
    angle = q * (0.9998660 + z * (-0.3302995 + z * (0.1801410 + z * (-0.0851330 + z * 0.0208351)))) / (2 * math.pi)
    if b > a:
        angle = 0.25 - angle
    if x < 0.0:
        angle = 0.5 - angle
    return -angle if y < 0.0 else angle
