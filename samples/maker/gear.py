"""Gears with involute teeth; bores and openings of several kinds."""

from math import asin, cos, pi, radians, sin, tan

import numpy as np

from maker.pen import Pen, Point, circle, closed_curve, moved, slot
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["gears"]


def gears() -> dict[str, Profile]:
    """Return gears with unlike teeth, and holes of many shapes and sizes."""
    return {
        "gear-1": Profile.of(involute(16, 5), [keyed_bore(17, 6)]),
        "gear-2": Profile.of(involute(12, 7), [circle(0, 0, 8), *around(3, circle(20, 0, 5))]),
        "gear-3": Profile.of(involute(20, 5), [polygon(6, 8), *around(4, kidney(17, 36, 62))]),
        "gear-4": Profile.of(involute(14, 6.5), [lobed_bore(6, 18, 2)]),
        "gear-5": Profile.of(involute(18, 5.5), [circle(0, 0, 11), *around(5, circle(27, 0, 8))]),
        "gear-6": Profile.of(involute(13, 7), [polygon(4, 15)]),
        "gear-7": Profile.of(involute(24, 4.5), [keyed_bore(9, 4), *around(5, kidney(18, 40, 48))]),
        "gear-8": Profile.of(involute(11, 8), [lobed_bore(3, 20, 5)]),
        "gear-9": Profile.of(involute(15, 6), [lobed_bore(8, 12, 1.4), *around(3, kidney(20, 30, 70))]),
        "gear-10": Profile.of(involute(17, 5.5), [circle(0, 0, 9), *around(6, slot(25, 0, 20, 7))]),
    }


def involute(teeth: int, module: float) -> Loop:
    """Draw a spur gear: flanks are B-splines through points of the involute, tips and roots are arcs."""
    pitch, tip, root = teeth * module / 2, (teeth / 2 + 1) * module, (teeth / 2 - 1.2) * module
    base = pitch * cos(radians(20))
    half = pi / (2 * teeth) + _unwound(base, pitch)
    radii = [root, *np.linspace(max(base, root + 0.5 * module), tip, 4)]
    angles = [half - _unwound(base, radius) for radius in radii]
    angles[0] = asin(1.06 * radii[1] * sin(half) / root)  # the foot of a tooth is a little wider than its waist
    step = 2 * pi / teeth
    pen = Pen(*_polar(root, -angles[0]), rounded=0.25 * module)
    for tooth in range(teeth):
        centre = tooth * step
        up = [_polar(r, centre - a) for r, a in zip(radii, angles, strict=True)]
        down = [_polar(r, centre + a) for r, a in zip(reversed(radii), reversed(angles), strict=True)]
        pen.curve(*up[1:], rounded=0.12 * module)
        pen.arc(*down[0], tan(angles[-1] / 2), rounded=0.12 * module)
        pen.curve(*down[1:], rounded=0.25 * module)
        if tooth < teeth - 1:
            pen.arc(*_polar(root, centre + step - angles[0]), tan((step - 2 * angles[0]) / 4), rounded=0.25 * module)
    pen.arc(*_polar(root, -angles[0]), tan((step - 2 * angles[0]) / 4))
    return pen.close()


def keyed_bore(radius: float, key: float) -> Loop:
    """Draw a round bore with a keyway of width `key`."""
    half = asin(key / 2 / radius)
    left, right = _polar(radius, pi / 2 + half), _polar(radius, pi / 2 - half)
    top = radius + key / 2
    pen = Pen(*left).arc(*right, tan((2 * pi - 2 * half) / 4))
    return pen.line(key / 2, top).line(-key / 2, top).close()


def lobed_bore(lobes: int, radius: float, depth: float) -> Loop:
    """Draw a bore whose outline swings by `depth` in and out: one closed B-spline."""
    around_it = pi / 2 + 2 * pi * np.arange(12 * lobes) / (12 * lobes)
    wave = np.tanh(1.2 * np.cos(lobes * (around_it - pi / 2))) / np.tanh(1.2)
    return closed_curve(*[_polar(radius + depth * w, a) for w, a in zip(wave, around_it, strict=True)])


def polygon(corners: int, radius: float) -> Loop:
    """Draw a bore with so many rounded corners."""
    first, *others = (_polar(radius, 2 * pi * i / corners) for i in range(corners))
    pen = Pen(*first, rounded=1.5)
    for x, y in others:
        pen.line(x, y, rounded=1.5)
    return pen.close()


def kidney(inner: float, outer: float, angle: float) -> Loop:
    """Draw an opening between two arcs about the origin, its corners rounded freely."""
    half, size = radians(angle) / 2, 0.3 * (outer - inner)
    pen = Pen(*_polar(inner, half), rounded=size).arc(*_polar(inner, -half), -tan(half / 2), rounded=size)
    pen.line(*_polar(outer, -half), rounded=size).arc(*_polar(outer, half), tan(half / 2), rounded=size)
    return pen.close()


def around(count: int, loop: Loop) -> list[Loop]:
    """Return `count` copies of a loop, turned evenly about the origin."""
    return [moved(loop, 0, 0, 360 * i / count) for i in range(count)]


def _unwound(base: float, radius: float) -> float:
    """Polar angle of the involute of a circle where it reaches `radius`; 0 inside the circle."""
    roll = np.sqrt(max((radius / base) ** 2 - 1, 0.0))
    return float(roll - np.arctan(roll))


def _polar(radius: float, angle: float) -> Point:
    return radius * cos(angle), radius * sin(angle)
