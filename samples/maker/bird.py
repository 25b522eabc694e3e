"""Birds in profile, beak to the right; some with an eye, some without."""

from maker.pen import Pen, circle
from mashape_cad.geometry.profile import Profile

__all__ = ["birds"]


def birds() -> dict[str, Profile]:
    """Return birds that swim, fly, stand and perch; number 10 is number 1 on a twig, the same above its feet."""
    drawn = (songbird(), dove(), duck(), swan(), gull(), goose(), penguin(), hen(), swallow(), perched())
    return {f"bird-{number}": profile for number, profile in enumerate(drawn, start=1)}


def songbird() -> Profile:
    """Draw a robin: round breast, wing tip over the tail."""
    pen = _back_of_a_songbird()
    pen.curve((-2, 10.5), (17, 16.5), (30, 11), (46, 2), (62, 2), (76, 12), (84, 28), (86, 44), (87, 55), rounded=2)
    pen.curve((94, 58), (101, 62))
    return Profile.of(pen.close(), [circle(77, 66, 2.6)])


def perched() -> Profile:
    """Draw the robin without an eye, on a twig with a leaf."""
    pen = _back_of_a_songbird()
    pen.curve((-2, 10.5), (17, 16.5), (30, 11), (45, 2.5), rounded=1.5).line(44, -9, rounded=1.5)
    pen.curve((20, -10), (-8, -6), rounded=1.5).curve((-12, -8), (-11, -12), rounded=1.5)
    pen.curve((10, -16), (40, -17), (70, -13), rounded=2)
    pen.curve((80, -24), (96, -26), (108, -20), rounded=1).curve((100, -10), (88, -7), (78, -8), rounded=1.5)
    pen.curve((66, -7.5), (57, -8.5), rounded=1.5).line(58, 1, rounded=1.5)
    pen.curve((67, 4), (76, 12), (84, 28), (86, 44), (87, 55), rounded=2).curve((94, 58), (101, 62))
    return Profile.of(pen.close())


def _back_of_a_songbird() -> Pen:
    """Draw from the tip of the beak over head and back to the lower corner of the tail."""
    pen = Pen(101, 62, rounded=1).curve((94, 66.5), (87, 68.5), rounded=2)
    pen.curve((80, 75.5), (69, 78), (58, 73.5), (48, 63), (34, 52), (18, 43), (2, 37))
    pen.curve((8, 32), (14, 29.5), rounded=1.5).curve((-6, 21), (-24, 14), rounded=2)
    return pen.line(-21, 5, rounded=2)


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


def gull() -> Profile:
    """Draw a gull from below, gliding: long bent wings, a fan of a tail."""
    pen = Pen(0, 60, rounded=2).curve((2.8, 54), (5, 50), rounded=1.5)
    pen.curve((8, 43), (9, 34), rounded=3).curve((26, 39), (44, 38), (64, 26), (86, 8), (98, -8))
    pen.curve((82, 2), (64, 10), (44, 14), (28, 10), (11, 2), rounded=3)
    pen.curve((10, -14), (6, -30), rounded=3).curve((12, -42), (17, -53), rounded=1.5).curve((0, -57), arrive=180)
    return Profile.of(pen.mirror_close())


def goose() -> Profile:
    """Draw a goose in flight: neck stretched out, one wing lifted."""
    pen = Pen(150, 46, rounded=1.8).curve((141, 50), (134, 54), rounded=2)
    pen.curve((126, 58), (118, 55), (104, 50), (90, 50), leave=140, rounded=3)
    pen.curve((84, 70), (70, 92), (50, 108), (34, 114)).curve((40, 103), (41, 95), rounded=1.5)
    pen.curve((34, 97), (25, 98)).curve((34, 86), (38, 76), rounded=1.5).curve((32, 77), (24, 77))
    pen.curve((36, 66), (42, 54), rounded=4).curve((24, 52), (2, 54), rounded=1.5)
    pen.curve((4, 47), (0, 40), rounded=1.5).curve(
        (24, 36), (46, 30), (72, 29), (94, 35), (112, 41), (128, 42), (138, 44), rounded=1.5
    )
    pen.curve((144, 44), (150, 46))
    return Profile.of(pen.close(), [circle(126, 50, 2)])


def penguin() -> Profile:
    """Draw a penguin that stands upright, its flipper a little off."""
    pen = Pen(66, 118, rounded=1.5).curve((57, 122), (51, 125), rounded=2)
    pen.curve((44, 132), (34, 132), (26, 124), (24, 112), (18, 98), (12, 80), rounded=3)
    pen.curve((5, 64), (0, 44), rounded=1.5).curve((7, 46), (11, 52), rounded=5)
    pen.curve((9, 34), (10, 20), (6, 10), (-4, 1), rounded=2).curve((8, 1), (18, 5), rounded=2)
    pen.curve((30, 2), (44, -2), (58, -1), rounded=2).curve((57, 4), (50, 8), rounded=2)
    pen.curve((58, 26), (61, 48), (59, 72), (53, 94), (50, 106), (53, 113), rounded=2).curve((60, 114), (66, 118))
    return Profile.of(pen.close(), [circle(42, 122, 2.4)])


def hen() -> Profile:
    """Draw a hen: comb, wattle, a tail that stands up, two legs."""
    pen = Pen(116, 86, rounded=1).curve((108, 90), (103, 92), rounded=1.5)
    pen.curve((104, 98), (101, 102), rounded=1.5).curve((99, 99), (97, 98), rounded=1)
    pen.curve((95, 103), (90, 105), rounded=1.5).curve((89, 101), (88, 99), rounded=1)
    pen.curve((84, 102), (79, 101), rounded=1.5).curve((81, 96), (82, 92), rounded=2)
    pen.curve((78, 76), (66, 64), (50, 62), (36, 72), (24, 92), rounded=1.5)
    pen.curve((16, 90), (10, 84), rounded=1.5).curve((4, 80), (-2, 72), rounded=1.5)
    pen.curve((6, 54), (14, 36), (30, 22), (46, 17), rounded=2).line(44, 6, rounded=1.5)
    pen.line(34, 0, rounded=2.5).line(57, 0, rounded=2.5).line(51, 6, rounded=1.5).line(53, 16, rounded=2)
    pen.curve((60, 16), (66, 17), rounded=2).line(65, 6, rounded=1.5)
    pen.line(59, 0, rounded=2.5).line(82, 0, rounded=2.5).line(72, 6, rounded=1.5).line(74, 20, rounded=2)
    pen.curve((90, 32), (99, 50), (101, 66), (101, 74), rounded=1.6)
    pen.curve((106, 72), (108, 77), (106, 82), rounded=1).curve((111, 83), (116, 86))
    return Profile.of(pen.close())


def swallow() -> Profile:
    """Draw a swallow from below: sickle wings, a forked tail."""
    pen = Pen(0, 52, rounded=1).curve((3, 46), (6, 38), (8, 28), rounded=2)
    pen.curve((24, 33), (42, 28), (62, 8), (76, -22)).curve((58, -2), (40, 8), (24, 10), (8, 4), rounded=3)
    pen.curve((8, -12), (7, -24), rounded=2).curve((14, -48), (25, -78)).curve((12, -62), (0, -44))
    return Profile.of(pen.mirror_close())
