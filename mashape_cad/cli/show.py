"""``mashape-cad show``."""
# ruff: noqa: PLC0415  -- what a command needs is imported when it runs, so that --help answers at once

from pathlib import Path

import click

from mashape_cad.cli.switches import output, read_switches
from mashape_cad.options import PartOptions, ReadOptions

__all__ = ["show"]


@click.command(short_help="Draw a profile, its medial axis and its histograms.")
@click.argument("file", metavar="FILE", type=click.Path(path_type=Path))
@click.option("--profile", type=click.IntRange(0), default=0, show_default=True, metavar="N", help="Which one, from 0.")
@output(".svg", ".png", required=True)
@read_switches
def show(file: Path, profile: int, output: Path, unit: str | None, gap_rel: float) -> int:
    """Draw a profile of FILE, its medial axis, some maximal discs and the three histograms of its signature.

    A file that is scanned is drawn from its sidecar, any other is read for it.
    """
    from mashape_cad.library.folders import check_file
    from mashape_cad.library.freshness import freshness
    from mashape_cad.library.selection import numbered, profiles_of
    from mashape_cad.views.picture import write_record

    check_file(file)
    options = PartOptions(ReadOptions(unit, gap_rel))
    title = f"{file.name}, profile {profile}" if profile else file.name
    sidecar = freshness(file, options).sidecar
    if sidecar is None:
        _from_file(file, profile, output, options, title)
    else:
        write_record(output, numbered(profiles_of(sidecar, str(file)), profile, str(file)), title)
    return 0


def _from_file(file: Path, number: int, output: Path, options: PartOptions, title: str) -> None:
    from mashape_cad.library.derivation import read_part
    from mashape_cad.library.selection import numbered
    from mashape_cad.medial.axis import medial_axis
    from mashape_cad.signatures.paper import signature
    from mashape_cad.views.picture import write_show

    profile = numbered(read_part(file, options.read).profiles, number, str(file))
    axis = medial_axis(profile)
    write_show(output, profile, axis, signature(axis, per_edge=options.signature.per_edge), title)
