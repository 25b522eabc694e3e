"""One door to all readers: `read` takes a part file of any known format, or a kernel object."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mashape_cad.errors import UnreadableFileError
from mashape_cad.options import ReadOptions
from mashape_cad.reading.content import foreign_content
from mashape_cad.reading.part import Part

__all__ = ["read"]

_FORMATS = {".dxf": "dxf", ".step": "step", ".stp": "step", ".brep": "brep", ".brp": "brep"}
_HEAD = 1024

Reader = Callable[[Path, ReadOptions], Part]


def read(source: str | os.PathLike[str] | Any, options: ReadOptions | None = None) -> Part:
    """Read the profiles of a part.

    Parameters
    ----------
    source : path or object
        A file whose name ends in .dxf, .step, .stp, .brep or .brp, in upper or lower case; or a face, wire, sketch or
        solid of CadQuery or build123d, or a bare kernel shape.
    options : ReadOptions, optional

    Returns
    -------
    Part
        Possibly without profiles; then its findings say why.

    Raises
    ------
    UnreadableFileError
        If there is no such file, it may not be read, is not what its name says, or is damaged beyond repair; if an
        object is none of those above.
    KernelUnavailableError
        If the geometry kernel is needed and cannot be imported.
    """
    options = options or ReadOptions()
    if not isinstance(source, str | os.PathLike):
        # Kernel and ezdxf are heavy: each is imported only for what needs it.
        from mashape_cad.reading.objects import read_object  # noqa: PLC0415

        return read_object(source, options)
    path = Path(source)
    try:
        kind = _checked_format(path)
        return _reader(kind)(path, options)
    except UnreadableFileError as error:
        raise UnreadableFileError(f"{path}: {error}") from error
    except OSError as error:
        reason = error.strerror or str(error)
        raise UnreadableFileError(f"{path}: cannot be opened ({reason}); check the path and its permissions") from error


def _checked_format(path: Path) -> str:
    """Return the format that the name says, if nothing speaks against it."""
    if path.is_dir():
        raise UnreadableFileError("is a folder; give one of its files, or scan the folder")
    if not path.exists():
        raise UnreadableFileError("no such file; check the path")
    kind = _FORMATS.get(path.suffix.lower())
    if kind is None:
        raise UnreadableFileError(f"unknown kind of file {path.suffix!r}; known are {', '.join(_FORMATS)}")
    with path.open("rb") as file:
        head = file.read(_HEAD)
    if not head.strip():
        raise UnreadableFileError("the file is empty; export or copy it again")
    foreign = foreign_content(head, kind)
    if foreign is not None:
        raise UnreadableFileError(f"is really {foreign}; export the part as one of {', '.join(_FORMATS)}")
    return kind


def _reader(kind: str) -> Reader:
    if kind == "dxf":
        from mashape_cad.reading.dxf import read_dxf  # noqa: PLC0415

        return read_dxf
    from mashape_cad.reading import step  # noqa: PLC0415

    return step.read_step if kind == "step" else step.read_brep
