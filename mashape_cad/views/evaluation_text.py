"""An evaluation for people, on a terminal or in a file."""

from typing import TextIO

from rich.console import Console
from rich.table import Table
from rich.text import Text

from mashape_cad.evaluation.measures import Protocol
from mashape_cad.evaluation.report import Report
from mashape_cad.views.evaluation_rows import Grid, class_grid, paper_grid, sampling_grid, summary_grid, time_grid
from mashape_cad.views.messages import readable

__all__ = ["grids", "headline", "print_report"]

# Into a file or a pipe a line is as long as it is: nothing is cut off or folded.
_UNBOUNDED = 10_000


def headline(report: Report) -> str:
    """Return what was evaluated, in one line."""
    labels = report.full.labels
    name = f"{readable(report.labelled.folder)}: {len(labels)} shapes in {len(set(labels))} classes"
    return f"{name}, a reconstruction of the paper's database" if report.published else name


def grids(report: Report) -> tuple[Grid, ...]:
    """Return all tables of a report, in the order in which they are read."""
    possible = (
        paper_grid(report),
        class_grid(report, Protocol.PAPER),
        class_grid(report, Protocol.PRINCETON),
        summary_grid(report),
        sampling_grid(report),
        time_grid(report),
    )
    return tuple(grid for grid in possible if grid is not None)


def print_report(report: Report, stream: TextIO) -> None:
    """Print all tables."""
    console = Console(file=stream, width=None if stream.isatty() else _UNBOUNDED, highlight=False)
    console.print(Text(headline(report)))
    for grid in grids(report):
        console.print()
        console.print(Text(grid.title, style="bold"))
        console.print(_table(grid))
        console.print(Text(grid.note, style="dim"), soft_wrap=False)


def _table(grid: Grid) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold", padding=(0, 2, 0, 0))
    for number, heading in enumerate(grid.headings):
        table.add_column(heading, justify="right" if number else "left", no_wrap=True)
    for number, row in enumerate(grid.rows):
        is_mean = grid.has_mean and number == len(grid.rows) - 1
        table.add_row(*(Text(cell) for cell in row), style="bold" if is_mean else None)
    return table
