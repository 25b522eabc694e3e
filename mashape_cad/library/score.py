"""From a distance to a score: how sure it is that two parts are of one kind, per cent.

``docs/signature.md`` has the measurement that the curve was laid through.
"""

import numpy as np

from mashape_cad.library.ranking import Floats, Singles

__all__ = ["scores"]

# The distance at which half of the pairs belong together, and the distance over which the odds change by a factor of e.
_HALF, _WIDTH = 0.97, 0.08


def scores(distances: Floats | Singles) -> Floats:
    """Return the scores of distances between default signatures: 100 at 0, falling to 0.

    A score is the share of pairs at that distance that belong together, in labelled sets of which 3 to 8 pairs in a
    hundred do.
    """
    return 100 * (_share(np.asarray(distances, dtype=np.float64)) / _share(np.zeros(())))


def _share(distances: Floats) -> Floats:
    return 1 / (1 + np.exp((distances - _HALF) / _WIDTH))
