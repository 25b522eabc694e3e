"""What the set's sidecars do not say of a part: how long each step takes, and its signature from half the stations.

The paper compares steps 0.01 and 0.02 (section 4.5, Table 4) and states running times (section 4.1, Table 5).
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from mashape_cad.library.record import CURRENT_SHAPE, CURRENT_SIGNATURE, SignatureName
from mashape_cad.options import PartOptions

__all__ = ["Seconds", "Trial", "coarser", "tried"]

Value = TypeVar("Value")


@dataclass(frozen=True, slots=True)
class Seconds:
    """CPU seconds that one part takes in a process that is warm.

    Attributes
    ----------
    reading : float
        From file to profiles, all of the file's.
    axis : float
        The exact medial axis of one profile; it does not depend on a step.
    signature : float
        Paper mode's signature as sidecars have it.
    coarse_signature : float
        The same from half as many stations.
    shape : float
        The default signature as sidecars have it.
    """

    reading: float
    axis: float
    signature: float
    coarse_signature: float
    shape: float


@dataclass(frozen=True, slots=True)
class Trial:
    """One part, computed anew.

    Attributes
    ----------
    blake2b : str
        Hash of the part's file.
    profile : int
    signature, shape_signature : SignatureName
    options : PartOptions
        What shaped the signatures that were timed; the coarse ones have half the stations, or steps.
    seconds : Seconds
    coarse : mapping of str to tuple of float
        Vectors of the coarse signatures.
    """

    blake2b: str
    profile: int
    signature: SignatureName
    shape_signature: SignatureName
    options: PartOptions
    seconds: Seconds
    coarse: Mapping[str, tuple[float, ...]]


def coarser(per_edge: int) -> int:
    """Return half as many stations: 50 for the paper's step 0.02, where 0.01 has 100 (reading 2)."""
    return max(per_edge // 2, 1)


def tried(path: Path, blake2b: str, profile: int, options: PartOptions) -> Trial:
    """Compute one part anew and time it.

    Raises
    ------
    MashapeError
        If the file cannot be read, or the profile has no medial axis.
    """
    # Loads the kernel: only in workers, and only for a part that was not tried before.
    from mashape_cad.library.derivation import read_part  # noqa: PLC0415
    from mashape_cad.medial.axis import medial_axis  # noqa: PLC0415
    from mashape_cad.signatures import paper, shape, spokes  # noqa: PLC0415

    stations = options.signature.per_edge
    reading, part = _timed(lambda: read_part(path, options.read))
    tracing, axis = _timed(lambda: medial_axis(part.profiles[profile]))
    full, _ = _timed(lambda: paper.signature(axis, stations))
    half, coarse = _timed(lambda: paper.signature(axis, coarser(stations)))
    default, _ = _timed(lambda: shape.shape_signature(axis))
    coarse_shape = shape.shape_signature(axis, coarser(spokes.STEPS))
    vectors = {name: tuple(row.tolist()) for each in (coarse, coarse_shape) for name, row in each.vectors.items()}
    spent = Seconds(reading, tracing, full, half, default)
    return Trial(blake2b, profile, CURRENT_SIGNATURE, CURRENT_SHAPE, options, spent, vectors)


def _timed(step: Callable[[], Value]) -> tuple[float, Value]:
    started = time.process_time()
    value = step()
    return time.process_time() - started, value
