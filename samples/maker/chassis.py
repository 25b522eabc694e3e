"""Vehicle frames seen from above, front up: side rails, cross members, openings between them."""

from maker.pen import Pen, circle, slot
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["chassis"]


def chassis() -> dict[str, Profile]:
    """Return a lorry's ladder frame, a car's floor, a kart's lozenge and a model car's plate."""
    return {"chassis-1": ladder(), "chassis-2": floor(), "chassis-3": lozenge(), "chassis-4": plate()}


def ladder() -> Profile:
    """Draw a lorry's frame: two rails, narrow in front, and six cross members."""
    pen = Pen(0, 118).curve((20, 115.5), leave=0, arrive=-12, rounded=5)
    pen.curve((22, 96), (23, 80), leave=-84, arrive=-90)
    rail = (29, 52), (33, 34), (33, 14), (32, -8), (29, -40), (27, -60), (28, -84), (28, -112)
    pen.curve(*rail, leave=-90, arrive=-90, rounded=5)
    pen.curve((0, -114), arrive=180)
    openings = (92, 15.5, 13, 24), (52, 19, 23, 34), (2, 24, 22, 44), (-46, 20, 19, 34), (-88, 19, 20, 32)
    return Profile.of(pen.mirror_close(), [window(0, *opening) for opening in openings])


def floor() -> Profile:
    """Draw a car's floor pan: four wheel arches, footwells, a spare wheel's well."""
    pen = Pen(0, 102).curve((20, 99), (34, 88), leave=0, rounded=5).line(36, 76, rounded=4)
    pen.curve((26, 71), (22, 60), (26, 49), (38, 45), rounded=5)
    pen.curve((40, 20), (40, -6), (38, -30), rounded=5)
    pen.curve((26, -35), (22, -46), (26, -57), (37, -62), rounded=4).line(36, -80, rounded=8)
    pen.curve((20, -93), (0, -96), arrive=180)
    windows = [window(0, 82, 17, 14, 18), window(19, 10, 13, 14, 44), window(-19, 10, 13, 14, 44)]
    return Profile.of(pen.mirror_close(), [*windows, circle(0, -70, 13), slot(0, -34, 28, 7), slot(0, 56, 22, 6)])


def lozenge() -> Profile:
    """Draw a kart's frame: a lozenge with three openings and four holes."""
    side = (9, 103), (17, 92), (26, 60), (38, 22), (44, 0), (40, -26), (28, -62), (18, -94), (10, -104), (0, -106)
    pen = Pen(0, 105).curve(*side, leave=0, arrive=180)
    windows = [window(0, 64, 9, 15, 36), window(0, 4, 26, 26, 46), window(0, -60, 18, 9, 40)]
    holes = [circle(0, 92, 4), circle(0, -94, 4), circle(36, 0, 3), circle(-36, 0, 3)]
    return Profile.of(pen.mirror_close(), [*windows, *holes])


def plate() -> Profile:
    """Draw a model car's plate: wheels beside its narrow ends, slots for the battery's strap, holes for screws."""
    pen = Pen(0, 88).line(16, 88, rounded=8).curve((18, 70), (16, 46), rounded=4)
    pen.curve((26, 38), (33, 28), rounded=5).curve((36, 0), (33, -26), rounded=5)
    pen.curve((26, -36), (17, -42), rounded=4).curve((19, -66), (22, -84), rounded=7)
    pen.curve((0, -86), arrive=180)
    slots = [slot(22, 0, 40, 7, 90), slot(-22, 0, 40, 7, 90), slot(0, 34, 18, 6)]
    holes = [circle(0, 72, 5), circle(0, -66, 5), circle(10, 60, 2.2), circle(-10, 60, 2.2)]
    return Profile.of(pen.mirror_close(), [window(0, -14, 11, 9, 36), *slots, *holes])


def window(x: float, y: float, top: float, bottom: float, height: float) -> Loop:
    """Return an opening with four rounded corners, `top` and `bottom` half wide, bulging a little."""
    up, down = y + height / 2, y - height / 2
    size = 0.35 * min(top, bottom, height / 2)
    side = (top + bottom) / 2 + 0.02 * height
    pen = Pen(x - top, up, rounded=size).curve((x, up + 0.06 * top), (x + top, up), rounded=size)
    pen.curve((x + side, y), (x + bottom, down), rounded=size)
    pen.curve((x, down - 0.06 * bottom), (x - bottom, down), rounded=size).curve((x - side, y), (x - top, up))
    return pen.close()
