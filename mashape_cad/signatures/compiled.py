"""Compilation of this floor's scalar code, on top of that of the medial axis."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from numba import config

from mashape_cad.medial import compiled as below

__all__ = ["compiled"]

Function = TypeVar("Function", bound=Callable[..., object])

# Of all sources in this folder: name, time of change, size.
_SOURCES = tuple(
    (path.name, path.stat().st_mtime, path.stat().st_size) for path in sorted(Path(__file__).parent.glob("*.py"))
)


def compiled(function: Function) -> Function:
    """Compile a function when it is first called, as `mashape_cad.medial.compiled.compiled` does.

    What is compiled here goes stale when a module of either floor changes, not only when one of the axis does.
    """
    dispatcher = below.compiled(function)
    if not config.DISABLE_JIT:  # type: ignore[attr-defined]
        file = dispatcher._cache._cache_file  # type: ignore[attr-defined]  # noqa: SLF001
        file._source_stamp += _SOURCES  # noqa: SLF001
    return dispatcher
