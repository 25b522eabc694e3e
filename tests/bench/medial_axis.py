"""Time and accuracy of the medial axis against its peers, in one run: `python tests/bench/medial_axis.py -o FOLDER`.

Writes benchmark.md and benchmark.png. Needs the extra `bench`, and node with npm for FloMat, which is left out without.
`--profile SHAPE` shows where our time goes instead.
"""

import argparse
import cProfile
import pstats
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from contest import contest
from growth import COUNTS, growth
from machine import described
from memory import peak_mb
from peers import boost, flomat, ours
from plot import draw
from report import Results, markdown, targets
from shapes import SHAPES

_PROFILED_RUNS, _PROFILED_LINES = 20, 25
_LARGEST = "plate"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run."""
    options = _options(arguments)
    if options.profile:
        _profile(options.profile)
        return 0
    if not boost.is_at_hand():
        print("pyvoronoi is not at hand and is left out; install the extra `bench`")
    with tempfile.TemporaryDirectory() as scratch:
        results = _results(options, _flomat_folder(options, Path(scratch)))
    options.output.mkdir(parents=True, exist_ok=True)
    draw(results, options.output / "benchmark.png")
    text = markdown(results, "python tests/bench/medial_axis.py -o FOLDER", "benchmark.png")
    (options.output / "benchmark.md").write_text(text, encoding="utf-8")
    for target in targets(results):
        print(f"{ {True: 'yes', False: 'no', None: '-'}[target.holds]:4}{target.text}: {target.measured}")
    return 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=Path("benchmark"), help="folder for table and plot")
    parser.add_argument("--shape", action="append", choices=SHAPES, help="only this shape; repeatable")
    parser.add_argument("--repeat", type=int, default=7, help="times that each call is measured")
    parser.add_argument("--counts", type=int, nargs="*", default=COUNTS, help="sizes at which growth is measured")
    parser.add_argument("--flomat", type=Path, help="install FloMat here, and find it again next time")
    parser.add_argument("--no-flomat", action="store_true", help="leave FloMat out")
    parser.add_argument("--profile", choices=SHAPES, metavar="SHAPE", help="show where our time goes, and end")
    return parser.parse_args(arguments)


def _results(options: argparse.Namespace, flomat_folder: Path | None) -> Results:
    names = options.shape or list(SHAPES)
    rows = tuple(contest(names, options.repeat, flomat_folder, _tell))
    growths = tuple(growth(tuple(options.counts), options.repeat, _tell)) if options.counts else ()
    _tell("memory")
    heaviest = _LARGEST if _LARGEST in names else names[-1]
    memory = peak_mb(heaviest)
    _tell("")
    return Results(rows, growths, memory, heaviest, described())


def _flomat_folder(options: argparse.Namespace, scratch: Path) -> Path | None:
    if options.no_flomat:
        return None
    if not flomat.is_at_hand():
        print("node and npm are not at hand: FloMat is left out")
        return None
    folder = (options.flomat or scratch).resolve()
    try:
        flomat.install(folder)
    except subprocess.SubprocessError as error:
        print(f"FloMat could not be installed and is left out: {error}")
        return None
    return folder


def _profile(name: str) -> None:
    profile = SHAPES[name]()
    ours.medial_axis(profile)  # compiled code is loaded at the first call
    profiler = cProfile.Profile()
    profiler.enable()
    for _ in range(_PROFILED_RUNS):
        ours.medial_axis(profile)
    profiler.disable()
    print(f"{name}, {_PROFILED_RUNS} runs, by own time:")
    pstats.Stats(profiler).sort_stats("tottime").print_stats(_PROFILED_LINES)


def _tell(text: str) -> None:
    """Show how far we are, where somebody looks."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
