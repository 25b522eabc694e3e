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
    across = shape.foot[None] - shape.foot[:, None]
    return _context(shape.foot, np.sqrt((across**2).sum(axis=2)), shape, BOUNDARY)


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
    near = np.zeros(turns)
    for s in range(n):
        near[:] = 0.0
        for t in range(n):
            y = heading[t] - heading[s]
            y = (y - math.floor(y)) * turns
            y0 = int(y)
            y, y0 = y - y0, y0 % turns
            y1 = (y0 + 1) % turns
            unseen = weight[t] * (1.0 - min(apart[s, t] / _NEAR, 1.0))
            near[y0] += unseen * (1.0 - y)
            near[y1] += unseen * y
            if unseen == weight[t]:
                continue
            x = _direction(place[t, 0] - place[s, 0], place[t, 1] - place[s, 1]) - heading[s]
            x = (x - math.floor(x)) * directions
            x0 = int(x)
            x, x0 = x - x0, x0 % directions
            x1 = (x0 + 1) % directions
            u = min(math.log(max(apart[s, t] / _NEAR, 1.0)) * per_ring, distances - 1.0)
            u0 = min(int(u), distances - 2)
            u -= u0
            b = (weight[t] - unseen) * u
            a = weight[t] - unseen - b
            out[s, u0, x0, y0] += a * (1.0 - x) * (1.0 - y)
            out[s, u0, x0, y1] += a * (1.0 - x) * y
            out[s, u0, x1, y0] += a * x * (1.0 - y)
            out[s, u0, x1, y1] += a * x * y
            out[s, u0 + 1, x0, y0] += b * (1.0 - x) * (1.0 - y)
            out[s, u0 + 1, x0, y1] += b * (1.0 - x) * y
            out[s, u0 + 1, x1, y0] += b * x * (1.0 - y)
            out[s, u0 + 1, x1, y1] += b * x * y
        # What is too near to be seen in a direction is seen in all.
        for k in range(directions):
            for m in range(turns):
                out[s, 0, k, m] += near[m] / directions
    return out.reshape(n, distances * directions * turns)


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
