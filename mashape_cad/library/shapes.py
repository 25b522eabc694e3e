"""The default signatures of a library, compared with one in a single matrix product: `Shapes`."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mashape_cad.library.ranking import Floats, Singles

__all__ = ["UNIT", "Shapes"]

# The numbers of a default signature are in steps of so many to 1. Stated here and not asked of the signature itself,
# because that loads the medial axis: a test holds the two together.
UNIT = 400.0


@dataclass(frozen=True, slots=True, eq=False)
class Shapes:
    """Default signatures as an array.

    Attributes
    ----------
    rows : (n, 256) array
        Whole numbers from -127 to 127. Their products and the sums of these stay below 2^24, so that single precision
        adds them up exactly, in whatever order.
    squares : (n,) array
        Of their norms.
    """

    rows: Singles
    squares: Singles

    @classmethod
    def of(cls, signatures: Sequence[Sequence[float]] | Floats) -> "Shapes":
        """Stack signatures, a row each."""
        rows = np.array(signatures, dtype=np.float32)
        return cls(rows, (rows**2).sum(axis=1))

    def distances(self, signature: Sequence[float] | Singles) -> Singles:
        """Return the Euclidean distance of one signature to each, (n,): from 0, exactly so to an equal one, to 2."""
        asked = np.asarray(signature, dtype=np.float32)
        squared = self.squares + (asked @ asked - 2 * (self.rows @ asked))
        return (np.sqrt(squared) / np.float32(UNIT)).astype(np.float32, copy=False)

    def pairs(self) -> Floats:
        """Return the distances of all pairs, (n, n)."""
        squared = self.squares[:, None] + self.squares - 2 * (self.rows @ self.rows.T)
        return np.sqrt(squared, dtype=np.float64) / UNIT
