"""The benchmarks run from their command lines; what they measure is read by people, not tested."""

import json
import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

_BENCH = Path(__file__).parent


def _run(script, *arguments):
    command = [sys.executable, str(_BENCH / script), *map(str, arguments)]
    environment = os.environ | {"PYTHONPATH": str(_BENCH.parent.parent)}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_real_profiles(tmp_path):
    """Two of the samples are certified, the table counts them, and a second run reads nothing again."""
    cache, output = tmp_path / "profiles.pickle", tmp_path / "verdicts.jsonl"
    done = _run("real_profiles.py", "--set", "samples", "--limit", 2, "--cache", cache, "-o", output)
    assert done.returncode == 0, done.stderr
    verdicts = [json.loads(line) for line in output.read_text(encoding="utf-8").splitlines()]
    assert {each["fate"] for each in verdicts} == {"certified"}
    assert f"| samples | 2 | 0 | {len(verdicts)} | {len(verdicts)} | 0 | 0 | 0 |" in done.stdout
    before = cache.stat().st_mtime_ns
    assert _run("real_profiles.py", "--set", "samples", "--limit", 2, "--cache", cache).returncode == 0
    assert cache.stat().st_mtime_ns == before


@pytest.mark.slow
def test_contest(tmp_path):
    """On one small shape, measured once, all ways find its three junctions; table and plot are there."""
    arguments = ["--shape", "L", "--repeat", 1, "--counts", 25, "--no-flomat", "-o", tmp_path]
    done = _run("medial_axis.py", *arguments)
    assert done.returncode == 0, done.stderr
    report = (tmp_path / "benchmark.md").read_text(encoding="utf-8")
    rows = [line.split(" | ") for line in report.splitlines() if line.startswith("| L | ") and line.count("|") == 9]
    peers = {"pyvoronoi 1e-04"} if find_spec("pyvoronoi") else set()  # of the extra `bench`
    assert {"ours", "scipy 1e-03", "OCCT"} | peers <= {row[1] for row in rows}
    assert all(row[-1].startswith("3 of 3") for row in rows if row[1] != "OCCT")
    assert (tmp_path / "benchmark.png").stat().st_size > 1000


def test_profile_of_a_shape():
    """Where our time goes is told by function."""
    done = _run("medial_axis.py", "--profile", "L")
    assert done.returncode == 0, done.stderr
    assert "tottime" in done.stdout


def test_ranking():
    """A query in a small library; the first line is what it is measured beside."""
    done = _run("ranking.py", "--profiles", 200)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("numpy's matrix product: ")
    assert len(done.stdout.splitlines()) == 3
