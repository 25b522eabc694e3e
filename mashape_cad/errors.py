"""One exception class per cause. An exception ends *this part*; a `Finding` says "done, but look".

Every message is one line that says what is wrong and, after a semicolon or dash, what to do about it.
"""

from pathlib import Path

__all__ = [
    "AxisError",
    "InvalidProfileError",
    "KernelUnavailableError",
    "LibraryError",
    "MashapeError",
    "NoProfileError",
    "QueryError",
    "SidecarError",
    "UnreadableFileError",
]


class MashapeError(Exception):
    """Base of all errors that this package raises on purpose."""


class KernelUnavailableError(MashapeError):
    """The geometry kernel (OCP) cannot be imported; the message names the remedy."""


class UnreadableFileError(MashapeError):
    """A part file cannot be read at all: missing, no permission, wrong format, truncated."""


class NoProfileError(MashapeError):
    """A readable file holds no closed planar profile."""


class InvalidProfileError(MashapeError):
    """A profile that bounds no domain: it crosses or touches itself, or degenerates.

    Parameters
    ----------
    kind : str
        What is wrong, from a closed list: ``crossing``, ``touching``, ``zero-length``, ``open``,
        ``hole-outside``, ``cusp``, ``degenerate``.
    text : str
        The message.
    place : tuple of float, optional
        Where, in the profile's coordinates, mm.
    """

    def __init__(self, kind: str, text: str, place: tuple[float, float] | None = None) -> None:
        super().__init__(text)
        self.kind = kind
        self.place = place


class AxisError(MashapeError):
    """The medial axis of a valid profile could not be completed; it is never returned half done."""

    def __init__(self, text: str, place: tuple[float, float] | None = None) -> None:
        super().__init__(text)
        self.place = place


class SidecarError(MashapeError):
    """A sidecar cannot be read, written, or is of a version that this release does not know."""


class LibraryError(MashapeError):
    """A folder holds no usable sidecars, or sidecars that cannot be compared with one another.

    Parameters
    ----------
    text : str
        The message.
    scan : tuple of Path
        The folders that a scan would mend; empty if none would.
    """

    def __init__(self, text: str, scan: tuple[Path, ...] = ()) -> None:
        super().__init__(text)
        self.scan = scan


class QueryError(MashapeError):
    """A query names a profile that is not there, or has none that can be compared."""
