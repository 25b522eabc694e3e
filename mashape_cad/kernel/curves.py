"""An `Edge` as the kernel's own curve: `KernelCurve`.

The kernel's curve is made of the very numbers of the edge (points, centre and axes, poles, knots and weights), so the
two differ by rounding only: about 2e-16 of the size in position, 2e-15 in the second derivative. The kernel keeps its
own parameter (length on lines, angle on arcs, knot parameter on B-splines); all three are linear in the edge's ``u``.
"""

from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import ArrayLike
from OCP.Geom2d import Geom2d_BezierCurve, Geom2d_BSplineCurve, Geom2d_Circle, Geom2d_Curve, Geom2d_Ellipse, Geom2d_Line
from OCP.Geom2dAdaptor import Geom2dAdaptor_Curve
from OCP.gp import gp_Ax22d, gp_Dir2d, gp_Pnt2d, gp_Vec2d
from OCP.TColgp import TColgp_Array1OfPnt2d
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line

__all__ = ["KernelCurve", "Twin", "bezier"]


@dataclass(frozen=True, slots=True, eq=False)
class Twin:
    """The kernel's curve of an edge, for use inside this package: its parameter is ``first + u * rate``."""

    curve: Geom2d_Curve
    first: float
    rate: float

    @classmethod
    def of(cls, edge: Edge) -> "Twin":
        """Make the kernel's curve of an edge.

        Raises
        ------
        ValueError
            If the edge has no length.
        """
        match edge:
            case Line():
                return _line(edge)
            case Arc():
                # A radius and not two semi-axes: the kernel knows closed answers for circles.
                curve = Geom2d_Circle(_axes(edge.centre, edge.axis_a, edge.axis_b), edge.radius)
                return cls(curve, edge.start_angle, edge.sweep)
            case EllipseArc():
                return _ellipse(edge)
            case BSpline():
                return cls(_spline(edge), float(edge.knots[0]), float(edge.knots[-1] - edge.knots[0]))
        raise TypeError(f"no kernel curve for {type(edge).__name__}")

    def adaptor(self, low: float = 0.0, high: float = 1.0) -> Geom2dAdaptor_Curve:
        """Return the kernel's view of the piece between two parameters ``u``."""
        ends = sorted((self.first + low * self.rate, self.first + high * self.rate))
        return Geom2dAdaptor_Curve(self.curve, *ends)


class KernelCurve:
    """One edge, evaluated by the kernel.

    Parameters
    ----------
    edge : Edge
        Of any kind and not of zero length.

    Raises
    ------
    ValueError
        If the edge has no length.
    """

    __slots__ = ("_adaptor", "_twin")

    def __init__(self, edge: Edge) -> None:
        self._twin = Twin.of(edge)
        self._adaptor = self._twin.adaptor()

    def derivatives(self, u: ArrayLike) -> Floats:
        """Return position, first and second derivative by the edge's own ``u``.

        Parameters
        ----------
        u : array_like
            n parameters in [0, 1].

        Returns
        -------
        (n, 3, 2) array
            Shaped as what `Edge.derivatives` returns, mm.
        """
        parameters = self._twin.first + np.atleast_1d(np.asarray(u, float)) * self._twin.rate
        point, first, second = gp_Pnt2d(), gp_Vec2d(), gp_Vec2d()
        values = np.empty((len(parameters), 3, 2))
        for row, parameter in zip(values, parameters.tolist(), strict=True):
            self._adaptor.D2(parameter, point, first, second)
            row[:] = (point.X(), point.Y()), (first.X(), first.Y()), (second.X(), second.Y())
        return values * (self._twin.rate ** np.arange(3))[:, None]

    def curvature(self, u: ArrayLike) -> Floats:
        """Return signed curvatures, 1/mm, positive where the edge turns left; nan where it stands still.

        Parameters
        ----------
        u : array_like
            n parameters in [0, 1].
        """
        values = self.derivatives(u)
        first, second = values[:, 1], values[:, 2]
        cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            return cross / np.hypot(first[:, 0], first[:, 1]) ** 3


def _direction(x: float, y: float) -> gp_Dir2d:
    if x == y == 0:
        raise ValueError("an edge without length has no kernel curve")
    return gp_Dir2d(x, y)


def _axes(centre: Floats, axis_a: Floats, axis_b: Floats) -> gp_Ax22d:
    return gp_Ax22d(gp_Pnt2d(*centre.tolist()), _direction(*axis_a.tolist()), _direction(*axis_b.tolist()))


def _line(edge: Line) -> Twin:
    (ax, ay), (bx, by) = edge.first.tolist(), edge.last.tolist()
    return Twin(Geom2d_Line(gp_Pnt2d(ax, ay), _direction(bx - ax, by - ay)), 0.0, hypot(bx - ax, by - ay))


def _ellipse(edge: EllipseArc) -> Twin:
    """Give the kernel the longer semi-axis first: turning the axes by 90 degrees takes as much off the angle."""
    axis_a, axis_b, first = edge.axis_a, edge.axis_b, edge.start_angle
    if np.hypot(*axis_a) < np.hypot(*axis_b):
        axis_a, axis_b, first = axis_b, -axis_a, first - np.pi / 2
    major, minor = float(np.hypot(*axis_a)), float(np.hypot(*axis_b))
    return Twin(Geom2d_Ellipse(_axes(edge.centre, axis_a, axis_b), major, minor), first, edge.sweep)


def _spline(edge: BSpline) -> Geom2d_BSplineCurve:
    knots, counts = _distinct(edge.knots.tolist())
    # The kernel counts end knots degree + 1 times, as we do.
    arguments = (_reals(knots), _integers(counts), edge.degree)
    if edge.is_rational:
        return Geom2d_BSplineCurve(_points(edge.poles), _reals(edge.weights.tolist()), *arguments)
    return Geom2d_BSplineCurve(_points(edge.poles), *arguments)


def _distinct(knots: list[float]) -> tuple[list[float], list[int]]:
    """Return the different knots and how often each occurs."""
    values, counts = [knots[0]], [0]
    for knot in knots:
        if knot == values[-1]:
            counts[-1] += 1
        else:
            values.append(knot)
            counts.append(1)
    return values, counts


def bezier(poles: Floats, weights: Floats) -> Geom2d_BezierCurve:
    """Make the kernel's Bezier curve of poles (n, 2) and weights (n,)."""
    if np.ptp(weights) == 0.0:
        return Geom2d_BezierCurve(_points(poles))
    return Geom2d_BezierCurve(_points(poles), _reals(weights.tolist()))


def _points(poles: Floats) -> TColgp_Array1OfPnt2d:
    array = TColgp_Array1OfPnt2d(1, len(poles))
    for index, (x, y) in enumerate(poles.tolist(), start=1):
        array.SetValue(index, gp_Pnt2d(x, y))
    return array


def _reals(values: list[float]) -> TColStd_Array1OfReal:
    array = TColStd_Array1OfReal(1, len(values))
    for index, value in enumerate(values, start=1):
        array.SetValue(index, value)
    return array


def _integers(values: list[int]) -> TColStd_Array1OfInteger:
    array = TColStd_Array1OfInteger(1, len(values))
    for index, value in enumerate(values, start=1):
        array.SetValue(index, value)
    return array
