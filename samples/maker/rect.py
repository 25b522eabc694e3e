"""Four-sided plates: unlike at first sight, but their medial axes have the same five branches."""

from collections.abc import Sequence

import numpy as np

from maker.pen import Pen, Point
from mashape_cad.geometry.profile import Profile

__all__ = ["rects"]


def rects() -> dict[str, Profile]:
    """Return barrels, pillows, wedges, waves, a dog bone, strips and plates, all of four sides."""
    return {
        "rect-1": rect((0, 0), (110, 0), (110, 60), (0, 60), bulges=((5, 5), (2, 2), (5, 5), (2, 2))),
        "rect-2": rect((0, 0), (130, 0), (130, 72), (0, 72), bulges=((-7, -7), (-4, -4), (-7, -7), (-4, -4))),
        "rect-3": rect((0, 8), (120, 0), (120, 74), (0, 56), bulges=((4, -3), (2, 2), (-3, 4), (1, 1))),
        "rect-4": rect((0, 0), (96, 6), (112, 62), (14, 54), bulges=((-3, 3), (1, 3), (3, -3), (3, 1))),
        "rect-5": rect((0, 0), (140, 0), (140, 56), (0, 56), bulges=((-14, -14), (0, 0), (-14, -14), (0, 0))),
        "rect-6": rect((0, 0), (180, 0), (180, 34), (0, 34), bulges=((0, 0), (2, 2), (0, 0), (2, 2))),
        "rect-7": rect((0, 0), (150, 0), (112, 64), (30, 64), bulges=((0, 0), (3, 3), (-4, -4), (3, 3))),
        "rect-8": rect((0, 0), (170, 0), (170, 44), (0, 44), bulges=((-9, 9), (0, 0), (9, -9), (0, 0))),
        "rect-9": rect((0, 0), (150, 0), (160, 46), (-10, 46), bulges=((-16, -16), (1, 1), (20, 20), (1, 1))),
        "rect-10": rect((0, 0), (100, 0), (100, 70), (0, 70), bulges=((0, 0), (-6, -6), (4, 4), (-6, -6))),
    }


def rect(*corners: Point, bulges: Sequence[tuple[float, float]]) -> Profile:
    """Draw a four-sided plate, counter-clockwise.

    `bulges` say how far each side lies outside the straight line at its two thirds, mm (negative: inside).
    """
    pen = Pen(*corners[0])
    for start, end, bulge in zip(corners, (*corners[1:], corners[0]), bulges, strict=True):
        along = np.subtract(end, start)
        outwards = np.array([along[1], -along[0]]) / np.hypot(*along)
        first, second = (
            start + share * along + high * outwards for share, high in zip((1 / 3, 2 / 3), bulge, strict=True)
        )
        pen.curve(tuple(first), tuple(second), end)
    return Profile.of(pen.close())
