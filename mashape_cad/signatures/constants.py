"""What was learned on generated shapes, frozen: code books and metrics of the default signature.

``research/learn.py`` makes the file beside this module; whoever changes it raises its version.
"""

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import IO

import numpy as np

from mashape_cad.signatures.codebook import Codebook
from mashape_cad.signatures.contexts import AXIS, BOUNDARY, ContextKind, mirror
from mashape_cad.signatures.learned_metric import LearnedMetric

__all__ = ["FILE", "VERSION", "Constants", "read_constants", "shipped", "write_constants"]

VERSION = 1
FILE = f"default-{VERSION}.npz"


@dataclass(frozen=True, slots=True, eq=False)
class Constants:
    """All that the default signature is computed with.

    Attributes
    ----------
    boundary, axis : Codebook
        Words of the two contexts.
    metrics : tuple of LearnedMetric
        Of boundary contexts, axis contexts, and the summary of the whole.
    """

    boundary: Codebook
    axis: Codebook
    metrics: tuple[LearnedMetric, LearnedMetric, LearnedMetric]


@cache
def shipped() -> Constants:
    """Return the constants of this release."""
    with files("mashape_cad.signatures").joinpath(FILE).open("rb") as stream:
        return read_constants(stream)


def read_constants(stream: IO[bytes]) -> Constants:
    """Read what `write_constants` has written.

    Raises
    ------
    ValueError
        If it is of another version.
    """
    with np.load(stream) as kept:
        if int(kept["version"]) != VERSION:
            raise ValueError(f"constants of version {int(kept['version'])}, this release has version {VERSION}")
        arrays = {name: kept[name] for name in kept.files}
    metrics = [
        LearnedMetric(
            arrays[f"{name}_steps"],
            arrays[f"{name}_unit"],
            arrays[f"{name}_offset"],
            float(arrays[f"{name}_weight"]),
        )
        for name in _METRICS
    ]
    return Constants(
        _codebook(arrays, "boundary", BOUNDARY), _codebook(arrays, "axis", AXIS), (metrics[0], metrics[1], metrics[2])
    )


def write_constants(stream: IO[bytes], constants: Constants) -> None:
    """Write constants, code books to half precision."""
    arrays: dict[str, np.ndarray] = {"version": np.array(VERSION)}
    for name, book in (("boundary", constants.boundary), ("axis", constants.axis)):
        for part in ("mean", "basis", "words"):
            arrays[f"{name}_{part}"] = getattr(book, part).astype(np.float16)
        arrays[f"{name}_spread"] = np.array(book.spread, dtype=np.float32)
    for name, metric in zip(_METRICS, constants.metrics, strict=True):
        for part in ("steps", "unit", "offset"):
            arrays[f"{name}_{part}"] = getattr(metric, part)
        arrays[f"{name}_weight"] = np.array(metric.weight, dtype=np.float32)
    np.savez_compressed(stream, **arrays)  # type: ignore[arg-type]


_METRICS = ("boundary_metric", "axis_metric", "whole_metric")


def _codebook(arrays: dict[str, np.ndarray], name: str, kind: ContextKind) -> Codebook:
    mean, basis, words = (arrays[f"{name}_{part}"].astype(np.float32) for part in ("mean", "basis", "words"))
    return Codebook(mean, basis, words, float(arrays[f"{name}_spread"]), mirror(kind))
