"""``mashape-cad axis``."""
# ruff: noqa: PLC0415  -- what a command needs is imported when it runs, so that --help answers at once

from pathlib import Path

import click

from mashape_cad.cli.switches import option, output, quiet, read_switches
from mashape_cad.options import AxisOptions, ReadOptions

__all__ = ["axis"]

FAILED, SOME_FAILED = 1, 3


@click.command(short_help="Write the medial axes of a file as DXF, SVG or JSON.")
@click.argument("file", metavar="FILE", type=click.Path(path_type=Path))
@click.option("--profile", type=click.IntRange(0), metavar="N", help="Only this profile, from 0. [default: all]")
@output(".dxf", ".svg", ".json", required=True, what="File to write")
@option(AxisOptions, "step")
@option(AxisOptions, "min_angle")
@option(AxisOptions, "min_thickness")
@read_switches
@quiet
def axis(
    file: Path,
    profile: int | None,
    output: Path,
    step: float | None,
    min_angle: float,
    min_thickness: float,
    unit: str | None,
    gap_rel: float,
    quiet: bool,
) -> int:
    """Write the medial axis of each profile of FILE, with the clearance along it.

    DXF: the outline, the branches as splines, and the same again with z = -clearance, for V-carving. SVG: a picture in
    true size. JSON: nodes and sampled branches. All in mm, in the coordinates of FILE. A profile whose axis is refused
    is named and left out.

    Exit code: 0 done, 3 some profiles were left out, 1 failed.
    """
    from mashape_cad.library.derivation import read_part
    from mashape_cad.library.selection import numbered
    from mashape_cad.library.tracing import traced_profiles
    from mashape_cad.views.axis_file import write_axes

    if output.exists() and file.exists() and output.samefile(file):
        raise click.BadParameter(f"{str(output)!r} is the file that is read; name another one", param_hint="-o")
    options = AxisOptions(step, min_angle, min_thickness)
    profiles = list(enumerate(read_part(file, ReadOptions(unit, gap_rel)).profiles))
    if profile is not None:
        profiles = [numbered(profiles, profile, str(file))]
    traced, refused = traced_profiles(profiles, options, splines=output.suffix.lower() == ".dxf")
    for each in refused:
        click.echo(f"left out: {file}: profile {each.number}: {each.refused.text}", err=True)
    if not traced:
        return FAILED
    write_axes(output, traced, refused, options, file)
    if not quiet:
        branches = sum(len(each.trace.branches) for each in traced)
        click.echo(f"{len(traced)} of {len(profiles)} profiles, {branches} branches")
    return SOME_FAILED if refused else 0
