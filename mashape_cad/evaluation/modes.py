"""Ways to compare the signatures of a set with one another: a `Mode` is a name and a function.

To add one, add its line to `MODES`: everything that measures, prints and draws goes through them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.library.ranking import Stack

__all__ = ["MODES", "Mode", "Signatures", "stacked"]

Floats = NDArray[np.float64]
# The vectors of all shapes by their name, one row for each shape: (n, d) arrays.
Signatures = Mapping[str, Floats]


@dataclass(frozen=True, slots=True)
class Mode:
    """One way to compare.

    Attributes
    ----------
    name : str
        As programs and people write it.
    distances : callable
        From the signatures of a set to an (n, n) array: row i holds the distances of all shapes to query i. It need
        not be symmetric, and may look at the whole set (medians, neighbours).
    is_drawn : bool
        Whether sheets show what it finds, where it is one of several.
    """

    name: str
    distances: Callable[[Signatures], Floats]
    is_drawn: bool = True


def stacked(vectors: Sequence[Mapping[str, Sequence[float]]]) -> Signatures:
    """Return the vectors of several signatures of one kind as arrays, one row for each."""
    return {name: np.array([each[name] for each in vectors], dtype=np.float64) for name in vectors[0]}


def histograms(*names: str) -> Callable[[Signatures], Floats]:
    """Return the paper's comparison by some of its functions (readings 15 and 16).

    The Euclidean distance of the histograms; several are added up, each divided by its median over the set.
    """

    def distances(signatures: Signatures) -> Floats:
        count = len(signatures[names[0]])
        rows = [{name: signatures[name][row] for name in names} for row in range(count)]
        stack = Stack.of(rows)
        return np.array([stack.distances(row) for row in rows])

    return distances


MODES = (
    Mode("paper-df", histograms("df")),
    Mode("paper-rf", histograms("rf")),
    Mode("paper-cf", histograms("cf")),
    Mode("paper-df-rf", histograms("df", "rf"), is_drawn=False),
    Mode("paper-df-cf", histograms("df", "cf"), is_drawn=False),
    Mode("paper-rf-cf", histograms("rf", "cf"), is_drawn=False),
    Mode("paper-all", histograms("df", "rf", "cf")),
)
