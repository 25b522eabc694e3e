"""Brackets: a wall leg and an arm, braced by a curve, with a window and screw holes."""

from maker.pen import Pen, Point, circle, slot
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["brackets"]


def brackets() -> dict[str, Profile]:
    """Return brackets that differ in their brace, their window and their holes."""
    screws = circle(7.5, 14, 2.6), circle(7.5, 101, 2.6), circle(109, 102.5, 2.6)
    return {
        "bracket-1": bracket(120, 110, 15, (46, 64), screws),
        "bracket-2": bracket(146, 100, 14, (58, 57), (slot(130, 93, 16, 5), slot(7, 16, 16, 5, 90))),
        "bracket-3": bracket(92, 132, 16, (42, 62), (circle(8, 14, 3), circle(8, 30, 3))),
        "bracket-4": bracket(112, 104, 22, (64, 40), ()),
    }


def bracket(reach: float, height: float, wide: float, brace: Point, holes: tuple[Loop, ...]) -> Profile:
    """Draw a bracket of legs `wide` across; its brace passes through the point `brace`."""
    x, y = brace
    foot = (wide + 0.16 * (x - wide), 0.34 * y)
    tip = (x + 0.66 * (reach - x), height - wide - 0.16 * (height - wide - y))
    pen = Pen(0, 0, rounded=4).line(wide, 0, rounded=5)
    pen.curve(foot, (x, y), tip, (reach, height - wide), leave=80, arrive=10, rounded=5)
    pen.line(reach, height, rounded=4).line(0, height, rounded=6)
    window = Pen(wide, height - wide, rounded=7)
    window.line(wide, 0.52 * y, rounded=5)
    window.curve((x - 0.6 * wide, y + 0.6 * wide), (x + 0.42 * (reach - x), height - wide), rounded=7)
    return Profile.of(pen.close(), [window.close(), *holes])
