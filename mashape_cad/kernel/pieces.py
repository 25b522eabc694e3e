"""A boundary cut into pieces that the kernel can be asked about: `Piece`, `pieces_of`.

Lines and arcs of at most 90 degrees stay what they are: the kernel has closed answers for them. Arcs of ellipses and
B-splines become rational Bezier curves, because the kernel's search for extrema is much better on those: in 550,000
trials of random points and spans it overlooked the nearest point 3 times, but 221 times on ranges of the B-spline.
B-splines are cut by the kernel itself.
"""

from collections.abc import Iterator

import numpy as np
from OCP.Extrema import Extrema_ExtPC2d, Extrema_LocateExtPC2d
from OCP.Geom2d import Geom2d_BezierCurve
from OCP.Geom2dAdaptor import Geom2dAdaptor_Curve
from OCP.Geom2dConvert import Geom2dConvert_BSplineCurveToBezierCurve
from OCP.gp import gp_Pnt2d

from mashape_cad.geometry.edge import Arc, BSpline, Edge, Floats, Line
from mashape_cad.kernel.curves import Twin, bezier

__all__ = ["SAMPLES", "Piece", "pieces_of"]

# Points on a piece, ends included. More make the first bound of its distance tighter, at the cost of a larger tree.
SAMPLES = 9
# Of the kernel's parameter, its own default; a distance is off by about its square.
_TOLERANCE = 1e-10


class Piece:
    """A piece of a boundary as the kernel's curve.

    Attributes
    ----------
    control : (degree + 1, 3) array
        Homogeneous control points (w x, w y, w) of the same curve as a rational Bezier curve.
    is_bezier : bool
        Whether the kernel's parameter is that of the Bezier curve; if not, the kernel's answers are closed forms.
    samples : (SAMPLES, 2) array
        Points of the kernel's curve, ends included.
    """

    __slots__ = ("_adaptor", "_extrema", "_range", "control", "is_bezier", "samples")

    def __init__(self, adaptor: Geom2dAdaptor_Curve, control: Floats, *, is_bezier: bool) -> None:
        first, last = adaptor.FirstParameter(), adaptor.LastParameter()
        parameters = np.linspace(first, last, SAMPLES).tolist()
        self.control = control
        self.is_bezier = is_bezier
        self.samples = np.array([(point.X(), point.Y()) for point in map(adaptor.Value, parameters)])
        self._adaptor = adaptor  # the extrema only point to it
        self._range = first, last
        self._extrema = Extrema_ExtPC2d()
        self._extrema.Initialize(adaptor, first, last, _TOLERANCE)

    def nearest(self, place: gp_Pnt2d) -> tuple[float, float]:
        """Return distance and parameter of the nearest stationary point that the kernel reports.

        If there is none, the distance is infinite and the parameter that of the middle. At the centre of a circle all
        points are stationary, and the kernel reports that as a failure. It also takes lines and arcs for 1e-7 longer
        than they are: what it reports beyond their ends does not count.
        """
        extrema, (first, last) = self._extrema, self._range
        extrema.Perform(place)
        if not extrema.IsDone():
            return float(np.hypot(*(self.samples[0] - (place.X(), place.Y())))), self._adaptor.FirstParameter()
        square, parameter = np.inf, (first + last) / 2
        for index in range(1, extrema.NbExt() + 1):
            found = extrema.SquareDistance(index)
            if found < square and first <= (at := extrema.Point(index).Parameter()) <= last:
                square, parameter = found, at
        return square**0.5, parameter

    def nearest_from(self, place: gp_Pnt2d, parameter: float) -> tuple[float, float]:
        """Return distance and parameter of the point that a local search leads to, never further than its start."""
        here = place.Distance(self._adaptor.Value(parameter))
        search = Extrema_LocateExtPC2d(place, self._adaptor, parameter, _TOLERANCE)
        if search.IsDone() and (found := search.SquareDistance() ** 0.5) < here:
            return found, search.Point().Parameter()
        return here, parameter

    def point(self, parameter: float) -> tuple[float, float]:
        """Return the point at one of the kernel's parameters."""
        point = self._adaptor.Value(parameter)
        return point.X(), point.Y()


def pieces_of(edge: Edge) -> Iterator[Piece]:
    """Cut an edge into pieces.

    Raises
    ------
    ValueError
        If the edge has no length.
    """
    twin = Twin.of(edge)
    controls, breaks = edge.spans()
    if isinstance(edge, Line | Arc):
        for control, low, high in zip(controls, breaks[:-1], breaks[1:], strict=True):
            yield Piece(twin.adaptor(low, high), control, is_bezier=False)
        return
    for curve in _bezier_curves(edge, twin, controls):
        yield Piece(Geom2dAdaptor_Curve(curve), _control(curve), is_bezier=True)


def _bezier_curves(edge: Edge, twin: Twin, controls: Floats) -> list[Geom2d_BezierCurve]:
    if isinstance(edge, BSpline):
        convert = Geom2dConvert_BSplineCurveToBezierCurve(twin.curve)
        return [convert.Arc(index) for index in range(1, convert.NbArcs() + 1)]
    return [bezier(control[:, :2] / control[:, 2:], control[:, 2]) for control in controls]


def _control(curve: Geom2d_BezierCurve) -> Floats:
    rows = []
    for index in range(1, curve.NbPoles() + 1):
        pole, weight = curve.Pole(index), curve.Weight(index)
        rows.append((pole.X() * weight, pole.Y() * weight, weight))
    return np.array(rows)
