"""CPU time of a call: warm, repeated, the median."""

import gc
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

__all__ = ["median_ms", "pooled", "timed"]

Result = TypeVar("Result")

# Seconds after which a slow call is not repeated any more, and for which a quick one is: FloMat runs warm for longer.
_ENOUGH, _AT_LEAST = 3.0, 0.3


def timed(function: Callable[[], Result]) -> tuple[Result, float]:
    """Return the result of a call and its CPU time, ms."""
    start = time.process_time()
    result = function()
    return result, 1000 * (time.process_time() - start)


def median_ms(function: Callable[[], dict[str, float]], repeats: int) -> dict[str, float]:
    """Call for CPU times by part several times, once more before; return the median of each part.

    A call that takes long needs no warm-up, and is not repeated.
    """
    start, times = time.monotonic(), [function()]
    if time.monotonic() - start > _ENOUGH:
        return times[0]
    times.clear()
    with _without_garbage_collection():
        while (
            not times
            or time.monotonic() - start < _AT_LEAST
            or (len(times) < repeats and time.monotonic() - start < _ENOUGH)
        ):
            times.append(function())
    return pooled(times)


def pooled(times: list[dict[str, float]]) -> dict[str, float]:
    """Return the median of each part."""
    return {part: statistics.median(each[part] for each in times) for part in times[0]}


@contextmanager
def _without_garbage_collection() -> Iterator[None]:
    """Do as timeit does: the many objects that some peers make are not held against them.

    Nothing is collected between calls either: that walks through all of the kernel's bindings, and the call after it
    starts with the processor's caches cold, half a millisecond that peers measured in a loop of their own do not pay.
    """
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
