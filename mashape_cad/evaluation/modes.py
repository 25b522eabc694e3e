"""Ways to compare the signatures of a set with one another: a `Mode` is a name, its vectors and a function.

To add one, add its line to `MODES`: everything that measures, prints and draws goes through them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.library.neighbours import neighbour_graph, reranked
from mashape_cad.library.ranking import Stack
from mashape_cad.library.shapes import Shapes

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
    vectors : tuple of str
        Names of the vectors that it compares; where a set lacks one, the mode is left out.
    distances : callable
        From these vectors of a set to an (n, n) array: row i holds the distances of all shapes to query i. It need
        not be symmetric, and may look at the whole set (medians, neighbours).
    is_drawn : bool
        Whether sheets show what it finds, where it is one of several.
    """

    name: str
    vectors: tuple[str, ...]
    distances: Callable[[Signatures], Floats]
    is_drawn: bool = True


def stacked(vectors: Sequence[Mapping[str, Sequence[float]]]) -> Signatures:
    """Return the vectors of several signatures of one kind as arrays, one row for each."""
    return {name: np.array([each[name] for each in vectors], dtype=np.float64) for name in vectors[0]}


def summed(signatures: Signatures) -> Floats:
    """Return the paper's distance: Euclidean; several are added, each over its median in the set (readings 15, 16)."""
    rows = [dict(zip(signatures, row, strict=True)) for row in zip(*signatures.values(), strict=True)]
    stack = Stack.of(rows)
    return np.array([stack.distances(row) for row in rows])


def straight(signatures: Signatures) -> Floats:
    """Return the Euclidean distances of default signatures."""
    return Shapes.of(signatures["shape"]).pairs()


def reordered(signatures: Signatures) -> Floats:
    """Return the places of all shapes in each query's order after re-ranking: of a set whose graph is its own."""
    plain = straight(signatures)
    graph = neighbour_graph(plain)
    places = np.empty(plain.shape)
    for query in range(len(plain)):
        places[query, reranked(plain, query, graph)] = np.arange(len(plain))
    return places


MODES = (
    Mode("paper-df", ("df",), summed),
    Mode("paper-rf", ("rf",), summed),
    Mode("paper-cf", ("cf",), summed),
    Mode("paper-df-rf", ("df", "rf"), summed, is_drawn=False),
    Mode("paper-df-cf", ("df", "cf"), summed, is_drawn=False),
    Mode("paper-rf-cf", ("rf", "cf"), summed, is_drawn=False),
    Mode("paper-all", ("df", "rf", "cf"), summed),
    Mode("default", ("shape",), straight),
    Mode("reranked", ("shape",), reordered),
)
