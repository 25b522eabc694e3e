"""Time against error, one panel for each shape, both on logarithmic axes."""

from pathlib import Path

import matplotlib as mpl
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from report import Results
from row import Row

__all__ = ["draw"]

# Colours that colour-blind people tell apart, and a mark besides.
_STYLES = {
    "ours": ("#d55e00", "*", 13),
    "pyvoronoi": ("#0072b2", "o", 4),
    "scipy": ("#009e73", "s", 4),
    "FloMat": ("#cc79a7", "D", 5),
    "OCCT": ("#777777", "x", 6),
}
_LABELS = {
    "ours": "ours",
    "pyvoronoi": "pyvoronoi (Boost), chords within 1e-2 to 1e-6, pruned",
    "scipy": "scipy Voronoi of samples, pruned",
    "FloMat": "FloMat: plain, and with the fewest discs",
    "OCCT": "OCCT BRepMAT2d",
}
# Errors below rounding are drawn here; those without any junction on the right edge.
_LEAST, _MOST = 1e-16, 1.0


def draw(results: Results, path: Path) -> None:
    """Write the picture."""
    mpl.use("Agg")
    columns = min(5, len(results.shapes))
    lines = -(-len(results.shapes) // columns)
    figure, axes = plt.subplots(
        lines, columns, figsize=(2.3 * columns + 0.4, 2.1 * lines + 0.9), sharex=True, sharey=True, squeeze=False
    )
    for panel, name in zip(axes.flat, results.shapes, strict=False):
        _draw_panel(panel, results, name)
    for panel in axes.flat[len(results.shapes) :]:
        panel.set_visible(False)
    figure.supxlabel("error, by the size of the shape", fontsize=9)
    figure.supylabel("CPU time, ms", fontsize=9)
    handles = [
        plt.Line2D([], [], color=colour, marker=mark, markersize=size * 0.7, lw=1, label=_LABELS[way])
        for way, (colour, mark, size) in _STYLES.items()
    ]
    figure.legend(handles=handles, loc="upper center", ncols=3, fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0, 1, 0.91), h_pad=0.5, w_pad=0.4)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _draw_panel(panel: Axes, results: Results, name: str) -> None:
    for way, (colour, mark, size) in _STYLES.items():
        rows = [row for row in results.rows if row.shape == name and row.way == way and not row.failure]
        points = [(_error(row), row.cpu_ms) for row in rows]
        if points:
            line = "-" if way in {"pyvoronoi", "scipy"} else ""
            panel.plot(*zip(*points, strict=True), color=colour, marker=mark, markersize=size, ls=line, lw=1)
    edges = next(row.edges for row in results.rows if row.shape == name)
    panel.set_title(f"{name}, {edges} edge{'s' * (edges > 1)}", fontsize=9)
    panel.set_xscale("log")
    panel.set_yscale("log")
    panel.set_xlim(_LEAST / 5, _MOST * 5)
    panel.set_xticks([1e-15, 1e-10, 1e-5, 1])
    panel.tick_params(labelsize=7)
    panel.grid(alpha=0.25)


def _error(row: Row) -> float:
    error = max(row.error, row.radius_error) if row.way == "ours" else row.error
    return min(max(error, _LEAST), _MOST)
