"""The command: what it prints and leaves, what it loads, and how it ends."""

import json
import os
import shutil
import subprocess
import sys

import pytest
import stand_ins
from stand_ins import REFUSED, profile_record, put_part

from mashape_cad.cli import main as program
from mashape_cad.evaluation import trials

CLASSES = ("ell", "rect")
MEMBERS = 3


@pytest.fixture
def run(capsys):
    """Run the program in this process: exit code, lines on stdout, lines on stderr."""

    def run(*arguments):
        code = program.main([str(each) for each in arguments])
        captured = capsys.readouterr()
        return code, captured.out.splitlines(), captured.err.splitlines()

    return run


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Two classes of two, scanned; trials are stood in for."""
    monkeypatch.setattr(trials.trials, "__kwdefaults__", {"function": stand_ins.tried, "warm_up": stand_ins.warm_up})
    for name, *bins in (("a/one", 0, 1), ("a/two", 0, 2), ("b/one", 30, 31), ("b/two", 30, 32)):
        put_part(tmp_path / f"{name}.dxf", profile_record(*bins))
    return tmp_path


def test_it_prints_tables_and_writes_the_page(folder, run):
    """Classes are sub-folders here."""
    code, out, err = run("evaluate", folder, "-j", "1", "-o", folder / "report.html", "--pictures", folder / "png")
    assert (code, err) == (0, [])
    assert out[0] == f"{folder}: 4 shapes in 2 classes"
    assert "Running times" in out
    assert (folder / "report.html").stat().st_size > 1000
    assert (folder / "png" / "database.png").exists()


def test_modes_can_be_chosen(folder, run):
    """By name; another name is answered with those that there are."""
    code, out, _ = run("evaluate", folder, "--quick", "--json", "--mode", "paper-rf", "--mode", "paper-all")
    assert code == 0
    assert {json.loads(line)["mode"] for line in out} == {"paper-rf", "paper-all"}
    code, _, err = run("evaluate", folder, "--mode", "psychic")
    assert code == 2
    assert "'psychic' is none of paper-df, paper-rf" in " ".join(err)


def test_csv_and_json_exclude_each_other(folder, run):
    """One stdout."""
    assert run("evaluate", folder, "--csv", "--json")[0] == 2


def test_what_takes_no_part_is_told_and_colours_the_exit_code(folder, run):
    """A part whose axis was refused."""
    put_part(folder / "b" / "crossed.dxf", profile_record(1, refused=REFUSED))
    code, out, err = run("evaluate", folder, "--quick", "--csv")
    assert code == 3
    assert err == ["take no part, having no medial axis: crossed.dxf (1)"]
    assert out[0].startswith("mode,protocol,step,class,")
    assert run("evaluate", folder, "--quick", "--csv", "--quiet")[2] == []


def test_a_missing_folder_is_one_line(tmp_path, run):
    """With exit code 1."""
    code, _, err = run("evaluate", tmp_path / "nowhere")
    assert code == 1
    assert err == [f"mashape-cad: error: {tmp_path / 'nowhere'}: no such folder; check the path"]


def _evaluate(folder, repository, *arguments):
    code = (
        "import sys; from mashape_cad.cli.main import main; code = main(sys.argv[1:]);"
        "print([name for name in ('OCP', 'ezdxf', 'numba') if name in sys.modules], file=sys.stderr); sys.exit(code)"
    )
    command = [sys.executable, "-c", code, "evaluate", str(folder), *map(str, arguments)]
    environment = os.environ | {"PYTHONPATH": str(repository)}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_a_folder_from_nothing_to_its_report(freeform80, repository, tmp_path):
    """Scans what is missing, measures, and the second time loads neither kernel nor reader."""
    folder = tmp_path / "parts"
    folder.mkdir()
    for name in CLASSES:
        for number in range(1, MEMBERS + 1):
            shutil.copy(freeform80 / f"{name}-{number}.dxf", folder)
    first = _evaluate(folder, repository, "--json")
    assert first.returncode == 0, first.stderr
    lines = [json.loads(line) for line in first.stdout.splitlines()]
    [times] = [line for line in lines if line["message_type"] == "time"]
    assert times["shapes"] == len(CLASSES) * MEMBERS
    assert 0 < times["axes"] < times["total"]
    second = _evaluate(folder, repository, "--json", "-o", tmp_path / "report.html")
    assert second.stderr.splitlines()[-1] == "[]"
    without_seconds = [
        [line for line in map(json.loads, done.stdout.splitlines()) if line["message_type"] != "time"]
        for done in (first, second)
    ]
    for line in (line for lines in without_seconds for line in lines):
        line.pop("seconds", None)
    assert without_seconds[0] == without_seconds[1]
    assert (tmp_path / "report.html").stat().st_size > 10_000
