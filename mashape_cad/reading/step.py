"""STEP and BREP files to profiles: `read_step`, `read_brep`."""

import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from mashape_cad.errors import UnreadableFileError
from mashape_cad.findings import Finding, Severity
from mashape_cad.kernel import shapes
from mashape_cad.kernel.faces import planar_faces
from mashape_cad.kernel.failures import ShapeError
from mashape_cad.options import ReadOptions
from mashape_cad.reading.faces import face_profiles
from mashape_cad.reading.part import Part, Unit

__all__ = ["read_brep", "read_step"]

# How far from a STEP file's beginning and end its marks may stand, bytes: comments and blank lines are allowed.
_MARGIN = 4096
_EXTERNAL = re.compile(rb"DOCUMENT_FILE\s*\(\s*'([^']*)'")
_SHORT_NAMES = {1e-3: "um", 1.0: "mm", 10.0: "cm", 1000.0: "m", 25.4: "in", 304.8: "ft"}
_EXPORT_AGAIN = "export or copy the file again"


def read_step(path: Path, options: ReadOptions) -> Part:
    """Read the planar faces of a STEP file.

    Parameters
    ----------
    path : Path
    options : ReadOptions
        A unit given there overrules the one that the file states.

    Raises
    ------
    UnreadableFileError
        If it is no STEP file, is cut off, or its geometry is damaged.
    OSError
        If it cannot be opened.
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    _refuse_other_text(path)
    try:
        content = shapes.read_step(path)
    except ShapeError as error:
        raise UnreadableFileError(f"not a sound STEP file: {error}; {_EXPORT_AGAIN}") from error
    stated = _stated_unit(content.units)
    unit = Unit.named(options.unit, "option") if options.unit else stated
    findings = [_unit_finding(unit, stated), *_mixed_unit_findings(content.units)]
    if content.shape is None:
        return Part(path, "step", unit, (), (*findings, _no_shape(path)))
    made = face_profiles(planar_faces(content.shape), options.gap_rel).scaled(unit.millimetres / stated.millimetres)
    return Part(path, "step", unit, made.profiles, (*findings, *made.findings))


def read_brep(path: Path, options: ReadOptions) -> Part:
    """Read the planar faces of a BREP file, the kernel's own format; its numbers are millimetres by convention.

    Parameters
    ----------
    path : Path
    options : ReadOptions

    Raises
    ------
    UnreadableFileError
        If it is no BREP file, or a damaged one.
    OSError
        If it cannot be opened.
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    _refuse_empty(path)
    try:
        shape = shapes.read_brep(path)
    except ShapeError as error:
        raise UnreadableFileError(f"not a sound BREP file: {error}; {_EXPORT_AGAIN}") from error
    unit = Unit.named(options.unit, "option") if options.unit else Unit.named("mm", "default")
    finding = _unit_finding(unit, unit)
    if shape is None:
        text = "the file holds no shape at all; save the part itself"
        return Part(path, "brep", unit, (), (finding, Finding("file-no-shape", Severity.LOST, text)))
    made = face_profiles(planar_faces(shape), options.gap_rel).scaled(unit.millimetres)
    return Part(path, "brep", unit, made.profiles, (finding, *made.findings))


def _refuse_empty(path: Path) -> None:
    with path.open("rb") as file:
        if not file.read(_MARGIN).strip(b"\0 \r\n\t"):
            raise UnreadableFileError(f"the file is empty; {_EXPORT_AGAIN}")


def _refuse_other_text(path: Path) -> None:
    """Look at both ends of the file, where most mishaps show, before the kernel does."""
    _refuse_empty(path)
    with path.open("rb") as file:
        head = file.read(_MARGIN)
        file.seek(max(0, path.stat().st_size - _MARGIN))
        tail = file.read()
    if b"ISO-10303-21" not in head:
        raise UnreadableFileError("not a STEP file: it does not begin with ISO-10303-21; check what it really is")
    if b"END-ISO-10303-21" not in tail:
        raise UnreadableFileError(f"cut off: its end mark (END-ISO-10303-21;) is missing; {_EXPORT_AGAIN}")


def _stated_unit(units: Iterable[tuple[str, float]]) -> Unit:
    """Return the first unit that the file states; the kernel takes a length without unit for millimetres."""
    for name, millimetres in units:
        for known, short in _SHORT_NAMES.items():
            if math.isclose(millimetres, known, rel_tol=1e-9):
                return Unit(short, known, "file")
        return Unit(name, millimetres, "file")
    return Unit.named("mm", "default")


_REASON: dict[Literal["option", "insunits", "measurement", "file", "default"], str] = {
    "option": "as the option says",
    "file": "as the file states",
    "default": "assumed, as the file does not say; the option for the unit overrules it",
}


def _unit_finding(unit: Unit, stated: Unit) -> Finding:
    text = f"1 unit of the file = 1 {unit.name}, {_REASON[unit.decided_by]}"
    if stated.decided_by == "file" and stated.name != unit.name:
        text += f"; the file states {stated.name}"
    return Finding("unit-decided", Severity.INFO, text)


def _mixed_unit_findings(units: tuple[tuple[str, float], ...]) -> list[Finding]:
    if len(units) < 2:
        return []
    text = f"the file mixes units ({', '.join(name for name, _ in units)}); each part was converted from its own"
    return [Finding("unit-mixed", Severity.INFO, text, count=len(units))]


def _no_shape(path: Path) -> Finding:
    names = [name.decode("utf-8", "replace") for name in _EXTERNAL.findall(path.read_bytes())]
    if not names:
        return Finding("file-no-shape", Severity.LOST, "the file describes no shape; export the part itself")
    listed = ", ".join(names[:3]) + (", ..." if len(names) > 3 else "")
    text = f"the file describes no shape, it only points at other files ({listed}); read those"
    return Finding("file-no-shape", Severity.LOST, text, count=len(names))
