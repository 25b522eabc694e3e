"""Compilation of the scalar code that the medial axis consists of.

The search works on a few numbers at a time, where calls of numpy cost many times what they compute. So it is written as
scalar code and compiled by numba, once for each machine and release: the first axis takes about a minute longer, later
programs load the result from a cache beside the source, or in the user's cache folder where that is read-only.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
from numba import config, njit

__all__ = ["Records", "compiled", "records"]

# Rows with named fields; numpy has no types for these.
Records = Any

Function = TypeVar("Function", bound=Callable[..., object])

# Of all sources in this folder: name, time of change, size.
_SOURCES = tuple(
    (path.name, path.stat().st_mtime, path.stat().st_size) for path in sorted(Path(__file__).parent.glob("*.py"))
)


def compiled(function: Function) -> Function:
    """Compile a function when it is first called.

    Division by zero gives an infinity or NaN, as in numpy, and no exception: exceptions would double the code, and what
    stands still is refused beforehand (`validity`).
    """
    if config.DISABLE_JIT:  # type: ignore[attr-defined]
        return function
    dispatcher = njit(cache=True, error_model="numpy")(function)
    # What is compiled holds copies of the functions it calls, but the cache looks at the caller's own file only: it
    # would keep old code when another module changes. So it is told to look at all of them.
    dispatcher._cache._cache_file._source_stamp = _SOURCES  # type: ignore[attr-defined]  # noqa: SLF001
    return cast("Function", dispatcher)


def records(rows: Records) -> Records:
    """Return rows with fields as compiled code takes them: ``rows[k].field``.

    So they are read in interpreted code only off a record array, which costs Python fifty times as much to look at.
    """
    return rows.view(np.recarray) if config.DISABLE_JIT else rows  # type: ignore[attr-defined]
