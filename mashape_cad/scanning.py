"""Scan folders: derive what is new or changed in worker processes, write a sidecar for each part.

One bad file costs that file only: it has a time limit, and a worker that dies is replaced. Only this process writes,
each sidecar whole or not at all, so that an interrupted scan leaves nothing half done; the next one goes on where it
ended.
"""

import os
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import closing, suppress
from dataclasses import dataclass, fields
from pathlib import Path

from mashape_cad.errors import KernelUnavailableError, MashapeError, SidecarError, UnreadableFileError
from mashape_cad.library.folders import check_folder, part_files
from mashape_cad.library.freshness import Status, freshness, source_of
from mashape_cad.library.record import Failure, Sidecar
from mashape_cad.library.sidecar import decode, encode, sidecar_path, write_sidecar
from mashape_cad.options import PartOptions, ScanOptions
from mashape_cad.workers import WorkerDiedError, outcomes

__all__ = ["Event", "FileScanned", "ScanStarted", "ScanSummary", "scan"]

Derive = Callable[[Path, PartOptions], Sidecar]

# What workers share where they can: see its text.
_PRELOAD = "mashape_cad.library.preload"


@dataclass(frozen=True, slots=True)
class ScanStarted:
    """All folders are listed; `total` part files were found."""

    total: int


@dataclass(frozen=True, slots=True)
class FileScanned:
    """One part file is done with.

    Attributes
    ----------
    path : Path
        The file, or a folder that could not be listed.
    status : Status
    sidecar : Sidecar or None
        What is on record now; None if nothing could be.
    failure : Failure or None
        Why the file gave nothing, now (`status` is `FAILED`) or when it was last tried (`UNCHANGED`). Its kinds are
        those of the record, and ``sidecar`` for a sidecar that cannot be written or is not ours to replace.
    """

    path: Path
    status: Status
    sidecar: Sidecar | None = None
    failure: Failure | None = None


@dataclass(frozen=True, slots=True)
class ScanSummary:
    """How a scan ended.

    Attributes
    ----------
    new, changed, unchanged, failed : int
        Files by status.
    failed_before : int
        Those of the unchanged that failed when they were last tried.
    profiles : int
        Profiles of all files together.
    seconds : float
    """

    new: int
    changed: int
    unchanged: int
    failed: int
    failed_before: int
    profiles: int
    seconds: float


Event = ScanStarted | FileScanned


def _derive(path: Path, options: PartOptions) -> Sidecar:
    from mashape_cad.library.derivation import derive  # noqa: PLC0415  (loads the kernel: in workers only)

    return derive(path, options)


def _warm_up() -> None:
    from mashape_cad.library.derivation import warm_up  # noqa: PLC0415  (as above)

    warm_up()


@dataclass(frozen=True, slots=True)
class _Work:
    """What a worker does for one file: the bytes of a sidecar, whatever happens."""

    derive: Derive
    options: PartOptions

    def __call__(self, path: Path) -> bytes:
        try:
            return encode(self.derive(path, self.options))
        except (KernelUnavailableError, UnreadableFileError):
            raise
        except Exception as error:  # noqa: BLE001  (the one place where a part's exception ends)
            return encode(Sidecar.failed(source_of(path), self.options, _internal(error)))


def scan(
    folders: Iterable[Path | str],
    options: ScanOptions | None = None,
    on_event: Callable[[Event], None] | None = None,
    *,
    derive: Derive = _derive,
    warm_up: Callable[[], None] = _warm_up,
) -> ScanSummary:
    """Read all parts below the folders and write their sidecars.

    Parameters
    ----------
    folders : iterable of path
        Walked through with all their subfolders, hidden ones left out.
    options : ScanOptions, optional
    on_event : callable, optional
        Hears of the start, then of each file: first of those that are unchanged, then in the order of finishing.
    derive, warm_up : callable
        What a worker does for a file, and before its first one, outside the time limit. Functions of a module.

    Returns
    -------
    ScanSummary

    Raises
    ------
    LibraryError
        If a folder does not exist.
    KernelUnavailableError
        If the geometry kernel cannot be imported.

    Notes
    -----
    Workers are processes: a script that calls this needs the usual ``if __name__ == "__main__":``.
    """
    started = time.perf_counter()
    options = options or ScanOptions()
    counts = Counter[str]()
    for event in _events(folders, options, _Work(derive, options.part), warm_up):
        if isinstance(event, FileScanned):
            counts.update(_counts(event))
        if on_event is not None:
            on_event(event)
    counted = {each.name: counts[each.name] for each in fields(ScanSummary) if each.name != "seconds"}
    return ScanSummary(**counted, seconds=time.perf_counter() - started)


def _events(
    folders: Iterable[Path | str], options: ScanOptions, work: _Work, warm_up: Callable[[], None]
) -> Iterator[Event]:
    parts, refused = _listed(folders)
    yield ScanStarted(len(parts) + len(refused))
    yield from refused
    tasks = dict[Path, Status]()
    for part in parts:
        settled = _checked(part, options)
        if isinstance(settled, FileScanned):
            yield settled
        else:
            tasks[part] = settled
    jobs = options.jobs or os.cpu_count() or 1
    found = outcomes(tasks, work, jobs=jobs, timeout=options.timeout, prepare=warm_up, preload=_PRELOAD)
    with closing(found):
        for part, outcome in found:
            yield _kept(part, tasks[part], outcome, options)


def _listed(folders: Iterable[Path | str]) -> tuple[list[Path], list[FileScanned]]:
    """Return all part files, each once, and the folders that could not be listed."""
    refused = list[FileScanned]()

    def on_refused(folder: Path, error: OSError) -> None:
        text = f"{folder}: cannot be listed ({error.strerror}); allow it and scan again"
        refused.append(FileScanned(folder, Status.FAILED, failure=Failure("unreadable", text)))

    paths = [Path(folder) for folder in folders]
    for folder in paths:
        check_folder(folder)
    parts = {part.absolute(): part for folder in paths for part in part_files(folder, on_refused)}
    return list(parts.values()), refused


def _checked(part: Path, options: ScanOptions) -> FileScanned | Status:
    """Return the end of the matter for a file that is unchanged or beyond reach, else what it will be."""
    try:
        fresh = freshness(part, options.part)
    except (SidecarError, UnreadableFileError) as error:
        return _out_of_reach(part, error)
    if fresh.sidecar is None:
        return fresh.status
    if fresh.sidecar.failure is not None and options.retry_failed:
        return Status.CHANGED
    if fresh.is_moved:
        with suppress(SidecarError):  # a convenience: without it the next scan computes the hash once more
            write_sidecar(sidecar_path(part), fresh.sidecar)
    return FileScanned(part, fresh.status, fresh.sidecar, fresh.sidecar.failure)


def _kept(part: Path, status: Status, outcome: bytes | Exception, options: ScanOptions) -> FileScanned:
    """Write the sidecar that a worker made, or one that says why there is none."""
    if isinstance(outcome, KernelUnavailableError):
        raise outcome
    try:
        sidecar = decode(outcome) if isinstance(outcome, bytes) else _failed(part, outcome, options)
        write_sidecar(sidecar_path(part), sidecar)
    except (SidecarError, UnreadableFileError) as error:
        return _out_of_reach(part, error)
    return FileScanned(part, Status.FAILED if sidecar.failure else status, sidecar, sidecar.failure)


def _failed(part: Path, error: Exception, options: ScanOptions) -> Sidecar:
    if isinstance(error, UnreadableFileError):
        raise error
    if isinstance(error, TimeoutError):
        text = f"took longer than {options.timeout:g} s; allow more with --timeout and --retry-failed"
        failure = Failure("timeout", text)
    elif isinstance(error, WorkerDiedError):
        failure = Failure("crash", f"its worker process died ({error}); try again with --retry-failed")
    else:
        failure = _internal(error)
    return Sidecar.failed(source_of(part), options.part, failure)


def _internal(error: Exception) -> Failure:
    text = " ".join(f"{type(error).__name__}: {error}".split())
    return Failure("internal", f"a fault of this program ({text}); please report it with the file")


def _out_of_reach(part: Path, error: MashapeError) -> FileScanned:
    kind = "sidecar" if isinstance(error, SidecarError) else "unreadable"
    return FileScanned(part, Status.FAILED, failure=Failure(kind, str(error)))


def _counts(event: FileScanned) -> Counter[str]:
    counts = Counter({event.status.value: 1})
    counts["failed_before"] = event.status is Status.UNCHANGED and event.failure is not None
    counts["profiles"] = len(event.sidecar.profiles) if event.sidecar else 0
    return counts
