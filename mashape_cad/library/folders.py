"""Which part files lie below a folder.

Hidden files and folders (a name that starts with a dot) are left out. Links to folders are followed, each folder once,
so that a link back up is harmless.
"""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

from mashape_cad.errors import LibraryError, UnreadableFileError

__all__ = ["PART_SUFFIXES", "check_file", "check_folder", "part_files"]

PART_SUFFIXES = (".dxf", ".step", ".stp", ".brep", ".brp")

Refused = Callable[[Path, OSError], None]


def check_folder(folder: Path) -> None:
    """See that there is such a folder.

    Raises
    ------
    LibraryError
        If there is none.
    """
    if not folder.is_dir():
        what = (
            "is a file, not a folder; give the folder it lies in"
            if folder.exists()
            else "no such folder; check the path"
        )
        raise LibraryError(f"{folder}: {what}")


def check_file(path: Path) -> None:
    """See that there is such a file.

    Raises
    ------
    UnreadableFileError
        If there is none.
    """
    if not path.is_file():
        what = "is a folder; give one of its files" if path.is_dir() else "no such file; check the path"
        raise UnreadableFileError(f"{path}: {what}")


def part_files(folder: Path, on_refused: Refused) -> Iterator[Path]:
    """Yield the part files below a folder, by name; `on_refused` hears of folders that cannot be listed.

    A link to a part counts as a part, also if it leads nowhere: whoever reads it will say so.
    """
    return _below(folder, on_refused, set())


def _below(folder: Path, on_refused: Refused, seen: set[tuple[int, int]]) -> Iterator[Path]:
    try:
        identity = folder.stat()
        entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
    except OSError as error:
        on_refused(folder, error)
        return
    if (identity.st_dev, identity.st_ino) in seen:
        return
    seen.add((identity.st_dev, identity.st_ino))
    for entry in entries:
        if entry.name.startswith("."):
            continue
        if _is_folder(entry):
            yield from _below(folder / entry.name, on_refused, seen)
        elif entry.name.lower().endswith(PART_SUFFIXES) and (entry.is_symlink() or entry.is_file()):
            yield folder / entry.name


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:  # a link that leads to itself
        return False
