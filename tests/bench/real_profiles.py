"""What becomes of every real profile: `python tests/bench/real_profiles.py [--cache FILE] [--set NAME] [--limit N]`.

Computes axis and certificate of all profiles of `samples/`, and of the folders that MASHAPE_RETRIEVAL and
MASHAPE_CORPUS name, and prints a table of sets, all that was refused or invalid, and the slowest.
"""

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import asdict
from pathlib import Path

import numpy as np
from collection import PRELOAD, Entry, collected, files_of_sets, warm_up
from verdict import Task, Verdict, lost, verdict

from mashape_cad.workers import outcomes

_HEADINGS = ("set", "files", "unread", "profiles", "certified", "invalid", "refused", "crashed", "median", "p95", "max")
_SLOWEST = 10


def main(arguments: Sequence[str] | None = None) -> int:
    """Run; the exit code is 1 if a valid profile was refused."""
    options = _options(arguments)
    files = files_of_sets(options.set, options.limit)
    entries = collected([path for paths in files.values() for path in paths], options.cache, options.jobs, _tell)
    verdicts = _verdicts(list(_tasks(files, entries, options)), options)
    _tell("")
    print(*_report(files, entries, verdicts), sep="\n")
    if options.output:
        options.output.write_text("".join(json.dumps(asdict(each)) + "\n" for each in verdicts), encoding="utf-8")
    return int(any(each.fate in {"refused", "crashed"} for each in verdicts))


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--set", action="append", default=[], help="only sets whose name begins so; repeatable")
    parser.add_argument("--limit", type=int, default=0, help="files of each set, spread evenly; 0 is all")
    parser.add_argument("--jobs", type=int, default=1, help="worker processes")
    parser.add_argument("--repeat", type=int, default=1, help="times that each axis is computed; the fastest counts")
    parser.add_argument("--timeout", type=float, default=60.0, help="seconds for one profile, after that it crashed")
    parser.add_argument("--cache", type=Path, help="keep what was read in this pickle")
    parser.add_argument("-o", "--output", type=Path, help="write all verdicts here, a JSON object a line")
    return parser.parse_args(arguments)


def _tasks(files: dict[str, list[Path]], entries: dict[Path, Entry], options: argparse.Namespace) -> Iterator[Task]:
    for name, paths in files.items():
        for path in paths:
            label = "/".join(path.parts[-2:])
            for number, profile in enumerate(entries[path].profiles):
                yield Task(name, label, number, profile, options.repeat)


def _verdicts(tasks: list[Task], options: argparse.Namespace) -> list[Verdict]:
    found = []
    work = outcomes(tasks, verdict, jobs=options.jobs, timeout=options.timeout, prepare=warm_up, preload=PRELOAD)
    with closing(work):
        for task, outcome in work:
            found.append(lost(task, outcome) if isinstance(outcome, Exception) else outcome)
            _tell(f"{len(found)} of {len(tasks)} profiles")
    return sorted(found, key=lambda each: (each.collection, each.file, each.number))


def _tell(text: str) -> None:
    """Show how far we are, where somebody looks."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def _report(files: dict[str, list[Path]], entries: dict[Path, Entry], verdicts: list[Verdict]) -> Iterator[str]:
    yield _row(_HEADINGS)
    yield _row(["---"] + ["---:"] * (len(_HEADINGS) - 1))
    for name, paths in files.items():
        yield _row(_figures(name, [entries[p] for p in paths], [each for each in verdicts if each.collection == name]))
    yield _row(_figures("all", [entries[p] for paths in files.values() for p in paths], verdicts))
    yield "\nCPU ms of medial_axis alone, of all profiles that are not invalid."
    for fate in ("invalid", "refused", "crashed"):
        counts = Counter(each.reason for each in verdicts if each.fate == fate)
        yield f"{fate}: " + (", ".join(f"{count} {reason}" for reason, count in counts.most_common()) or "none")
    yield from _listed("\nRefused and crashed:", [each for each in verdicts if each.fate in {"refused", "crashed"}])
    yield from _listed("\nInvalid:", [each for each in verdicts if each.fate == "invalid"])
    yield f"\nThe {_SLOWEST} slowest:"
    for each in sorted(_valid(verdicts), key=lambda each: -each.cpu_ms)[:_SLOWEST]:
        yield f"  {each.cpu_ms:8.1f} ms  {_name(each)}"


def _listed(heading: str, verdicts: list[Verdict]) -> Iterator[str]:
    yield heading
    for each in verdicts:
        yield f"  {_name(each)}: {each.message}"


def _figures(name: str, entries: list[Entry], verdicts: list[Verdict]) -> list[str]:
    counts = Counter(each.fate for each in verdicts)
    times = [each.cpu_ms for each in _valid(verdicts)] or [np.nan]
    unread = sum(bool(entry.failure) for entry in entries)
    numbers = [len(entries), unread, len(verdicts), *(counts[fate] for fate in _HEADINGS[4:8])]
    return [name, *map(str, numbers), *(f"{value:.1f}" for value in np.quantile(times, [0.5, 0.95, 1.0]))]


def _valid(verdicts: list[Verdict]) -> list[Verdict]:
    return [each for each in verdicts if each.fate != "invalid" and np.isfinite(each.cpu_ms)]


def _name(each: Verdict) -> str:
    return f"{each.collection}: {each.file} #{each.number} ({each.edges} edges)"


def _row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"


if __name__ == "__main__":
    sys.exit(main())
