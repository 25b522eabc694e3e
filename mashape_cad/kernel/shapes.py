"""Kernel shapes, opaque outside this package: out of files by `read_step` and `read_brep`, told by `is_shape`."""

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from OCP.BinTools import BinTools
from OCP.BRep import BRep_Builder
from OCP.BRepTools import BRepTools
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.Message import Message, Message_PrinterOStream
from OCP.STEPConstruct import STEPConstruct_UnitContext
from OCP.STEPControl import STEPControl_Reader
from OCP.TColStd import TColStd_SequenceOfAsciiString
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS_Compound, TopoDS_Shape

from mashape_cad.kernel.failures import ShapeError, kernel_failures_told

__all__ = ["Shape", "StepContent", "has_faces", "is_shape", "read_brep", "read_step", "together"]

Shape = Any  # a kernel shape; nobody outside this package looks into it

# How a text file ends: the end of the list of shapes, and which of them is the whole. Asked before the kernel is, which
# reads on for ever in some files that are cut off.
_TEXT_END = re.compile(rb"\*\s+([+-]\d+ \d+\s*)?(0\s*)?$")
_TEXT_END_BYTES = 200
# In the kernel's complaints on entities of a STEP file: what good files are blamed for.
_HARMLESS = ("Count of Parameters", "(name)")


@dataclass(frozen=True, slots=True)
class StepContent:
    """What a STEP file holds.

    Attributes
    ----------
    shape : Shape or None
        In mm; None if the file describes no shape.
    units : tuple of (str, float)
        The length units that the file states, each once: the name, and its length in mm.
    """

    shape: Shape | None
    units: tuple[tuple[str, float], ...]


def read_step(path: Path) -> StepContent:
    """Read a STEP file, converted to mm, all parts of an assembly in their places.

    Raises
    ------
    ShapeError
        If it is no STEP file, or one with damaged geometry.
    """
    with _quiet(), kernel_failures_told():
        return _step_content(path)


def read_brep(path: Path) -> Shape | None:
    """Read a shape in the kernel's own format, text or binary; None if it is the null shape.

    Raises
    ------
    ShapeError
        If it is no such file, or a damaged one.
    """
    content = path.read_bytes()
    is_text = content.lstrip().startswith((b"DBRep_DrawableShape", b"CASCADE Topology"))
    if is_text and not _TEXT_END.search(content[-_TEXT_END_BYTES:]):
        raise ShapeError("it is cut off: the entry for the whole shape at its end is missing")
    shape = TopoDS_Shape()
    with _quiet(), kernel_failures_told():
        done = BRepTools.Read_s(shape, str(path), BRep_Builder()) if is_text else BinTools.Read_s(shape, str(path))
    if not done:
        raise ShapeError("its content breaks the rules of BREP files")
    return None if shape.IsNull() else shape


def is_shape(thing: object) -> bool:
    """Whether something is a kernel shape that holds anything."""
    return isinstance(thing, TopoDS_Shape) and not thing.IsNull()


def has_faces(shape: Shape) -> bool:
    """Whether a shape has any face, flat or curved."""
    return bool(TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE).More())


def together(shapes: Sequence[Shape]) -> Shape:
    """Return one shape that holds others, in their order."""
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    for shape in shapes:
        builder.Add(compound, shape)
    return compound


def _step_content(path: Path) -> StepContent:
    reader = STEPControl_Reader()
    Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")  # another user of the kernel may have changed it
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise ShapeError("its text breaks the rules of STEP files, or ends too early")
    damaged = _damaged_entities(reader)
    if damaged:
        raise ShapeError(f"its geometry is damaged or parts of it are missing, first noticed in {damaged[0]}")
    reader.TransferRoots()
    shape = reader.OneShape()
    return StepContent(None if shape.IsNull() else shape, _units(reader))


def _damaged_entities(reader: STEPControl_Reader) -> list[str]:
    """Return the types of the geometric entities whose parameters are missing or of a wrong kind.

    The kernel would leave faces out without a word, or crash. Complaints on texts, colours, representations, names, and
    on the number of parameters (of stray entities that nobody refers to) are common in good files.
    """
    model, checks = reader.StepModel(), reader.WS().ModelCheckList(False)  # noqa: FBT003  (everything)
    damaged = []
    checks.Start()
    while checks.More():
        check, number = checks.Value(), checks.Number()
        kind = model.Value(number).DynamicType().Name() if number else ""
        is_geometry = kind.startswith(("StepGeom_", "StepShape_")) and not kind.endswith("Representation")
        fails = [check.CFail(index, True) for index in range(1, check.NbFails() + 1)]  # noqa: FBT003  (with names)
        if is_geometry and not all(any(word in fail for word in _HARMLESS) for fail in fails):
            damaged.append(kind.partition("_")[2])
        checks.Next()
    return damaged


def _units(reader: STEPControl_Reader) -> tuple[tuple[str, float], ...]:
    lengths, angles, solid_angles = (TColStd_SequenceOfAsciiString() for _ in range(3))
    reader.FileUnits(lengths, angles, solid_angles)
    names = [lengths.Value(index).ToCString().lower() for index in range(1, lengths.Length() + 1)]
    factors = list(dict.fromkeys(_length_factors(reader)))
    # The kernel gives each unit once, in the order of the file, by name here and by length there.
    return tuple(zip(names, factors, strict=False)) or tuple(("mm", factor) for factor in factors)


def _length_factors(reader: STEPControl_Reader) -> Iterator[float]:
    """Yield the length in mm of the unit of each context in which the file gives lengths."""
    model = reader.StepModel()
    for number in range(1, model.NbEntities() + 1):
        entity = model.Value(number)
        if hasattr(entity, "GlobalUnitAssignedContext"):
            units = STEPConstruct_UnitContext()
            units.ComputeFactors(entity.GlobalUnitAssignedContext())
            if units.LengthDone():
                yield float(units.LengthFactor())


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep the kernel from writing to the terminal: its messengers, and what it writes to file descriptor 1."""
    messenger = Message.DefaultMessenger_s()
    printers = [printer for printer in messenger.Printers() if isinstance(printer, Message_PrinterOStream)]
    for printer in printers:
        messenger.RemovePrinter(printer)
    try:
        with _without_descriptor(1):
            yield
    finally:
        for printer in printers:
            messenger.AddPrinter(printer)


@contextmanager
def _without_descriptor(descriptor: int) -> Iterator[None]:
    try:
        kept = os.dup(descriptor)
    except OSError:  # closed: nothing to keep quiet
        yield
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, descriptor)
        yield
    finally:
        with suppress(OSError):
            os.dup2(kept, descriptor)
        os.close(kept)
        os.close(nowhere)
