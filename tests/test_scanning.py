"""Scanning folders: what is read, what is written, what a bad file costs."""

import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest
import stand_ins

from mashape_cad import scanning
from mashape_cad.errors import KernelUnavailableError, LibraryError
from mashape_cad.library.freshness import Status
from mashape_cad.library.sidecar import read_sidecar, sidecar_path
from mashape_cad.options import PartOptions, ReadOptions, ScanOptions
from mashape_cad.scanning import FileScanned, ScanStarted

_scan = partial(scanning.scan, derive=stand_ins.derive, warm_up=stand_ins.warm_up)


@pytest.fixture(autouse=True)
def _light_workers(monkeypatch):
    # The stand-ins need no kernel, so that workers start at once.
    monkeypatch.setattr(scanning, "_PRELOAD", "json")


def _put(folder, *names):
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"content of {name}", encoding="utf-8")


def _statuses(folder, options=None, **more):
    events = []
    summary = _scan([folder], options or ScanOptions(jobs=2, timeout=1.0), events.append, **more)
    scanned = {each.path.name: each for each in events if isinstance(each, FileScanned)}
    return {name: each.status.value for name, each in scanned.items()}, scanned, summary


def test_every_part_gets_a_sidecar_and_the_next_scan_leaves_it(tmp_path):
    """New at first, unchanged then, and changed when it has."""
    _put(tmp_path, "a.dxf", "sub/b.step", "c.txt")
    assert _statuses(tmp_path)[0] == {"a.dxf": "new", "b.step": "new"}
    assert read_sidecar(sidecar_path(tmp_path / "sub" / "b.step")).profiles
    assert _statuses(tmp_path)[0] == {"a.dxf": "unchanged", "b.step": "unchanged"}
    _put(tmp_path, "c.brep")
    (tmp_path / "a.dxf").write_text("something else")
    assert _statuses(tmp_path)[0] == {"a.dxf": "changed", "b.step": "unchanged", "c.brep": "new"}


def test_summary_counts(tmp_path):
    """Statuses, profiles, and those that failed before."""
    _put(tmp_path, "a.dxf", "b.dxf", "unreadable.dxf")
    first, second = _statuses(tmp_path)[2], _statuses(tmp_path)[2]
    assert (first.new, first.changed, first.unchanged, first.failed, first.failed_before) == (2, 0, 0, 1, 0)
    assert (second.new, second.changed, second.unchanged, second.failed, second.failed_before) == (0, 0, 3, 0, 1)
    assert first.profiles == second.profiles == 2
    assert first.seconds > 0


def test_start_is_told_with_the_number_of_files(tmp_path):
    """So that progress knows how much there is to do."""
    _put(tmp_path, "a.dxf", "b.dxf")
    events = []
    _scan([tmp_path], ScanOptions(jobs=1), events.append)
    assert events[0] == ScanStarted(2)


def test_one_bad_file_costs_that_file_only(tmp_path):
    """Crashes, endless loops, faults and unreadable files: each has its error sidecar, the others are done."""
    bad = {"die": "crash", "segfault": "crash", "sleep": "timeout", "bug": "internal", "unreadable": "unreadable"}
    _put(tmp_path, *(f"{word}-{i}.dxf" for word in bad for i in range(2)), *(f"good-{i}.dxf" for i in range(6)))
    statuses, scanned, _ = _statuses(tmp_path)
    assert {name for name, status in statuses.items() if status == "new"} == {f"good-{i}.dxf" for i in range(6)}
    for name, event in scanned.items():
        if event.status is Status.FAILED:
            assert event.failure.kind == bad[name.partition("-")[0]]
            assert read_sidecar(sidecar_path(event.path)).failure == event.failure


def test_failed_files_are_unchanged_until_asked_for(tmp_path):
    """The reason stays known; --retry-failed tries again."""
    _put(tmp_path, "a.dxf", "bug.dxf")
    _statuses(tmp_path)
    statuses, scanned, _ = _statuses(tmp_path)
    assert statuses == {"a.dxf": "unchanged", "bug.dxf": "unchanged"}
    assert scanned["bug.dxf"].failure.kind == "internal"
    again = ScanOptions(jobs=1, timeout=1.0, retry_failed=True)
    assert _statuses(tmp_path, again)[0] == {"a.dxf": "unchanged", "bug.dxf": "failed"}


def test_messages_of_failures_name_the_remedy(tmp_path):
    """One line each."""
    _put(tmp_path, "die.dxf", "sleep.dxf", "bug.dxf")
    _, scanned, _ = _statuses(tmp_path)
    texts = {name: event.failure.text for name, event in scanned.items()}
    assert texts == {
        "die.dxf": "its worker process died (exit code 7); try again with --retry-failed",
        "sleep.dxf": "took longer than 1 s; allow more with --timeout and --retry-failed",
        "bug.dxf": "a fault of this program (ZeroDivisionError: division by zero); please report it with the file",
    }


def test_other_options_read_everything_again(tmp_path):
    """What shaped the sidecars has changed."""
    _put(tmp_path, "a.dxf")
    _statuses(tmp_path)
    inches = ScanOptions(jobs=1, part=PartOptions(ReadOptions(unit="in")))
    assert _statuses(tmp_path, inches)[0] == {"a.dxf": "changed"}
    assert read_sidecar(sidecar_path(tmp_path / "a.dxf")).options.read.unit == "in"


def test_same_file_same_bytes(tmp_path):
    """A sidecar that is deleted and made again is the same to the byte, also in a copy of the folder."""
    _put(tmp_path / "one", "a.dxf", "unreadable.dxf")
    (tmp_path / "two").mkdir()
    for part in (tmp_path / "one").iterdir():
        copy = tmp_path / "two" / part.name
        copy.write_bytes(part.read_bytes())
        os.utime(copy, ns=(part.stat().st_atime_ns, part.stat().st_mtime_ns))
    _scan([tmp_path / "one", tmp_path / "two"], ScanOptions(jobs=2))
    for name in ("a.dxf", "unreadable.dxf"):
        first, second = (sidecar_path(tmp_path / folder / name).read_bytes() for folder in ("one", "two"))
        assert first == second


def test_touched_file_is_brought_up_to_date(tmp_path):
    """Another time, the same content: the next scan need not hash it again."""
    _put(tmp_path, "a.dxf")
    _statuses(tmp_path)
    os.utime(tmp_path / "a.dxf", (1, 1))
    assert _statuses(tmp_path)[0] == {"a.dxf": "unchanged"}
    assert read_sidecar(sidecar_path(tmp_path / "a.dxf")).source.mtime_ns == 10**9


def test_folder_given_twice_is_scanned_once(tmp_path):
    """Also by way of its subfolder."""
    _put(tmp_path, "a.dxf", "sub/b.dxf")
    events = []
    _scan([tmp_path, tmp_path / "sub", tmp_path], ScanOptions(jobs=1), events.append)
    assert sorted(each.path.name for each in events[1:]) == ["a.dxf", "b.dxf"]


def test_folder_that_does_not_exist_stops_before_anything_is_done(tmp_path):
    """A typing error does not cost an hour."""
    _put(tmp_path, "a.dxf")
    with pytest.raises(LibraryError, match="gone: no such folder; check the path"):
        _scan([tmp_path, tmp_path / "gone"], ScanOptions(jobs=1))
    assert not sidecar_path(tmp_path / "a.dxf").exists()


def test_sidecar_that_cannot_be_written_fails_that_file(tmp_path):
    """As in a folder that is read-only: one clear line, and the scan goes on."""
    _put(tmp_path, "a.dxf", "b.dxf")
    sidecar_path(tmp_path / "a.dxf").mkdir()  # works for the superuser too
    statuses, scanned, _ = _statuses(tmp_path)
    assert statuses == {"a.dxf": "failed", "b.dxf": "new"}
    assert "cannot write" in scanned["a.dxf"].failure.text
    assert "make the folder writable" in scanned["a.dxf"].failure.text
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".mashape")] == []


def test_read_only_folder(tmp_path):
    """Its files fail, and nothing is lost."""
    _put(tmp_path, "a.dxf", "sub/b.dxf")
    (tmp_path / "sub").chmod(0o555)
    if os.access(tmp_path / "sub", os.W_OK):
        pytest.skip("permissions do not bind this user")
    statuses, scanned, _ = _statuses(tmp_path)
    assert statuses == {"a.dxf": "new", "b.dxf": "failed"}
    assert "make the folder writable and scan again" in scanned["b.dxf"].failure.text


def test_no_read_permission(tmp_path):
    """The file fails, and is tried again once it may be read."""
    _put(tmp_path, "a.dxf")
    (tmp_path / "a.dxf").chmod(0)
    if os.access(tmp_path / "a.dxf", os.R_OK):
        pytest.skip("permissions do not bind this user")
    _statuses(tmp_path)
    assert read_sidecar(sidecar_path(tmp_path / "a.dxf")).source.blake2b is None
    assert _statuses(tmp_path)[0] == {"a.dxf": "unchanged"}
    (tmp_path / "a.dxf").chmod(0o644)
    assert _statuses(tmp_path)[0] == {"a.dxf": "changed"}


def test_folder_that_cannot_be_listed(tmp_path):
    """It counts as failed and is named; the others are scanned."""
    _put(tmp_path, "a.dxf", "sub/b.dxf")
    (tmp_path / "sub").chmod(0)
    if os.access(tmp_path / "sub", os.R_OK):
        pytest.skip("permissions do not bind this user")
    statuses, scanned, _ = _statuses(tmp_path)
    (tmp_path / "sub").chmod(0o755)
    assert statuses == {"a.dxf": "new", "sub": "failed"}
    assert "cannot be listed" in scanned["sub"].failure.text


def test_sidecar_of_a_newer_release_is_left_alone(tmp_path):
    """It is not ours to replace."""
    _put(tmp_path, "a.dxf")
    _statuses(tmp_path)
    path = sidecar_path(tmp_path / "a.dxf")
    newer = path.read_bytes().replace(b'"version": 1', b'"version": 2', 1)
    path.write_bytes(newer)
    statuses, scanned, _ = _statuses(tmp_path)
    assert statuses == {"a.dxf": "failed"}
    assert scanned["a.dxf"].failure.kind == "sidecar"
    assert path.read_bytes() == newer


def test_link_to_nowhere_fails(tmp_path):
    """It is named and has no sidecar."""
    (tmp_path / "a.dxf").symlink_to(tmp_path / "gone.dxf")
    _, scanned, _ = _statuses(tmp_path)
    assert scanned["a.dxf"].failure.kind == "unreadable"
    assert list(tmp_path.iterdir()) == [tmp_path / "a.dxf"]


def test_missing_kernel_ends_the_scan_and_no_file_is_blamed(tmp_path):
    """It is no fault of the file: there must be no error sidecar that would count as fresh."""
    _put(tmp_path, "kernel.dxf")
    with pytest.raises(KernelUnavailableError, match="no kernel; install it"):
        _scan([tmp_path], ScanOptions(jobs=1))
    assert list(tmp_path.iterdir()) == [tmp_path / "kernel.dxf"]


def test_what_libraries_print_does_not_reach_stdout(tmp_path, capfd):
    """Results are alone on stdout."""
    _put(tmp_path, "print.dxf")
    _statuses(tmp_path)
    assert capfd.readouterr().out == ""


def test_strange_names(tmp_path):
    """Spaces, umlauts, brackets, quotes."""
    names = ["a b.dxf", "Träger [1].dxf", "it's.dxf", "-dash.dxf"]
    _put(tmp_path, *names)
    assert _statuses(tmp_path)[0] == dict.fromkeys(names, "new")


_INTERRUPTED = """
import sys
sys.path.insert(0, {tests!r})
import stand_ins
from mashape_cad import scanning
from mashape_cad.cli import main
from mashape_cad.options import ScanOptions

if __name__ == "__main__":
    scanning._PRELOAD = "json"
    scanning.scan.__kwdefaults__.update(derive=stand_ins.derive, warm_up=stand_ins.warm_up)
    sys.exit(main.main(["scan", {folder!r}, "--jobs", "2", "--json"]))
"""


@pytest.mark.skipif(os.name == "nt", reason="sends a POSIX signal")
def test_ctrl_c_stops_at_once_and_leaves_whole_sidecars(tmp_path, repository):
    """Exit code 130, one line, no traceback of any process, no half sidecars, no processes left behind."""
    folder = tmp_path / "parts"
    _put(folder, *(f"a-{i}.dxf" for i in range(20)), *(f"sleep-{i}.dxf" for i in range(4)))
    script = tmp_path / "run.py"
    script.write_text(_INTERRUPTED.format(tests=str(Path(__file__).parent), folder=str(folder)))
    environment = os.environ | {"PYTHONPATH": str(repository)}
    process = subprocess.Popen(
        [sys.executable, str(script)],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # a terminal sends Ctrl-C to the whole group
    )
    for _ in range(20):
        assert '"status":"new"' in process.stdout.readline()
    time.sleep(0.5)
    started = time.monotonic()
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=20)  # ends when the last process that holds the pipe has ended
    assert process.returncode == 130
    assert time.monotonic() - started < 5
    assert errors.strip() == "mashape-cad: interrupted; what was written is whole, the next run goes on from there"
    sidecars = sorted(folder.glob("*.mashape.json"))
    assert [read_sidecar(path).source.name for path in sidecars] == sorted(f"a-{i}.dxf" for i in range(20))
    assert list(folder.glob(".*")) == []
