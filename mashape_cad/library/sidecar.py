"""One sidecar on disk: where it lies, written whole or not at all, read or refused.

The format is described in ``docs/sidecar.md``; the values in it are those of `mashape_cad.library.record`.
"""

import secrets
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import msgspec

from mashape_cad.errors import SidecarError
from mashape_cad.library.record import Sidecar

__all__ = [
    "FORMAT_VERSION",
    "SUFFIX",
    "UnknownVersionError",
    "decode",
    "encode",
    "read_sidecar",
    "schema",
    "sidecar_path",
    "valid_text",
    "write_sidecar",
]

SUFFIX = ".mashape.json"
FORMAT = "mashape-sidecar"
FORMAT_VERSION = 1

_PLAIN = (str, int, float, bool, type(None))


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


def valid_text(text: str) -> str:
    """Return a text that can be written as UTF-8: what Python took in as stray bytes becomes a question mark."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")


def encode(sidecar: Sidecar) -> bytes:
    """Return the bytes of a sidecar: same value, same bytes, on every system."""
    document = {"format": FORMAT, "version": FORMAT_VERSION, **msgspec.to_builtins(sidecar)}
    return b"".join(_lines(document, b"\n")) + b"\n"


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
        _replace(path, encode(sidecar))
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


def _replace(path: Path, content: bytes) -> None:
    # In the same folder, because a rename is atomic only within one file system. The name is short, since the
    # sidecar's own may already be as long as the file system allows, and hidden, so that no scan looks at it.
    temporary = path.with_name(f".mashape-{secrets.token_hex(6)}.tmp")
    try:
        temporary.write_bytes(content)
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _lines(value: Any, newline: bytes) -> Iterator[bytes]:
    """Yield the text of a value, indented by one space a level; `newline` is a line's end and the indent so far."""
    if _is_flat(value):
        yield _json(value)
    elif isinstance(value, Mapping):
        yield from _block(value.items(), newline, b"{}", lambda item: msgspec.json.encode(item[0]) + b": ")
    else:
        yield from _block([(None, each) for each in value], newline, b"[]", lambda _: b"")


def _block(items: Any, newline: bytes, brackets: bytes, label: Any) -> Iterator[bytes]:
    deeper = newline + b" "
    yield brackets[:1]
    for number, item in enumerate(items):
        yield (b"," if number else b"") + deeper + label(item)
        yield from _lines(item[1], deeper)
    yield newline + brackets[1:]


def _json(value: Any) -> bytes:
    try:
        return msgspec.json.encode(value)
    except UnicodeEncodeError:  # bytes that were no text, in a layer's name say
        return msgspec.json.encode(_valid(value))


def _valid(value: Any) -> Any:
    if isinstance(value, str):
        return valid_text(value)
    if isinstance(value, Mapping):
        return {name: _valid(member) for name, member in value.items()}
    return [_valid(member) for member in value] if isinstance(value, list | tuple) else value


def _is_flat(value: Any) -> bool:
    if isinstance(value, _PLAIN):
        return True
    members = value.values() if isinstance(value, Mapping) else value
    return all(isinstance(member, _PLAIN) for member in members)
