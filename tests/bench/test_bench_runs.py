"""The benchmarks run from their command lines; what they measure is read by people, not tested."""

import json
import subprocess
import sys
from pathlib import Path

_BENCH = Path(__file__).parent


def _run(script, *arguments):
    command = [sys.executable, str(_BENCH / script), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


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
