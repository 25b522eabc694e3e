"""Libraries that stay loaded between two requests, and are loaded again when something in them has changed: `Shelf`."""

from collections.abc import Iterator
from pathlib import Path

from mashape_cad.library.folders import part_files
from mashape_cad.library.library import Library
from mashape_cad.library.sidecar import sidecar_path

__all__ = ["Shelf"]

# Time of the last change and size; None for a file that is not there.
_State = tuple[int, int] | None
_Stamp = tuple[tuple[Path, _State, _State], ...]


class Shelf:
    """Keeps the library that was asked last."""

    def __init__(self) -> None:
        self._kept: tuple[tuple[Path, ...], _Stamp, Library] | None = None

    def library(self, folders: tuple[Path, ...]) -> Library:
        """Return the library of these folders as it is now.

        Raises
        ------
        LibraryError
            If they do not make one.
        """
        stamp = tuple(_stamps(folders))
        if self._kept is None or self._kept[:2] != (folders, stamp):
            self._kept = None
            self._kept = (folders, stamp, Library(*folders))
        return self._kept[2]


def _stamps(folders: tuple[Path, ...]) -> Iterator[tuple[Path, _State, _State]]:
    """Yield each part file with its state and that of its sidecar: much faster than reading them."""
    for folder in folders:
        for path in part_files(folder, lambda *_: None):  # the library says what is wrong with a folder
            yield path, _state(path), _state(sidecar_path(path))


def _state(path: Path) -> _State:
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size
