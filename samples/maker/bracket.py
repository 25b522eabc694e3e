"""Brackets: a wall leg and an arm, braced by a curve, with one opening between them."""

from maker.pen import Pen, Point, circle
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["brackets"]


def brackets() -> dict[str, Profile]:
    """Return brackets that differ in their legs, their brace, their corner and their opening."""
    return {
        "bracket-1": bracket(120, 110, 15, brace=(46, 64)),
        "bracket-2": bracket(146, 100, 14, brace=(58, 57)),
        "bracket-3": bracket(92, 132, 16, brace=(42, 62)),
        "bracket-4": bracket(112, 104, 18, brace=(58, 46)),
        "bracket-5": bracket(128, 124, 17, brace=(50, 72), corner=24),
        "bracket-6": bracket(118, 118, 16, brace=(48, 68), lugs=7),
        "bracket-7": bracket(140, 120, 18, brace=(58, 66), recess=5),
        "bracket-8": bracket(110, 126, 18, brace=(46, 66), is_round=True),
        "bracket-9": bracket(132, 108, 16, brace=(56, 56), corner=18, lugs=6),
        "bracket-10": bracket(116, 132, 19, brace=(52, 70), lugs=7, recess=6),
    }


def bracket(
    reach: float,
    height: float,
    wide: float,
    brace: Point,
    corner: float = 0.0,
    lugs: float = 0.0,
    recess: float = 0.0,
    *,
    is_round: bool = False,
) -> Profile:
    """Draw a bracket of legs `wide` across; its brace passes through the point `brace`.

    `corner` is cut off where the legs meet; round `lugs` of that radius stand on the ends of both legs; the backs of
    both legs have a flat `recess` of that depth.
    """
    x, y = brace
    end = 0.8 * wide  # legs taper
    foot = (end + 0.16 * (x - end), 0.34 * y)
    tip = (x + 0.66 * (reach - x), height - end - 0.16 * (height - end - y))
    pen = Pen(0, 0, rounded=4).line(end, 0, rounded=5)
    pen.curve(foot, (x, y), tip, (reach, height - end), leave=80, arrive=10, rounded=5)
    pen.line(reach, height, rounded=4)
    _back(pen, (reach, height), (corner, height), lugs, recess)
    pen.line(corner, height, rounded=4 if corner else 6)
    if corner:
        pen.line(0, height - corner, rounded=4)
    _back(pen, (0, 0), (0, height - corner), lugs, recess, is_upwards=False)
    hole = _round_opening(height, wide, brace) if is_round else _opening(reach, height, wide, brace, corner)
    return Profile.of(pen.close(), [hole])


def _back(pen: Pen, tip: Point, heel: Point, lugs: float, recess: float, *, is_upwards: bool = True) -> None:
    """Draw what stands on or is cut into the back of a leg; the arm is drawn from tip to heel, the wall leg back."""
    (ax, ay), (bx, by) = tip, heel
    length = abs(bx - ax) + abs(by - ay)

    def at(along: float, out: float) -> Point:
        share = along / length
        # The arm's back looks up, the wall leg's to the left.
        return ax + share * (bx - ax) - (0 if is_upwards else out), ay + share * (by - ay) + (out if is_upwards else 0)

    places = []
    if lugs:
        places += [(2 * lugs, 0.0, 2.0), (2 * lugs, 0.4 * lugs, 0.0), (4 * lugs, 0.4 * lugs, 0.0), (4 * lugs, 0.0, 2.0)]
    if recess:
        low, high = 0.5 * length, 0.78 * length
        places += [(low, 0.0, 2.0), (low + recess, -recess, 2.0), (high - recess, -recess, 2.0), (high, 0.0, 2.0)]
    for along, out, rounded in places if is_upwards else reversed(places):
        is_top = lugs > 0 and out > 0 and along == (4 * lugs if is_upwards else 2 * lugs)
        if is_top:
            pen.arc(*at(along, out), 1.0)
        else:
            pen.line(*at(along, out), rounded=rounded)


def _opening(reach: float, height: float, wide: float, brace: Point, corner: float) -> Loop:
    """Return an opening along legs and brace; where the corner is cut off, so is its own."""
    x, y = brace
    left, top, cut = 1.15 * wide, height - 1.15 * wide, 0.55 * corner
    pen = Pen(left, top - cut, rounded=5 if cut else 7).line(0.85 * wide, 0.5 * y, rounded=5)
    pen.curve((x - 0.6 * wide, y + 0.6 * wide), (x + 0.45 * (reach - x), height - 0.85 * wide), rounded=7)
    if cut:
        pen.line(left + cut, top, rounded=5)
    return pen.close()


def _round_opening(height: float, wide: float, brace: Point) -> Loop:
    x, y = brace
    return circle(0.5 * x + 0.5 * wide, 0.5 * (height + y) - 0.2 * wide, 0.3 * (height - y))
