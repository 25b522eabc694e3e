"""The shape as a whole, without places on it: `summary`."""

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.signatures.spokes import Spokes

__all__ = ["SIZE", "summary"]

_RINGS, _ORDERS = 8, 13
# Radius of the outermost ring, in root mean square distances of the boundary from the middle.
_REACH = 2.2
# Square roots grow without bound at 0, where magnitudes are noise: there they are taken for straight.
_SOFT = 1e-3
# Radii are counted in logarithmic steps, in square roots of the area: an inscribed circle's is at most 0.56.
_DEPTHS, _SHALLOW, _DEEP = 10, 0.02, 0.6
# How far out a place of the axis lies is its mean distance to all others along the axis, over the mean of these.
_OUTWARDS, _INMOST, _OUTMOST = 6, 0.5, 1.7
_ZERO = 1e-9
SIZE = 2 * _RINGS * _ORDERS + _DEPTHS * _OUTWARDS


def summary(shape: Spokes) -> Floats:
    """Return how boundary and axis lie around their middle, and how deep the axis runs how far out: (268,).

    * Magnitudes of angular waves of the boundary and of the axis on soft rings around the centroid of the axis, each
      disc counted by its radius. Turning changes nothing but by rounding; magnitudes do not see a mirror.
    * A soft histogram of radius and mean distance along the axis, as square roots.
    """
    return np.concatenate([_waves_of_both(shape), _depths(shape)])


def _waves_of_both(shape: Spokes) -> Floats:
    thick = shape.weight * shape.radius
    thick = thick / thick.sum()
    middle = thick @ shape.centre
    unit = np.sqrt(shape.weight @ ((shape.foot - middle) ** 2).sum(axis=1))
    boundary = _waves((shape.foot - middle) / unit, shape.weight)
    return np.concatenate([boundary, _waves((shape.centre - middle) / unit, thick)])


def _waves(place: Floats, weight: Floats) -> Floats:
    z = place[:, 0] + 1j * place[:, 1]
    radius = np.abs(z)
    # At the middle itself there is no direction; next to it, it fades.
    phase = z / np.maximum(radius, _ZERO)
    seen = np.minimum(radius * _RINGS / _REACH, 1.0)
    waves = phase[:, None] ** np.arange(_ORDERS) * weight[:, None]
    waves[:, 1:] *= seen[:, None]
    size = np.abs(_hats(radius * _RINGS / _REACH - 0.5, _RINGS).T @ waves).ravel()
    return np.sqrt(size + _SOFT) - np.sqrt(_SOFT)


def _depths(shape: Spokes) -> Floats:
    outwards = shape.geodesic @ shape.weight
    outwards /= max(float(outwards @ shape.weight), _ZERO)
    depth = np.log(np.maximum(shape.radius / np.sqrt(shape.area), _SHALLOW) / _SHALLOW) / np.log(_DEEP / _SHALLOW)
    deep = _hats(depth * (_DEPTHS - 1), _DEPTHS)
    out = _hats((outwards - _INMOST) / (_OUTMOST - _INMOST) * (_OUTWARDS - 1), _OUTWARDS)
    return np.sqrt((deep * shape.weight[:, None]).T @ out).ravel()


def _hats(at: Floats, count: int) -> Floats:
    """Share each number between the two whole numbers next to it, from 0 to `count` - 1: (n, count)."""
    clipped = np.clip(at, 0.0, count - 1.0)
    return np.maximum(1.0 - np.abs(clipped[:, None] - np.arange(count)), 0.0)
