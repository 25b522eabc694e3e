"""The kernel's edges on a plane as exact `Edge`: `FlatEdge`, `flat_edge`.

Lines, circles, ellipses and B-splines keep their kind; Bezier curves, parabolas and hyperbolas become the rational
B-splines that they are. What has no such form (offset curves, some curves given on a surface alone) is approximated,
and the error is on record.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from OCP.Approx import Approx_Curve3d
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.Geom import Geom_BSplineCurve, Geom_TrimmedCurve
from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_Shape
from OCP.GeomConvert import GeomConvert

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line, frozen
from mashape_cad.kernel.frames import Frame, coordinates
from mashape_cad.kernel.queries import distances

__all__ = ["FlatEdge", "flat_edge"]

# Of the edge's size: accuracy asked of an approximation, and how many pieces it may have.
_APPROXIMATION = 1e-8
_APPROXIMATION_PIECES = 400
_APPROXIMATION_DEGREE = 5
# Radians: an arc this close to a whole turn is one. A gap of a millionth of a millimetre on a metre.
_WHOLE_TURN = 1e-9
# Of the parameter range: ends this close to a spline's own ends are those.
_SAME_PARAMETER = 1e-12
# Of the coordinates: an error up to here is no reason to look closer.
_ROUNDING = 1e-13
# Where an edge is compared with the kernel's curve, in its parameter.
_CHECKED = (0.0, 0.17, 0.31, 0.5, 0.77, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class FlatEdge:
    """An edge of a face in the face's plane.

    Attributes
    ----------
    edge : Edge
        mm.
    error : float
        Largest distance found from the kernel's curve, seen along the normal, mm: rounding, unless `is_approximation`.
    height : float
        Largest distance found of the kernel's curve from the plane, mm.
    is_approximation : bool
        Whether the kernel's curve has no exact form here.
    """

    edge: Edge
    error: float
    height: float
    is_approximation: bool


def flat_edge(curve: BRepAdaptor_Curve, frame: Frame) -> FlatEdge:
    """Return the kernel's edge, in its own direction, as coordinates in a plane.

    Parameters
    ----------
    curve : BRepAdaptor_Curve
        Of finite length.
    frame : Frame
        Of a plane that the curve lies in.

    Raises
    ------
    ValueError
        If the curve is infinite, or its numbers make no curve.
    """
    first, last = curve.FirstParameter(), curve.LastParameter()
    if not (abs(first) < 1e100 and abs(last) < 1e100):  # noqa: PLR2004  (the kernel's infinity is 2e100)
        raise ValueError("the edge is infinite")
    exact = _EXACT.get(curve.GetType())
    if exact is _exact_spline and not curve.Is3DCurve():
        exact = None  # only the simpler kinds can be had from a curve that is given on a surface alone
    edge = (exact or _approximated)(curve, frame)
    parameters = first + np.array(_CHECKED) * (last - first)
    points = np.stack([coordinates(curve.Value(parameter)) for parameter in parameters.tolist()])
    height = float(np.abs(frame.heights(points)).max())
    return FlatEdge(edge, _error(edge, frame.flat(points)), height, is_approximation=exact is None)


def _error(edge: Edge, expected: Floats) -> float:
    """Return how far an edge is from points at `_CHECKED`, or, if it has another parametrization, anywhere on it."""
    error = float(np.linalg.norm(edge.point(_CHECKED) - expected, axis=1).max())
    if error <= _ROUNDING * float(np.abs(expected).max()):
        return error
    return float(distances([edge], expected).max())


def _line(curve: BRepAdaptor_Curve, frame: Frame) -> Line:
    ends = [coordinates(curve.Value(parameter)) for parameter in (curve.FirstParameter(), curve.LastParameter())]
    return Line.of(*frame.flat(ends))


def _circle(curve: BRepAdaptor_Curve, frame: Frame) -> Arc:
    circle = curve.Circle()
    axis_a, axis_b = _semi_axes(circle, frame, circle.Radius(), circle.Radius())
    centre = frame.flat(coordinates(circle.Location()))
    return Arc(frozen(centre), axis_a, axis_b, float(curve.FirstParameter()), _sweep(curve))


def _ellipse(curve: BRepAdaptor_Curve, frame: Frame) -> EllipseArc:
    ellipse = curve.Ellipse()
    axis_a, axis_b = _semi_axes(ellipse, frame, ellipse.MajorRadius(), ellipse.MinorRadius())
    centre = frame.flat(coordinates(ellipse.Location()))
    return EllipseArc(frozen(centre), axis_a, axis_b, float(curve.FirstParameter()), _sweep(curve))


def _semi_axes(conic: object, frame: Frame, size_a: float, size_b: float) -> tuple[Floats, Floats]:
    """Return perpendicular semi-axes in the plane, whatever rounding made of the conic's own axes."""
    position = conic.Position()  # type: ignore[attr-defined]
    x, y = (frame.turned(coordinates(axis)) for axis in (position.XDirection(), position.YDirection()))
    x = x / np.hypot(*x)
    across = np.array([-x[1], x[0]])
    return frozen(size_a * x), frozen(size_b * np.copysign(1.0, across @ y) * across)


def _sweep(curve: BRepAdaptor_Curve) -> float:
    sweep = float(curve.LastParameter() - curve.FirstParameter())
    return 2 * np.pi if abs(sweep - 2 * np.pi) <= _WHOLE_TURN else sweep


def _spline(curve: BRepAdaptor_Curve, frame: Frame) -> BSpline:
    spline = curve.BSpline().Copy()  # the kernel hands out its own curve
    _trim(spline, curve.FirstParameter(), curve.LastParameter())
    return _flat_spline(spline, frame)


def _exact_spline(curve: BRepAdaptor_Curve, frame: Frame) -> BSpline:
    """Convert what is a rational B-spline by another name."""
    whole = curve.Curve().Curve().Transformed(curve.Trsf())
    part = Geom_TrimmedCurve(whole, curve.FirstParameter(), curve.LastParameter())
    return _flat_spline(GeomConvert.CurveToBSplineCurve_s(part), frame)


def _approximated(curve: BRepAdaptor_Curve, frame: Frame) -> BSpline:
    ends = np.linspace(curve.FirstParameter(), curve.LastParameter(), 9).tolist()
    points = np.stack([coordinates(curve.Value(parameter)) for parameter in ends])
    tol = _APPROXIMATION * float(np.ptp(points, axis=0).max())
    approximation = Approx_Curve3d(curve, tol, GeomAbs_Shape.GeomAbs_C2, _APPROXIMATION_PIECES, _APPROXIMATION_DEGREE)
    if not approximation.HasResult():
        raise ValueError("the edge's curve cannot be approximated")
    return _flat_spline(approximation.Curve(), frame)


def _trim(spline: Geom_BSplineCurve, first: float, last: float) -> None:
    """Cut a spline to a range; a periodic one is unrolled by that."""
    low, high = spline.FirstParameter(), spline.LastParameter()
    near = _SAME_PARAMETER * (high - low)
    is_whole = abs(first - low) <= near and abs(last - high) <= near
    if not is_whole:
        spline.Segment(first, last)
    elif spline.IsPeriodic():
        spline.SetNotPeriodic()


def _flat_spline(spline: Geom_BSplineCurve, frame: Frame) -> BSpline:
    count = spline.NbPoles()
    poles = np.stack([coordinates(spline.Pole(index)) for index in range(1, count + 1)])
    weights = [spline.Weight(index) for index in range(1, count + 1)] if spline.IsRational() else None
    knots = [spline.Knot(index) for index in range(1, spline.NbKnots() + 1)]
    counts = [spline.Multiplicity(index) for index in range(1, spline.NbKnots() + 1)]
    return BSpline.of(spline.Degree(), np.repeat(knots, counts), frame.flat(poles), weights)


_EXACT: dict[GeomAbs_CurveType, Callable[[BRepAdaptor_Curve, Frame], Edge]] = {
    GeomAbs_CurveType.GeomAbs_Line: _line,
    GeomAbs_CurveType.GeomAbs_Circle: _circle,
    GeomAbs_CurveType.GeomAbs_Ellipse: _ellipse,
    GeomAbs_CurveType.GeomAbs_BSplineCurve: _spline,
    GeomAbs_CurveType.GeomAbs_BezierCurve: _exact_spline,
    GeomAbs_CurveType.GeomAbs_Parabola: _exact_spline,
    GeomAbs_CurveType.GeomAbs_Hyperbola: _exact_spline,
}
