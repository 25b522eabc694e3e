"""The light picture in a sidecar as polylines in mm: `loops_of`, `outer_loop_of`, `branches_of`."""

import numpy as np
from numpy.typing import NDArray

from mashape_cad.library.record import Thumbnail

__all__ = ["branches_of", "loops_of", "outer_loop_of"]

Floats = NDArray[np.float64]


def loops_of(light: Thumbnail) -> tuple[Floats, ...]:
    """Return the loops of a light picture, each (n, 2), mm; the first point is not repeated."""
    return tuple(np.array(loop, float).reshape(-1, 2) * light.pitch + light.corner for loop in light.loops)


def outer_loop_of(light: Thumbnail) -> Floats:
    """Return the outer loop of a light picture, (n, 2), mm; the first point is not repeated."""
    return loops_of(light)[0]


def branches_of(light: Thumbnail) -> tuple[Floats, ...]:
    """Return the branches of a light picture, each (n, 3): x, y and radius, mm."""
    return tuple(np.array(run, float).reshape(-1, 3) * light.pitch + (*light.corner, 0.0) for run in light.branches)
