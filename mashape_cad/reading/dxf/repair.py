"""Repairs of a DXF file's text, for files that ezdxf neither reads nor recovers, or recovers wrongly.

A text DXF file is a list of pairs of lines: a group code and a value. Two faults are mended on these pairs: decimal
commas, of which a recovering reader keeps only the digits before the comma, and missing subclass markers, without
which the entities of newer versions have no attributes.

References
----------
AutoCAD DXF Reference, "Group Codes in Numerical Order", "Subclass Markers".
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

__all__ = ["Marked", "with_decimal_points", "with_subclass_markers"]

Pair = tuple[bytes, bytes]

_DECIMAL_COMMA = re.compile(rb"^\s*[-+]?\d+,\d+(?:[eE][-+]?\d+)?\s*$")
# Group codes that hold floating point numbers: 10-59, 110-149, 210-239, 460-469, 1010-1059.
_FLOAT_CODES = frozenset((*range(10, 60), *range(110, 150), *range(210, 240), *range(460, 470), *range(1010, 1060)))
# Group codes that any entity may have before those of its own class.
_COMMON_CODES = frozenset(
    (b"6", b"8", b"48", b"60", b"62", b"67", b"92", b"284", b"310", b"347", b"370", b"410", b"420")
)
# Group codes that name an entity and its owners.
_NAME_CODES = frozenset((b"0", b"5", b"102", b"330", b"360"))

# The classes of each kind of record, base first.
_MARKERS: dict[bytes, tuple[bytes, ...]] = {
    b"ARC": (b"AcDbEntity", b"AcDbCircle", b"AcDbArc"),
    b"BLOCK": (b"AcDbEntity", b"AcDbBlockBegin"),
    b"CIRCLE": (b"AcDbEntity", b"AcDbCircle"),
    b"ELLIPSE": (b"AcDbEntity", b"AcDbEllipse"),
    b"ENDBLK": (b"AcDbEntity", b"AcDbBlockEnd"),
    b"INSERT": (b"AcDbEntity", b"AcDbBlockReference"),
    b"LAYER": (b"AcDbSymbolTableRecord", b"AcDbLayerTableRecord"),
    b"LINE": (b"AcDbEntity", b"AcDbLine"),
    b"LWPOLYLINE": (b"AcDbEntity", b"AcDbPolyline"),
    b"POINT": (b"AcDbEntity", b"AcDbPoint"),
    b"POLYLINE": (b"AcDbEntity", b"AcDb2dPolyline"),
    b"SEQEND": (b"AcDbEntity",),
    b"SPLINE": (b"AcDbEntity", b"AcDbSpline"),
    b"VERTEX": (b"AcDbEntity", b"AcDbVertex", b"AcDb2dVertex"),
}
# Of an arc, the angles belong to the class after that of the circle; else all attributes belong to the last class.
_ANGLE_CODES = frozenset((b"50", b"51"))
# Records that have no classes.
_STRUCTURE = frozenset((b"SECTION", b"ENDSEC", b"TABLE", b"ENDTAB"))
_OLDEST_WITH_MARKERS = b"AC1012"


def with_decimal_points(data: bytes) -> tuple[bytes, int]:
    """Replace decimal commas in coordinates.

    Parameters
    ----------
    data : bytes
        A text DXF file.

    Returns
    -------
    data : bytes
    count : int
        How many values were changed.
    """
    count = 0
    lines = []
    for code, value in _pairs(data):
        changed = value.replace(b",", b".") if _is_float(code) and _DECIMAL_COMMA.match(value) else value
        count += changed != value
        lines += [code, changed]
    return b"\n".join(lines) + b"\n", count


@dataclass(frozen=True, slots=True)
class Marked:
    """A DXF file with subclass markers.

    Attributes
    ----------
    data : bytes
    mended : int
        How many records got markers.
    left_out : int
        How many were left out, since their classes are not known here.
    is_newer : bool
        Whether the header now names a version that has markers, and did not before.
    """

    data: bytes
    mended: int
    left_out: int
    is_newer: bool = False


def with_subclass_markers(data: bytes) -> Marked:
    """Add the subclass markers that entities of R13 and later need; sections that hold no geometry are left out.

    Parameters
    ----------
    data : bytes
        A text DXF file.
    """
    before = [record for section in _sections(_pairs(data)) for record in _with_geometry(section)]
    after = [_marked(_with_newer_version(record)) for record in before]
    pairs = [*(pair for record in after for pair in record), (b"0", b"EOF")]
    text = b"\n".join(line for pair in pairs for line in pair) + b"\n"
    return Marked(
        data=text,
        mended=sum(1 for old, new in zip(before, after, strict=True) if len(new) > len(old)),
        left_out=sum(1 for record in after if not record),
        is_newer=any(_with_newer_version(record) != record for record in before),
    )


def _pairs(data: bytes) -> Iterator[Pair]:
    lines = data.splitlines()
    return ((code.strip(), value.strip()) for code, value in zip(lines[::2], lines[1::2], strict=False))


def _is_float(code: bytes) -> bool:
    return code.isdigit() and int(code) in _FLOAT_CODES


def _records(pairs: Iterator[Pair]) -> Iterator[list[Pair]]:
    """Group pairs by entities and other things that begin with group code 0."""
    record: list[Pair] = []
    for pair in pairs:
        if pair[0] == b"0" and record:
            yield record
            record = []
        record.append(pair)
    if record:
        yield record


def _sections(pairs: Iterator[Pair]) -> Iterator[list[list[Pair]]]:
    """Group records by sections, from SECTION to ENDSEC; what stands between sections is left out."""
    section: list[list[Pair]] = []
    for record in _records(pairs):
        if record[0] == (b"0", b"SECTION"):
            section = []
        section.append(record)
        if record[0] == (b"0", b"ENDSEC") and section[0][0] == (b"0", b"SECTION"):
            yield section
            section = []


def _with_geometry(section: list[list[Pair]]) -> list[list[Pair]]:
    """Return what matters of a section: variables, layers, blocks, entities."""
    start, *records, end = section
    name = next((value for code, value in start if code == b"2"), b"")
    if name == b"TABLES":
        return [start, *_layer_table(records), end]
    return section if name in {b"HEADER", b"BLOCKS", b"ENTITIES"} else []


def _with_newer_version(record: list[Pair]) -> list[Pair]:
    """Let a version that has markers stand in the header, if this is the header."""
    before = [(b"", b""), *record]
    return [
        (code, max(value, _OLDEST_WITH_MARKERS)) if name == (b"9", b"$ACADVER") else (code, value)
        for name, (code, value) in zip(before, record, strict=False)
    ]


def _layer_table(tables: list[list[Pair]]) -> list[list[Pair]]:
    """Keep only the table that says which layers are hidden."""
    layers = [record for record in tables if record[0][1] == b"LAYER"]
    return [[(b"0", b"TABLE"), (b"2", b"LAYER")], *layers, [(b"0", b"ENDTAB")]]


def _marked(record: list[Pair]) -> list[Pair]:
    """Sort the pairs of a record into its classes, each under its marker; empty if its classes are not known."""
    kind = record[0][1]
    if kind in _STRUCTURE or any(code == b"100" for code, _ in record):
        return record
    if kind not in _MARKERS:
        return []
    base, *classes = _MARKERS[kind]
    named = [pair for pair in record if pair[0] in _NAME_CODES]
    rest = [pair for pair in record if pair[0] not in _NAME_CODES]
    common = [pair for pair in rest if pair[0] in _COMMON_CODES and kind != b"LAYER"]
    own = [pair for pair in rest if pair[0] not in _COMMON_CODES or kind == b"LAYER"]
    last = [pair for pair in own if kind != b"ARC" or pair[0] in _ANGLE_CODES]
    inherited = [pair for pair in own if kind == b"ARC" and pair[0] not in _ANGLE_CODES]
    marked = [*named, (b"100", base), *common]
    for marker in classes[:-1]:
        marked += [(b"100", marker), *inherited]
    return [*marked, *((b"100", marker) for marker in classes[-1:]), *last]
