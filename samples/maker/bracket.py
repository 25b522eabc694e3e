"""Brackets: a wall leg and an arm, braced by a curve, with a window and screw holes."""

from maker.pen import Pen, Point, circle
from mashape_cad.geometry.profile import Profile

__all__ = ["brackets"]


def brackets() -> dict[str, Profile]:
    """Return brackets that differ in their legs, their brace and their window."""
    return {
        "bracket-1": bracket(120, 110, 15, brace=(46, 64)),
        "bracket-2": bracket(146, 100, 14, brace=(58, 57)),
        "bracket-3": bracket(92, 132, 16, brace=(42, 62)),
        "bracket-4": bracket(112, 104, 18, brace=(58, 46)),
    }


def bracket(reach: float, height: float, wide: float, brace: Point) -> Profile:
    """Draw a bracket of legs `wide` across; its brace passes through the point `brace`."""
    x, y = brace
    end = 0.8 * wide  # legs taper
    foot = (end + 0.16 * (x - end), 0.34 * y)
    tip = (x + 0.66 * (reach - x), height - end - 0.16 * (height - end - y))
    pen = Pen(0, 0, rounded=4).line(end, 0, rounded=5)
    pen.curve(foot, (x, y), tip, (reach, height - end), leave=80, arrive=10, rounded=5)
    pen.line(reach, height, rounded=4).line(0, height, rounded=6)
    window = Pen(1.15 * wide, height - 1.15 * wide, rounded=7)
    window.line(0.85 * wide, 0.5 * y, rounded=5)
    window.curve((x - 0.6 * wide, y + 0.6 * wide), (x + 0.45 * (reach - x), height - 0.85 * wide), rounded=7)
    middle, top = 0.48 * wide, height - 0.48 * wide
    screws = [circle(*place, 0.16 * wide) for place in ((middle, 0.12 * height), (middle, top), (reach - middle, top))]
    return Profile.of(pen.close(), [window.close(), *screws])
