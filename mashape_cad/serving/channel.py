"""The two ends of the line to the plug-in: `lines_of` takes in what it sends, a `Channel` gives it its answers."""

import os
import threading
from collections.abc import Callable, Iterator
from queue import SimpleQueue
from typing import BinaryIO

__all__ = ["Channel", "claimed_stdout", "lines_of"]

_CHUNK = 1 << 20
# Seconds that the last lines may take at the end, if nobody reads them.
_PATIENCE = 1.0


def claimed_stdout() -> BinaryIO:
    """Return a stream to where stdout leads, and let whatever else writes there write to stderr from now on.

    That is the file descriptor itself: libraries written in C++ know nothing of `sys.stdout`.
    """
    ours = os.dup(1)
    os.dup2(2, 1)
    return os.fdopen(ours, "wb", buffering=0)


def lines_of(descriptor: int) -> Iterator[bytes]:
    """Yield the lines that come from a file descriptor; the beginning of one that never ended is left out.

    Python's own stream would do, but for this: it has a lock, which a thread that waits for a line holds, and Python
    aborts if it is held when the process ends.
    """
    pieces = list[bytes]()
    while chunk := os.read(descriptor, _CHUNK):
        first, *more = chunk.split(b"\n")
        pieces.append(first)
        for start in more:
            yield b"".join(pieces)
            pieces = [start]


class Channel:
    """Writes lines in a thread of its own, whole and in order, so that a cancelled request never leaves half a line.

    Parameters
    ----------
    stream : binary stream
        Not buffered.
    on_closed : callable
        Called, in that thread, if nobody reads any more.
    """

    def __init__(self, stream: BinaryIO, on_closed: Callable[[], None]) -> None:
        self._stream = stream
        self._on_closed = on_closed
        self._lines = SimpleQueue[str | None]()
        self._thread = threading.Thread(target=self._write, daemon=True)
        self._thread.start()

    def send(self, line: str) -> None:
        """Send a line; it is on its way when this returns."""
        self._lines.put(line)

    def close(self) -> None:
        """Wait until all lines are written."""
        self._lines.put(None)
        self._thread.join(_PATIENCE)

    def _write(self) -> None:
        try:
            while (line := self._lines.get()) is not None:
                _write_all(self._stream, f"{line}\n".encode())
        except OSError:
            self._on_closed()


def _write_all(stream: BinaryIO, content: bytes) -> None:
    left = memoryview(content)
    while left:
        left = left[stream.write(left) :]
