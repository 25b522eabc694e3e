"""``mashape-cad certify``."""
# ruff: noqa: PLC0415  -- what a command needs is imported when it runs, so that --help answers at once

import time
from pathlib import Path

import click

from mashape_cad.cli.switches import as_json, quiet, read_switches
from mashape_cad.options import ReadOptions, SignatureOptions

__all__ = ["certify"]


@click.command(short_help="Compute the medial axes of a file and tell what is proven of them.")
@click.argument("file", metavar="FILE", type=click.Path(path_type=Path))
@read_switches
@as_json
@quiet
def certify(file: Path, unit: str | None, gap_rel: float, as_json: bool, quiet: bool) -> int:
    """Compute the medial axis of each profile of FILE and tell what is proven of it, measured with the kernel.

    That goes further than what scan checks: the discs are also held against their definition.

    Exit code: 0 if all are ok, 1 if some are not.
    """
    from mashape_cad.library.derivation import profile_records, read_part
    from mashape_cad.medial.certificate import STATIONS
    from mashape_cad.views import messages, table

    started = time.perf_counter()
    part = read_part(file, ReadOptions(unit, gap_rel))
    ok = 0
    for number, record in enumerate(profile_records(part, SignatureOptions(), STATIONS)):
        ok += record.axis is not None and record.axis.ok
        line = messages.certificate_message(file, number, record) if as_json else table.certificate_line(number, record)
        click.echo(line)
    total = len(part.profiles)
    if as_json:
        click.echo(messages.certify_summary(file, total, ok, time.perf_counter() - started))
    elif not quiet:
        click.echo(f"{ok} of {total} ok")
    return 0 if ok == total else 1
