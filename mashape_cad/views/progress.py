"""How a scan gets on and how it ended, for people: files, rate, time left, failures."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TextIO

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, Task, TextColumn, TimeRemainingColumn
from rich.text import Text

from mashape_cad.library.freshness import Status
from mashape_cad.scanning import Event, FileScanned, ScanStarted, ScanSummary
from mashape_cad.views.messages import readable

__all__ = ["comparing_progress", "scan_progress", "summary_sentence"]

# Shown till the first file has been read.
_STARTING = "starting (once after an installation: compiling for a minute or two)"


@contextmanager
def scan_progress(stream: TextIO, *, bar: bool) -> Iterator[Callable[[Event], None]]:
    """Give a function that is told of each event: it shows a bar, if asked for, and a line for each failed file."""
    console = Console(file=stream, highlight=False, soft_wrap=True)
    columns = (BarColumn(), MofNCompleteColumn(), _Rate(), TimeRemainingColumn(), TextColumn("{task.description}"))
    # The results on stdout are not ours to redirect.
    shown = Progress(*columns, console=console, transient=True, disable=not bar, redirect_stdout=False)
    with shown as progress:
        task = progress.add_task("")
        failed = 0

        def tell(event: Event) -> None:
            nonlocal failed
            if isinstance(event, ScanStarted):
                progress.update(task, total=event.total, description=_STARTING)
                return
            if event.status is Status.UNCHANGED:
                progress.update(task, advance=1)
                return
            if event.status is Status.FAILED:
                failed += 1
                console.print(Text(_failure_line(event)))
            progress.update(task, advance=1, description=f"{failed} failed" if failed else "")

        yield tell


@contextmanager
def comparing_progress(stream: TextIO, total: int, *, bar: bool) -> Iterator[Callable[[], None]]:
    """Give a function that is told of each hit that has been compared."""
    console = Console(file=stream, highlight=False)
    columns = (TextColumn("comparing"), BarColumn(), MofNCompleteColumn())
    with Progress(*columns, console=console, transient=True, disable=not bar, redirect_stdout=False) as shown:
        task = shown.add_task("", total=total)
        yield lambda: shown.update(task, advance=1)


def summary_sentence(summary: ScanSummary) -> str:
    """Return how a scan ended, in one line."""
    files = summary.new + summary.changed + summary.unchanged + summary.failed
    counts = {status.value: getattr(summary, status.value) for status in Status}
    told = ", ".join(f"{count} {status}" for status, count in counts.items() if count) or "nothing to read"
    before = f" ({summary.failed_before} of the unchanged had failed: --retry-failed)" if summary.failed_before else ""
    return f"{files} files: {told}{before}; {summary.profiles} profiles, {summary.seconds:.1f} s"


def _failure_line(event: FileScanned) -> str:
    text = event.failure.text if event.failure else ""
    label = readable(event.path)
    return f"failed: {text}" if text.startswith(label) else f"failed: {label}: {text}"


class _Rate(TextColumn):
    """Files a second."""

    def __init__(self) -> None:
        super().__init__("")

    def render(self, task: Task) -> Text:
        speed = task.finished_speed or task.speed
        return Text("" if speed is None else f"{speed:.1f}/s")
