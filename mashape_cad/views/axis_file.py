"""Medial axes as a file; its suffix says which kind."""
# ruff: noqa: PLC0415  -- each kind needs other libraries

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mashape_cad.options import AxisOptions
from mashape_cad.views.output import checked_suffix, write

if TYPE_CHECKING:
    from mashape_cad.library.tracing import RefusedProfile, TracedProfile

__all__ = ["SUFFIXES", "write_axes"]

SUFFIXES = (".dxf", ".svg", ".json")


def write_axes(
    out: Path,
    traced: Sequence["TracedProfile"],
    refused: Sequence["RefusedProfile"],
    options: AxisOptions,
    source: Path,
) -> None:
    """Write the axes of a part's profiles.

    Parameters
    ----------
    out : Path
        Ends with one of `SUFFIXES`.
    traced : sequence of TracedProfile
        For DXF with splines.
    refused : sequence of RefusedProfile
        On record in JSON.
    options : AxisOptions
        What shaped the traces.
    source : Path
        The part file.

    Raises
    ------
    PictureError
        If the suffix is not known or the file cannot be written.
    """
    match checked_suffix(out, SUFFIXES):
        case ".json":
            from mashape_cad.views.axis_json import axes_json

            write(out, axes_json(traced, refused, options, source))
        case ".dxf":
            from mashape_cad.views.axis_dxf import axes_dxf

            write(out, axes_dxf(traced))
        case _:
            from mashape_cad.views.axis_svg import axes_svg

            write(out, axes_svg(traced, source).encode())
