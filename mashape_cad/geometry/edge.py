"""Exact boundary curves on numbers: `Line`, `Arc`, `EllipseArc`, `BSpline`.

An *edge* is one curve with a direction. All four kinds share one parameter convention: ``u`` runs from 0 at the start
to 1 at the end, linear in length on lines, in the angle on (elliptic) arcs, in the knot parameter on B-splines. Kernel
twins of edges are made in `mashape_cad.kernel`; the medial axis works on `Edge.spans`, the same curves as rational
Bezier pieces.

References
----------
L. Piegl, W. Tiller, The NURBS Book, 2nd ed., Springer 1997: section 7.3 (arcs as rational quadratics), algorithm A5.6
(Bezier decomposition, done here by `scipy.interpolate.insert`).
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import interpolate

__all__ = ["Arc", "BSpline", "Edge", "EllipseArc", "Floats", "Line", "Similarity", "frozen"]

Floats = NDArray[np.float64]

_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(24)
# A rational quadratic arc of at most 90 degrees keeps its middle weight above 0.7, so that the rational
# parameter stays close to the angle and Bernstein bounds stay tight.
_MAX_ARC_SPAN = np.pi / 2 + 1e-9


def frozen(values: ArrayLike) -> Floats:
    """Return a read-only float copy of `values`."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


@dataclass(frozen=True, slots=True, eq=False)
class Similarity:
    """A map ``p -> matrix @ p + offset`` that keeps shapes: move, turn, uniform scale, mirror.

    Attributes
    ----------
    matrix : (2, 2) array
        Scale times an orthogonal matrix.
    offset : (2,) array
        Translation, mm.
    """

    matrix: Floats
    offset: Floats

    @classmethod
    def of(
        cls, scale: float = 1.0, angle: float = 0.0, offset: ArrayLike = (0.0, 0.0), *, mirror: bool = False
    ) -> "Similarity":
        """Mirror in the x axis (if asked), turn by `angle` (radians), scale, then move by `offset`."""
        cos, sin = scale * np.cos(angle), scale * np.sin(angle)
        flip = -1.0 if mirror else 1.0
        return cls(frozen([[cos, -sin * flip], [sin, cos * flip]]), frozen(offset))

    @classmethod
    def carrying(cls, source: tuple[ArrayLike, ArrayLike], target: tuple[ArrayLike, ArrayLike]) -> "Similarity":
        """Return the direct similarity that carries two points onto two points.

        Raises
        ------
        ZeroDivisionError
            If the two source points coincide.
        """
        (a, b), (c, d) = (tuple(complex(*np.asarray(p, float)) for p in pair) for pair in (source, target))
        turn = (d - c) / (b - a)
        offset = c - turn * a
        return cls(frozen([[turn.real, -turn.imag], [turn.imag, turn.real]]), frozen([offset.real, offset.imag]))

    @property
    def scale(self) -> float:
        """Factor by which lengths grow."""
        return float(np.sqrt(abs(np.linalg.det(self.matrix))))

    @property
    def mirrors(self) -> bool:
        """Whether orientation is reversed."""
        return bool(np.linalg.det(self.matrix) < 0)

    def apply(self, points: ArrayLike) -> Floats:
        """Map points of shape (..., 2)."""
        return np.asarray(points, float) @ self.matrix.T + self.offset


class Edge(ABC):
    """One exact boundary curve with its direction; see the module's text for the parameter ``u``."""

    __slots__ = ()

    @abstractmethod
    def derivatives(self, u: ArrayLike) -> Floats:
        """Return position, first and second derivative by ``u``: shape (n, 3, 2) for n parameters."""

    @abstractmethod
    def reversed(self) -> "Edge":
        """Return the same curve run through backwards."""

    @abstractmethod
    def transformed(self, similarity: Similarity) -> "Edge":
        """Return the curve's image; the kind stays the same."""

    @abstractmethod
    def split(self, u: float) -> "tuple[Edge, Edge]":
        """Cut at ``0 < u < 1``."""

    @abstractmethod
    def spans(self) -> tuple[Floats, Floats]:
        """Return the curve as rational Bezier pieces.

        Returns
        -------
        control : (k, degree + 1, 3) array
            Homogeneous control points (w x, w y, w).
        breaks : (k + 1,) array
            ``u`` at the pieces' ends.
        """

    def point(self, u: ArrayLike) -> Floats:
        """Return positions at the parameters ``u``: shape (n, 2), mm."""
        return self.derivatives(u)[:, 0]

    @property
    def start(self) -> Floats:
        """First point, (2,)."""
        return self.point([0.0])[0]

    @property
    def end(self) -> Floats:
        """Last point, (2,)."""
        return self.point([1.0])[0]

    @property
    def is_closed(self) -> bool:
        """Whether start and end coincide to rounding."""
        size = np.max(np.abs(self.bounds())) + 1e-300
        return bool(np.linalg.norm(self.end - self.start) <= 1e-12 * size)

    def length(self) -> float:
        """Arc length, mm; Gauss quadrature on each span, good to about 1e-10 relative, near a cusp to 1e-5."""
        return float(self.length_up_to(1.0))

    def length_up_to(self, u: float) -> float:
        """Arc length from the start to ``u``, mm."""
        nodes, weights = self._quadrature(u)
        return float(weights @ np.linalg.norm(self.derivatives(nodes)[:, 1], axis=1))

    def area_integral(self) -> float:
        """Half the integral of x dy - y dx along the curve: a closed loop's sum is its signed area, mm2."""
        nodes, weights = self._quadrature(1.0)
        values = self.derivatives(nodes)
        point, tangent = values[:, 0], values[:, 1]
        return float(weights @ (point[:, 0] * tangent[:, 1] - point[:, 1] * tangent[:, 0]) / 2)

    def bounds(self) -> Floats:
        """Return a box that surely holds the curve, tight to a hundredth of its size: ((xmin, ymin), (xmax, ymax)).

        The box of the control points of each span cut in eight: never too small, and fast.
        """
        control, _ = self.spans()
        for _ in range(3):
            control = _halved(control)
        points = control[..., :2] / control[..., 2:]
        return np.array([points.min(axis=(0, 1)), points.max(axis=(0, 1))])

    def flattened(self, count_per_span: int = 16) -> Floats:
        """Return points along the curve for pictures and coarse tests, ends included: (n, 2)."""
        _, breaks = self.spans()
        steps = np.linspace(0.0, 1.0, count_per_span + 1)[:-1]
        u = (breaks[:-1, None] + steps * np.diff(breaks)[:, None]).ravel()
        return self.point(np.append(u, 1.0))

    def _quadrature(self, u: float) -> tuple[Floats, Floats]:
        """Gauss nodes and weights on [0, u], piece by piece between the span breaks, each cut in two."""
        _, breaks = self.spans()
        breaks = np.append(breaks[breaks < u], u)
        breaks = np.sort(np.concatenate([breaks, (breaks[1:] + breaks[:-1]) / 2]))
        middle, half = (breaks[1:] + breaks[:-1]) / 2, np.diff(breaks) / 2
        nodes = (middle[:, None] + half[:, None] * _GAUSS_NODES).ravel()
        return nodes, (half[:, None] * _GAUSS_WEIGHTS).ravel()


@dataclass(frozen=True, slots=True, eq=False)
class Line(Edge):
    """Straight segment from `first` to `last`, (2,) each."""

    first: Floats
    last: Floats

    @classmethod
    def of(cls, first: ArrayLike, last: ArrayLike) -> "Line":
        """Make a line from two points."""
        return cls(frozen(first), frozen(last))

    def derivatives(self, u: ArrayLike) -> Floats:
        """See `Edge.derivatives`."""
        u = np.atleast_1d(np.asarray(u, float))[:, None]
        chord = self.last - self.first
        position = self.first * (1 - u) + self.last * u
        return np.stack([position, np.broadcast_to(chord, position.shape), np.zeros_like(position)], axis=1)

    def reversed(self) -> "Line":
        """See `Edge.reversed`."""
        return Line(self.last, self.first)

    def transformed(self, similarity: Similarity) -> "Line":
        """See `Edge.transformed`."""
        return Line.of(similarity.apply(self.first), similarity.apply(self.last))

    def split(self, u: float) -> "tuple[Line, Line]":
        """See `Edge.split`."""
        middle = frozen(self.point([u])[0])
        return Line(self.first, middle), Line(middle, self.last)

    def length_up_to(self, u: float) -> float:
        """See `Edge.length_up_to`; exact."""
        return float(u * np.hypot(*(self.last - self.first)))

    def area_integral(self) -> float:
        """See `Edge.area_integral`; exact."""
        return float(self.first[0] * self.last[1] - self.first[1] * self.last[0]) / 2

    def bounds(self) -> Floats:
        """See `Edge.bounds`; exact."""
        return np.array([np.minimum(self.first, self.last), np.maximum(self.first, self.last)])

    def spans(self) -> tuple[Floats, Floats]:
        """See `Edge.spans`."""
        return np.array([[(*self.first.tolist(), 1.0), (*self.last.tolist(), 1.0)]]), np.array([0.0, 1.0])


@dataclass(frozen=True, slots=True, eq=False)
class EllipseArc(Edge):
    """Arc of an ellipse: ``centre + cos(t) axis_a + sin(t) axis_b``, t from `start_angle` over `sweep` (signed).

    Attributes
    ----------
    centre : (2,) array
    axis_a, axis_b : (2,) arrays
        Perpendicular semi-axes, mm; together they may be left-handed.
    start_angle, sweep : float
        Eccentric angles, radians; ``0 < |sweep| <= 2 pi``.
    """

    centre: Floats
    axis_a: Floats
    axis_b: Floats
    start_angle: float
    sweep: float

    def derivatives(self, u: ArrayLike) -> Floats:
        """See `Edge.derivatives`."""
        u = np.atleast_1d(np.asarray(u, float))
        angle = self.start_angle + u * self.sweep
        cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
        outward = cos * self.axis_a + sin * self.axis_b
        along = -sin * self.axis_a + cos * self.axis_b
        return np.stack([self.centre + outward, self.sweep * along, -(self.sweep**2) * outward], axis=1)

    def reversed(self) -> "EllipseArc":
        """See `Edge.reversed`."""
        return replace(self, start_angle=self.start_angle + self.sweep, sweep=-self.sweep)

    def transformed(self, similarity: Similarity) -> "EllipseArc":
        """See `Edge.transformed`."""
        return replace(
            self,
            centre=frozen(similarity.apply(self.centre)),
            axis_a=frozen(similarity.matrix @ self.axis_a),
            axis_b=frozen(similarity.matrix @ self.axis_b),
        )

    def split(self, u: float) -> "tuple[EllipseArc, EllipseArc]":
        """See `Edge.split`."""
        rest = replace(self, start_angle=self.start_angle + u * self.sweep, sweep=(1 - u) * self.sweep)
        return replace(self, sweep=u * self.sweep), rest

    def area_integral(self) -> float:
        """See `Edge.area_integral`; exact: the chord's part and the segment's.

        The centre's part and the sector's would do too, but on a nearly straight arc both are huge and cancel.
        """
        (ax, ay), (bx, by) = self.start, self.end
        sector = self.axis_a[0] * self.axis_b[1] - self.axis_a[1] * self.axis_b[0]
        return float(ax * by - ay * bx + sector * (self.sweep - np.sin(self.sweep))) / 2

    def spans(self) -> tuple[Floats, Floats]:
        """See `Edge.spans`; rational quadratics of at most 90 degrees (The NURBS Book, section 7.3)."""
        count = max(1, math.ceil(abs(self.sweep) / _MAX_ARC_SPAN))
        (x, y), (ax, ay), (bx, by) = self.centre.tolist(), self.axis_a.tolist(), self.axis_b.tolist()
        weight = math.cos(self.sweep / count / 2)
        rows = []
        for i in range(2 * count + 1):  # ends, and between them the points where neighbouring tangents meet
            angle = self.start_angle + i * self.sweep / (2 * count)
            cos, sin, w = math.cos(angle), math.sin(angle), weight if i % 2 else 1.0
            rows.append((w * x + cos * ax + sin * bx, w * y + cos * ay + sin * by, w))
        control = [rows[i : i + 3] for i in range(0, 2 * count, 2)]
        return np.array(control), np.array([i / count for i in range(count + 1)])


@dataclass(frozen=True, slots=True, eq=False)
class Arc(EllipseArc):
    """Circular arc: an `EllipseArc` whose semi-axes have the same length."""

    @classmethod
    def of(cls, centre: ArrayLike, radius: float, start_angle: float = 0.0, sweep: float = 2 * np.pi) -> "Arc":
        """Make an arc; angles in radians, counter-clockwise for a positive `sweep`."""
        return cls(frozen(centre), frozen([radius, 0.0]), frozen([0.0, radius]), float(start_angle), float(sweep))

    @property
    def radius(self) -> float:
        """Radius, mm."""
        return float(np.hypot(*self.axis_a))

    def length_up_to(self, u: float) -> float:
        """See `Edge.length_up_to`; exact."""
        return self.radius * abs(self.sweep) * u

    @property
    def is_counter_clockwise(self) -> bool:
        """Whether the arc turns left on its way."""
        cross = self.axis_a[0] * self.axis_b[1] - self.axis_a[1] * self.axis_b[0]
        return bool(cross * self.sweep > 0)


@dataclass(frozen=True, slots=True, eq=False)
class BSpline(Edge):
    """Clamped, possibly rational B-spline curve.

    Attributes
    ----------
    degree : int
    knots : (n + degree + 1,) array
        Non-decreasing, end knots of multiplicity degree + 1.
    poles : (n, 2) array
    weights : (n,) array
        Positive.
    """

    degree: int
    knots: Floats
    poles: Floats
    weights: Floats

    @classmethod
    def of(cls, degree: int, knots: ArrayLike, poles: ArrayLike, weights: ArrayLike | None = None) -> "BSpline":
        """Make a B-spline; an unclamped (e.g. periodic, unrolled) knot vector is clamped by knot insertion.

        Raises
        ------
        ValueError
            If counts do not match, knots fall, or a weight is not positive.
        """
        knot_array, pole_array = np.array(knots, float), np.array(poles, float)
        weight_array = np.ones(len(pole_array)) if weights is None else np.array(weights, float)
        if degree < 1 or len(pole_array) < degree + 1 or len(knot_array) != len(pole_array) + degree + 1:
            raise ValueError(f"{len(pole_array)} poles and {len(knot_array)} knots do not make degree {degree}")
        if len(weight_array) != len(pole_array) or not np.all(weight_array > 0):
            raise ValueError("weights must be positive, one for each pole")
        if np.any(np.diff(knot_array) < 0) or not np.all(np.isfinite(pole_array)):
            raise ValueError("knots must not fall and poles must be finite")
        homogeneous = np.column_stack([pole_array * weight_array[:, None], weight_array])
        knot_array, homogeneous = _clamped(degree, knot_array, homogeneous)
        return cls(
            degree,
            frozen(knot_array),
            frozen(homogeneous[:, :2] / homogeneous[:, 2:]),
            frozen(homogeneous[:, 2]),
        )

    @property
    def is_rational(self) -> bool:
        """Whether weights differ."""
        return bool(np.ptp(self.weights) > 1e-14 * self.weights.max())

    @property
    def start(self) -> Floats:
        """First point, (2,): the first pole, since both ends are clamped."""
        return self.poles[0]

    @property
    def end(self) -> Floats:
        """Last point, (2,)."""
        return self.poles[-1]

    def derivatives(self, u: ArrayLike) -> Floats:
        """See `Edge.derivatives`."""
        u = np.atleast_1d(np.asarray(u, float))
        first, last = self.knots[0], self.knots[-1]
        curve = interpolate.BSpline(self.knots, self._homogeneous(), self.degree)
        t = np.clip(first + u * (last - first), first, last)
        (x0, w0), (x1, w1), (x2, w2) = (
            (values[:, :2], values[:, 2:])
            for values in (curve(t, nu=order) * (last - first) ** order for order in range(3))
        )
        position = x0 / w0
        tangent = (x1 - w1 * position) / w0
        second = (x2 - 2 * w1 * tangent - w2 * position) / w0
        return np.stack([position, tangent, second], axis=1)

    def reversed(self) -> "BSpline":
        """See `Edge.reversed`."""
        knots = frozen(self.knots[0] + self.knots[-1] - self.knots[::-1])
        return replace(self, knots=knots, poles=frozen(self.poles[::-1]), weights=frozen(self.weights[::-1]))

    def transformed(self, similarity: Similarity) -> "BSpline":
        """See `Edge.transformed`."""
        return replace(self, poles=frozen(similarity.apply(self.poles)))

    def split(self, u: float) -> "tuple[BSpline, BSpline]":
        """See `Edge.split`."""
        cut = self.knots[0] + u * (self.knots[-1] - self.knots[0])
        nearest = self.knots[np.argmin(np.abs(self.knots - cut))]
        if abs(nearest - cut) <= 1e-12 * (self.knots[-1] - self.knots[0]):
            cut = nearest  # a knot a hair beside an old one would make a span of no length
        knots, homogeneous = _with_multiplicity(self.degree, self.knots, self._homogeneous(), cut, self.degree)
        at = int(np.searchsorted(knots, cut))  # first of `degree` equal knots
        pole = at - 1
        left = BSpline.of(
            self.degree,
            np.append(knots[: at + self.degree], cut),
            homogeneous[: pole + 1, :2] / homogeneous[: pole + 1, 2:],
            homogeneous[: pole + 1, 2],
        )
        right = BSpline.of(
            self.degree,
            np.insert(knots[at:], 0, cut),
            homogeneous[pole:, :2] / homogeneous[pole:, 2:],
            homogeneous[pole:, 2],
        )
        return left, right

    def spans(self) -> tuple[Floats, Floats]:
        """See `Edge.spans`."""
        if len(self.poles) == self.degree + 1:
            return self._homogeneous()[None], np.array([0.0, 1.0])
        # Knots that occur degree + 1 times inside (a C(-1) spline) never pass `pieces_without_kinks`.
        first = np.flatnonzero(np.diff(self.knots[self.degree : -self.degree]) > 0) + self.degree
        breaks = self.knots[np.append(first, len(self.knots) - 1)]
        return _bezier_pieces(self.degree, self.knots, self._homogeneous(), first), _fractions(breaks)

    def _homogeneous(self) -> Floats:
        """Poles as rows (w x, w y, w)."""
        rows = np.empty((len(self.poles), 3))
        rows[:, 2] = self.weights
        rows[:, :2] = self.poles * rows[:, 2:]
        return rows


def _fractions(knots: Floats) -> Floats:
    return (knots - knots[0]) / (knots[-1] - knots[0])


def _bezier_pieces(degree: int, knots: Floats, homogeneous: Floats, first: NDArray[np.intp]) -> Floats:
    """Return the Bezier control points of all spans: (k, degree + 1, 3), by blossoms.

    Point m of the span [a, b] is the spline's blossom at degree - m times a and m times b; de Boor's scheme evaluates
    it. `first` holds the number of the last knot at the start of each span.
    """
    local = homogeneous[first[:, None] + np.arange(-degree, 1)]
    before, behind = knots[first[:, None] + np.arange(-degree, 1)], knots[first[:, None] + np.arange(1, degree + 1)]
    shares = []  # of the later point in round r, for both ends of a span
    for r in range(degree):
        low, high = before[:, r + 1 :], behind[:, : degree - r]
        shares.append([((u - low) / (high - low))[..., None] for u in (before[:, -1:], behind[:, :1])])
    control = np.empty_like(local)
    for m in range(degree + 1):
        row = local
        for r in range(degree):
            share = shares[r][int(r < m)]
            row = (1.0 - share) * row[:, :-1] + share * row[:, 1:]
        control[:, m] = row[:, 0]
    return control


def _halved(control: Floats) -> Floats:
    """Cut Bezier pieces (k, d + 1, 3) in the middle by de Casteljau: (2 k, d + 1, 3)."""
    left, right, row = [control[:, 0]], [control[:, -1]], control
    while row.shape[1] > 1:
        row = (row[:, 1:] + row[:, :-1]) / 2
        left.append(row[:, 0])
        right.append(row[:, -1])
    return np.concatenate([np.stack(left, axis=1), np.stack(right[::-1], axis=1)])


def _with_multiplicity(
    degree: int, knots: Floats, homogeneous: Floats, knot: float, multiplicity: int
) -> tuple[Floats, Floats]:
    """Insert `knot` until it occurs `multiplicity` times."""
    missing = multiplicity - int(np.count_nonzero(knots == knot))
    if missing <= 0:
        return knots, homogeneous
    refined = interpolate.insert(knot, (knots, list(_padded(homogeneous, len(knots))), degree), m=missing)
    count = len(refined[0]) - degree - 1
    return np.asarray(refined[0]), np.column_stack([column[:count] for column in refined[1]])


def _padded(homogeneous: Floats, knot_count: int) -> Floats:
    """FITPACK's layout: coefficient columns as long as the knot vector, padded by zeros."""
    padded = np.zeros((homogeneous.shape[1], knot_count))
    padded[:, : len(homogeneous)] = homogeneous.T
    return padded


def _clamped(degree: int, knots: Floats, homogeneous: Floats) -> tuple[Floats, Floats]:
    """Clamp both ends to [knots[degree], knots[-degree - 1]] by knot insertion (Boehm)."""
    for _ in range(2):  # once for the front, then mirrored for the back
        first = knots[degree]
        if knots[0] != first:
            while np.count_nonzero(knots == first) < degree:
                knots, homogeneous = _boehm(degree, knots, homogeneous, first)
            at = int(np.searchsorted(knots, first))
            knots, homogeneous = np.insert(knots[at:], 0, first), homogeneous[at - 1 :]
            knots = np.insert(knots, 0, [first] * (degree + 1 - np.count_nonzero(knots == first)))
        knots, homogeneous = -knots[::-1], homogeneous[::-1]
    return knots, homogeneous


def _boehm(degree: int, knots: Floats, homogeneous: Floats, knot: float) -> tuple[Floats, Floats]:
    """Insert `knot` once (The NURBS Book, equation 5.15); unlike FITPACK it may lie outside a clamped interior."""
    k = int(np.searchsorted(knots, knot, side="right")) - 1
    rows = [homogeneous[: k - degree + 1]]
    for i in range(k - degree + 1, k + 1):
        if knots[i] == knot:
            rows.append(homogeneous[i - 1 : k])
            break
        ratio = (knot - knots[i]) / (knots[i + degree] - knots[i])
        rows.append((ratio * homogeneous[i] + (1 - ratio) * homogeneous[i - 1])[None])
    rows.append(homogeneous[k:])
    return np.insert(knots, k + 1, knot), np.concatenate(rows)
