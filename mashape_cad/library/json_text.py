"""JSON that people can read too: what holds only plain values stands on one line."""

from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

__all__ = ["json_text", "valid_text"]

_PLAIN = (str, int, float, bool, type(None))


def valid_text(text: str) -> str:
    """Return a text that can be written as UTF-8: what Python took in as stray bytes becomes a question mark."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")


def json_text(document: Any) -> bytes:
    """Return a document of plain values, lists and mappings as UTF-8, indented by one space a level."""
    return b"".join(_lines(document, b"\n")) + b"\n"


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
