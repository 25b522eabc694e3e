"""Whose turn it is, and how another thread ends it: `Turns`.

Work on a request goes on in the main thread, as long as it takes. Python runs the handler of a signal in that thread,
between two steps of whatever it does, and the handler may raise: so a request ends in the middle of an axis or of a
ranking, and nothing on the way there needs to know of it. Only a single call into the kernel runs to its end.
"""

import _thread
import signal
import threading
from types import FrameType

from mashape_cad.serving.protocol import Id

__all__ = ["Cancelled", "Turns"]


class Cancelled(BaseException):
    """The request at work is no longer wanted."""


class Turns:
    """Requests that wait, and the one whose turn it is.

    `wait` and `cancel` and `end` are for the thread that hears of requests, all else for the main thread.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting = set[Id]()
        self._current: Id | None = None
        self._doomed: Id | None = None
        self.is_over = False

    def listen(self) -> None:
        """Take over the signal of Ctrl-C, which this process may still send to itself."""
        signal.signal(signal.SIGINT, self._interrupt)

    def wait(self, request: Id) -> bool:
        """Put a request into the queue; return False if one of this name is there or at work."""
        with self._lock:
            if request in self._waiting or request == self._current:
                return False
            self._waiting.add(request)
        return True

    def begin(self, request: Id) -> bool:
        """Give a waiting request its turn; return whether it still wants it."""
        with self._lock:
            wanted = request in self._waiting
            self._waiting.discard(request)
            if wanted:
                self._current = request
        return wanted

    def finish(self) -> None:
        """End the turn; from here on it cannot be cancelled."""
        self._current = None

    def check(self) -> None:
        """Raise if the request at work has been cancelled: for places where signals are not heard."""
        if self.is_over:
            raise KeyboardInterrupt
        if self._current is not None and self._doomed == self._current:
            self._doomed = None
            raise Cancelled

    def cancel(self, request: Id) -> bool:
        """Give up a request; return whether that is all, because it had not begun."""
        with self._lock:
            if request in self._waiting:
                self._waiting.discard(request)
                return True
            if request == self._current:
                self._doomed = request
                _thread.interrupt_main()
        return False

    def end(self) -> None:
        """Give up everything."""
        self.is_over = True
        _thread.interrupt_main()

    def _interrupt(self, _signal: int, _frame: FrameType | None) -> None:
        doomed = self._doomed
        self.check()
        self._doomed = None
        if doomed is None:  # a person did it
            raise KeyboardInterrupt
