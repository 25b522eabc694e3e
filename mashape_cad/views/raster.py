"""A `Drawing` as PNG, by matplotlib: loaded only when a PNG is asked for, since that takes a good second."""
# ruff: noqa: PLC0415  -- see above

import io
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np

from mashape_cad.views.drawing import Anchor, Area, Circle, Difference, Drawing, Floats, Label, Lines, Shape, printable

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.patches import Patch
    from matplotlib.path import Path

__all__ = ["png"]

# matplotlib measures widths and fonts in points, 1/72 inch, and we in pixels; 100 pixels to the inch is as good as any.
_PER_INCH = 100.0
_POINTS = 72.0 / _PER_INCH
_ALIGNED: dict[Anchor, Literal["left", "center", "right"]] = {"start": "left", "middle": "center", "end": "right"}


def png(drawing: Drawing, density: float = 2.0) -> bytes:
    """Return a PNG with `density` dots to a pixel of the drawing, so that it is sharp on fine screens too."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(drawing.width / _PER_INCH, drawing.height / _PER_INCH), dpi=_PER_INCH * density)
    figure.patch.set_facecolor(drawing.background or "none")
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, drawing.width), ylim=(drawing.height, 0))
    axes.axis("off")
    for order, artist in enumerate(_artist(shape) for shape in drawing.shapes if _is_visible(shape)):
        artist.set_zorder(order)
        axes.add_artist(artist)
    content = io.BytesIO()
    with warnings.catch_warnings():
        # A name in a script that the font lacks shows as boxes: a pity, but no reason to bother anybody.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure.savefig(content, format="png", metadata={"Title": printable(drawing.title), "Software": None})
    return content.getvalue()


def _is_visible(shape: Shape) -> bool:
    match shape:
        case Area(rings=polylines) | Lines(runs=polylines):
            return bool(polylines)
        case _:
            return True


def _artist(shape: Shape) -> "Artist":
    from matplotlib import patches

    patch: Patch
    match shape:
        case Area():
            path = _closed(_wound(shape.rings, left=True))
            patch = patches.PathPatch(path, facecolor=shape.fill, edgecolor=shape.stroke or "none")
        case Difference():
            path = _closed([*_wound(shape.one, left=True), *_wound(shape.other, left=False)])
            patch = patches.PathPatch(path, facecolor=shape.fill, edgecolor="none", linewidth=0)
            return patch
        case Lines():
            patch = patches.PathPatch(_open(shape.runs), facecolor="none", edgecolor=shape.colour, capstyle="round")
        case Circle():
            fill = "none" if shape.fill == "none" else (shape.fill, shape.opacity)
            patch = patches.Circle((shape.x, shape.y), shape.radius, facecolor=fill, edgecolor=shape.stroke)
        case _:
            return _text(shape)
    patch.set_linewidth(shape.width * _POINTS)
    patch.set_joinstyle("round")
    return patch


def _text(label: Label) -> "Artist":
    from matplotlib.text import Text

    return Text(
        label.x,
        label.y,
        printable(label.text),
        fontsize=label.size * _POINTS,
        color=label.colour,
        horizontalalignment=_ALIGNED[label.anchor],
        verticalalignment="baseline",
        fontweight="bold" if label.bold else "normal",
        parse_math=False,  # a file name may hold dollar signs, which are no formulas
    )


def _closed(rings: Sequence[Floats]) -> "Path":
    """Make one path of rings, which is filled where it winds round."""
    from matplotlib.path import Path

    codes = [[Path.MOVETO, *[Path.LINETO] * (len(ring) - 1), Path.CLOSEPOLY] for ring in rings]
    return Path(np.concatenate([np.concatenate([ring, ring[:1]]) for ring in rings]), np.concatenate(codes))


def _wound(rings: Sequence[Floats], *, left: bool) -> list[Floats]:
    """Turn an outer ring one way and its holes the other, so that a path winds round the material alone.

    Agg fills by winding. Of two profiles, wound in opposite ways, it leaves out what they share.
    """
    outer, *holes = rings
    return [_turned(outer, left=left), *(_turned(hole, left=not left) for hole in holes)]


def _open(runs: tuple[Floats, ...]) -> "Path":
    from matplotlib.path import Path

    codes = [[Path.MOVETO, *[Path.LINETO] * (len(run) - 1)] for run in runs]
    return Path(np.concatenate(runs), np.concatenate(codes))


def _turned(ring: Floats, *, left: bool) -> Floats:
    x, y = ring.T
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    return ring if (area > 0) == left else ring[::-1]
