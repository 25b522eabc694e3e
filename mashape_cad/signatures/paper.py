"""The paper's signature: histograms of footpoint distance (DF), radius (RF) and tangent change (CF).

Faithful to the text, also where it is weak: it depends on how a boundary is divided into edges (reading 3), mirror
images agree (reading 19), and size is divided out (reading 20).

References
----------
M. Ramanathan, Matching of Shapes Bound by Freeform Curves, Computer-Aided Design & Applications 9 (2012), 133-146.
Readings of its unclear lines are cited by their number in ``docs/paper-readings.md``.
"""

from types import MappingProxyType

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.signatures.stations import Stations, stations
from mashape_cad.signatures.vectors import Signature

__all__ = ["BINS", "curvature_function", "footpoint_distance", "histogram", "radius_function", "signature"]

BINS = 64  # section 3.1.1
# A value this close below the upper edge of a bin belongs to the next bin, so that a rigid motion, which changes the
# last digits, cannot move the many equal values of straight branches (reading 5).
_EDGE = 1e-9


def signature(axis: MedialAxis, per_edge: int = 100) -> Signature:
    """Return the three histograms of a medial axis.

    Parameters
    ----------
    axis : MedialAxis
    per_edge : int
        Stations on each edge: 100 is the paper's step 0.01 (section 4.5, reading 2).

    Returns
    -------
    Signature
        Vectors ``df``, ``rf`` and ``cf``, each (64,) and of sum 1.
    """
    sampled = stations(axis, per_edge)
    vectors = {
        "df": histogram(footpoint_distance(sampled)),
        "rf": histogram(radius_function(sampled)),
        "cf": histogram(curvature_function(sampled)),
    }
    for vector in vectors.values():
        vector.setflags(write=False)
    return Signature("paper", 1, MappingProxyType(vectors))


def footpoint_distance(sampled: Stations) -> Floats:
    """DF (section 3.2): distance between the two footpoints, mm, at every station and convex vertex (reading 6)."""
    return sampled.foot_distance


def radius_function(sampled: Stations) -> Floats:
    """RF (section 3.3): radius of the maximal disc, mm, at every station; 0 at convex vertices (reading 6)."""
    return sampled.radius


def curvature_function(sampled: Stations) -> Floats:
    """CF (section 3.4): change of the unit tangent between consecutive points of one branch (reading 12).

    Returns
    -------
    (n,) array
        ``|T(i+1) - T(i)|``, not divided by arc length; the sign of T is taken so that the change is the smaller one.
    """
    run, tangent = sampled.run, sampled.tangent
    pairs = np.flatnonzero((run[1:] == run[:-1]) & (run[1:] >= 0))
    first, second = tangent[pairs], tangent[pairs + 1]
    return np.minimum(np.linalg.norm(second - first, axis=1), np.linalg.norm(second + first, axis=1))


def histogram(values: Floats) -> Floats:
    """Divide by the maximum and count in 64 bins over [0, 1], the last one closed; the sum is 1 (reading 4).

    A function that is 0 everywhere falls into the first bin (reading 13).
    """
    if not len(values):
        return np.eye(1, BINS)[0]
    largest = float(np.max(values))
    # Straight branches have no curvature but for rounding, which must not be divided by itself.
    scaled = values / largest if largest > _EDGE else np.zeros_like(values)
    bins = np.minimum((scaled * BINS + _EDGE * BINS).astype(int), BINS - 1)
    return np.bincount(bins, minlength=BINS) / len(values)
