"""A scanned folder whose parts have classes: what is evaluated."""

import re
from dataclasses import dataclass
from pathlib import Path

from mashape_cad.errors import LibraryError
from mashape_cad.evaluation.classes import class_of
from mashape_cad.library.folders import part_files
from mashape_cad.library.library import Library
from mashape_cad.library.record import ProfileRecord, Sidecar, Source
from mashape_cad.library.selection import comparable
from mashape_cad.options import PartOptions

__all__ = ["LabelledSet", "Shape", "labelled_set"]


@dataclass(frozen=True, slots=True)
class Shape:
    """One part of a set, by the profile that stands for it.

    Attributes
    ----------
    path : Path
    label : str
        Its class.
    source : Source
        The file's state when it was scanned.
    profile : int
        Number of the first profile that can be compared.
    record : ProfileRecord
        What is known of that profile.
    """

    path: Path
    label: str
    source: Source
    profile: int
    record: ProfileRecord


@dataclass(frozen=True, slots=True)
class LabelledSet:
    """All parts of a folder that can be compared, class by class.

    Attributes
    ----------
    folder : Path
    options : PartOptions
        What shaped their signatures.
    shapes : tuple of Shape
        By class, then by name, numbers in names by their value.
    left_out : tuple of Path
        Part files without a profile that can be compared.
    """

    folder: Path
    options: PartOptions
    shapes: tuple[Shape, ...]
    left_out: tuple[Path, ...]

    @property
    def labels(self) -> tuple[str, ...]:
        """The class of each shape."""
        return tuple(shape.label for shape in self.shapes)


def labelled_set(folder: Path) -> LabelledSet:
    """Return the set in a scanned folder.

    Raises
    ------
    LibraryError
        If the folder was not scanned, or no class has two members.
    """
    library = Library(folder)
    shapes = [_shape(path, class_of(path, folder), sidecar) for path, sidecar in library.parts]
    shapes.sort(key=lambda shape: (_natural(shape.label), _natural(shape.path.relative_to(folder).as_posix())))
    labels = [shape.label for shape in shapes]
    if len(set(labels)) == len(labels):
        raise LibraryError(
            f"{folder}: no class has two members; give each class a sub-folder, or name files bird-1, bird-2"
        )
    known = {shape.path for shape in shapes}
    left_out = tuple(path for path in part_files(folder, lambda *_: None) if path not in known)
    return LabelledSet(folder, library.options, tuple(shapes), left_out)


def _shape(path: Path, label: str, sidecar: Sidecar) -> Shape:
    number = comparable(sidecar.profiles, None, str(path))
    return Shape(path, label, sidecar.source, number, sidecar.profiles[number])


def _natural(name: str) -> list[tuple[bool, int, str]]:
    """Return a key that puts bird-9 before bird-10."""
    return [(not each.isdigit(), int(each) if each.isdigit() else 0, each) for each in re.split(r"(\d+)", name)]
