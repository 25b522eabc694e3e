"""Birds in profile, beak to the right; some with an eye, some without."""

from maker.pen import Pen, circle
from mashape_cad.geometry.profile import Profile

__all__ = ["birds"]


def birds() -> dict[str, Profile]:
    """Return a songbird, a dove in flight, a duck and a swan."""
    return {"bird-1": songbird(), "bird-2": dove(), "bird-3": duck(), "bird-4": swan()}


def songbird() -> Profile:
    """Draw a robin: round breast, wing tip over the tail."""
    pen = Pen(101, 62, rounded=1).curve((94, 66.5), (87, 68.5), rounded=2)
    pen.curve((80, 75.5), (69, 78), (58, 73.5), (48, 63), (34, 52), (18, 43), (2, 37))
    pen.curve((8, 32), (14, 29.5), rounded=1.5).curve((-6, 21), (-24, 14), rounded=2).line(-21, 5, rounded=2)
    pen.curve((-2, 10.5), (17, 16.5), (30, 11), (46, 2), (62, 2), (76, 12), (84, 28), (86, 44), (87, 55), rounded=2)
    pen.curve((94, 58), (101, 62))
    return Profile.of(pen.close(), [circle(77, 66, 2.6)])


def dove() -> Profile:
    """Draw a dove in flight: wing up, tail spread."""
    pen = Pen(124, 55, rounded=1.5).curve((118, 59), (114, 61.5), rounded=1.5)
    pen.curve((108, 67.5), (99, 67.5), (91, 63), (84, 62), leave=112, rounded=4)
    pen.curve((82, 80), (75, 99), (62, 117), (44, 130))
    pen.curve((46, 121), (45, 113), rounded=1.5).curve((38, 114.5), (30, 115))
    pen.curve((35, 106), (37, 99), rounded=1.5).curve((30, 99), (22, 97.5))
    pen.curve((30, 90), (34, 83.5), rounded=1.5).curve((28, 82), (22, 79))
    pen.curve((34, 74), (44, 63), rounded=4)
    pen.curve((32, 57), (16, 56), (-2, 60)).curve((0, 54), (-1, 50.5), rounded=1.5)
    pen.curve((-7, 49), (-13, 46)).curve((-7, 42), (-3, 38.5), rounded=1.5)
    pen.curve((-6, 35), (-9, 29))
    pen.curve((8, 30), (24, 34), (42, 31), (62, 26), (82, 27), (100, 34), (111, 44), (115, 51), rounded=1.5)
    pen.curve((120, 53), (124, 55))
    return Profile.of(pen.close())


def duck() -> Profile:
    """Draw a swimming duck."""
    pen = Pen(128, 76, rounded=2).curve((120, 80), (113, 83), rounded=3)
    pen.curve((107, 92), (95, 96), (82, 91), (77, 79), (80, 67), (78, 58), (66, 54), (48, 55), (28, 60), (6, 70),
              rounded=1.5)  # fmt: skip
    pen.curve((3, 58), (8, 42), (20, 26), (40, 16), (66, 13), (92, 17), (108, 30), (112, 46), (107, 58), (105, 66),
              (113, 71), rounded=2)  # fmt: skip
    pen.curve((121, 70), (128, 70), rounded=2).line(128, 76)
    return Profile.of(pen.close(), [circle(98, 83, 3)])


def swan() -> Profile:
    """Draw a swan: long bent neck, raised wing."""
    pen = Pen(126, 88, rounded=1.5).curve((119, 96), (113, 101), rounded=2)
    pen.curve((106, 108), (96, 107), (89, 98), (89, 84), (93, 68), (94, 56), (88, 50), (80, 53), (69, 62), (54, 67),
              (38, 67), (24, 63), leave=125, arrive=200)  # fmt: skip
    pen.curve((28, 60), (31, 56.5), rounded=1.5).curve((22, 56), (12, 52))
    pen.curve((17, 49), (20, 45.5), rounded=1.5).curve((8, 45), (-8, 48))
    pen.curve((-4, 34), (8, 20), (28, 9), (54, 5), (80, 8), (100, 20), (110, 38), (108, 58), (103, 76), (102, 88),
              (107, 93), (113, 90), rounded=1.5)  # fmt: skip
    pen.curve((119, 88), (126, 88))
    return Profile.of(pen.close())
