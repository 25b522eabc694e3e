"""The benchmark as Markdown: a summary, what was asked for and whether it holds, all figures."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from growth import Growth
from row import Row
from shapes import CURVED

__all__ = ["Results", "Target", "markdown", "targets"]

_SUMMARY = (("pyvoronoi", "1e-04"), ("pyvoronoi", "1e-06"), ("scipy", "1e-03"), ("FloMat", "plain"))
# CPU ms that were asked for.
_MOST_MS = {"bracket": 5.0, "gear": 15.0, "plate": 40.0}
_MOST_MB, _MOST_GROWTH = 300.0, 1.15
_LEGEND = """\
Inputs are edges, chords or points. Times are CPU ms, medians after warm-up; those of diagrams are constructing +
pruning, and making the polygon is not counted. Error: the largest distance of an exact junction from the nearest one
found, or, of shapes without a junction, of a found point from the closed form. Radius: the largest difference of a
radius and the kernel's distance. All by the larger side. FloMat takes no arcs: they are one cubic for each quarter, and
where no closed form is known, its errors are against the axis of these cubics. "Coarse" asks it for the fewest discs,
and it then misses junctions. The kernel's own locus (OCCT) counts more nodes as junctions than there are; it is right
on few lines and arcs, and wrong without a word on splines and on many arcs.
"""


@dataclass(frozen=True, slots=True)
class Results:
    """All that one run measured."""

    rows: tuple[Row, ...]
    growths: tuple[Growth, ...]
    memory_mb: float
    memory_shape: str
    machine: str

    @property
    def shapes(self) -> list[str]:
        """Names in the order of measuring."""
        return list(dict.fromkeys(row.shape for row in self.rows))

    def row(self, shape: str, way: str, setting: str = "") -> Row | None:
        """Return one row, if it was measured and gave something."""
        found = (row for row in self.rows if (row.shape, row.way, row.setting) == (shape, way, setting))
        return next((row for row in found if not row.failure), None)

    def ratio(self, shape: str, way: str, setting: str) -> float:
        """How many times as long as ours another way took; NaN if either is missing."""
        mine, theirs = self.row(shape, "ours"), self.row(shape, way, setting)
        return theirs.cpu_ms / mine.cpu_ms if mine and theirs else math.nan


@dataclass(frozen=True, slots=True)
class Target:
    """One figure that was asked for, what was measured, and whether it holds; None if it was not measured."""

    text: str
    measured: str
    holds: bool | None


def targets(results: Results) -> Iterator[Target]:
    """Compare with what was asked for."""
    yield _ratio_target(results, "10 times as fast as FloMat on every shape", results.shapes, "FloMat", "plain", 10)
    curved = [name for name in results.shapes if name in CURVED]
    yield _ratio_target(results, "faster than pyvoronoi at 1e-4 on every curved shape", curved, "pyvoronoi", "1e-04", 1)
    yield _ratio_target(results, "10 times as fast as pyvoronoi at 1e-6", curved, "pyvoronoi", "1e-06", 10)
    for name, most in _MOST_MS.items():
        row = results.row(name, "ours")
        if row:
            yield Target(f"{name} in at most {most:g} ms", f"{row.cpu_ms:.1f} ms", row.cpu_ms <= most)
    for each in results.growths:
        text = f"{each.family}: growth at most n^{_MOST_GROWTH}"
        if math.isfinite(each.exponent):
            yield Target(text, f"n^{each.exponent:.2f}", each.exponent <= _MOST_GROWTH)
    text = f"{results.memory_shape}: peak memory under {_MOST_MB:.0f} MB above the import"
    yield Target(text, f"{results.memory_mb:.0f} MB", results.memory_mb < _MOST_MB)


def _ratio_target(results: Results, text: str, shapes: Sequence[str], way: str, setting: str, least: float) -> Target:
    ratios = {name: results.ratio(name, way, setting) for name in shapes}
    known = {name: ratio for name, ratio in ratios.items() if math.isfinite(ratio)}
    if not known:
        return Target(text, "not measured", None)
    worst = min(known, key=known.__getitem__)
    told = f"{known[worst]:.1f} times on {worst}, {max(known.values()):.1f} at best"
    return Target(text, told, known[worst] >= least)


def markdown(results: Results, command: str, picture: str) -> str:
    """Return the whole report."""
    return (
        "\n".join([*_summary(results, picture), *_targets(results), *_growth(results), *_raw(results, command)]) + "\n"
    )


def _summary(results: Results, picture: str) -> Iterator[str]:
    yield "# Benchmark of the medial axis\n"
    yield f"![Time against error of each way, one panel for each shape]({picture})\n"
    yield "Ours in CPU ms; of the others how many times as long they took in the same run; errors by the size.\n"
    yield _line(["shape", "edges", "ours", *(f"{way} {setting}" for way, setting in _SUMMARY)])
    yield _line(["---", *["---:"] * (2 + len(_SUMMARY))])
    for name in results.shapes:
        mine = results.row(name, "ours")
        if mine:
            cells = [_against(results, name, way, setting) for way, setting in _SUMMARY]
            yield _line([name, str(mine.edges), f"{mine.cpu_ms:.1f} ms, {_error(mine)}", *cells])


def _against(results: Results, name: str, way: str, setting: str) -> str:
    row = results.row(name, way, setting)
    return f"{_figures(results.ratio(name, way, setting))} x, {_error(row)}" if row else "-"


def _targets(results: Results) -> Iterator[str]:
    yield "\n## Aims\n"
    yield _line(["figure", "measured", "holds"])
    yield _line(["---"] * 3)
    for target in targets(results):
        yield _line([target.text, target.measured, {True: "yes", False: "no", None: "-"}[target.holds]])


def _growth(results: Results) -> Iterator[str]:
    yield "\n## Growth\n"
    yield "CPU ms by the number of edges (plate) or spans (star).\n"
    for each in results.growths:
        yield _line([each.family, *map(str, each.counts), "exponent"])
        yield _line(["---", *["---:"] * (len(each.counts) + 1)])
        yield _line(["ms", *(f"{value:.1f}" for value in each.cpu_ms), f"{each.exponent:.2f}"]) + "\n"


def _raw(results: Results, command: str) -> Iterator[str]:
    yield "## All figures\n"
    yield f"`{command}`; {results.machine}.\n"
    yield _LEGEND
    yield _line(["shape", "way", "inputs", "CPU ms", "times ours", "error", "radius", "junctions"])
    yield _line(["---", "---", *["---:"] * 6])
    for row in results.rows:
        yield _line(_raw_cells(results, row))


def _raw_cells(results: Results, row: Row) -> list[str]:
    way = f"{row.way} {row.setting}".strip()
    if row.failure:
        return [row.shape, way, str(row.inputs), row.failure.replace("|", "/")[:80], "", "", "", ""]
    parts = " + ".join(f"{value:.2f}" for value in row.parts_ms.values())
    ratio = _figures(results.ratio(row.shape, row.way, row.setting))
    radius = "" if math.isnan(row.radius_error) else f"{row.radius_error:.0e}"
    counts = f"{row.junctions} of {row.expected}"
    return [row.shape, way, str(row.inputs), parts, ratio, _error(row), radius, counts]


def _error(row: Row) -> str:
    if math.isinf(row.error):
        return "nothing"
    # Where there is no closed form, ours is the measure, and has what the kernel says of its radii.
    error = max(row.error, row.radius_error) if row.way == "ours" else row.error
    return f"{error:.0e}"


def _figures(ratio: float) -> str:
    return f"{ratio:.2g}" if ratio < 100 else f"{ratio:.0f}"


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"
