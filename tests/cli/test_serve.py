"""``mashape-cad serve`` as a plug-in meets it: a process, lines in, lines out."""

import base64
import json
import os
import queue
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from drawings import write_drawing
from stand_ins import profile_record, put_part

from mashape_cad.serving.protocol import PROTOCOL
from mashape_cad.version import __version__

# Seconds: far above what any answer here takes, so that a fault ends the test and not the run.
PATIENCE = 200.0
LAST = ("summary", "error", "cancelled")


class Plugin:
    """The other end of the line."""

    def __init__(self, code: str | None = None, **environment: str) -> None:
        program = [sys.executable, "-c", code] if code else [sys.executable, "-m", "mashape_cad", "serve"]
        everything = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])} | environment
        self.process = subprocess.Popen(
            program, env=everything, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self._lines = queue.Queue()
        self._number = 0
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self) -> None:
        with self.process.stdout:
            for line in self.process.stdout:
                self._lines.put(line)
        self._lines.put(None)

    def hear(self) -> dict | None:
        """The next message; None at the end."""
        line = self._lines.get(timeout=PATIENCE)
        return None if line is None else json.loads(line)

    def hear_until(self, *kinds: str) -> list[dict]:
        """Messages up to the first of these kinds."""
        heard = []
        while (message := self.hear()) is not None:
            heard.append(message)
            if message["message_type"] in kinds:
                break
        return heard

    def send(self, line: bytes) -> None:
        """A line as it is."""
        self.process.stdin.write(line + b"\n")
        self.process.stdin.flush()

    def say(self, request: str, **fields) -> int:
        """A request; its id."""
        self._number += 1
        self.send(json.dumps({"request": request, "id": self._number} | fields).encode())
        return self._number

    def ask(self, request: str, **fields) -> list[dict]:
        """All messages on a request."""
        self.say(request, **fields)
        return self.hear_until(*LAST)

    def close(self) -> int:
        """End of the line; the exit code."""
        self.process.stdin.close()
        return self.process.wait(PATIENCE)

    def dispose(self) -> None:
        """Whatever state it is in."""
        self.process.kill()
        self.process.wait()
        self._reader.join()
        with suppress(OSError):
            self.process.stdin.close()
        self.process.stderr.close()


@pytest.fixture
def start() -> Iterator[Callable[..., Plugin]]:
    """Starts plug-ins that are gone after the test."""
    started = []

    def start(*arguments, **environment):
        started.append(Plugin(*arguments, **environment))
        return started[-1]

    yield start
    for plugin in started:
        plugin.dispose()


@pytest.fixture(scope="module")
def plugin() -> Iterator[Plugin]:
    """One that has seen the greeting."""
    plugin = Plugin()
    plugin.hear_until("ready")
    yield plugin
    plugin.dispose()


@pytest.fixture(scope="module")
def parts(tmp_path_factory: pytest.TempPathFactory, plugin: Plugin) -> Path:
    """A library of three drawings, scanned by the plug-in."""
    folder = tmp_path_factory.mktemp("Träger und Bleche")
    write_drawing(folder / "angle.dxf", lambda space: space.add_lwpolyline(ANGLE, close=True))
    write_drawing(folder / "plate.dxf", lambda space: space.add_lwpolyline(PLATE, close=True))
    write_drawing(folder / "disc.dxf", lambda space: space.add_circle((0, 0), 9))
    plugin.ask("scan", folders=[str(folder)], options={"jobs": 1})
    return folder


ANGLE = [(0, 0), (40, 0), (40, 10), (10, 10), (10, 25), (0, 25)]
PLATE = [(0, 0), (30, 0), (30, 20), (0, 20)]


def _search(parts: Path, query: dict, **more) -> dict:
    return {"library": [str(parts)], "query": query} | more


def _kinds(messages: list[dict]) -> list[str]:
    return [each["message_type"] for each in messages if each["message_type"] != "progress"]


def _matches(messages: list[dict]) -> list[dict]:
    return [each for each in messages if each["message_type"] == "match"]


def _is_png(text: str) -> bool:
    return base64.b64decode(text, validate=True).startswith(b"\x89PNG\r\n")


# The line


def test_greets_with_the_version_of_the_protocol(start):
    """Before anything heavy is loaded, so that a plug-in knows at once whom it talks to; the end of stdin ends it."""
    plugin = start()
    hello = plugin.hear()
    assert hello == {
        "message_type": "hello",
        "protocol": PROTOCOL,
        "program": "mashape-cad",
        "version": __version__,
        "pid": plugin.process.pid,
    }
    started = time.monotonic()
    assert plugin.close() == 0
    assert time.monotonic() - started < 5
    assert plugin.process.stderr.read() == b""


@pytest.mark.skipif(os.name == "nt", reason="Ctrl-C goes another way there")
def test_ends_quietly_on_ctrl_c(start):
    """A CAD program started in a terminal passes it on.

    Python aborted here, because a thread was waiting in its stream of stdin; and a signal that came just when the
    process began to wait for a request was not heard.
    """
    plugin = start()
    plugin.hear_until("ready")
    plugin.process.send_signal(signal.SIGINT)
    assert plugin.process.wait(PATIENCE) == 130
    assert len(plugin.process.stderr.read().strip().splitlines()) == 1


def test_ends_if_nobody_reads():
    """A CAD program that was killed leaves no process behind, even if something else holds the line open."""
    ours, theirs = os.pipe()
    command = [sys.executable, "-m", "mashape_cad", "serve"]
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}
    with subprocess.Popen(command, env=environment, stdin=subprocess.PIPE, stdout=theirs) as process:
        os.close(theirs)
        os.close(ours)
        assert process.wait(PATIENCE) == 0


def test_what_libraries_print_is_kept_from_the_line(start):
    """Not even what the kernel writes to the file descriptor comes between the messages."""
    code = (
        "import os, sys, mashape_cad.library.derivation as derivation\n"
        "derivation.warm_up = lambda: (os.write(1, b'chatter'), print('more'), sys.stdout.flush())\n"
        "from mashape_cad.cli.main import main\n"
        "sys.exit(main(['serve']))"
    )
    plugin = start(code)
    assert _kinds(plugin.hear_until("ready")) == ["hello", "ready"]
    assert plugin.close() == 0
    assert plugin.process.stderr.read() == b"chattermore\n"


@pytest.mark.parametrize(
    ("line", "id_", "text"),
    [
        (b"nonsense", None, "not a request of protocol 1"),
        (b"\xff\xfe", None, "not a request"),
        (b"[1]", None, "not a request"),
        (b'{"request": "sing", "id": 7}', 7, "'sing'"),
        (b'{"request": "search", "id": 8}', 8, "library"),
        (b'{"request": "search", "id": 9, "library": ["."], "query": {"file": "a"}, "colour": 1}', 9, "colour"),
        (b'{"request": "search", "id": 9, "library": ["."], "query": {}}', 9, "not none"),
        (b'{"request": "search", "id": 9, "library": ["."], "query": {"file": "a", "dxf": "b"}}', 9, "file and dxf"),
        (b'{"request": "search", "id": 9, "library": [], "query": {"file": "a"}}', 9, "at least one folder"),
        (b'{"request": "search", "id": 9, "library": ["."], "query": {"file": "a"}, "count": 0}', 9, "at least 1"),
        (b'{"request": "scan", "id": "x", "folders": ["."], "options": {"speed": 9}}', "x", "no speed"),
        (b'{"request": "scan", "id": "x", "folders": ["."], "options": {"jobs": 0}}', "x", "jobs"),
    ],
)
def test_what_is_not_understood_is_an_error(plugin, line, id_, text):
    """The line goes on."""
    plugin.send(line)
    error = plugin.hear_until("error")[-1]
    assert (error["id"], error["code"]) == (id_, "request")
    assert text in error["text"]


# Searching


def test_search_gives_what_the_command_gives(parts, plugin):
    """The very same matches and summary as `search --json`, with the request's id."""
    query = str(parts / "angle.dxf")
    command = [sys.executable, "-m", "mashape_cad", "search", query, "--json", "--in", str(parts), "--mode", "same"]
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run(command, env=environment, capture_output=True, check=False, encoding="utf-8")
    *expected, summary = map(json.loads, done.stdout.splitlines())
    messages = plugin.ask("search", **_search(parts, {"file": query}, options={"mode": "same"}))
    number = messages[-1]["id"]
    assert _matches(messages) == [{"id": number} | each for each in expected]
    assert messages[-1] | {"seconds": 0} == {"id": number} | summary | {"seconds": 0}
    assert expected[0]["relation"] == "identical"


def test_search_with_the_text_of_a_drawing(parts, plugin):
    """A plug-in need not write files."""
    text = (parts / "angle.dxf").read_text(encoding="utf-8")
    messages = plugin.ask("search", **_search(parts, {"dxf": text}, count=2))
    assert _kinds(messages) == ["library", "query", "match", "match", "summary"]
    assert Path(_matches(messages)[0]["path"]).name == "angle.dxf"
    assert _matches(messages)[0]["score"] >= 99
    assert messages[-1]["query"] is None


@pytest.mark.parametrize(("reverse", "relation"), [(False, "identical"), (True, "mirrored")])
def test_search_with_the_text_of_a_shape(parts, plugin, tmp_path, reverse, relation):
    """As FreeCAD hands it over: a face as it is seen from outside, so that a reversed one is the mirror image."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepTools import BRepTools
    from solids import polygon_wire

    face = BRepBuilderAPI_MakeFace(polygon_wire(ANGLE)).Face()
    path = tmp_path / "face.brep"
    BRepTools.Write_s(face.Reversed() if reverse else face, str(path))
    query = {"brep": path.read_text(encoding="ascii")}
    messages = plugin.ask("search", **_search(parts, query, count=1, options={"mode": "same"}))
    (match,) = _matches(messages)
    assert (Path(match["path"]).name, match["relation"], match["mirrored"]) == ("angle.dxf", relation, reverse)


def test_search_with_an_option_of_search(parts, plugin):
    """Every one of them is an option here, by the same name."""
    query = {"file": str(parts / "angle.dxf")}
    assert len(_matches(plugin.ask("search", **_search(parts, query, options={"min_score": 99.0})))) == 1
    *_, error = plugin.ask("search", **_search(parts, query, options={"min_score": 101.0}))
    assert (error["code"], "min_score" in error["text"]) == ("request", True)


def test_pictures_come_with_the_answer(parts, plugin):
    """Of the query and of each match, if asked for."""
    messages = plugin.ask("search", **_search(parts, {"file": str(parts / "disc.dxf")}, thumbnail=64))
    pictures = [each["thumbnail"] for each in messages if each["message_type"] in {"query", "match"}]
    assert len(pictures) == 4
    assert all(map(_is_png, pictures))
    assert pictures[0] == pictures[1] != pictures[2]


def test_progress_counts_what_is_compared(parts, plugin):
    """From none to all."""
    messages = plugin.ask("search", **_search(parts, {"file": str(parts / "disc.dxf")}, options={"mode": "same"}))
    told = [(each["stage"], each["done"], each["total"]) for each in messages if each["message_type"] == "progress"]
    assert told == [("library", None, None), ("query", None, None), *(("comparing", n, 3) for n in range(4))]


def test_no_file_is_left(start, parts, tmp_path):
    """The text of a query lives in a file only while it is read."""
    plugin = start(TMPDIR=str(tmp_path))
    plugin.ask("search", **_search(parts, {"dxf": (parts / "angle.dxf").read_text(encoding="utf-8")}))
    assert list(tmp_path.iterdir()) == []
    plugin.close()


def test_a_library_that_has_changed_is_read_again(parts, plugin, tmp_path):
    """Between two requests, without a word from the plug-in."""
    query = {"dxf": (parts / "angle.dxf").read_text(encoding="utf-8")}
    for name in ("angle.dxf", "angle.dxf.mashape.json"):
        shutil.copy2(parts / name, tmp_path)
    assert plugin.ask("search", **_search(tmp_path, query))[-1]["parts"] == 1
    put_part(tmp_path / "b.dxf", profile_record(1, 2, 3))
    assert plugin.ask("search", **_search(tmp_path, query))[-1]["parts"] == 2
    (tmp_path / "c.dxf").write_text("0")
    library = next(
        each for each in plugin.ask("search", **_search(tmp_path, query)) if each["message_type"] == "library"
    )
    assert (library["parts"], library["unscanned"], library["outdated"]) == (2, 1, 0)
    assert library["scan"] == ["mashape-cad", "scan", str(tmp_path)]


@pytest.mark.parametrize(
    ("query", "text"),
    [
        ({"brep": "nonsense"}, "the query: not a sound BREP file"),
        ({"dxf": "nonsense"}, "the query: not a DXF file"),
        ({"dxf": ""}, "the query: the file is empty"),
        ({"file": "/gone/part.step"}, "no such file"),
    ],
)
def test_a_query_that_cannot_be_used(parts, plugin, query, text):
    """One error, with the reason and without the name of a file that the user never saw."""
    *_, error = plugin.ask("search", **_search(parts, query))
    assert (error["message_type"], error["code"]) == ("error", "query")
    assert text in error["text"]
    assert "query." not in error["text"]


def test_a_library_that_was_not_scanned(plugin, tmp_path):
    """The error has the command that mends it."""
    (tmp_path / "a.dxf").write_text("0")
    *_, error = plugin.ask("search", **_search(tmp_path, {"dxf": "0"}))
    assert (error["code"], error["scan"]) == ("no-index", ["mashape-cad", "scan", str(tmp_path)])


def test_a_library_that_is_not_there(plugin, tmp_path):
    """A scan would not help."""
    *_, error = plugin.ask("search", **_search(tmp_path / "gone", {"dxf": "0"}))
    assert (error["code"], "scan" in error) == ("library", False)
    assert "no such folder" in error["text"]


# Scanning and cancelling


def test_scan_tells_how_it_gets_on(parts, plugin):
    """A message for each file, as `scan --json` prints them, and progress between them."""
    messages = plugin.ask("scan", folders=[str(parts)])
    assert _kinds(messages) == ["file"] * 3 + ["summary"]
    assert {each["status"] for each in messages if each["message_type"] == "file"} == {"unchanged"}
    told = [(each["done"], each["total"]) for each in messages if each["message_type"] == "progress"]
    assert told == [(n, 3) for n in range(4)]
    assert messages[-1]["unchanged"] == 3


def _slow(seconds: float, what: str) -> str:
    return (
        "import sys, time, mashape_cad.library.derivation as derivation\n"
        f"from mashape_cad.serving import {what.partition('.')[0]}\n"
        "derivation.warm_up = lambda: None\n"
        f"{what} = lambda *_: [time.sleep(0.01) for _ in range({100 * seconds:.0f})]\n"
        "from mashape_cad.cli.main import main\n"
        "sys.exit(main(['serve']))"
    )


def test_cancel_ends_work_in_the_middle(start, parts):
    """In the middle of one long step too; the next request is answered, and no answer to the old one follows."""
    plugin = start(_slow(600, "queries.query_of"))
    plugin.hear_until("ready")
    first = plugin.say("search", **_search(parts, {"dxf": "0"}))
    plugin.hear_until("library")
    started = time.monotonic()
    plugin.send(json.dumps({"request": "cancel", "id": first}).encode())
    assert plugin.hear_until(*LAST)[-1] == {"message_type": "cancelled", "id": first}
    assert time.monotonic() - started < 1
    (error,) = plugin.ask("search", **_search(parts / "gone", {"dxf": "0"}))[-1:]
    assert (error["id"], error["code"]) == (2, "library")
    assert plugin.close() == 0


def test_cancel_of_a_request_that_waits(start, parts):
    """It never begins."""
    plugin = start(_slow(600, "queries.query_of"))
    plugin.hear_until("ready")
    first, second = (plugin.say("search", **_search(parts, {"dxf": "0"})) for _ in range(2))
    plugin.send(json.dumps({"request": "cancel", "id": second}).encode())
    assert plugin.hear_until("cancelled")[-1]["id"] == second
    plugin.send(json.dumps({"request": "cancel", "id": first}).encode())
    assert plugin.hear_until("cancelled")[-1]["id"] == first
    assert plugin.close() == 0


def test_cancel_of_what_is_done_is_not_an_error(parts, plugin):
    """It crossed the answer on the way."""
    done = plugin.ask("scan", folders=[str(parts)])[-1]["id"]
    plugin.send(json.dumps({"request": "cancel", "id": done}).encode())
    assert _kinds(plugin.ask("scan", folders=[str(parts)])) == ["file"] * 3 + ["summary"]


def test_the_end_of_the_line_ends_work_in_the_middle(start, parts):
    """The CAD program is gone, and whatever it asked for with it."""
    plugin = start(_slow(600, "queries.query_of"))
    plugin.say("search", **_search(parts, {"dxf": "0"}))
    plugin.hear_until("library")
    started = time.monotonic()
    assert plugin.close() == 0
    assert time.monotonic() - started < 5
