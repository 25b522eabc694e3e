"""One sidecar on disk: where it lies, written whole or not at all, read or refused.

The format is described in ``docs/sidecar.md``; the values in it are those of `mashape_cad.library.record`.
"""

from pathlib import Path
from typing import Any

import msgspec

from mashape_cad.errors import SidecarError
from mashape_cad.library.json_text import json_text
from mashape_cad.library.record import Sidecar
from mashape_cad.library.replacing import replace_file

__all__ = [
    "FORMAT_VERSION",
    "SUFFIX",
    "UnknownVersionError",
    "decode",
    "encode",
    "read_sidecar",
    "schema",
    "sidecar_path",
    "write_sidecar",
]

SUFFIX = ".mashape.json"
FORMAT = "mashape-sidecar"
FORMAT_VERSION = 1


class UnknownVersionError(SidecarError):
    """A sidecar of a format version that this release does not know.

    Parameters
    ----------
    label : str
        Which sidecar.
    found : int
        The version that it states.
    """

    def __init__(self, label: str, found: int) -> None:
        remedy = "install a newer mashape-cad" if found > FORMAT_VERSION else "run mashape-cad scan again"
        super().__init__(f"{label}: format version {found}, this release knows version {FORMAT_VERSION}; {remedy}")
        self.is_newer = found > FORMAT_VERSION


class _Head(msgspec.Struct):
    format: str = ""
    version: int = 0


def sidecar_path(part: Path) -> Path:
    """Return where the sidecar of a part file lies."""
    return part.with_name(part.name + SUFFIX)


def encode(sidecar: Sidecar) -> bytes:
    """Return the bytes of a sidecar: same value, same bytes, on every system."""
    document = {"format": FORMAT, "version": FORMAT_VERSION, **msgspec.to_builtins(sidecar)}
    return json_text(document)


def decode(content: bytes, label: str = "sidecar") -> Sidecar:
    """Return what the bytes of a sidecar say.

    Parameters
    ----------
    content : bytes
    label : str
        What messages call it: its path, if it has one.

    Raises
    ------
    UnknownVersionError
        If it is of another version of the format.
    SidecarError
        If it is no sidecar at all.
    """
    try:
        head = msgspec.json.decode(content, type=_Head)
        if head.format != FORMAT:
            raise SidecarError(f"{label}: not a sidecar, its format is {head.format!r}; delete it and scan again")
        if head.version != FORMAT_VERSION:
            raise UnknownVersionError(label, head.version)
        return msgspec.json.decode(content, type=Sidecar)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise SidecarError(f"{label}: broken sidecar ({error}); delete it and scan again") from error


def read_sidecar(path: Path) -> Sidecar:
    """Read the sidecar at `path`.

    Raises
    ------
    UnknownVersionError
        If it is of another version of the format.
    SidecarError
        If it cannot be opened, or is no sidecar.
    """
    try:
        return decode(path.read_bytes(), label=str(path))
    except OSError as error:
        raise SidecarError(f"{path}: cannot be read ({error.strerror or error}); allow it and scan again") from error


def write_sidecar(path: Path, sidecar: Sidecar) -> None:
    """Write a sidecar to `path`, replacing what is there; a reader sees the old one or the new one, whole.

    Raises
    ------
    SidecarError
        If the folder cannot be written to.
    """
    try:
        replace_file(path, encode(sidecar))
    except OSError as error:
        reason = error.strerror or error
        raise SidecarError(f"cannot write {path}: {reason}; make the folder writable and scan again") from error


def schema() -> dict[str, Any]:
    """Return the JSON schema of the format, as it lies in ``sidecar.schema.json`` beside this module."""
    _, parts = msgspec.json.schema_components([Sidecar], ref_template="#/$defs/{name}")
    for part in parts.values():
        if "description" in part:
            part["description"] = part["description"].partition("\n")[0]
    document = dict(parts.pop("Sidecar"))
    head = {"format": {"const": FORMAT}, "version": {"const": FORMAT_VERSION}}
    document["properties"] = head | document["properties"]
    document["required"] = [*head, *document["required"]]
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **document, "$defs": parts}
