"""Worker processes that do one thing to many items: a time limit for each, and a worker that dies is replaced.

Each worker has a pipe of its own and one item at a time, so that it is always known which item a worker was at when it
died or ran out of time: the others lose nothing. (Ready-made pools share one queue among all workers. They break as a
whole, or blame a neighbour, when a process vanishes right after taking an item; both were seen.)
"""

import multiprocessing
import os
import signal
import sys
import threading
import time
import warnings
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.context import BaseContext
from multiprocessing.process import BaseProcess
from typing import Any, Generic, TypeVar

from mashape_cad.errors import MashapeError

__all__ = ["WorkerDiedError", "WorkersUnavailableError", "outcomes"]

Item = TypeVar("Item")
Result = TypeVar("Result")

# Some systems notice Ctrl-C only between two waits, seconds: the longest time that this may take.
_PATIENCE = 0.5
# Seconds until a worker has loaded what is heavy; the very first one of an installation compiles for a minute or two.
_PREPARATION = 900.0
# Workers that die in a row before their first item: then it is not bad luck but this machine.
_MOST_STILLBORN = 3
_READY = "ready"
# What tells the libraries behind numpy, before it is loaded, how many threads to take.
_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
_ENVIRONMENT = threading.Lock()  # one at a time changes it


class WorkerDiedError(Exception):
    """The worker process of an item ended without an answer."""


class WorkersUnavailableError(MashapeError):
    """Worker processes cannot be started on this machine."""


@dataclass(slots=True)
class _Worker(Generic[Item]):
    """One process; `item` is what it is at, in a list of one, or none yet."""

    process: BaseProcess
    pipe: Connection
    item: list[Item]
    deadline: float

    def begin(self, item: Item, timeout: float) -> None:
        self.item, self.deadline = [item], time.monotonic() + timeout
        with suppress(OSError):  # died while idle: its pipe will say so
            self.pipe.send(item)

    def end(self) -> str:
        """Kill the process and return how it ended; it holds nothing that would have to be put in order."""
        self.pipe.close()
        self.process.join(0.1)  # if it is dying by itself, learn of what
        self.process.kill()
        self.process.join()
        code = self.process.exitcode or 0
        return f"killed by {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"


def outcomes(
    items: Iterable[Item],
    function: Callable[[Item], Result],
    *,
    jobs: int,
    timeout: float,
    prepare: Callable[[], None],
    preload: str,
) -> Generator[tuple[Item, Result | Exception], None, None]:
    """Apply a function to items in worker processes and yield each with its outcome, in the order of finishing.

    Parameters
    ----------
    items : iterable
    function : callable
        Of one item; it can be pickled.
    jobs : int
        Number of workers.
    timeout : float
        Seconds for one item; then its worker is killed.
    prepare : callable
        Called in each worker before its first item, outside the time limit; what it raises is ignored.
    preload : str
        Module that is imported once for all workers, where the system can fork them from a prepared process.

    Yields
    ------
    item, outcome
        The outcome is the function's value, the exception that it raised, `TimeoutError` or `WorkerDiedError`.

    Raises
    ------
    WorkersUnavailableError
        If workers die before they begin.

    Notes
    -----
    Workers are killed when the generator is closed or an exception passes through it, `KeyboardInterrupt` too.
    """
    crew = _Crew[Item, Result](deque(items), function, timeout, prepare, _context(preload))
    try:
        while crew.queue or crew.is_busy:
            crew.man(jobs)
            yield from crew.news()
    finally:
        crew.dismiss()


class _Crew(Generic[Item, Result]):
    def __init__(
        self,
        queue: deque[Item],
        function: Callable[[Item], Result],
        timeout: float,
        prepare: Callable[[], None],
        context: BaseContext,
    ) -> None:
        self.queue = queue
        self._duty = (function, prepare)
        self._timeout = timeout
        self._context = context
        self._workers = dict[Connection, _Worker[Item]]()
        self._stillborn = 0

    @property
    def is_busy(self) -> bool:
        """Whether any worker is at an item."""
        return any(worker.item for worker in self._workers.values())

    def man(self, jobs: int) -> None:
        """Start workers until there are as many as asked for, or as there are items."""
        wanted = min(jobs, len(self.queue) + sum(bool(worker.item) for worker in self._workers.values()))
        while len(self._workers) < wanted:
            ours, theirs = self._context.Pipe()
            process = self._context.Process(  # type: ignore[attr-defined]  # typeshed leaves it to the subclasses
                target=_serve, args=(theirs, *self._duty), daemon=True
            )
            with _one_thread_each():
                process.start()
            theirs.close()  # so that ours ends when the process does
            self._workers[ours] = _Worker(process, ours, [], time.monotonic() + _PREPARATION)

    def news(self) -> Iterator[tuple[Item, Result | Exception]]:
        """Wait for a moment; yield what was done, died or took too long, and hand out new items."""
        next_deadline = min(worker.deadline for worker in self._workers.values())
        patience = min(_PATIENCE, max(0.0, next_deadline - time.monotonic()))
        for pipe in wait(list(self._workers), patience):
            yield from self._heard(self._workers[pipe])  # type: ignore[index]  # only our connections were waited for
        for worker in list(self._workers.values()):
            if worker.deadline < time.monotonic():
                yield from self._lost(worker, TimeoutError(f"took longer than {self._timeout:g} s"))

    def _heard(self, worker: _Worker[Item]) -> Iterator[tuple[Item, Result | Exception]]:
        try:
            answer = worker.pipe.recv()
        except (EOFError, OSError):
            yield from self._lost(worker, None)
            return
        if worker.item:
            yield worker.item[0], answer
        self._stillborn = 0
        worker.item, worker.deadline = [], float("inf")
        if self.queue:
            worker.begin(self.queue.popleft(), self._timeout)

    def _lost(self, worker: _Worker[Item], error: Exception | None) -> Iterator[tuple[Item, Result | Exception]]:
        last_words = self._discharge(worker)
        if worker.item:
            yield worker.item[0], error or WorkerDiedError(last_words)
            return
        self._stillborn += 1
        if self._stillborn >= _MOST_STILLBORN:
            raise WorkersUnavailableError(
                f'worker processes cannot start ({last_words}); in a script, call scan under: if __name__ == "__main__"'
            )

    def _discharge(self, worker: _Worker[Item]) -> str:
        del self._workers[worker.pipe]
        return worker.end()

    def dismiss(self) -> None:
        """Kill all workers."""
        for worker in self._workers.values():
            worker.process.kill()
        for worker in list(self._workers.values()):
            self._discharge(worker)


def _context(preload: str) -> BaseContext:
    """Return how workers are started: forked from a prepared process on Linux, else each from scratch."""
    if sys.platform != "linux":
        return multiprocessing.get_context("spawn")
    from multiprocessing import forkserver  # noqa: PLC0415  (not on every system)

    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([preload])
    with _deaf_to_interrupts(), _one_thread_each():
        forkserver.ensure_running()
    return context


@contextmanager
def _one_thread_each() -> Iterator[None]:
    """Have processes that are started now multiply matrices in one thread, unless the user wants it otherwise.

    Matrices are small here: two threads take twice the processor time and gain nothing, and workers are many already.
    """
    with _ENVIRONMENT:
        added = () if any(name in os.environ for name in _THREADS) else _THREADS
        os.environ.update(dict.fromkeys(added, "1"))
        try:
            yield
        finally:
            for name in added:
                os.environ.pop(name, None)


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """Ignore Ctrl-C for a moment: a process started now inherits that, and so do all that it starts.

    A terminal sends Ctrl-C to all processes at once; workers that are just starting would each print a traceback.
    """
    if threading.current_thread() is not threading.main_thread():
        yield  # only the main thread may say so
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _serve(pipe: Connection, function: Callable[[Any], Any], prepare: Callable[[], None]) -> None:
    """Be a worker: answer each item that comes through the pipe until the other end closes it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    os.dup2(2, 1)  # what libraries print does not belong between the results
    if not sys.warnoptions:
        warnings.simplefilter("ignore")
    with suppress(Exception):  # each item will meet the same and say so
        prepare()
    pipe.send(_READY)
    with suppress(EOFError, OSError):  # nobody is there any more
        while True:
            pipe.send(_answer(function, pipe.recv()))


def _end_with_parent() -> None:
    """Wait until the process that gives us work is gone, whatever it died of, and end in the middle of ours."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _answer(function: Callable[[Any], Any], item: Any) -> Any:
    try:
        return function(item)
    except Exception as error:  # noqa: BLE001  (it is the answer)
        return error
