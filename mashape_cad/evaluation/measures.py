"""How well a ranking finds what belongs together: distances and classes in, the usual measures of retrieval out.

Every shape queries the whole set. Two protocols are in use, and their figures are not to be compared:

* ``paper``: the query counts as its own first hit ("the first shape is the query shape and also it is the retrieved
  one", section 4.3; reading 17). In a class of C the first tier looks at K = C ranks, the second at 2C.
* ``princeton``: the query is left out. The first tier looks at C - 1 ranks, the second at 2(C - 1).

References
----------
M. Ramanathan, Matching of Shapes Bound by Freeform Curves, Computer-Aided Design & Applications 9 (2012), 133-146,
section 4.4. P. Shilane et al., The Princeton Shape Benchmark, Shape Modeling International 2004. L. J. Latecki et al.,
Shape Descriptors for Non-rigid Shapes with a Single Closed Contour, CVPR 2000 (bull's-eye). Readings are cited by their
number in ``docs/paper-readings.md``.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

__all__ = ["Measures", "Protocol", "means", "measures", "measures_of_ranking", "ranking"]

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]
Bools = NDArray[np.bool_]


class Protocol(StrEnum):
    """Whether the query counts as a hit of its own."""

    PAPER = "paper"
    PRINCETON = "princeton"


@dataclass(frozen=True, slots=True, eq=False)
class Measures:
    """The measures of each query, (n,) arrays of shares from 0 to 1; NaN for a query that is alone in its class.

    Attributes
    ----------
    nearest_neighbour : (n,) array
        1 if the first shape other than the query is of its class, else 0; in both protocols.
    first_tier, second_tier : (n,) array
        Share of the class that is among the first K ranks, or 2K; see the protocols above.
    average_precision : (n,) array
        Mean, over the members of the class, of the share of hits down to the rank of that member.
    bulls_eye : (n,) array
        Share of the C members among the first 2C ranks; the query counts, in both protocols.
    """

    nearest_neighbour: Floats
    first_tier: Floats
    second_tier: Floats
    average_precision: Floats
    bulls_eye: Floats


def ranking(distances: Floats, labels: Sequence[str]) -> Ints:
    """Return the order in which each query finds all shapes.

    Parameters
    ----------
    distances : (n, n) array
        Row i holds the distances of all shapes to query i; it need not be symmetric.
    labels : sequence of str
        The class of each shape.

    Returns
    -------
    (n, n) array of int
        Row i begins with i itself, whatever its distance. Of equal distances, shapes of other classes come first (a
        tie never flatters), then those with the smaller index: so the order is the same in every run.

    Raises
    ------
    ValueError
        If the shapes do not fit together, or a distance is not a number.
    """
    distances = np.asarray(distances, dtype=np.float64)
    count = len(labels)
    if distances.shape != (count, count):
        raise ValueError(f"{count} labels need ({count}, {count}) distances, not {distances.shape}")
    if np.isnan(distances).any():
        raise ValueError("a distance is not a number")
    is_mate = _are_mates(labels)
    is_other = ~np.eye(count, dtype=np.bool_)
    return np.lexsort((is_mate, distances, is_other), axis=1)  # the last key counts most; the sort is stable


def measures(distances: Floats, labels: Sequence[str], protocol: Protocol = Protocol.PAPER) -> Measures:
    """Return the measures of each query; for parameters and errors see `ranking`."""
    return measures_of_ranking(ranking(distances, labels), labels, protocol)


def measures_of_ranking(order: Ints, labels: Sequence[str], protocol: Protocol) -> Measures:
    """Return the measures of each query from the order in which it finds all shapes, as `ranking` returns it."""
    hits = np.take_along_axis(_are_mates(labels), order, axis=1)  # column 0 is the query itself
    members = hits.sum(axis=1)
    counted = hits if protocol is Protocol.PAPER else hits[:, 1:]
    sought = members if protocol is Protocol.PAPER else members - 1
    found = {
        "nearest_neighbour": hits[:, 1:2].sum(axis=1, dtype=np.float64),
        "first_tier": _share_among_first(counted, sought, sought),
        "second_tier": _share_among_first(counted, sought, 2 * sought),
        "average_precision": _average_precision(counted, sought),
        "bulls_eye": _share_among_first(hits, members, 2 * members),
    }
    is_alone = members < 2
    return Measures(**{name: np.where(is_alone, np.nan, values) for name, values in found.items()})


def means(found: Measures, chosen: Bools | None = None) -> dict[str, float]:
    """Return the mean of each measure over the queries, those that are alone in their class left out.

    Parameters
    ----------
    found : Measures
    chosen : (n,) array of bool, optional
        Only these queries, such as those of one class.

    Returns
    -------
    dict of str to float
        By the measure's name; NaN if no query is left.
    """
    return {each.name: _mean(getattr(found, each.name), chosen) for each in fields(found)}


def _mean(values: Floats, chosen: Bools | None) -> float:
    kept = values if chosen is None else values[chosen]
    kept = kept[~np.isnan(kept)]
    return float(kept.mean()) if len(kept) else float("nan")


def _are_mates(labels: Sequence[str]) -> Bools:
    """Return which shapes are of one class, (n, n)."""
    _, number = np.unique(np.asarray(labels, dtype=np.str_), return_inverse=True)
    return number[:, None] == number[None, :]


def _share_among_first(hits: Bools, sought: Ints, depth: Ints) -> Floats:
    """Return the share of `sought` hits among the first `depth` ranks of each row; 0 where none is sought."""
    is_within = np.arange(hits.shape[1]) < depth[:, None]
    return (hits & is_within).sum(axis=1) / np.maximum(sought, 1)


def _average_precision(hits: Bools, sought: Ints) -> Floats:
    precision = np.cumsum(hits, axis=1) / np.arange(1, hits.shape[1] + 1)
    return (precision * hits).sum(axis=1) / np.maximum(sought, 1)
