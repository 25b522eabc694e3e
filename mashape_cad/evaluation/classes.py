"""Which class a file of a labelled folder belongs to."""

import re
from pathlib import Path

__all__ = ["class_of"]

_NUMBERED = re.compile(r"(?P<prefix>.*?)[-_ .]*\d+")
_SEPARATED = re.compile(r"(?P<prefix>.+)[-_ .][^-_ .]+")


def class_of(path: Path, folder: Path) -> str:
    """Return the class of a file: the sub-folder of `folder` that it lies in, else what its name begins with.

    Parameters
    ----------
    path : Path
        Below `folder`, at any depth.
    folder : Path

    Returns
    -------
    str
        ``bird`` for ``bird/robin.dxf``, ``bird-10.dxf``, ``bird 3.step`` and ``bird_robin.dxf``; a name without number
        and separator is a class of its own.
    """
    first, *deeper = path.relative_to(folder).parts
    if deeper:
        return first
    for pattern in (_NUMBERED, _SEPARATED):
        found = pattern.fullmatch(path.stem)
        if found and found["prefix"]:
            return found["prefix"]
    return path.stem
