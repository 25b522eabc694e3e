"""``mashape-cad evaluate``."""
# ruff: noqa: PLC0415  -- what a command needs is imported when it runs, so that --help answers at once

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mashape_cad.cli.switches import as_json, option, output, quiet, read_switches
from mashape_cad.options import EvaluateOptions, PartOptions, ReadOptions, ScanOptions

if TYPE_CHECKING:
    from mashape_cad.evaluation.labelled import LabelledSet
    from mashape_cad.evaluation.modes import Mode
    from mashape_cad.evaluation.report import Report

__all__ = ["evaluate"]

SOME_FAILED = 3
MOST_NAMED = 5


@click.command(short_help="Measure how well each class of a labelled folder is found.")
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option(
    "--mode", "names", metavar="NAME", multiple=True, help="Only this mode; repeat it for more. [default: all]"
)
@option(EvaluateOptions, "quick")
@click.option(
    "--csv", "as_csv", is_flag=True, help="One line for each class, mode, protocol and step, and for each mean."
)
@output(".html", what="Page with tables, retrieval sheets, medial axes and signatures")
@click.option(
    "--pictures",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="OUT",
    help="Folder to write the sheets into, as PNG.",
)
@option(ScanOptions, "jobs", "-j", "--jobs")
@option(ScanOptions, "timeout")
@read_switches
@as_json
@quiet
def evaluate(
    folder: Path,
    names: tuple[str, ...],
    quick: bool,
    as_csv: bool,
    output: Path | None,
    pictures: Path | None,
    jobs: int | None,
    timeout: float,
    unit: str | None,
    gap_rel: float,
    as_json: bool,
    quiet: bool,
) -> int:
    """Let every part of DIR search all others, and measure how many of its own class it finds.

    The class of a part is the sub-folder of DIR that it lies in, or else what its name begins with: bird-1.dxf and
    bird-2.dxf are of one class. What is not scanned yet is scanned first.

    Exit code: 0 done, 3 some files took no part, 1 failed.
    """
    from mashape_cad.evaluation.labelled import labelled_set
    from mashape_cad.evaluation.report import report
    from mashape_cad.evaluation.trials import trials
    from mashape_cad.scanning import scan
    from mashape_cad.views import progress

    if as_csv and as_json:
        raise click.UsageError("--csv and --json are two ways to print the same; give one")
    modes = _modes(names)
    options = ScanOptions(jobs, timeout, part=PartOptions(ReadOptions(unit, gap_rel)))
    bar = sys.stderr.isatty() and not quiet
    with progress.scan_progress(sys.stderr, bar=bar) as tell:
        scan([folder], options, tell)
    labelled = labelled_set(folder)
    with progress.scan_progress(sys.stderr, bar=bar) as tell:
        made = {} if quick else trials(labelled, options, tell)
    found = report(labelled, modes, made)
    _print(found, as_csv=as_csv, as_json=as_json)
    _draw(found, output, pictures)
    return _told_what_is_left_out(labelled, quiet)


def _modes(names: tuple[str, ...]) -> "tuple[Mode, ...]":
    from mashape_cad.evaluation.modes import MODES

    known = {mode.name: mode for mode in MODES}
    for name in names:
        if name not in known:
            raise click.BadParameter(f"{name!r} is none of {', '.join(known)}", param_hint="--mode")
    return tuple(mode for name, mode in known.items() if not names or name in names)


def _print(found: "Report", *, as_csv: bool, as_json: bool) -> None:
    if as_csv:
        from mashape_cad.views.evaluation_csv import evaluation_csv

        click.echo(evaluation_csv(found), nl=False)
    elif as_json:
        from mashape_cad.views.evaluation_json import evaluation_messages

        for line in evaluation_messages(found):
            click.echo(line)
    else:
        from mashape_cad.views.evaluation_text import print_report

        print_report(found, sys.stdout)


def _draw(found: "Report", page: Path | None, pictures: Path | None) -> None:
    if page is not None:
        from mashape_cad.views.evaluation_page import write_page

        write_page(page, found)
    if pictures is not None:
        from mashape_cad.views.evaluation_page import write_pictures

        write_pictures(pictures, found)


def _told_what_is_left_out(labelled: "LabelledSet", quiet: bool) -> int:
    if not labelled.left_out:
        return 0
    if not quiet:
        names = ", ".join(path.name for path in labelled.left_out[:MOST_NAMED])
        more = ", ..." if len(labelled.left_out) > MOST_NAMED else ""
        click.echo(f"take no part, having no medial axis: {names}{more} ({len(labelled.left_out)})", err=True)
    return SOME_FAILED
