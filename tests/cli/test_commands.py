"""The program as people and programs meet it: output, messages, exit codes, and what it loads."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import stand_ins
from stand_ins import REFUSED, profile_record, put_part

from mashape_cad import scanning
from mashape_cad.cli import main as program
from mashape_cad.library.freshness import source_of
from mashape_cad.library.record import Failure, Sidecar
from mashape_cad.library.sidecar import sidecar_path, write_sidecar
from mashape_cad.options import PartOptions, ScanOptions
from mashape_cad.version import __version__

HEAVY = ("OCP", "ezdxf", "numba", "matplotlib", "cadquery", "build123d")


@pytest.fixture
def folder(tmp_path):
    """Three scanned parts, one of them with a name that needs care."""
    put_part(tmp_path / "a.dxf", profile_record(0, 1, 2, 3))
    put_part(tmp_path / "Träger [bold] 2.dxf", profile_record(0, 1, 2, 4))
    put_part(tmp_path / "sub" / "c.step", profile_record(7, 8, 9, 10))
    return tmp_path


@pytest.fixture
def stood_in(monkeypatch):
    """Scans use the stand-in for the real derivation."""
    monkeypatch.setattr(scanning, "_PRELOAD", "json")
    stand_in = {"derive": stand_ins.derive, "warm_up": stand_ins.warm_up}
    monkeypatch.setattr(scanning.scan, "__kwdefaults__", stand_in)


@pytest.fixture
def run(capsys):
    """Run the program in this process: exit code, lines on stdout, lines on stderr."""

    def run(*arguments):
        code = program.main([str(each) for each in arguments])
        captured = capsys.readouterr()
        return code, captured.out.splitlines(), captured.err.splitlines()

    return run


def _python(code, repository, *arguments, **environment):
    everything = os.environ | {"PYTHONPATH": str(repository)} | environment
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, env=everything, capture_output=True, encoding="utf-8", check=False)


def _fail(path, kind, text):
    path.write_text("0")
    write_sidecar(sidecar_path(path), Sidecar.failed(source_of(path), PartOptions(), Failure(kind, text)))
    return path


def _messages(lines):
    return [json.loads(line) for line in lines]


# What is loaded


_LOADED = f"""
import sys
from mashape_cad.cli.main import main
code = main(sys.argv[1:])
print("loaded:", [name for name in {HEAVY!r} if name in sys.modules], code)
"""


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["scan", "--help"], ["axis", "--help"]])
def test_help_loads_nothing_heavy(repository, arguments):
    """Not even numpy and rich: it answers at once."""
    code = _LOADED.replace("'OCP'", "'numpy', 'rich', 'OCP'")
    done = _python(code, repository, *arguments)
    assert done.stdout.splitlines()[-1] == "loaded: [] 0", done.stderr


@pytest.mark.parametrize("switches", [[], ["--json"], ["-o", "sheet.html"]])
def test_search_in_a_scanned_library_loads_no_kernel(folder, repository, switches):
    """With a query that has a sidecar, neither kernel nor readers nor compilers are loaded."""
    switches = [str(folder / each) if each.endswith(".html") else each for each in switches]
    done = _python(_LOADED, repository, "search", folder / "a.dxf", *switches)
    assert done.stdout.splitlines()[-1] == "loaded: [] 0", done.stderr


def test_show_of_a_scanned_part_loads_no_kernel(folder, repository):
    """Its sidecar has all that the picture needs."""
    done = _python(_LOADED, repository, "show", folder / "a.dxf", "-o", folder / "a.svg")
    assert done.stdout.splitlines()[-1] == "loaded: [] 0", done.stderr
    assert (folder / "a.svg").read_text(encoding="utf-8").startswith("<")


def test_second_scan_loads_no_kernel(folder, repository):
    """All unchanged: no worker is started, and this process needs neither kernel nor numpy."""
    done = _python(_LOADED.replace("'OCP'", "'numpy', 'OCP'"), repository, "scan", folder)
    assert done.stdout.splitlines()[-1] == "loaded: [] 0", done.stderr
    assert done.stdout.splitlines()[0].startswith("3 files: 3 unchanged; 3 profiles, ")


def test_importing_the_package_loads_nothing_heavy(repository):
    """Names are loaded on first use."""
    code = f"import sys, mashape_cad; print([name for name in ('numpy', *{HEAVY!r}) if name in sys.modules])"
    assert _python(code, repository).stdout == "[]\n"


# scan


def test_scan_as_json(folder, run, stood_in):
    """A line for each file, the summary last."""
    (folder / "unreadable.dxf").write_text("0")
    (folder / "new.brep").write_text("0")
    code, out, _ = run("scan", folder, "--json", "--jobs", "1")
    *files, summary = _messages(out)
    assert code == 3
    assert {Path(each["path"]).name: each["status"] for each in files} == {
        "a.dxf": "unchanged",
        "Träger [bold] 2.dxf": "unchanged",
        "c.step": "unchanged",
        "unreadable.dxf": "failed",
        "new.brep": "new",
    }
    assert all(each["message_type"] == "file" for each in files)
    assert files[0]["profiles"] == 1
    assert files[0]["findings"][0]["code"] == "chain-open"
    assert files[-1]["path"].startswith(str(folder))
    assert summary["message_type"] == "summary"
    assert (summary["new"], summary["unchanged"], summary["failed"]) == (1, 3, 1)
    assert summary["seconds"] > 0


def test_scan_for_people(folder, run, stood_in):
    """One line that sums up on stdout; a line for each failed file on stderr."""
    bad = folder / "unreadable-[1].dxf"
    bad.write_text("0")
    code, out, err = run("scan", folder, "--jobs", "1")
    assert code == 3
    assert out[0].startswith("4 files: 3 unchanged, 1 failed; 3 profiles, ")
    assert err == [f"failed: {bad}: not a DXF file; export it again"]
    code, out, err = run("scan", folder)
    assert code == 0
    assert out[0].startswith("4 files: 4 unchanged (1 of the unchanged had failed: --retry-failed); 3 profiles")


def test_scan_quietly(folder, run, stood_in):
    """Nothing but what failed."""
    assert run("scan", folder, "-q") == (0, [], [])


def test_scan_of_an_empty_folder(tmp_path, run):
    """There is nothing to do, and it is done."""
    code, out, _ = run("scan", tmp_path)
    assert (code, out[0].partition(";")[0]) == (0, "0 files: nothing to read")


def test_scan_of_a_folder_that_does_not_exist(tmp_path, run):
    """One line with the remedy."""
    gone = tmp_path / "gone"
    assert run("scan", gone) == (1, [], [f"mashape-cad: error: {gone}: no such folder; check the path"])


def test_scan_of_a_file(folder, run):
    """Folders are scanned."""
    code, _, err = run("scan", folder / "a.dxf")
    assert (code, len(err)) == (1, 1)
    assert "is a file, not a folder; give the folder it lies in" in err[0]


@pytest.mark.parametrize(
    "arguments",
    [
        ["scan"],
        ["scan", ".", "--jobs", "0"],
        ["scan", ".", "--jobs", "many"],
        ["scan", ".", "--timeout", "-1"],
        ["scan", ".", "--unit", "furlong"],
        ["scan", ".", "--unknown"],
        ["search"],
        ["search", "a.dxf", "-k", "0"],
        ["search", "a.dxf", "--profile", "-1"],
        ["search", "a.dxf", "-o", "sheet.pdf"],
        ["show", "a.dxf"],
        ["show", "a.dxf", "-o", "a.html"],
        ["certify"],
        ["axis", "a.dxf"],
        ["axis", "a.dxf", "-o", "a.png"],
        ["axis", "a.dxf", "-o", "a.dxf", "--step", "0"],
        ["axis", "a.dxf", "-o", "a.dxf", "--min-angle", "91"],
        ["unknown"],
    ],
)
def test_what_is_not_understood(run, arguments):
    """Exit code 2, nothing on stdout, and a message."""
    code, out, err = run(*arguments)
    assert (code, out) == (2, [])
    assert err


def test_defaults_stand_in_one_place(run, monkeypatch):
    """The switches of scan are the declared options with their defaults."""
    seen = []

    def scan(folders, options, on_event):
        seen.append(options)
        raise KeyboardInterrupt

    monkeypatch.setattr(scanning, "scan", scan)
    run("scan", ".")
    assert seen == [ScanOptions()]
    run("scan", ".", "--jobs", "3", "--timeout", "7", "--unit", "in", "--gap", "1e-5", "--retry-failed")
    assert (seen[1].jobs, seen[1].timeout, seen[1].retry_failed) == (3, 7.0, True)
    assert (seen[1].part.read.unit, seen[1].part.read.gap_rel) == ("in", 1e-5)


def test_interrupted(run, monkeypatch):
    """Exit code 130 and one line."""

    def scan(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(scanning, "scan", scan)
    code, out, err = run("scan", ".")
    assert (code, out) == (130, [])
    assert err[-1] == "mashape-cad: interrupted; what was written is whole, the next run goes on from there"


# search


def test_search_as_json(folder, run):
    """A line for each match, the nearest first, the summary last."""
    code, out, err = run("search", folder / "a.dxf", "--json")
    *matches, summary = _messages(out)
    assert (code, err) == (0, [])
    assert [each["message_type"] for each in matches] == ["match"] * 3
    assert [each["rank"] for each in matches] == [1, 2, 3]
    assert [Path(each["path"]).name for each in matches] == ["a.dxf", "Träger [bold] 2.dxf", "c.step"]
    assert (matches[0]["profile"], matches[0]["distance"], matches[0]["size_mm"]) == (0, 0.0, [10.0, 10.0])
    assert (summary["message_type"], summary["matches"], summary["parts"]) == ("summary", 3, 3)


def test_search_for_people(folder, run):
    """A table; names are shown as they are, however long, also where they look like markup."""
    code, out, _ = run("search", folder / "a.dxf")
    assert code == 0
    assert out[0].split() == ["rank", "part", "profile", "score", "distance", "size", "(mm)"]
    assert out[1].split() == ["1", str(folder / "a.dxf"), "0", "100", "0.0000", "10", "x", "10"]
    assert str(folder / "Träger [bold] 2.dxf") in out[2]


def test_search_in_other_folders(folder, run, tmp_path_factory):
    """--in takes the place of the query's own folder, and may be repeated."""
    one, two = (tmp_path_factory.mktemp(name) for name in ("one", "two"))
    put_part(one / "e.dxf", profile_record(0, 1, 2, 3))
    put_part(two / "f.dxf", profile_record(0, 1, 2, 9))
    _, out, _ = run("search", folder / "a.dxf", "--in", one, "--in", two, "--json")
    assert [Path(each["path"]).name for each in _messages(out)[:-1]] == ["e.dxf", "f.dxf"]


def test_search_gives_as_many_as_asked_for(folder, run):
    """-k."""
    assert len(run("search", folder / "a.dxf", "-k", "2", "--json")[1]) == 3


def test_search_says_what_takes_no_part(folder, run):
    """Notes go to stderr, and -q leaves them out."""
    (folder / "new.dxf").write_text("0")
    os.utime(folder / "sub" / "c.step", (1, 1))
    _, _, err = run("search", folder / "a.dxf")
    assert err == ["1 files are not scanned yet and take no part", "1 files have changed since they were scanned"]
    assert run("search", folder / "a.dxf", "-q")[2] == []


def test_search_draws_a_sheet(folder, run):
    """-o sheet.html."""
    code, _, _ = run("search", folder / "a.dxf", "-o", folder / "my sheet.html")
    assert code == 0
    assert "Träger [bold] 2.dxf" in (folder / "my sheet.html").read_text(encoding="utf-8")


def test_search_into_a_folder_that_is_not_there(folder, run):
    """One line, no traceback."""
    code, _, err = run("search", folder / "a.dxf", "-o", folder / "gone" / "sheet.html")
    assert (code, len(err)) == (1, 1)
    assert err[0].startswith("mashape-cad: error: ")


def test_search_in_a_folder_that_was_not_scanned(tmp_path, run):
    """The message is the command to run."""
    (tmp_path / "a.dxf").write_text("0")
    code, out, err = run("search", tmp_path / "a.dxf")
    assert (code, out) == (1, [])
    assert err == [f"mashape-cad: error: {tmp_path}: not scanned yet; run: mashape-cad scan {tmp_path}"]


def test_search_with_a_file_that_does_not_exist(folder, run):
    """One line with the remedy."""
    gone = folder / "gone.dxf"
    assert run("search", gone) == (1, [], [f"mashape-cad: error: {gone}: no such file; check the path"])


@pytest.mark.parametrize(("number", "text"), [(5, "no profile 5; it has 2"), (1, "crosses itself")])
def test_search_with_a_profile_that_cannot_be_used(folder, run, number, text):
    """One line with the reason."""
    put_part(folder / "q.dxf", profile_record(1), profile_record(refused=REFUSED))
    code, out, err = run("search", folder / "q.dxf", "--profile", str(number))
    assert (code, out, len(err)) == (1, [], 1)
    assert text in err[0]


def test_search_with_a_file_that_failed(folder, run):
    """The reason on record."""
    bad = _fail(folder / "text.dxf", "no-profile", "no closed planar outline in it; draw it as closed edges")
    code, _, err = run("search", bad)
    assert code == 1
    assert err == [f"mashape-cad: error: {bad}: no closed planar outline in it; draw it as closed edges"]


# show


def test_show_draws_what_is_on_record(folder, run):
    """SVG by the suffix."""
    code, out, err = run("show", folder / "a.dxf", "-o", folder / "a.svg")
    assert (code, out, err) == (0, [], [])
    assert "a.dxf" in (folder / "a.svg").read_text(encoding="utf-8")


def test_show_of_a_refused_profile_draws_it_with_the_reason(folder, run):
    """There is something to look at."""
    put_part(folder / "q.dxf", profile_record(1), profile_record(refused=REFUSED))
    code, _, _ = run("show", folder / "q.dxf", "--profile", "1", "-o", folder / "q.svg")
    assert code == 0
    assert "crosses itself" in (folder / "q.svg").read_text(encoding="utf-8")


def test_show_of_a_profile_that_is_not_there(folder, run):
    """One line."""
    code, _, err = run("show", folder / "a.dxf", "--profile", "4", "-o", folder / "a.svg")
    assert (code, len(err)) == (1, 1)
    assert "no profile 4; it has 1, numbered from 0" in err[0]


# The program as such


def test_version(run):
    """Name and version."""
    assert run("--version") == (0, [f"mashape-cad, version {__version__}"], [])


def test_runs_as_a_module(repository):
    """The command is there without the script."""
    command = [sys.executable, "-m", "mashape_cad", "--version"]
    done = subprocess.run(command, cwd=repository, capture_output=True, text=True, check=False)
    assert done.stdout == f"mashape-cad, version {__version__}\n"


def test_a_fault_of_the_program_is_one_line(run, monkeypatch):
    """Unless somebody wants to look into it."""

    def scan(*_):
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(scanning, "scan", scan)
    code, _, err = run("scan", ".")
    assert (code, len(err)) == (1, 1)
    assert "a fault of this program (ZeroDivisionError: by zero); please report it" in err[0]
    monkeypatch.setenv("MASHAPE_TRACEBACK", "1")
    with pytest.raises(ZeroDivisionError):
        run("scan", ".")


def test_output_is_utf8_everywhere(folder, repository):
    """Also where the system's encoding knows no umlauts."""
    code = "import sys; from mashape_cad.cli.main import main; sys.exit(main(sys.argv[1:]))"
    done = _python(code, repository, "search", folder / "a.dxf", PYTHONIOENCODING="ascii", PYTHONUTF8="0", LC_ALL="C")
    assert done.returncode == 0, done.stderr
    assert "Träger [bold] 2.dxf" in done.stdout


@pytest.mark.skipif(os.name == "nt", reason="file names are Unicode there")
def test_a_name_that_is_no_unicode(folder, run):
    """Is shown as well as can be."""
    part = Path(os.fsdecode(os.fsencode(folder) + b"/L\xe4nge.dxf"))
    put_part(part, profile_record(0, 1, 2, 3))
    code, out, _ = run("search", folder / "a.dxf", "--json")
    assert code == 0
    assert "L\ufffdnge.dxf" in _messages(out)[1]["path"]


@pytest.mark.skipif(os.name == "nt", reason="needs a POSIX shell")
def test_closed_pipe_is_quiet(folder, repository):
    """As in: search ... | head -1."""
    code = "import sys; from mashape_cad.cli.main import main; sys.exit(main(sys.argv[1:]))"
    command = f"'{sys.executable}' -c '{code}' search '{folder / 'a.dxf'}' --json | true"
    environment = os.environ | {"PYTHONPATH": str(repository)}
    done = subprocess.run(["sh", "-c", command], env=environment, capture_output=True, text=True, check=False)
    assert done.stderr == ""


# Filters, and hits laid over the query


def test_filters_are_switches(folder, run):
    """Without a number --same-size has one of its own; all parts here are squares of 10 mm without holes."""
    assert len(_messages(run("search", folder / "a.dxf", "--json", "--same-size")[1])) == 4
    assert len(_messages(run("search", folder / "a.dxf", "--json", "--same-size=0.01", "--holes", "0")[1])) == 4
    assert len(_messages(run("search", folder / "a.dxf", "--json", "--holes", "1")[1])) == 1


def test_no_mirror_needs_hits_to_be_compared(folder, run):
    """A switch that cannot be honoured is refused."""
    code, _, told = run("search", folder / "a.dxf", "--no-mirror")
    assert code == 2
    assert "--mode same" in told[-1]


def test_mode_same_says_what_hits_are(tmp_path, run):
    """Those that are gone are told on stderr, and the exit code is that of a search that was done."""
    from drawings import write_drawing
    from stand_ins import sidecar

    square = [(0, 0), (10, 0), (10, 10), (0, 10)]
    for name in ("a.dxf", "b.dxf", "c.dxf"):
        path = write_drawing(tmp_path / name, lambda space: space.add_lwpolyline(square, close=True))
        write_sidecar(sidecar_path(path), sidecar(source_of(path), profile_record(0, 1, 2, 3)))
    changed = write_drawing(tmp_path / "c.dxf", lambda space: space.add_circle((0, 0), 5))
    code, lines, told = run("search", tmp_path / "a.dxf", "--mode", "same", "--json")
    messages = _messages(lines)
    assert code == 0
    assert [each.get("relation") for each in messages] == ["identical", "identical", None, None]
    assert messages[1]["deviation_mm"] < 1e-9
    assert any(f"not compared: {changed}: it has changed" in line for line in told)
    _, lines, _ = run("search", tmp_path / "a.dxf", "--mode", "same", "-q")
    assert lines[1].split()[-3:] == ["identical", "0", "0.00%"]
