"""Requests of a plug-in in, answers out, for as long as it keeps the line open: `serve`."""

import os
import sys
import threading
from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import islice
from pathlib import Path
from queue import Empty, SimpleQueue
from time import perf_counter
from typing import Any, BinaryIO

from mashape_cad import scanning
from mashape_cad.errors import KernelUnavailableError, LibraryError, MashapeError
from mashape_cad.library.folders import check_file
from mashape_cad.library.library import Library, Query
from mashape_cad.library.match import Match
from mashape_cad.library.record import ProfileRecord
from mashape_cad.options import SearchOptions
from mashape_cad.serving.channel import Channel
from mashape_cad.serving.protocol import PROTOCOL, Cancel, Id, Request, RequestError, Scan, Search, parsed
from mashape_cad.serving.shelf import Shelf
from mashape_cad.serving.turns import Cancelled, Turns
from mashape_cad.version import __version__
from mashape_cad.views.answer import answer_lines
from mashape_cad.views.messages import file_message, message, readable, scan_summary
from mashape_cad.views.tile import tile_png

__all__ = ["serve"]

# Seconds from the end of the line until this process is gone, if a call into the kernel holds it up.
_GRACE = 2.0
# Seconds after which an idle process looks up.
_PATIENCE = 0.5


def serve(requests: Iterable[bytes], answers: BinaryIO) -> None:
    """Answer requests until there are no more, or nobody reads the answers.

    Parameters
    ----------
    requests : iterable of bytes
        Lines as `docs/serve.md` describes them.
    answers : binary stream
        Not buffered.
    """
    turns = Turns()
    channel = Channel(answers, turns.end)
    turns.listen()
    try:
        _Server(turns, channel).run(requests)
    except KeyboardInterrupt:
        if not turns.is_over:
            raise
    finally:
        channel.close()


class _Server:
    def __init__(self, turns: Turns, channel: Channel) -> None:
        self._turns = turns
        self._channel = channel
        self._queue = SimpleQueue[Request | None]()
        self._shelf = Shelf()

    def run(self, requests: Iterable[bytes]) -> None:
        self._say("hello", protocol=PROTOCOL, program="mashape-cad", version=__version__, pid=os.getpid())
        threading.Thread(target=self._hear, args=(requests,), daemon=True).start()
        self._load()
        self._say("ready")
        while (request := self._next()) is not None:
            self._answer(request)

    def _say(self, message_type: str, **fields: Any) -> None:
        self._channel.send(message(message_type, **fields))

    def _load(self) -> None:
        """Load what takes seconds before it is asked for; if that fails, the first request says so."""
        self._progress(None, "loading")
        try:
            from mashape_cad.library.derivation import warm_up  # noqa: PLC0415  (loads the kernel)

            warm_up()
        except Exception as error:  # noqa: BLE001
            print(f"mashape-cad: {error}", file=sys.stderr)  # noqa: T201  (whoever looks for the reason finds it here)

    # In the thread that reads

    def _hear(self, requests: Iterable[bytes]) -> None:
        """Take in requests; when there are no more, this process ends in the middle of whatever it does."""
        try:
            for line in requests:
                if line.strip():
                    self._take_in(line)
        finally:
            self._queue.put(None)
            self._turns.end()
            last_resort = threading.Timer(_GRACE, os._exit, (0,))
            last_resort.daemon = True
            last_resort.start()

    def _take_in(self, line: bytes) -> None:
        try:
            request = parsed(line)
        except RequestError as error:
            self._say("error", id=error.id, code="request", text=str(error))
            return
        if isinstance(request, Cancel):
            if self._turns.cancel(request.id):
                self._say("cancelled", id=request.id)
        elif self._turns.wait(request.id):
            self._queue.put(request)
        else:
            self._say("error", id=None, code="request", text=f"there is a request {request.id!r} already")

    # In the main thread

    def _next(self) -> Request | None:
        """Wait for a request; a signal that comes just when the waiting begins is heard when it is repeated."""
        while True:
            with suppress(Empty):
                return self._queue.get(timeout=_PATIENCE)

    def _answer(self, request: Request) -> None:
        """Send one `summary`, `cancelled` or `error` for a request, last of its messages."""
        try:
            try:
                if self._turns.begin(request.id):
                    for line in self._lines(request):
                        self._channel.send(line)
            except Exception as error:  # noqa: BLE001  (the next request shall have its answer)
                self._turns.finish()
                self._say("error", id=request.id, **_told(error))
            self._turns.finish()
        except Cancelled:
            self._turns.finish()
            self._say("cancelled", id=request.id)

    def _lines(self, request: Request) -> Iterator[str]:
        return self._searched(request) if isinstance(request, Search) else self._scanned(request)  # type: ignore[arg-type]

    def _searched(self, request: Search) -> Iterator[str]:
        started = perf_counter()
        options = request.search_options()
        picture = _picture(request.thumbnail)
        self._progress(request.id, "library")
        library = self._shelf.library(tuple(map(Path, request.library)))
        yield _library_line(request.id, library)
        self._progress(request.id, "query")
        asked = _asked(request, library)
        size = asked.record.size
        yield message("query", id=request.id, profile=asked.profile, size_mm=size, **picture(asked.record))
        yield from answer_lines(
            self._matches(request, library, asked, options),
            query=asked.path,
            profile=asked.profile,
            parts=len(library.parts),
            started=started,
            always={"id": request.id},
            more=lambda match: picture(match.record),
        )

    def _matches(self, request: Search, library: Library, asked: Query, options: SearchOptions) -> Iterator[Match]:
        total = min(request.count, len(library.parts))
        stage = "comparing" if options.mode == "same" else "ranking"
        self._progress(request.id, stage, 0, total)
        for done, match in enumerate(islice(library.matches(asked, options), request.count), start=1):
            self._turns.check()
            yield match
            self._progress(request.id, stage, done, total)

    def _scanned(self, request: Scan) -> Iterator[str]:
        total, done = 0, 0

        def on_event(event: scanning.Event) -> None:
            nonlocal total, done
            self._turns.check()
            if isinstance(event, scanning.ScanStarted):
                total = event.total
            else:
                done += 1
                self._channel.send(file_message(event, id=request.id))
            self._progress(request.id, "scanning", done, total)

        summary = scanning.scan(request.folders, request.scan_options(), on_event)
        yield scan_summary(summary, id=request.id)

    def _progress(self, id_: Id | None, stage: str, done: int | None = None, total: int | None = None) -> None:
        self._say("progress", id=id_, stage=stage, done=done, total=total)


def _asked(request: Search, library: Library) -> Query:
    from mashape_cad.serving.queries import query_of  # noqa: PLC0415  (loads the kernel)

    if request.query.file is not None:
        check_file(Path(request.query.file))
    return query_of(request.query, request.profile, library)


def _library_line(id_: Id, library: Library) -> str:
    """Return how many parts there are to compare with, and how many files a scan would add or bring up to date."""
    counts = {"parts": len(library.parts), "unscanned": len(library.unscanned), "outdated": len(library.outdated)}
    return message("library", id=id_, **counts, scan=_scan_command(library.folders))


def _scan_command(folders: Iterable[Path]) -> list[str]:
    return ["mashape-cad", "scan", *map(readable, folders)]


def _picture(side: int | None) -> Callable[[ProfileRecord], dict[str, str]]:
    """Return what makes the picture of a profile, as a field; nothing if none is wanted."""
    if side is None:
        return lambda _record: {}
    return lambda record: {"thumbnail": b64encode(tile_png(record, side)).decode()}


# The first that fits; their order matters where one is a kind of another.
_CODES = (
    (LibraryError, "library"),
    (KernelUnavailableError, "kernel"),
    (MashapeError, "query"),
    (RequestError, "request"),
    (OSError, "system"),
)


def _told(error: Exception) -> dict[str, Any]:
    """Return what is said of an error: a code for programs, a line with the remedy for people."""
    text = " ".join(str(error).split())
    if isinstance(error, LibraryError) and error.scan:
        return {"code": "no-index", "text": text, "scan": _scan_command(error.scan)}
    for kind, code in _CODES:
        if isinstance(error, kind):
            return {"code": code, "text": text}
    return {"code": "internal", "text": f"a fault of this program ({type(error).__name__}: {text}); please report it"}
