"""What a plug-in searches with, as a `Query` of the library.

Importing this module loads the kernel.
"""

import tempfile
from pathlib import Path

from mashape_cad.errors import MashapeError, QueryError
from mashape_cad.library.derivation import profile_record, read_part
from mashape_cad.library.library import Library, Query
from mashape_cad.library.selection import numbered
from mashape_cad.options import PartOptions
from mashape_cad.serving.protocol import QuerySource

__all__ = ["query_of"]

_LABEL = "the query"


def query_of(source: QuerySource, profile: int | None, library: Library) -> Query:
    """Return the profile to search with: the one asked for, else the first that can be compared.

    Raises
    ------
    MashapeError
        If there is none.
    """
    if source.file is not None:
        return library.query(Path(source.file), profile)
    if source.brep is not None:
        return _of_text(source.brep, ".brep", profile, library.options)
    return _of_text(source.dxf or "", ".dxf", profile, library.options)


def _of_text(text: str, suffix: str, number: int | None, options: PartOptions) -> Query:
    """Read a text as the file that it would be; both readers want a file, which is gone when this returns."""
    with tempfile.TemporaryDirectory(prefix="mashape-", ignore_cleanup_errors=True) as folder:
        path = Path(folder, f"query{suffix}")
        path.write_text(text, encoding="utf-8", newline="")
        try:
            part = read_part(path, options.read)
        except MashapeError as error:
            raise type(error)(str(error).replace(str(path), _LABEL)) from error
    reasons = []
    for each in range(len(part.profiles)) if number is None else [number]:
        chosen = numbered(part.profiles, each, _LABEL)
        record = profile_record(chosen, options.signature)
        if record.vectors:
            return Query(record, profile=each, thing=chosen)
        reasons.append(record.refused.text if record.refused else "it has no signature")
    raise QueryError(f"{_LABEL} cannot be compared: {reasons[0]}")
