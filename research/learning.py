"""From groups of variants to code books and metrics."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy import sparse

from mashape_cad.signatures.codebook import Codebook
from mashape_cad.signatures.constants import Constants
from mashape_cad.signatures.contexts import AXIS, BOUNDARY, ContextKind, axis_context, boundary_context, mirror
from mashape_cad.signatures.learned_metric import LearnedMetric
from mashape_cad.signatures.spokes import Spokes

# Numbers of the two contexts and of the summary of the whole, and how much they count; 256 together.
NUMBERS = (104, 104, 48)
WEIGHTS = (1.0, 1.1, 0.7)
WORDS = 128
DIRECTIONS = 40
# Contexts from which words are learned, so many of one shape.
CONTEXTS, OF_ONE = 40_000, 40
ROUNDS = 25
# Of the metric: directions of greatest variance that are looked at, how far differences within groups are evened out
# (1 would be whitening), and what is added to their scatter as a share of its mean.
LOOKED_AT = 600
EVENED = 1.1
REGULAR = 0.03


def books(boundary: np.ndarray, axis: np.ndarray, rng: np.random.Generator) -> Constants:
    """Learn the words of both contexts; the metrics are still empty."""
    none = LearnedMetric(np.zeros((1, 1), np.int8), np.zeros(1, np.float32), np.zeros(1, np.float32), 0.0)
    return Constants(codebook(boundary, BOUNDARY, rng), codebook(axis, AXIS, rng), (none, none, none))


def learned(known: Constants, parts: Sequence[np.ndarray], groups: np.ndarray, rng: np.random.Generator) -> Constants:
    """Learn the metrics from what shapes are described by with known code books, and the numbers of their groups."""
    return replace(known, metrics=metrics(parts, groups, rng))


def metrics(parts: Sequence[np.ndarray], groups: np.ndarray, rng: np.random.Generator) -> tuple[LearnedMetric, ...]:
    """Learn the metrics of both contexts and of the summary of the whole."""
    return tuple(
        metric(part, groups, numbers, weight, rng)
        for part, numbers, weight in zip(parts, NUMBERS, WEIGHTS, strict=True)
    )


def sample(shape: Spokes, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Return some of a shape's boundary contexts and axis contexts."""
    rows = rng.choice(len(shape.weight), OF_ONE, replace=False)
    return boundary_context(shape)[rows], axis_context(shape)[rows]


def codebook(contexts: np.ndarray, kind: ContextKind, rng: np.random.Generator) -> Codebook:
    """Learn words: principal directions, then means of clusters; contexts count with their mirror images."""
    order = mirror(kind)
    both = np.concatenate([contexts, contexts[:, order]]).astype(np.float32)
    mean = both.mean(axis=0)
    _, vectors = np.linalg.eigh(np.cov((both - mean).T))
    basis = np.ascontiguousarray(vectors[:, ::-1][:, :DIRECTIONS]).astype(np.float32)
    points = ((both - mean) @ basis)[rng.permutation(len(both))[:CONTEXTS]]
    words = points[rng.choice(len(points), WORDS, replace=False)]
    for _ in range(ROUNDS):
        nearest = _squared(points, words).argmin(axis=1)
        member = sparse.csr_matrix(
            (np.ones(len(points), np.float32), (nearest, np.arange(len(points)))), (WORDS, len(points))
        )
        count = np.bincount(nearest, minlength=WORDS)[:, None]
        words = np.where(count > 0, (member @ points) / np.maximum(count, 1), words)
    spread = float(np.median(np.sqrt(np.maximum(_squared(points, words).min(axis=1), 0.0))))
    return Codebook(_half(mean), _half(basis), _half(words), spread, order)


def _half(values: np.ndarray) -> np.ndarray:
    """Round to what the file keeps, so that metrics are learned with the words that are shipped."""
    return values.astype(np.float16).astype(np.float32)


def _squared(points: np.ndarray, words: np.ndarray) -> np.ndarray:
    return (points**2).sum(axis=1)[:, None] + (words**2).sum(axis=1) - 2 * points @ words.T


def metric(
    rows: np.ndarray, groups: np.ndarray, numbers: int, weight: float, rng: np.random.Generator
) -> LearnedMetric:
    """Learn a map that shrinks what variants differ by, and keep what then differs most.

    Whitening within groups to a power, as in linear discriminant analysis but for the power; at the end a random turn,
    so that all numbers are of one size and fill their bytes alike.
    """
    rows = rows.astype(np.float64)
    mean = rows.mean(axis=0)
    centred = rows - mean
    basis = leading(centred, min(LOOKED_AT, rows.shape[1]), rng)
    seen = centred @ basis
    number = np.unique(groups, return_inverse=True)[1]
    count = np.bincount(number)
    middle = np.zeros((len(count), seen.shape[1]))
    np.add.at(middle, number, seen)
    within = (seen - (middle / count[:, None])[number])[count[number] > 1]
    scatter = within.T @ within / len(within)
    scatter += REGULAR * np.trace(scatter) / len(scatter) * np.eye(len(scatter))
    values, vectors = np.linalg.eigh(scatter)
    evened = vectors * values ** (-EVENED / 2) @ vectors.T
    seen = seen @ evened
    _, vectors = np.linalg.eigh(seen.T @ seen / len(seen))
    turn = np.linalg.qr(rng.normal(size=(numbers, numbers)))[0]
    full = basis @ evened @ vectors[:, ::-1][:, :numbers] @ turn
    unit = np.abs(full).max(axis=0) / 127
    steps = np.rint(full / unit).astype(np.int8)
    return LearnedMetric(steps, unit.astype(np.float32), (mean @ (steps * unit)).astype(np.float32), weight)


def leading(rows: np.ndarray, count: int, rng: np.random.Generator) -> np.ndarray:
    """Return the directions of greatest variance, by subspace iteration (Halko et al., SIAM Review 53, 2011)."""
    if count == rows.shape[1]:
        return np.eye(count)
    basis = rng.normal(size=(rows.shape[1], count + 60))
    for _ in range(4):
        basis = np.linalg.qr(rows.T @ (rows @ basis))[0]
    vectors = np.linalg.eigh((rows @ basis).T @ (rows @ basis))[1]
    return basis @ vectors[:, ::-1][:, :count]
