"""What a picture is made of: shapes on a canvas of pixels, y downwards. `svg` and `raster` write the same `Drawing`.

A shape knows how it looks and nothing of parts; shapes later in the list lie on top.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Anchor",
    "Area",
    "Circle",
    "Difference",
    "Drawing",
    "Label",
    "Lines",
    "Placement",
    "Shape",
    "dimensions",
    "printable",
    "rectangle",
]

# The same as in `mashape_cad.geometry.edge`, which would load scipy.
Floats = NDArray[np.float64]
Anchor = Literal["start", "middle", "end"]


@dataclass(frozen=True, slots=True, eq=False)
class Area:
    """What lies inside an odd number of `rings`, (n, 2) each; outlined if `stroke` names a colour."""

    rings: tuple[Floats, ...]
    fill: str
    stroke: str | None = None
    width: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Difference:
    """What lies in exactly one of two profiles, each an outer ring, (n, 2), and its holes."""

    one: tuple[Floats, ...]
    other: tuple[Floats, ...]
    fill: str


@dataclass(frozen=True, slots=True, eq=False)
class Lines:
    """Open polylines of one colour, (n, 2) each, with round ends."""

    runs: tuple[Floats, ...]
    colour: str
    width: float


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle, filled with `fill` at `opacity` (0 to 1), outlined by `stroke`."""

    x: float
    y: float
    radius: float
    fill: str
    stroke: str
    width: float
    opacity: float = 1.0


@dataclass(frozen=True, slots=True)
class Label:
    """One line of text; `y` is its base line, `size` the height of its font."""

    x: float
    y: float
    text: str
    size: float
    colour: str
    anchor: Anchor = "start"
    bold: bool = False


Shape = Area | Difference | Lines | Circle | Label


@dataclass(frozen=True, slots=True)
class Drawing:
    """A canvas; `title` is what it is called where it cannot be seen.

    Attributes
    ----------
    width, height : float
        Pixels.
    title : str
    shapes : tuple of Shape
    background : str or None
        None leaves it transparent.
    pixel : float or None
        Size of a pixel, mm, of a drawing in true size; None for pictures, which have none.
    """

    width: float
    height: float
    title: str
    shapes: tuple[Shape, ...]
    background: str | None = None
    pixel: float | None = None


@dataclass(frozen=True, slots=True)
class Placement:
    """Where millimetres come to lie on the canvas: x to the right, y upwards in the part, downwards on the canvas."""

    scale: float
    x: float
    y: float

    @classmethod
    def fitting(cls, bounds: Floats, left: float, top: float, width: float, height: float) -> "Placement":
        """Centre a box ((xmin, ymin), (xmax, ymax)), mm, in a rectangle of the canvas, as large as it gets."""
        (xmin, ymin), (xmax, ymax) = bounds.tolist()
        # A picture of nothing has no size; any scale shows it equally well.
        scale = min(width / max(xmax - xmin, 1e-300), height / max(ymax - ymin, 1e-300), 1e300)
        x = left + width / 2 - scale * (xmin + xmax) / 2
        return cls(scale, x, top + height / 2 + scale * (ymin + ymax) / 2)

    def apply(self, points: Floats) -> Floats:
        """Return where points (n, 2), mm, lie on the canvas."""
        return np.column_stack([self.x + self.scale * points[:, 0], self.y - self.scale * points[:, 1]])


def rectangle(left: float, top: float, width: float, height: float) -> Floats:
    """Return the ring of an upright rectangle."""
    right, bottom = left + width, top + height
    return np.array([(left, top), (right, top), (right, bottom), (left, bottom)])


def dimensions(width: float, height: float) -> str:
    """Return a size to three digits, mm."""
    return f"{_digits(width)} \N{MULTIPLICATION SIGN} {_digits(height)} mm"


def _digits(length: float) -> str:
    return f"{length:.0f}" if length >= 100 else f"{length:#.3g}".rstrip(".")


def printable(text: str, limit: int | None = None) -> str:
    """Return text that any picture can show: no control characters, no half characters, at most `limit` long.

    File names may hold all of these. What is too long loses its middle, since the ends tell files apart.
    """
    shown = "".join(_visible(text))
    if limit is None or len(shown) <= limit:
        return shown
    tail = (limit - 1) // 2
    return f"{shown[: limit - 1 - tail]}…{shown[len(shown) - tail :]}"


def _visible(text: str) -> Iterable[str]:
    for each in text:
        if each.isprintable():
            yield each
        else:
            yield " " if each.isspace() else "\N{REPLACEMENT CHARACTER}"
