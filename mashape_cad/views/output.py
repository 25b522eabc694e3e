"""Where a picture goes: which suffixes are known, and writing it."""

from collections.abc import Sequence
from pathlib import Path

from mashape_cad.errors import MashapeError
from mashape_cad.library.replacing import replace_file

__all__ = ["PictureError", "checked_suffix", "folder_for", "write"]


class PictureError(MashapeError):
    """A picture cannot be written: its suffix is not known, or its folder does not take it."""


def checked_suffix(out: Path, suffixes: Sequence[str]) -> str:
    """Return the suffix of `out` in small letters.

    Raises
    ------
    PictureError
        If it is none of `suffixes`.
    """
    suffix = out.suffix.lower()
    if suffix not in suffixes:
        known = " or ".join([", ".join(suffixes[:-1]), suffixes[-1]] if len(suffixes) > 1 else suffixes)
        raise PictureError(f"cannot draw {out.name}: name the picture with {known} at its end")
    return suffix


def write(out: Path, content: bytes) -> None:
    """Write a picture, whole or not at all.

    Raises
    ------
    PictureError
        If the system refuses.
    """
    try:
        replace_file(out, content)
    except OSError as error:
        reason = error.strerror or error
        raise PictureError(f"cannot write {out}: {reason}; choose a folder that exists and is writable") from error


def folder_for(folder: Path) -> None:
    """Make a folder for pictures, unless there is one.

    Raises
    ------
    PictureError
        If the system refuses.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise PictureError(f"cannot make {folder}: {error.strerror or error}; choose another folder") from error
