"""A bag of local contexts as one vector: what they differ by from the words of a code book, summed up: `Codebook`.

References
----------
H. Jegou, F. Perronnin, M. Douze, J. Sanchez, P. Perez, C. Schmid, Aggregating local image descriptors into compact
codes, IEEE PAMI 34 (2012), 1704-1716. Deviation: contexts are shared softly among words, so that a small change of a
context never moves it from one word to another at once.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints

__all__ = ["Codebook"]

Singles = NDArray[np.float32]

# Width of the soft share, in the spread of contexts about their words: narrower, and noise decides between two words;
# wider, and all words say the same.
_WIDTH = 0.5
# Sums are raised to this power, so that what is frequent does not drown the rest. Less, and what is next to nothing
# counts: it is noise.
_POWER = 0.6


@dataclass(frozen=True, slots=True, eq=False)
class Codebook:
    """Words for contexts.

    Attributes
    ----------
    mean : (d,) array
    basis : (d, m) array
        Directions in which contexts differ most.
    words : (k, m) array
        Typical contexts, in that basis.
    spread : float
        Median distance of a context to the nearest word.
    mirror : (d,) array
        Order of the bins of a context in the mirrored shape.
    """

    mean: Singles
    basis: Singles
    words: Singles
    spread: float
    mirror: Ints

    def described(self, contexts: Floats, weight: Floats) -> Singles:
        """Sum up contexts, each as it is and as its mirror image, so that mirrored shapes agree.

        Parameters
        ----------
        contexts : (n, d) array
        weight : (n,) array

        Returns
        -------
        (k * m,) array
            Sums raised to a power, with their signs; of norm 1.
        """
        both = np.concatenate([contexts, contexts[:, self.mirror]]).astype(np.float32)
        seen = ((both - self.mean) @ self.basis).astype(np.float32)
        share = self._shares(seen) * np.concatenate([weight, weight]).astype(np.float32)[:, None]
        summed = (share.T @ seen - share.sum(axis=0)[:, None] * self.words).ravel()
        raised = np.sign(summed) * np.abs(summed) ** np.float32(_POWER)
        return raised / np.linalg.norm(raised)

    def _shares(self, seen: Singles) -> Singles:
        """Return how much of each context goes to each word: (n, k), rows of sum 1."""
        squared = (self.words**2).sum(axis=1) - 2 * seen @ self.words.T
        squared -= squared.min(axis=1, keepdims=True)
        share = np.exp(squared / np.float32(-2 * (_WIDTH * self.spread) ** 2))
        return share / share.sum(axis=1, keepdims=True)
