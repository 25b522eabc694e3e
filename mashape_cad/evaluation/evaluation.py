"""The evaluation of a labelled set: every mode's ranking and its measures, by class and over all queries."""

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.evaluation.measures import Protocol, means, measures_of_ranking, ranking
from mashape_cad.evaluation.modes import Mode, Signatures
from mashape_cad.evaluation.trial import Trial

__all__ = ["ClassResult", "Evaluation", "ModeResult", "Times", "evaluated", "total_times"]


@dataclass(frozen=True, slots=True)
class ClassResult:
    """Means over the queries of one class.

    Attributes
    ----------
    label : str
    members : int
    means : mapping of str to float
        Each measure of `mashape_cad.evaluation.measures.Measures`, 0 to 1; NaN for a class of one.
    """

    label: str
    members: int
    means: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class ModeResult:
    """What one mode comes to in one protocol.

    Attributes
    ----------
    mode : str
    protocol : Protocol
    classes : tuple of ClassResult
        By name.
    means : mapping of str to float
        Over all queries, those that are alone in their class left out.
    """

    mode: str
    protocol: Protocol
    classes: tuple[ClassResult, ...]
    means: Mapping[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """All that was found out with one kind of signatures.

    Attributes
    ----------
    labels : tuple of str
        The class of each shape.
    results : tuple of ModeResult
        Mode by mode, each in both protocols.
    orders : mapping of str to (n, n) arrays of int
        By mode: row i is the order in which query i finds all shapes, itself first.
    seconds : mapping of str to float
        By mode: CPU seconds of all queries, from signatures to rankings.
    """

    labels: tuple[str, ...]
    results: tuple[ModeResult, ...]
    orders: Mapping[str, NDArray[np.intp]]
    seconds: Mapping[str, float]

    def result(self, mode: str, protocol: Protocol) -> ModeResult:
        """Return the result of one mode in one protocol."""
        return next(each for each in self.results if (each.mode, each.protocol) == (mode, protocol))

    @property
    def modes(self) -> tuple[str, ...]:
        """Names of the modes, in the order in which they were given."""
        return tuple(self.orders)


@dataclass(frozen=True, slots=True)
class Times:
    """CPU seconds of a whole set, one processor.

    Attributes
    ----------
    shapes : int
        How many were timed.
    reading, axes, signatures, coarse_signatures, default_signatures : float
        See `mashape_cad.evaluation.trial.Seconds`.
    queries, coarse_queries : float
        All against all, in the mode that takes longest.
    """

    shapes: int
    reading: float
    axes: float
    signatures: float
    coarse_signatures: float
    default_signatures: float
    queries: float
    coarse_queries: float

    @property
    def total(self) -> float:
        """Medial axes, both signatures and queries."""
        return self.axes + self.signatures + self.default_signatures + self.queries


def evaluated(labels: Sequence[str], signatures: Signatures, modes: Sequence[Mode]) -> Evaluation:
    """Rank a set by each mode and measure the rankings.

    Parameters
    ----------
    labels : sequence of str
        The class of each shape.
    signatures : mapping of str to (n, d) arrays
        Their vectors.
    modes : sequence of Mode
        Those that compare other vectors than these are left out.
    """
    orders, seconds = {}, {}
    for mode in modes:
        if not signatures.keys() >= set(mode.vectors):
            continue
        started = time.process_time()
        orders[mode.name] = ranking(mode.distances({name: signatures[name] for name in mode.vectors}), labels)
        seconds[mode.name] = time.process_time() - started
    results = tuple(_result(name, order, labels, protocol) for name, order in orders.items() for protocol in Protocol)
    return Evaluation(tuple(labels), results, orders, seconds)


def _result(mode: str, order: NDArray[np.intp], labels: Sequence[str], protocol: Protocol) -> ModeResult:
    found = measures_of_ranking(order, labels, protocol)
    of_shape = np.asarray(labels, dtype=np.str_)
    names, counts = np.unique(of_shape, return_counts=True)
    classes = (
        ClassResult(label, count, means(found, of_shape == label))
        for label, count in zip(names.tolist(), counts.tolist(), strict=True)
    )
    return ModeResult(mode, protocol, tuple(classes), means(found))


def total_times(trials: Sequence[Trial], full: Evaluation, coarse: Evaluation) -> Times:
    """Add up what the trials took, and the queries of the slowest mode."""
    spent = [each.seconds for each in trials]
    return Times(
        shapes=len(spent),
        reading=math.fsum(each.reading for each in spent),
        axes=math.fsum(each.axis for each in spent),
        signatures=math.fsum(each.signature for each in spent),
        coarse_signatures=math.fsum(each.coarse_signature for each in spent),
        default_signatures=math.fsum(each.shape for each in spent),
        queries=max(full.seconds.values(), default=0.0),
        coarse_queries=max(coarse.seconds.values(), default=0.0),
    )
