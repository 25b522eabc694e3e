import numpy as np
import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
from OCP.Geom import (
    Geom_BezierCurve,
    Geom_BSplineCurve,
    Geom_Circle,
    Geom_Ellipse,
    Geom_Hyperbola,
    Geom_Line,
    Geom_OffsetCurve,
    Geom_Parabola,
    Geom_Plane,
)
from OCP.Geom2d import Geom2d_Circle
from OCP.gp import gp_Ax2, gp_Ax3, gp_Ax22d, gp_Dir, gp_Pln, gp_Pnt, gp_Trsf, gp_Vec
from OCP.TColgp import TColgp_Array1OfPnt
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS

from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line
from mashape_cad.kernel import distances
from mashape_cad.kernel.flattening import flat_edge
from mashape_cad.kernel.frames import Frame, coordinates

# A slanted plane, far from the origin by ten sizes.
_AXES = gp_Ax2(gp_Pnt(300, -200, 100), gp_Dir(1, 2, 3), gp_Dir(-2, 1, 0.1))
_FRAME = Frame.of(gp_Pln(gp_Ax3(_AXES)), reverse=False)


def _in_space(x, y):
    return gp_Pnt(*(_FRAME.origin + x * _FRAME.axes[0] + y * _FRAME.axes[1]).tolist())


def _poles(seed, count):
    rng = np.random.default_rng(seed)
    array = TColgp_Array1OfPnt(1, count)
    for index in range(1, count + 1):
        array.SetValue(index, _in_space(*(20 * rng.normal(size=2)).tolist()))
    return array


def _reals(values):
    array = TColStd_Array1OfReal(1, len(values))
    for index, value in enumerate(values, start=1):
        array.SetValue(index, float(value))
    return array


def _integers(values):
    array = TColStd_Array1OfInteger(1, len(values))
    for index, value in enumerate(values, start=1):
        array.SetValue(index, value)
    return array


def _spline(seed=1, rational=False):
    weights = [_reals([1, 2, 0.5, 1, 1, 3, 1])] if rational else []
    return Geom_BSplineCurve(_poles(seed, 7), *weights, _reals([0, 1, 2, 5, 7]), _integers([4, 1, 1, 1, 4]), 3, False)


def _periodic():
    return Geom_BSplineCurve(_poles(3, 6), _reals(range(7)), _integers([1] * 7), 3, True)


_CURVES = {
    "line": (Geom_Line(_in_space(3, 4), gp_Dir(*_FRAME.axes[0].tolist())), -3.0, 8.0, Line),
    "arc": (Geom_Circle(_AXES, 7.0), 0.4, 3.0, Arc),
    "arc past the seam": (Geom_Circle(_AXES, 7.0), 5.0, 9.0, Arc),
    "circle": (Geom_Circle(_AXES, 7.0), 0.0, 2 * np.pi, Arc),
    "ellipse": (Geom_Ellipse(_AXES, 7.0, 3.0), 0.0, 2 * np.pi, EllipseArc),
    "arc of an ellipse": (Geom_Ellipse(_AXES, 7.0, 3.0), 2.0, 7.0, EllipseArc),
    "spline": (_spline(), 0.0, 7.0, BSpline),
    "rational spline": (_spline(2, rational=True), 0.0, 7.0, BSpline),
    "part of a spline": (_spline(2, rational=True), 0.7, 5.3, BSpline),
    "periodic spline": (_periodic(), 0.0, 6.0, BSpline),
    "periodic spline from elsewhere": (_periodic(), 2.5, 8.5, BSpline),
    "part of a periodic spline across its seam": (_periodic(), 4.5, 7.3, BSpline),
    "Bezier curve": (Geom_BezierCurve(_poles(4, 5)), 0.0, 1.0, BSpline),
    "part of a Bezier curve": (Geom_BezierCurve(_poles(4, 5)), 0.2, 0.9, BSpline),
    "parabola": (Geom_Parabola(_AXES, 2.0), -3.0, 5.0, BSpline),
    "hyperbola": (Geom_Hyperbola(_AXES, 4.0, 3.0), -1.0, 1.5, BSpline),
}


def _flat_points(curve, count=101):
    parameters = np.linspace(curve.FirstParameter(), curve.LastParameter(), count).tolist()
    return _FRAME.flat([coordinates(curve.Value(parameter)) for parameter in parameters])


@pytest.mark.parametrize(("curve", "first", "last", "kind"), _CURVES.values(), ids=_CURVES)
def test_edges_are_exact(curve, first, last, kind):
    """Points at the same parameter agree to 1e-12 of the size; a hyperbola has another parameter, so its distance."""
    adaptor = BRepAdaptor_Curve(BRepBuilderAPI_MakeEdge(curve, first, last).Edge())
    flat = flat_edge(adaptor, _FRAME)
    expected = _flat_points(adaptor)
    size = np.ptp(expected, axis=0).max()
    assert type(flat.edge) is kind
    assert not flat.is_approximation
    if isinstance(curve, Geom_Hyperbola):
        assert distances([flat.edge], expected).max() <= 1e-12 * size
        expected = expected[[0, -1]]
        actual = flat.edge.point([0, 1])
    else:
        actual = flat.edge.point(np.linspace(0, 1, 101))
    assert np.abs(actual - expected).max() <= 1e-12 * size
    assert flat.error <= 1e-12 * size
    assert flat.height <= 1e-12 * size


def test_a_spline_keeps_poles_knots_and_weights():
    """The numbers of the kernel's spline, only turned into the plane."""
    edge = flat_edge(BRepAdaptor_Curve(BRepBuilderAPI_MakeEdge(_spline(2, rational=True)).Edge()), _FRAME).edge
    assert edge.knots.tolist() == [0, 0, 0, 0, 1, 2, 5, 7, 7, 7, 7]
    assert edge.weights == pytest.approx([1, 2, 0.5, 1, 1, 3, 1], rel=1e-15)
    poles = _FRAME.flat([coordinates(pole) for pole in _poles(2, 7)])
    assert edge.poles == pytest.approx(poles, abs=1e-12)


def test_a_circle_has_a_full_turn_and_one_radius():
    """Not 2 pi less a rounding error, and semi-axes of the same length at a right angle."""
    edge = flat_edge(BRepAdaptor_Curve(BRepBuilderAPI_MakeEdge(Geom_Circle(_AXES, 7.0)).Edge()), _FRAME).edge
    assert abs(edge.sweep) == 2 * np.pi
    assert edge.radius == pytest.approx(7.0, rel=1e-15)
    assert edge.axis_a @ edge.axis_b == pytest.approx(0, abs=1e-13)
    assert edge.is_closed


def test_seen_from_behind_a_circle_turns_the_other_way():
    """The reversed frame mirrors."""
    behind = Frame.of(gp_Pln(gp_Ax3(_AXES)), reverse=True)
    adaptor = BRepAdaptor_Curve(BRepBuilderAPI_MakeEdge(Geom_Circle(_AXES, 7.0)).Edge())
    front_edge, back_edge = flat_edge(adaptor, _FRAME).edge, flat_edge(adaptor, behind).edge
    assert front_edge.is_counter_clockwise
    assert not back_edge.is_counter_clockwise
    assert back_edge.point([0.1])[0] == pytest.approx(front_edge.point([0.1])[0] * (1, -1), abs=1e-12)


def test_an_edge_in_another_place_is_moved_with_its_location():
    """An instance of an assembly carries its place; the shared curve itself stays as it is."""
    move = gp_Trsf()
    move.SetTranslation(gp_Vec(*(5 * _FRAME.axes[0] - 2 * _FRAME.axes[1]).tolist()))
    edge = BRepBuilderAPI_MakeEdge(_spline(), 0.5, 3.0).Edge()
    here = flat_edge(BRepAdaptor_Curve(edge), _FRAME).edge
    there = flat_edge(BRepAdaptor_Curve(TopoDS.Edge_s(edge.Moved(TopLoc_Location(move)))), _FRAME).edge
    again = flat_edge(BRepAdaptor_Curve(edge), _FRAME).edge
    assert there.poles == pytest.approx(here.poles + np.array([5, -2]), abs=1e-12)
    assert np.array_equal(again.poles, here.poles)


def test_an_offset_curve_is_approximated_and_says_so():
    """To a millionth of a percent of its size."""
    offset = Geom_OffsetCurve(_spline(), 1.0, gp_Dir(*_FRAME.axes[2].tolist()))
    adaptor = BRepAdaptor_Curve(BRepBuilderAPI_MakeEdge(offset).Edge())
    flat = flat_edge(adaptor, _FRAME)
    points = _flat_points(adaptor, 301)
    assert flat.is_approximation
    assert distances([flat.edge], points).max() <= 3e-8 * np.ptp(points, axis=0).max()
    assert flat.error <= 3e-8 * np.ptp(points, axis=0).max()


@pytest.mark.parametrize("backwards", [False, True])
def test_a_curve_given_only_on_the_plane_is_exact(backwards):
    """Some programs write no curve in space for a face that is flat."""
    circle = Geom2d_Circle(gp_Ax22d(), 5.0)
    made = BRepBuilderAPI_MakeEdge(circle, Geom_Plane(gp_Ax3(_AXES)), 0.0, 2.0).Edge()
    frame = Frame.of(gp_Pln(gp_Ax3(_AXES)), reverse=backwards)
    flat = flat_edge(BRepAdaptor_Curve(made), frame)
    assert isinstance(flat.edge, Arc)
    assert not flat.is_approximation
    assert flat.edge.start == pytest.approx([5, 0], abs=1e-12)
    assert flat.edge.end[0] == pytest.approx(5 * np.cos(2.0), abs=1e-12)


def test_a_curve_that_leaves_the_plane_tells_its_height():
    """A circle tilted by 1e-3 rad reaches 7e-3 out of the plane."""
    tilted = gp_Ax2(_AXES.Location(), gp_Dir(*(_FRAME.axes[2] + 1e-3 * _FRAME.axes[0]).tolist()))
    flat = flat_edge(BRepAdaptor_Curve(BRepBuilderAPI_MakeEdge(Geom_Circle(tilted, 7.0)).Edge()), _FRAME)
    assert flat.height == pytest.approx(7e-3, rel=0.2)
    assert 1e-7 < flat.error < 1e-5


def test_an_infinite_line_is_refused():
    """It bounds nothing."""
    with pytest.raises(ValueError, match="infinite"):
        flat_edge(BRepAdaptor_Curve(BRepBuilderAPI_MakeEdge(Geom_Line(gp_Pnt(), gp_Dir(1, 0, 0))).Edge()), _FRAME)
