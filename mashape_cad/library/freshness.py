"""Whether what a sidecar says of its part still holds: new, changed, unchanged.

A part is unchanged if signature and options are the same and its content is: same name, size and mtime, or else same
hash. That holds for files that failed as well, so that a hopeless file is not tried at every scan.
"""

import hashlib
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from mashape_cad.errors import SidecarError, UnreadableFileError
from mashape_cad.library.json_text import valid_text
from mashape_cad.library.record import CURRENT_SHAPE, CURRENT_SIGNATURE, Sidecar, Source
from mashape_cad.library.sidecar import UnknownVersionError, read_sidecar, sidecar_path
from mashape_cad.options import PartOptions

__all__ = ["Freshness", "Status", "freshness", "source_of"]


class Status(StrEnum):
    """What a scan says of a part file."""

    NEW = "new"
    CHANGED = "changed"
    UNCHANGED = "unchanged"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class Freshness:
    """What is known of a part before it is read.

    Attributes
    ----------
    status : Status
        `NEW`, `CHANGED` or `UNCHANGED`.
    sidecar : Sidecar or None
        What still holds, if unchanged, with its `source` brought up to date.
    is_moved : bool
        Whether only name or mtime differ from the sidecar on disk: then writing it again saves the next scan a hash.
    """

    status: Status
    sidecar: Sidecar | None = None
    is_moved: bool = False


def source_of(part: Path) -> Source:
    """Return name, size, time and hash of a part file; the hash is None if it may not be opened.

    Raises
    ------
    UnreadableFileError
        If there is no such file.
    """
    try:
        # Before the content: a change while we read is then seen as a newer mtime by the next scan.
        status = part.stat()
    except OSError as error:
        raise UnreadableFileError(f"{part}: {error.strerror or error}; check the path") from error
    return Source(valid_text(part.name), status.st_size, status.st_mtime_ns, _hash(part))


def freshness(part: Path, options: PartOptions) -> Freshness:
    """Compare a part file with its sidecar.

    Raises
    ------
    UnknownVersionError
        If the sidecar was written by a newer release: it is not ours to replace.
    UnreadableFileError
        If the part has vanished.
    """
    try:
        sidecar = read_sidecar(sidecar_path(part))
    except UnknownVersionError as error:
        if error.is_newer:
            raise
        return Freshness(Status.CHANGED)
    except SidecarError:
        return Freshness(Status.CHANGED if sidecar_path(part).exists() else Status.NEW)
    if (sidecar.signature, sidecar.shape_signature, sidecar.options) != (CURRENT_SIGNATURE, CURRENT_SHAPE, options):
        return Freshness(Status.CHANGED)
    return _compared(part, sidecar)


def _compared(part: Path, sidecar: Sidecar) -> Freshness:
    kept = sidecar.source
    looks_the_same = kept.blake2b is not None and _without_hash(part, kept) == kept
    source = kept if looks_the_same else source_of(part)
    if source.blake2b != kept.blake2b:
        return Freshness(Status.CHANGED)
    return Freshness(Status.UNCHANGED, replace(sidecar, source=source), is_moved=source != kept)


def _without_hash(part: Path, kept: Source) -> Source:
    try:
        status = part.stat()
    except OSError as error:
        raise UnreadableFileError(f"{part}: {error.strerror or error}; check the path") from error
    return Source(valid_text(part.name), status.st_size, status.st_mtime_ns, kept.blake2b)


def _hash(part: Path) -> str | None:
    try:
        with part.open("rb") as stream:
            return hashlib.file_digest(stream, lambda: hashlib.blake2b(digest_size=32)).hexdigest()
    except OSError:
        return None
