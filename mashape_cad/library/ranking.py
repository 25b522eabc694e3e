"""How far paper mode's signatures are apart: many stacked into arrays, compared with one in a single pass.

The distance of two profiles is the sum over the signature's vectors (DF, RF, CF) of their Euclidean distance, each
divided by its median over the library (paper notes, readings 15 and 16), so that no function outweighs the others
because its histograms happen to differ more.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["PAPER_VECTORS", "Floats", "Singles", "Stack", "rising"]

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]

# In the order in which weights are given.
PAPER_VECTORS = ("df", "rf", "cf")
# Medians are taken over all pairs of at most so many profiles: half a million pairs, some tenths of a second. Of a
# larger library every n-th profile is taken, in the order of names, so that the same library gives the same distances.
_MOST_FOR_MEDIAN = 1000
_HALF = 32


@dataclass(frozen=True, slots=True, eq=False)
class Stack:
    """The signatures of a library.

    Attributes
    ----------
    vectors : mapping of str to (n, d) arrays
        One row for each profile.
    scales : mapping of str to float
        Median distance of two of the profiles that count, by vector.
    """

    vectors: Mapping[str, Floats]
    scales: Mapping[str, float]

    @classmethod
    def of(
        cls, signatures: Sequence[Mapping[str, Sequence[float]]], counts: NDArray[np.bool_] | None = None
    ) -> "Stack":
        """Stack signatures with the same vectors; the medians are taken over those that `counts` names, else all."""
        names = list(signatures[0]) if signatures else []
        vectors = {name: np.array([each[name] for each in signatures], dtype=np.float64) for name in names}
        chosen = slice(None) if counts is None else counts
        return cls(vectors, {name: _median_distance(rows[chosen]) for name, rows in vectors.items()})

    def distances(self, signature: Mapping[str, Sequence[float]], weights: Mapping[str, float] | None = None) -> Floats:
        """Return the distance of one signature to each of the stack, (n,); exactly 0 to an equal one.

        `weights` are factors of the vectors by name; not given, all count alike.
        """
        factors = dict.fromkeys(self.vectors, 1.0) | dict(weights or {})
        parts = [
            factors[name]
            * np.linalg.norm(rows - np.asarray(signature[name], dtype=np.float64), axis=1)
            / self.scales[name]
            for name, rows in self.vectors.items()
        ]
        return np.sum(parts, axis=0)


def rising(values: Floats | Singles) -> NDArray[np.intp]:
    """Return the order in which values of 0 and more rise, equal ones as they stand.

    Of single precision in a fifth of the time: their bits rise with them, and with the place in the lower half of one
    whole number they are sorted at once.
    """
    if values.dtype != np.float32:
        return np.argsort(values, kind="stable")
    bits = (values + np.float32(0.0)).view(np.int32).astype(np.int64)
    both = (bits << _HALF) | np.arange(len(values))
    both.sort()
    return both & ((1 << _HALF) - 1)


def _median_distance(rows: Floats) -> float:
    """Return the median distance of two different rows.

    If more than half of all pairs are equal (a library of rectangles has one CF), the median of the others is taken,
    and 1 if all are: dividing by it must stay possible and must not blow up what little difference there is.
    """
    if len(rows) > _MOST_FOR_MEDIAN:
        rows = rows[np.linspace(0, len(rows) - 1, _MOST_FOR_MEDIAN).astype(int)]
    pairs = _pair_distances(rows)
    for candidates in (pairs, pairs[pairs > 0]):
        if len(candidates) and (median := float(np.median(candidates))) > 0:
            return median
    return 1.0


def _pair_distances(rows: Floats) -> Floats:
    """Return the distances of all pairs of rows, row by row, exactly 0 for equal ones."""
    if len(rows) == 0:
        return np.empty(0)
    return np.concatenate([np.linalg.norm(rows[number + 1 :] - row, axis=1) for number, row in enumerate(rows)])
