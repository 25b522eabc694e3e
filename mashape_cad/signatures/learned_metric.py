"""A learned linear map after which Euclidean distance says how different shapes are: `LearnedMetric`."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.signatures.codebook import Singles

__all__ = ["LearnedMetric"]

_ZERO = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class LearnedMetric:
    """Keeps what tells shapes apart, and little of what variants of one shape differ by.

    Attributes
    ----------
    steps : (d, m) array of int8
        The map, column by column in units of `unit`.
    unit : (m,) array
    offset : (m,) array
        Where the mean of all shapes comes to lie.
    weight : float
        How much the result counts beside others.
    """

    steps: NDArray[np.int8]
    unit: Singles
    offset: Singles
    weight: float

    def mapped(self, described: NDArray[np.float32]) -> Singles:
        """Return the image of a vector, or of each row: of norm `weight`."""
        image = (described @ self.steps.astype(np.float32)) * self.unit - self.offset
        return self.weight * image / np.maximum(np.linalg.norm(image, axis=-1, keepdims=True), _ZERO)
