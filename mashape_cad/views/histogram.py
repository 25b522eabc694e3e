"""One histogram as a small chart: bins over [0, 1], heights on a square-root scale.

Most histograms of an axis have one tall bin and many low ones; on a straight scale one sees the tall one only.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from mashape_cad.views.colours import Theme
from mashape_cad.views.drawing import Area, Floats, Label, Lines, Shape

__all__ = ["histogram"]

_LEVELS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
_NEAREST = 15.0  # pixels between two lines of the grid, so that their numbers do not touch
_SMALL = 11.0


def histogram(
    heights: Sequence[float], left: float, top: float, width: float, height: float, colours: Sequence[str], theme: Theme
) -> Iterator[Shape]:
    """Yield the shapes of a chart; the rectangle holds its bars, numbers lie outside of it.

    Parameters
    ----------
    heights : sequence of float
        One share for each bin, of a sum of 1.
    left, top, width, height : float
        Pixels.
    colours : sequence of str
        From the first bin to the last.
    theme : Theme
    """
    shares = np.asarray(heights, float)
    highest = max(float(shares.max(initial=0.0)), _LEVELS[0])
    bottom = top + height
    rise = height * np.sqrt(np.maximum(shares, 0.0) / highest)
    for level in _grid(highest, height):
        y = bottom - height * np.sqrt(level / highest)
        yield Lines((_across(left, left + width, y),), theme.faint, 0.7)
        yield Label(left - 6, y + 4, f"{100 * level:g} %", _SMALL, theme.muted, "end")
    yield from _bars(rise, left, bottom, width, colours)
    yield Lines((_across(left, left + width, bottom),), theme.muted, 1.0)
    for place in (0.0, 0.5, 1.0):
        yield Label(left + place * width, bottom + 15, f"{place:g}", _SMALL, theme.muted, "middle")


def _bars(rise: Floats, left: float, bottom: float, width: float, colours: Sequence[str]) -> Iterator[Shape]:
    """Yield one area for each colour, so that neighbours of one colour show no seam."""
    pitch = width / len(rise)
    of_bin = np.minimum(np.arange(len(rise)) * len(colours) // len(rise), len(colours) - 1)
    for number, colour in enumerate(colours):
        bins = [i for i in np.flatnonzero(of_bin == number).tolist() if rise[i] > 0]
        if bins:
            yield Area((_skyline(rise, bins, left, bottom, pitch),), colour)


def _skyline(rise: Floats, bins: list[int], left: float, bottom: float, pitch: float) -> Floats:
    steps = [(left + (i + side) * pitch, bottom - rise[i]) for i in range(bins[0], bins[-1] + 1) for side in (0, 1)]
    return np.array([(steps[0][0], bottom), *steps, (steps[-1][0], bottom)])


def _grid(highest: float, height: float) -> Iterator[float]:
    """Yield levels from the top downwards that lie far enough apart."""
    last = 2.0 * height
    for level in reversed(_LEVELS):
        y = height * np.sqrt(level / highest)
        if level <= highest and last - y >= _NEAREST and y >= _NEAREST / 2:
            yield level
            last = y


def _across(left: float, right: float, y: float) -> Floats:
    return np.array([(left, y), (right, y)])
