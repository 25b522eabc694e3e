"""What a file's first bytes tell: which format it really is, whatever its name says."""

__all__ = ["foreign_content"]

_MARKS = (
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"%PDF", "a PDF document"),
    (b"PK\x03\x04", "a zip archive"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"AC10", "a DWG drawing"),
    (b"ISO-10303-21", "a STEP file"),
    (b"AutoCAD Binary DXF", "a DXF drawing"),
    (b"CASCADE Topology", "a BREP file"),
    (b"DBRep_DrawableShape", "a BREP file"),
    (b"{", "a JSON document"),
    (b"<", "an HTML or XML page"),
)
_OWN = {"dxf": "a DXF drawing", "step": "a STEP file", "brep": "a BREP file"}


def foreign_content(head: bytes, expected: str) -> str | None:
    """Say what a file is, if that is known and not what its name says.

    Parameters
    ----------
    head : bytes
        The beginning of the file.
    expected : str
        ``dxf``, ``step`` or ``brep``.
    """
    start = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    kind = next((kind for mark, kind in _MARKS if start.startswith(mark)), None)
    return None if kind == _OWN[expected] else kind
