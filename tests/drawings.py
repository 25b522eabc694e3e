"""Small DXF drawings for tests, written with ezdxf."""

from collections.abc import Callable
from pathlib import Path

import ezdxf

from mashape_cad.options import ReadOptions
from mashape_cad.reading.dxf import read_dxf
from mashape_cad.reading.part import Part

MM = 4


def write_drawing(path: Path, draw: Callable, version: str = "R2000", units: int | None = MM) -> Path:
    """Write what `draw` adds to model space; `draw` gets the space, and the document as its attribute `doc`."""
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = units if units is not None else 0
    draw(document.modelspace())
    document.saveas(path)
    return path


def drawn(folder: Path, draw: Callable, options: ReadOptions | None = None, **more) -> Part:
    """Write a drawing and read it back."""
    return read_dxf(write_drawing(folder / "drawing.dxf", draw, **more), options or ReadOptions())


def codes(part: Part) -> list[str]:
    """Codes of a part's findings, but for the unit that is always on record."""
    return [finding.code for finding in part.findings if finding.code != "unit-decided"]


def kinds(part: Part) -> list[str]:
    """Kinds of all edges of all profiles, in order."""
    return [type(edge).__name__ for profile in part.profiles for edge in profile.edges]
