"""The trials of a set: made in worker processes, and kept in one file in its folder, which is safe to delete."""

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec

from mashape_cad.errors import KernelUnavailableError
from mashape_cad.evaluation.labelled import LabelledSet, Shape
from mashape_cad.evaluation.trial import Trial, tried
from mashape_cad.library.freshness import Status
from mashape_cad.library.record import CURRENT_SHAPE, CURRENT_SIGNATURE, Failure
from mashape_cad.library.replacing import replace_file
from mashape_cad.options import PartOptions, ScanOptions
from mashape_cad.scanning import Event, FileScanned, ScanStarted
from mashape_cad.workers import outcomes

__all__ = ["STORE", "trials"]

# A name that no scan looks at.
STORE = ".mashape-trials.json"
_FORMAT = 2
_PRELOAD = "mashape_cad.library.preload"

Try = Callable[[Path, str, int, PartOptions], Trial]


@dataclass(frozen=True, slots=True)
class _Stored:
    format: int
    trials: tuple[Trial, ...]


@dataclass(frozen=True, slots=True)
class _Work:
    """What a worker does with one shape; it can be sent to it."""

    function: Try
    options: PartOptions

    def __call__(self, task: tuple[Path, str, int]) -> Trial:
        return self.function(*task, self.options)


def _warm_up() -> None:
    from mashape_cad.library.derivation import warm_up  # noqa: PLC0415  (loads the kernel: in workers only)

    warm_up()


def trials(
    labelled: LabelledSet,
    options: ScanOptions,
    on_event: Callable[[Event], None],
    *,
    function: Try = tried,
    warm_up: Callable[[], None] = _warm_up,
) -> dict[Path, Trial]:
    """Return the trial of each shape, from an earlier evaluation where nothing has changed since.

    Parameters
    ----------
    labelled : LabelledSet
    options : ScanOptions
        Its `jobs` and `timeout`.
    on_event : callable
        Hears of each shape, as of the files of a scan.
    function, warm_up : callable
        What a worker does with a shape, and before its first one. Functions of a module.

    Returns
    -------
    dict of Path to Trial
        Without shapes whose trial failed; `on_event` has heard why.

    Raises
    ------
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    store = labelled.folder / STORE
    earlier = {(each.blake2b, each.profile): each for each in _read(store) if _fits(each, labelled.options)}
    found = {shape.path: earlier[_key(shape)] for shape in labelled.shapes if _key(shape) in earlier}
    missing = [shape for shape in labelled.shapes if shape.path not in found]
    if missing:
        on_event(ScanStarted(len(missing)))
        work = _Work(function, labelled.options)
        found |= dict(_made(missing, options, work, warm_up, on_event))
        _write(store, found.values())
    return found


def _made(
    shapes: list[Shape],
    options: ScanOptions,
    work: _Work,
    warm_up: Callable[[], None],
    on_event: Callable[[Event], None],
) -> Iterator[tuple[Path, Trial]]:
    jobs = options.jobs or os.cpu_count() or 1
    tasks = [(shape.path, *_key(shape)) for shape in shapes]
    results = outcomes(tasks, work, jobs=jobs, timeout=options.timeout, prepare=warm_up, preload=_PRELOAD)
    with closing(results):
        for (path, *_), outcome in results:
            if isinstance(outcome, KernelUnavailableError):
                raise outcome
            if isinstance(outcome, Exception):
                on_event(FileScanned(path, Status.FAILED, failure=Failure("trial", " ".join(str(outcome).split()))))
            else:
                on_event(FileScanned(path, Status.NEW))
                yield path, outcome


def _key(shape: Shape) -> tuple[str, int]:
    return shape.source.blake2b or "", shape.profile


def _fits(trial: Trial, options: PartOptions) -> bool:
    return (trial.signature, trial.shape_signature, trial.options) == (CURRENT_SIGNATURE, CURRENT_SHAPE, options)


def _read(store: Path) -> Iterable[Trial]:
    """Return what an earlier evaluation kept; what cannot be read is as good as none."""
    with suppress(OSError, msgspec.MsgspecError):
        stored = msgspec.json.decode(store.read_bytes(), type=_Stored)
        if stored.format == _FORMAT:
            return stored.trials
    return ()


def _write(store: Path, made: Iterable[Trial]) -> None:
    with suppress(OSError):  # a convenience: without it the next evaluation tries again
        replace_file(store, msgspec.json.encode(_Stored(_FORMAT, tuple(made))))
