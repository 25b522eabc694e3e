"""The default signature: 256 numbers of a byte each, compared by Euclidean distance.

1. Spokes at equal steps along the boundary, to the significant part of the medial axis (`spokes`).
2. How the rest lies seen from each, on the boundary and on the axis (`contexts`), summed up against a code book
   (`codebook`); and what can be said of the whole without places on it (`whole`).
3. A learned map (`learned_metric`) to 256 numbers.

``docs/signature.md`` says why, and what each part gains.
"""

from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.signatures.constants import VERSION, Constants, shipped
from mashape_cad.signatures.contexts import axis_context, boundary_context
from mashape_cad.signatures.spokes import STEPS, Spokes, spokes
from mashape_cad.signatures.vectors import Signature
from mashape_cad.signatures.whole import summary

__all__ = ["NAME", "NORM", "SIZE", "described", "mapped", "shape_signature", "whole"]

NAME = "default"
SIZE = 256
# Norm of the vector before it is rounded to whole numbers. Larger, and the largest numbers no longer fit into a byte;
# smaller, and rounding shows.
NORM = 400.0
_MOST = 127


def shape_signature(axis: MedialAxis, steps: int = STEPS) -> Signature:
    """Return the default signature of a medial axis.

    Parameters
    ----------
    axis : MedialAxis
    steps : int
        Along the boundary; the result hardly depends on it.

    Returns
    -------
    Signature
        Its one vector, ``shape``, holds 256 whole numbers from -127 to 127; its norm is 400, but for rounding.
    """
    constants = shipped()
    vector = whole(mapped(described(spokes(axis, steps), constants), constants))
    vector.setflags(write=False)
    return Signature(NAME, VERSION, MappingProxyType({"shape": vector}))


def described(shape: Spokes, constants: Constants) -> tuple[NDArray[np.float32], ...]:
    """Return boundary contexts and axis contexts, each summed up, and the summary of the whole."""
    return (
        constants.boundary.described(boundary_context(shape), shape.weight),
        constants.axis.described(axis_context(shape), shape.weight),
        summary(shape).astype(np.float32),
    )


def mapped(parts: tuple[NDArray[np.float32], ...], constants: Constants) -> Floats:
    """Return the vector of norm 1, or one for each row of the parts."""
    joined = np.concatenate(
        [metric.mapped(part) for metric, part in zip(constants.metrics, parts, strict=True)], axis=-1
    )
    return joined / np.linalg.norm(joined, axis=-1, keepdims=True)


def whole(vector: Floats) -> Floats:
    """Return a vector of norm 1, or one for each row, in whole numbers that fit into a byte."""
    return np.clip(np.rint(vector * NORM), -_MOST, _MOST)
