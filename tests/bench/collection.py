"""Profiles of real files, set by set: our samples, and the folders that MASHAPE_RETRIEVAL and MASHAPE_CORPUS name.

A *set* is one folder: the samples, or one folder inside those two. Reading costs more than the axis, so what was read
can be kept in a pickle; a file is read again when its size or its time has changed.
"""

import os
import pickle
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from mashape_cad import read
from mashape_cad.errors import MashapeError
from mashape_cad.geometry.profile import Profile
from mashape_cad.library.derivation import warm_up
from mashape_cad.workers import outcomes

__all__ = ["PRELOAD", "SUFFIXES", "Entry", "collected", "files_of_sets", "warm_up"]

SUFFIXES = (".dxf", ".step", ".stp", ".brep", ".brp")
# What workers share, where they can be forked from a prepared process.
PRELOAD = "mashape_cad.library.preload"

_SAMPLES = Path(__file__).parent.parent.parent / "samples"
_FOLDERS = {"retrieval": "MASHAPE_RETRIEVAL", "corpus": "MASHAPE_CORPUS"}
# Seconds for reading one file: the largest real ones take a few.
_PATIENCE = 120.0

Stamp = tuple[int, int]


@dataclass(frozen=True, slots=True, eq=False)
class Entry:
    """What one file gave: its profiles, or the reason why it could not be read."""

    path: Path
    stamp: Stamp
    profiles: tuple[Profile, ...]
    failure: str = ""


def files_of_sets(names: list[str], limit: int) -> dict[str, list[Path]]:
    """Return the part files of each set whose name begins with one of `names`.

    A positive `limit` leaves so many files of a set, spread evenly over it, since neighbours are alike.
    """
    found = {name: _files(folder) for name, folder in _sets() if not names or name.startswith(tuple(names))}
    return {name: _spread(files, limit) for name, files in found.items() if files}


def collected(paths: list[Path], cache: Path | None, jobs: int, tell: Callable[[str], None]) -> dict[Path, Entry]:
    """Read files in worker processes; those that `cache` holds are taken from it, and the others put there."""
    known = pickle.loads(cache.read_bytes()) if cache and cache.exists() else {}  # noqa: S301  (our own file)
    missing = [path for path in paths if path not in known or known[path].stamp != _stamp(path)]
    work = outcomes(missing, _entry, jobs=jobs, timeout=_PATIENCE, prepare=warm_up, preload=PRELOAD)
    with closing(work):
        for done, (path, outcome) in enumerate(work, 1):
            is_lost = isinstance(outcome, Exception)
            known[path] = Entry(path, _stamp(path), (), f"{outcome}") if is_lost else outcome
            tell(f"reading {done} of {len(missing)}")
    if cache and missing:
        cache.write_bytes(pickle.dumps(known))
    return {path: known[path] for path in paths}


def _sets() -> Iterator[tuple[str, Path]]:
    yield "samples", _SAMPLES
    for name, variable in _FOLDERS.items():
        root = os.environ.get(variable)
        for folder in sorted(Path(root).iterdir()) if root else ():
            if folder.is_dir():
                yield f"{name}/{folder.name}", folder.resolve()


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES)


def _spread(files: list[Path], limit: int) -> list[Path]:
    if not 0 < limit < len(files):
        return files
    return [files[k * len(files) // limit] for k in range(limit)]


def _stamp(path: Path) -> Stamp:
    status = path.stat()
    return status.st_size, status.st_mtime_ns


def _entry(path: Path) -> Entry:
    try:
        return Entry(path, _stamp(path), read(path).profiles)
    except MashapeError as error:
        return Entry(path, _stamp(path), (), str(error))
