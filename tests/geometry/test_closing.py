import numpy as np
import pytest

from mashape_cad.geometry.closing import closed_loop
from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line, frozen


def open_joints(loop):
    """Distances between the ends that should meet."""
    return [float(np.linalg.norm(a.end - b.start)) for a, b in zip(loop.edges, np.roll(loop.edges, -1), strict=True)]


def test_lines_meet_to_the_last_bit_and_the_gaps_are_on_record():
    """A triangle with three gaps."""
    fit = closed_loop([Line.of((0, 0), (3.99, 0)), Line.of((4, 0.02), (0, 3)), Line.of((0.0, 2.97), (0, 0))])
    assert open_joints(fit.loop) == [0, 0, 0]
    assert fit.gaps == pytest.approx([0, np.hypot(0.01, 0.02), 0.03])
    assert all(isinstance(edge, Line) for edge in fit.loop.edges)


def test_a_line_goes_to_the_curve_and_the_curve_stays_where_it_is():
    """A slot with gaps where lines meet arcs: centres and radii are untouched."""
    arcs = [Arc.of((4, 0), 1.0, -np.pi / 2, np.pi), Arc.of((0, 0), 1.0, np.pi / 2, np.pi)]
    fit = closed_loop([Line.of((0.01, -1), (3.99, -1)), arcs[0], Line.of((3.98, 1), (0, 1)), arcs[1]])
    assert max(open_joints(fit.loop)) <= 1e-15
    assert fit.loop.edges[1] is arcs[0]
    assert fit.loop.edges[3] is arcs[1]


def test_two_arcs_meet_halfway_and_stay_arcs_with_their_sweep():
    """Each is carried onto the joined ends by a similarity."""
    arcs = [Arc.of((0, 0), 5.0, 0.0, np.pi), Arc.of((0.01, 0), 5.0, np.pi, np.pi)]
    fit = closed_loop(arcs)
    assert max(open_joints(fit.loop)) <= 1e-14
    assert [type(edge) for edge in fit.loop.edges] == [Arc, Arc]
    assert [edge.sweep for edge in fit.loop.edges] == [np.pi, np.pi]
    assert np.allclose(fit.loop.edges[0].start, (5.005, 0))


def test_an_arc_of_nearly_a_full_turn_keeps_its_radius():
    """Its ends are close together: carrying it onto new ones would change its size, so the line comes to it."""
    arc = Arc.of((0, 0), 5.0, 0.01, 2 * np.pi - 0.02)
    fit = closed_loop([arc, Line.of((5, -0.06), (5, 0.06))])
    assert fit.loop.edges[0] is arc
    assert max(open_joints(fit.loop)) <= 1e-15


def test_a_c_shaped_arc_becomes_a_full_circle():
    """The gap is closed along the circle, clockwise or not."""
    (arc,) = closed_loop([Arc.of((1, 2), 5.0, 0.3, -2 * np.pi + 1e-4)]).loop.edges
    assert arc.sweep == -2 * np.pi
    assert arc.start_angle == 0.3


def test_a_c_shaped_ellipse_becomes_a_full_ellipse():
    """Likewise."""
    ellipse = EllipseArc(frozen([0, 0]), frozen([5, 0]), frozen([0, 2]), 1.0, 2 * np.pi - 1e-3)
    (closed,) = closed_loop([ellipse]).loop.edges
    assert closed.sweep == 2 * np.pi


def test_a_c_shaped_spline_closes_by_spreading_the_gap_evenly():
    """A cubic moves by the gap times (1/2 - u), exactly: half at each end, nothing in the middle."""
    poles = [(0, 0), (2, 2), (4, 2), (6, 0), (4, -2), (2, -2), (0.0, -0.1)]
    spline = BSpline.of(3, [0, 0, 0, 0, 0.2, 0.5, 0.9, 1, 1, 1, 1], poles)
    (closed,) = closed_loop([spline]).loop.edges
    u = np.linspace(0, 1, 11)
    expected = spline.point(u) + (0.5 - u)[:, None] * np.array([0, -0.1])
    assert np.allclose(closed.point(u), expected, rtol=0, atol=1e-14)
    assert np.allclose(closed.start, closed.end, rtol=0, atol=1e-15)


def test_a_closed_curve_is_left_alone():
    """A full circle far from the origin is not touched, although rounding opens it by a hair."""
    circle = Arc.of((1e7, -3e6), 5.0, 0.7)
    assert closed_loop([circle]).loop.edges[0] is circle
