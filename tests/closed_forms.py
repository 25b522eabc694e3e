"""Curves of points (x, y, r) in closed form, of which medial axes are made: `Piece` and its kinds.

Most bisectors are of two kinds. Between two walls the centre runs along a line and the radius changes in proportion.
Between a wall and a point it runs along a parabola with the point as focus; a round wall bent outwards (a hole) acts as
its centre, the clearance to it being the distance to the centre less its radius.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mashape_cad.geometry.edge import Floats

TAU = 2 * np.pi


class Piece(Protocol):
    """A curve of points (x, y, r) in closed form."""

    def along(self, count: int) -> Floats:
        """Points from one end to the other: (count, 3)."""

    def off(self, points: Floats) -> Floats:
        """How far points (n, 3) are from fulfilling the closed form, mm: (n,)."""


@dataclass(frozen=True, slots=True)
class Straight:
    """Centre and radius change in proportion from `first` to `last`, (x, y, r) each."""

    first: tuple[float, float, float]
    last: tuple[float, float, float]

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        return np.linspace(self.first, self.last, count)

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        start, way = np.array(self.first), np.subtract(self.last, self.first)
        share = np.clip((points - start) @ way / (way @ way), 0.0, 1.0)
        return np.linalg.norm(points - start - share[:, None] * way, axis=1)


@dataclass(frozen=True, slots=True)
class Parabola:
    """As near to a wall as to a point, or to a round hole of radius `hole` about it.

    The wall passes through `wall` with the inward unit normal `normal`; `low` and `high` bound the place along the
    wall, counted from below the focus to the right of the normal.
    """

    focus: tuple[float, float]
    wall: tuple[float, float]
    normal: tuple[float, float]
    low: float
    high: float
    hole: float = 0.0

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        s = np.linspace(self.low, self.high, count)
        height = float(np.dot(self.normal, np.subtract(self.focus, self.wall)))
        r = (s**2 + height**2 - self.hole**2) / (2 * (height + self.hole))
        base = np.array(self.focus) - height * np.array(self.normal)
        return np.column_stack([base + s[:, None] * self._right() + r[:, None] * np.array(self.normal), r])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        centre, r = points[:, :2], points[:, 2]
        to_wall = (centre - self.wall) @ np.array(self.normal)
        to_focus = np.linalg.norm(centre - self.focus, axis=1) - self.hole
        s = (centre - self.focus) @ self._right()
        outside = np.maximum(np.maximum(self.low - s, s - self.high), 0.0)
        return np.max(np.abs([to_wall - r, to_focus - r, outside]), axis=0)

    def _right(self) -> Floats:
        return np.array([self.normal[1], -self.normal[0]])


@dataclass(frozen=True, slots=True)
class BetweenCircles:
    """As near to a circle from inside as to one within it from outside: an ellipse with the centres as foci."""

    outer: tuple[float, float, float]
    inner: tuple[float, float, float]

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        (x0, y0, big), (x1, y1, small) = self.outer, self.inner
        apart, turn = np.hypot(x1 - x0, y1 - y0), np.arctan2(y1 - y0, x1 - x0)
        a = (big + small) / 2  # R - r and rho + r add up to R + rho
        b = np.sqrt(a**2 - apart**2 / 4)
        t = np.linspace(0.0, TAU, count)
        flat = a * np.cos(t) + 1j * b * np.sin(t)
        centre = flat * np.exp(1j * turn) + complex(x0 + x1, y0 + y1) / 2
        r = big - np.abs(centre - complex(x0, y0))
        return np.column_stack([centre.real, centre.imag, r])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        to_outer = self.outer[2] - np.linalg.norm(points[:, :2] - self.outer[:2], axis=1)
        to_inner = np.linalg.norm(points[:, :2] - self.inner[:2], axis=1) - self.inner[2]
        return np.max(np.abs([to_outer - points[:, 2], to_inner - points[:, 2]]), axis=0)


@dataclass(frozen=True, slots=True)
class InEllipse:
    """Inside an ellipse with semi-axes a > b: |x| <= (a^2 - b^2) / a, r = b sqrt(1 - x^2 / (a^2 - b^2))."""

    a: float
    b: float

    @property
    def reach(self) -> float:
        """Largest x of a centre."""
        return (self.a**2 - self.b**2) / self.a

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        x = np.linspace(-self.reach, self.reach, count)
        return np.column_stack([x, np.zeros(count), self._radius(x)])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        x, y, r = points.T
        within = np.clip(x, -self.reach, self.reach)
        return np.max(np.abs([x - within, y, r - self._radius(within)]), axis=0)

    def _radius(self, x: Floats) -> Floats:
        return self.b * np.sqrt(1 - x**2 / (self.a**2 - self.b**2))


@dataclass(frozen=True, slots=True)
class AlongParabola:
    """Inside the parabola y = a x^2: discs on its axis touch it twice, where x^2 = (y - 1 / 2a) / a.

    `high` bounds the centre's y; at its lowest, 1 / 2a, the disc osculates.
    """

    a: float
    high: float

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        y = np.linspace(1 / (2 * self.a), self.high, count)
        return np.column_stack([np.zeros(count), y, self._radius(y)])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        x, y, r = points.T
        within = np.clip(y, 1 / (2 * self.a), self.high)
        return np.max(np.abs([x, y - within, r - self._radius(within)]), axis=0)

    def _radius(self, y: Floats) -> Floats:
        return np.sqrt((y - 1 / (4 * self.a)) / self.a)


@dataclass(frozen=True, slots=True)
class UnderChord:
    """As near to the parabola y = a x^2, from inside, as to its chord y = `chord`.

    The foot on the parabola runs from x = `low` to x = `high`. With s = sqrt(1 + 4 a^2 x^2) the radius is the height of
    the chord above the foot times s / (1 + s).
    """

    a: float
    chord: float
    low: float
    high: float

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        x = np.linspace(self.low, self.high, count)
        s = np.sqrt(1 + (2 * self.a * x) ** 2)
        r = (self.chord - self.a * x**2) * s / (1 + s)
        return np.column_stack([x - 2 * self.a * x * r / s, self.chord - r, r])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        x, y, r = points.T
        foot = np.array([self._foot(*centre) for centre in points[:, :2]])
        to_parabola = np.hypot(x - foot, y - self.a * foot**2)
        outside = np.maximum(np.maximum(self.low - foot, foot - self.high), 0.0)
        return np.max(np.abs([self.chord - y - r, to_parabola - r, outside]), axis=0)

    def _foot(self, x: float, y: float) -> float:
        """Of the stationary feet, 2 a^2 q^3 + (1 - 2 a y) q = x, the nearest."""
        roots = np.roots([2 * self.a**2, 0.0, 1 - 2 * self.a * y, -x])
        feet = roots[np.abs(roots.imag) <= 1e-6 * (1 + np.abs(roots))].real
        return float(feet[np.argmin(np.hypot(x - feet, y - self.a * feet**2))])


@dataclass(frozen=True, slots=True, eq=False)
class Corridor:
    """The middle of a corridor of constant width: a cubic curve, given by its coefficients of 1, t, t^2 and t^3."""

    coefficients: Floats
    radius: float

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        return np.column_stack([self._at(np.linspace(0, 1, count)), np.full(count, self.radius)])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        return np.array([self._nearest(np.array([x, y])) + abs(r - self.radius) for x, y, r in points])

    def _at(self, t: Floats) -> Floats:
        return np.vander(t, 4, increasing=True) @ self.coefficients

    def _nearest(self, centre: Floats) -> float:
        """Distance from the curve: at an end, or where (q - c).q' = 0."""
        q = [np.polynomial.Polynomial(column) for column in (self.coefficients - [centre, *[[0, 0]] * 3]).T]
        roots = sum(part * part.deriv() for part in q).roots()
        t = np.concatenate([[0.0, 1.0], np.clip(roots.real, 0.0, 1.0)])
        return float(np.min(np.hypot(*(self._at(t) - centre).T)))


@dataclass(frozen=True, slots=True)
class AroundBore:
    """As near to a round bore about the origin as to a point, or to a round wall about the origin, `far` away.

    Between two circles with one centre runs a third; between bore and point a hyperbola with the centre and the point
    as foci. `angle` is the direction of the point, None for the wall; `low` and `high` bound the direction of the
    centre, radians, from `angle` where there is one.
    """

    bore: float
    far: float
    low: float
    high: float
    angle: float | None = None

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        turn = np.linspace(self.low, self.high, count)
        if self.angle is None:
            reach = np.full(count, (self.far + self.bore) / 2)
        else:
            reach = (self.far**2 - self.bore**2) / (2 * (self.far * np.cos(turn) - self.bore))
        direction = turn + (self.angle or 0.0)
        return np.column_stack([reach * np.cos(direction), reach * np.sin(direction), reach - self.bore])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        x, y, r = points.T
        reach, turn = np.hypot(x, y), np.arctan2(y, x) - (self.angle or 0.0)
        middle = (self.low + self.high) / 2
        outside = np.abs(np.remainder(turn - middle + np.pi, TAU) - np.pi) - (self.high - self.low) / 2
        if self.angle is None:
            to_wall = self.far - reach
        else:
            to_wall = np.hypot(x - self.far * np.cos(self.angle), y - self.far * np.sin(self.angle))
        return np.max(np.abs([reach - self.bore - r, to_wall - r, np.maximum(outside, 0.0) * reach]), axis=0)


@dataclass(frozen=True, slots=True)
class BetweenPoints:
    """As near to one point as to another: off from their middle along the unit vector `way`, from `low` to `high`."""

    first: tuple[float, float]
    last: tuple[float, float]
    way: tuple[float, float]
    low: float
    high: float

    def along(self, count: int) -> Floats:
        """See `Piece.along`."""
        s = np.linspace(self.low, self.high, count)
        centre = np.add(self.first, self.last) / 2 + s[:, None] * np.array(self.way)
        return np.column_stack([centre, np.linalg.norm(centre - self.first, axis=1)])

    def off(self, points: Floats) -> Floats:
        """See `Piece.off`."""
        centre, r = points[:, :2], points[:, 2]
        s = (centre - np.add(self.first, self.last) / 2) @ np.array(self.way)
        outside = np.maximum(np.maximum(self.low - s, s - self.high), 0.0)
        to_both = [np.linalg.norm(centre - point, axis=1) - r for point in (self.first, self.last)]
        return np.max(np.abs([*to_both, outside]), axis=0)
