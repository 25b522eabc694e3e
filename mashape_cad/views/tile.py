"""The outline of a profile as a small PNG, in about a millisecond: what programs show in the rows of a list.

Large pictures are drawn by `mashape_cad.views.raster`; loading its library takes longer than a whole search.
"""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

from mashape_cad.library.record import ProfileRecord
from mashape_cad.views.colours import PAPER
from mashape_cad.views.drawing import Floats, Placement
from mashape_cad.views.likeness import Likeness

__all__ = ["LARGEST", "SMALLEST", "tile_png"]

SMALLEST, LARGEST = 16, 1024
# Each dot is the mean of so many by so many: steps of a slanting line no longer show. More costs time, squared.
_FINER = 4
_MARGIN = 0.05  # of the side, left free around the outline
_LINE = 1  # width of the line along the outline, dots for each hundred of the side, at least one
_BLUE = "8fb4dc"  # of the material: what stands out on a light and on a dark list alike

Mask = NDArray[np.bool_]


def tile_png(record: ProfileRecord, side: int) -> bytes:
    """Draw the outline of a profile, holes left out, on a transparent square.

    Parameters
    ----------
    record : ProfileRecord
        Drawn from its light picture.
    side : int
        Width and height, dots, from `SMALLEST` to `LARGEST`.

    Raises
    ------
    ValueError
        If the side is outside that range.
    """
    if not SMALLEST <= side <= LARGEST:
        raise ValueError(f"a picture is {SMALLEST} to {LARGEST} dots wide, not {side}")
    material = _filled(Likeness.of_record(record), side * _FINER)
    line = material & ~_shrunk(material, _FINER * max(1, _LINE * side // 100))
    return _png(_coloured(_share(material), _share(line)))


def _filled(likeness: Likeness, side: int) -> Mask:
    """Return which points of a fine grid lie inside: an odd number of edges crosses the row to the right of each."""
    margin = side * _MARGIN
    placement = Placement.fitting(likeness.bounds, margin, margin, side - 2 * margin, side - 2 * margin)
    crossings = np.zeros((side, side + 1), np.uint8)
    for loop in likeness.loops:
        _count_crossings(crossings, placement.apply(loop))
    return np.cumsum(crossings, axis=1, dtype=np.uint8)[:, :side] % 2 == 1


def _count_crossings(crossings: NDArray[np.uint8], ring: Floats) -> None:
    """Add one, in each row, at the first point to the right of each place where an edge of the ring crosses it."""
    side = len(crossings)
    start, end = ring, np.roll(ring, -1, axis=0)
    rows = np.arange(side) + 0.5
    # Half open, so that a corner that lies on a row counts once.
    edge, row = np.nonzero((start[:, 1, None] <= rows) != (end[:, 1, None] <= rows))
    share = (rows[row] - start[edge, 1]) / (end[edge, 1] - start[edge, 1])
    x = start[edge, 0] + share * (end[edge, 0] - start[edge, 0])
    column = np.clip(np.ceil(x - 0.5), 0, side).astype(np.intp)
    np.add.at(crossings, (row, column), 1)


def _shrunk(mask: Mask, width: int) -> Mask:
    """Return what is left of a mask without its outermost `width` points, counted along rows and columns."""
    padded = np.pad(mask, width)
    kept = mask.copy()
    rows, columns = mask.shape
    for across, down in ((0, width), (2 * width, width), (width, 0), (width, 2 * width)):
        kept &= padded[down : down + rows, across : across + columns]
    return kept


def _share(mask: Mask) -> Floats:
    """Return how much of each dot is covered, from 0 to 1."""
    counts = mask.view(np.uint8)
    in_rows = sum(counts[:, k::_FINER] for k in range(1, _FINER)) + counts[:, ::_FINER]
    return (sum(in_rows[k::_FINER] for k in range(1, _FINER)) + in_rows[::_FINER]) / _FINER**2


def _coloured(material: Floats, line: Floats) -> NDArray[np.uint8]:
    """Return red, green, blue and opacity of each dot, from 0 to 255."""
    fill, ink = (np.frombuffer(bytes.fromhex(colour), np.uint8) for colour in (_BLUE, PAPER.ink.removeprefix("#")))
    inked = np.divide(line, material, out=np.zeros_like(line), where=material > 0)[..., None]
    colours = fill + inked * (ink.astype(float) - fill)
    return np.rint(np.concatenate([colours, 255 * material[..., None]], axis=2)).astype(np.uint8)


def _png(dots: NDArray[np.uint8]) -> bytes:
    """Pack dots (height, width, 4) as the PNG specification says: header, rows without filter, end."""
    height, width, _ = dots.shape
    rows = np.zeros((height, 1 + 4 * width), np.uint8)
    rows[:, 1:] = dots.reshape(height, -1)
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes(), 6)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, content) for kind, content in chunks)


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
