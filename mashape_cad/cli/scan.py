"""``mashape-cad scan``."""
# ruff: noqa: PLC0415  -- what a command needs is imported when it runs, so that --help answers at once

import sys
from pathlib import Path

import click

from mashape_cad.cli.switches import as_json, option, quiet, read_switches
from mashape_cad.options import PartOptions, ReadOptions, ScanOptions

__all__ = ["scan"]

SOME_FAILED = 3


@click.command(short_help="Read all parts below folders, write a sidecar beside each.")
@click.argument("folders", metavar="DIR...", nargs=-1, required=True, type=click.Path(path_type=Path))
@option(ScanOptions, "jobs", "-j", "--jobs")
@option(ScanOptions, "timeout")
@option(ScanOptions, "retry_failed")
@read_switches
@as_json
@quiet
def scan(
    folders: tuple[Path, ...],
    jobs: int | None,
    timeout: float,
    retry_failed: bool,
    unit: str | None,
    gap_rel: float,
    as_json: bool,
    quiet: bool,
) -> int:
    """Read all DXF, STEP and BREP files below the folders and write a sidecar beside each.

    What has not changed since the last scan is not read again. A file that cannot be read costs that file only.

    Exit code: 0 done, 3 some files failed, 1 failed, 130 interrupted (what is written is whole; scan again to go on).
    """
    from mashape_cad import scanning
    from mashape_cad.views import messages, progress

    bar = sys.stderr.isatty() and not quiet and not (as_json and sys.stdout.isatty())
    options = ScanOptions(jobs, timeout, retry_failed, PartOptions(ReadOptions(unit, gap_rel)))
    with progress.scan_progress(sys.stderr, bar=bar) as tell:

        def on_event(event: scanning.Event) -> None:
            tell(event)
            if as_json and isinstance(event, scanning.FileScanned):
                click.echo(messages.file_message(event))

        summary = scanning.scan(folders, options, on_event)
    if as_json:
        click.echo(messages.scan_summary(summary))
    elif not quiet:
        click.echo(progress.summary_sentence(summary))
    return SOME_FAILED if summary.failed else 0
