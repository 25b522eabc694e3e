"""Vehicle frames seen from above, front up: side rails, cross members, openings between them."""

from maker.pen import Pen, circle, slot
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["chassis"]


def chassis() -> dict[str, Profile]:
    """Return frames and floors of lorries, cars, karts, model cars and trailers; number 5 has the front of number 1."""
    drawn = (ladder(), floor(), lozenge(), plate(), pickup(), waisted(), trailer(), racer(), backbone(), buggy())
    return {f"chassis-{number}": profile for number, profile in enumerate(drawn, start=1)}


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


def pickup() -> Profile:
    """Draw a pickup's frame: the front of the lorry's, a rear axle between two wheels, a short bed."""
    pen = Pen(0, 118).curve((20, 115.5), leave=0, arrive=-12, rounded=5)
    pen.curve((22, 96), (23, 80), leave=-84, arrive=-90)
    pen.curve((29, 52), (33, 34), (33, 14), (32, -8), (29, -24), leave=-90, arrive=-115, rounded=4)
    pen.curve((20, -32), (17, -46), (21, -60), (32, -68), rounded=4).line(33, -100, rounded=8)
    pen.curve((0, -104), arrive=180)
    openings = (92, 15.5, 13, 24), (52, 19, 23, 34), (2, 24, 22, 44), (-84, 22, 23, 20)
    return Profile.of(pen.mirror_close(), [window(0, *opening) for opening in openings])


def waisted() -> Profile:
    """Draw a car's frame that is narrow in the middle: two trapezoids and a tunnel."""
    side = (18, 100), (33, 90), (36, 70), (30, 46), (19, 24), (15, 0), (19, -24), (31, -46), (37, -72), (33, -92)
    pen = Pen(0, 102).curve(*side, (18, -103), (0, -105), leave=0, arrive=180)
    openings = (70, 25, 15, 36), (0, 6.5, 6.5, 40), (-72, 15, 26, 38)
    return Profile.of(pen.mirror_close(), [window(0, *opening) for opening in openings])


def trailer() -> Profile:
    """Draw a trailer's frame: a drawbar, a wide bed of three openings, round holes at the corners."""
    pen = Pen(0, 120).curve((7, 116), (8, 106), leave=0, arrive=-90, rounded=4).curve((11, 84), (34, 52), rounded=8)
    pen.curve((37, 20), (37, -40), (34, -92), rounded=7).curve((0, -95), arrive=180)
    windows = [window(0, 62, 5, 16, 24), window(0, 22, 25, 27, 34), window(0, -24, 27, 27, 34)]
    holes = [circle(0, 107, 3.5), *(circle(x, -80, 4) for x in (-24, 24)), slot(0, -64, 44, 8)]
    return Profile.of(pen.mirror_close(), [*windows, *holes])


def racer() -> Profile:
    """Draw a racing car's floor: a slender nose, a cockpit, side pods, a diffuser."""
    pen = Pen(0, 125).curve((7, 119), (10, 100), (12, 70), (15, 46), leave=0, rounded=4)
    pen.curve((30, 40), (37, 24), (38, -4), (32, -32), (20, -48), rounded=5)
    pen.curve((21, -70), (26, -92), rounded=6).curve((0, -96), arrive=180)
    pods = [slot(x, 2, 46, 9, 90) for x in (-26, 26)]
    return Profile.of(pen.mirror_close(), [window(0, 18, 9, 13, 52), *pods, slot(0, 84, 34, 6, 90), circle(0, -64, 9)])


def backbone() -> Profile:
    """Draw a backbone frame: one beam with arms for four wheels and round holes along it."""
    pen = Pen(0, 112).curve((12, 110), leave=0, rounded=5).line(13, 90, rounded=6)
    pen.curve((26, 86), (39, 88), rounded=5).line(39, 70, rounded=5).curve((26, 68), (14, 60), rounded=6)
    pen.curve((12, 20), (12, -20), (15, -52), rounded=6)
    pen.curve((28, -60), (40, -60), rounded=5).line(40, -80, rounded=5).curve((28, -82), (16, -86), rounded=6)
    pen.line(14, -104, rounded=5).curve((0, -106), arrive=180)
    holes = [circle(0, y, radius) for y, radius in ((76, 8), (48, 6), (22, 5), (-4, 5), (-30, 6), (-70, 9))]
    return Profile.of(pen.mirror_close(), [*holes, *(circle(x, y, 3) for x in (-32, 32) for y in (79, -70))])


def buggy() -> Profile:
    """Draw a buggy's plate: the kart's lozenge cut short, with wheel arches behind and a round seat."""
    side = (9, 92), (18, 80), (27, 52), (38, 20), (41, 0)
    pen = Pen(0, 94).curve(*side, leave=0, rounded=6).curve((28, -8), (24, -24), (29, -40), (42, -46), rounded=5)
    pen.line(36, -72, rounded=9).curve((0, -78), arrive=180)
    windows = [window(0, 56, 8, 13, 34), window(0, -56, 20, 22, 20)]
    return Profile.of(pen.mirror_close(), [*windows, circle(0, 8, 19), circle(0, 82, 3.5)])


def window(x: float, y: float, top: float, bottom: float, height: float) -> Loop:
    """Return an opening with four rounded corners, `top` and `bottom` half wide, bulging a little."""
    up, down = y + height / 2, y - height / 2
    size = 0.35 * min(top, bottom, height / 2)
    side = (top + bottom) / 2 + 0.02 * height
    pen = Pen(x - top, up, rounded=size).curve((x, up + 0.06 * top), (x + top, up), rounded=size)
    pen.curve((x + side, y), (x + bottom, down), rounded=size)
    pen.curve((x, down - 0.06 * bottom), (x - bottom, down), rounded=size).curve((x - side, y), (x - top, up))
    return pen.close()
