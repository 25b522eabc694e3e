"""What plug-ins may ask, as values; `docs/serve.md` describes every field.

A request that has a field unknown here is refused as a whole: what cannot be honoured must not be dropped in silence.
"""

from dataclasses import fields
from typing import Any, TypeVar

import msgspec

from mashape_cad.options import ScanOptions, SearchOptions

__all__ = ["PROTOCOL", "Cancel", "Id", "QuerySource", "Request", "RequestError", "Scan", "Search", "parsed"]

# Raised when a plug-in written for the old number would misunderstand an answer. New fields and kinds of messages do
# not raise it.
PROTOCOL = 1

Id = int | str
Options = TypeVar("Options", SearchOptions, ScanOptions)


class RequestError(ValueError):
    """A line that is no request of this protocol; `id` is the request's, if it could be made out."""

    def __init__(self, text: str, id_: Id | None = None) -> None:
        super().__init__(text)
        self.id = id_


class _Request(msgspec.Struct, frozen=True, kw_only=True, tag_field="request", forbid_unknown_fields=True):
    id: Id


class QuerySource(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What to search with: exactly one of a file's path, the text of a BREP file, the text of a DXF file."""

    file: str | None = None
    brep: str | None = None
    dxf: str | None = None


class Search(_Request, frozen=True, kw_only=True, tag="search"):
    """Rank the parts of scanned folders; `options` are the fields of `SearchOptions`."""

    library: tuple[str, ...]
    query: QuerySource
    profile: int | None = None
    count: int = 10
    options: dict[str, Any] = {}
    thumbnail: int | None = None

    def search_options(self) -> SearchOptions:
        """Return the options, checked."""
        return _checked(self, SearchOptions)


class Scan(_Request, frozen=True, kw_only=True, tag="scan"):
    """Scan folders; `options` are the fields of `ScanOptions`."""

    folders: tuple[str, ...]
    options: dict[str, Any] = {}

    def scan_options(self) -> ScanOptions:
        """Return the options, checked."""
        return _checked(self, ScanOptions)


class Cancel(_Request, frozen=True, kw_only=True, tag="cancel"):
    """Give up the request of this `id`."""


Request = Search | Scan | Cancel


class _OnlyId(msgspec.Struct, frozen=True):
    id: Id | None = None


_DECODER = msgspec.json.Decoder(Request)


def parsed(line: bytes) -> Request:
    """Return the request of one line.

    Raises
    ------
    RequestError
        If it is none.
    """
    try:
        request = _DECODER.decode(line)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise RequestError(f"not a request of protocol {PROTOCOL}: {error}", _id_of(line)) from error
    if isinstance(request, Search):
        _check_search(request)
    return request


def _check_search(request: Search) -> None:
    given = [name for name in QuerySource.__struct_fields__ if getattr(request.query, name) is not None]
    if len(given) != 1:
        raise RequestError(f"a query is one of file, brep and dxf, not {' and '.join(given) or 'none'}", request.id)
    if not request.library:
        raise RequestError("library is empty; name at least one folder", request.id)
    if request.count < 1:
        raise RequestError(f"count must be at least 1, not {request.count}", request.id)


def _checked(request: Search | Scan, kind: type[Options]) -> Options:
    unknown = sorted(set(request.options) - {each.name for each in fields(kind)})
    if unknown:
        raise RequestError(f"options: there is no {' and no '.join(unknown)}", request.id)
    try:
        return msgspec.convert(request.options, kind)
    except msgspec.ValidationError as error:
        raise RequestError(f"options: {error}", request.id) from error


def _id_of(line: bytes) -> Id | None:
    try:
        return msgspec.json.decode(line, type=_OnlyId).id
    except (msgspec.DecodeError, UnicodeDecodeError):
        return None
