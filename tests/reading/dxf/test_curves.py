import math

import numpy as np
import pytest
from drawings import codes, drawn, kinds

from mashape_cad.geometry.edge import Arc, Line
from mashape_cad.reading.dxf.curves import bulge_edge

RING = [(6 * math.cos(t), 4 * math.sin(t)) for t in np.linspace(0, 2 * math.pi, 9)[:-1]]
BELOW = {"extrusion": (0, 0, -1)}


def test_a_circle_is_one_full_arc(tmp_path):
    """Exact area, one edge."""
    part = drawn(tmp_path, lambda space: space.add_circle((3, 4), 2.5))
    assert kinds(part) == ["Arc"]
    assert part.profiles[0].area == pytest.approx(math.pi * 6.25, rel=1e-14)


def test_lines_and_arcs_make_a_slot(tmp_path):
    """Each stays what it is; angles are degrees, counter-clockwise."""

    def draw(space):
        space.add_line((0, -1), (4, -1))
        space.add_arc((4, 0), 1, 270, 90)
        space.add_line((4, 1), (0, 1))
        space.add_arc((0, 0), 1, 90, 270)

    part = drawn(tmp_path, draw)
    assert sorted(kinds(part)) == ["Arc", "Arc", "Line", "Line"]
    assert part.profiles[0].area == pytest.approx(8 + math.pi, rel=1e-13)


def test_an_arc_over_the_positive_x_axis_and_one_of_equal_angles(tmp_path):
    """350 to 10 degrees are 20 degrees; 30 to 30 is a full circle, as CAD programs draw it."""

    def draw(space):
        space.add_arc((0, 0), 3, 350, 10)
        space.add_line((3 * math.cos(math.radians(10)), 3 * math.sin(math.radians(10))), (0, 0))
        space.add_line((0, 0), (3 * math.cos(math.radians(10)), -3 * math.sin(math.radians(10))))
        space.add_arc((50, 0), 2, 30, 30)

    part = drawn(tmp_path, draw)
    areas = [profile.area for profile in part.profiles]
    assert areas == pytest.approx([4 * math.pi, 9 * math.radians(20) / 2], rel=1e-12)


@pytest.mark.parametrize("bulge", [0.3, -0.3, 1.0, -1.0, 2.5, 1e-6])
def test_a_bulge_is_the_tangent_of_a_quarter_of_the_arc(bulge):
    """Positive turns left; the height of the arc over its chord is bulge times half the chord."""
    arc = bulge_edge((1, 2), (5, 5), bulge)
    assert isinstance(arc, Arc)
    assert arc.sweep == pytest.approx(4 * math.atan(bulge), rel=1e-14)
    assert np.allclose([arc.start, arc.end], [(1, 2), (5, 5)], rtol=0, atol=1e-15 / abs(bulge) + 1e-14)
    sagitta = (arc.point([0.5])[0] - (3, 3.5)) @ np.array([3, -4]) / 5
    assert sagitta == pytest.approx(2.5 * bulge, abs=1e-14 + 1e-15 / abs(bulge))


def test_no_bulge_is_a_line():
    """Zero, and rounding of zero."""
    assert isinstance(bulge_edge((0, 0), (1, 0), 0.0), Line)
    assert isinstance(bulge_edge((0, 0), (1, 0), 1e-10), Line)


@pytest.mark.parametrize("kind", ["add_lwpolyline", "add_polyline2d"])
def test_polylines_give_an_edge_for_each_segment(tmp_path, kind):
    """A slot as a closed polyline with two bulges: two lines and two half circles."""
    points = [(0, -1, 0), (4, -1, 1), (4, 1, 0), (0, 1, 1)]
    part = drawn(tmp_path, lambda space: getattr(space, kind)(points, format="xyb", close=True))
    assert kinds(part) == ["Line", "Arc", "Line", "Arc"]
    assert part.profiles[0].area == pytest.approx(8 + math.pi, rel=1e-14)


def test_a_polyline_in_space_is_read_where_it_is_level(tmp_path):
    """A 3D polyline at one height."""
    part = drawn(tmp_path, lambda space: space.add_polyline3d([(0, 0, 2), (4, 0, 2), (4, 3, 2)], close=True))
    assert kinds(part) == ["Line"] * 3
    assert codes(part) == []


def test_the_frame_of_a_spline_fit_polyline_is_no_outline(tmp_path):
    """Vertices marked as control points are shown beside the curve, not as part of it."""

    def draw(space):
        line = space.add_polyline2d([(0, 0), (50, 50), (4, 0), (4, 3)], close=True)
        line.vertices[1].dxf.flags = 16

    assert drawn(tmp_path, draw).profiles[0].area == pytest.approx(6.0)


def test_a_mesh_is_no_outline(tmp_path):
    """POLYLINE is also the name of meshes."""
    part = drawn(tmp_path, lambda space: space.add_polymesh((3, 3)))
    assert codes(part) == ["entity-3d"]


def test_ellipses_whole_and_in_part(tmp_path):
    """Semi-axes and eccentric angles; ratio 1 gives an arc."""

    def draw(space):
        space.add_ellipse((0, 0), (5, 0), 0.4)
        space.add_ellipse((20, 0), (3, 4), 0.5, math.pi, 2 * math.pi)
        space.add_line((17, -4), (23, 4))
        space.add_ellipse((40, 0), (0, 3), 1.0)

    part = drawn(tmp_path, draw)
    assert [profile.area for profile in part.profiles] == pytest.approx([10 * math.pi, 9 * math.pi, 6.25 * math.pi])
    assert kinds(part)[:2] == ["EllipseArc", "Arc"]


def test_seen_from_below_x_is_mirrored(tmp_path):
    """Extrusion (0, 0, -1): arcs, circles and polylines lie at -x and turn the other way."""

    def draw(space):
        space.add_arc((-4, 0), 1, 90, 270, dxfattribs=BELOW)  # bulges to the right, at x = 4
        space.add_line((4, 1), (0, 1))
        space.add_line((0, 1), (0, -1))
        space.add_line((0, -1), (4, -1))
        space.add_circle((-2, 0), 0.5, dxfattribs=BELOW)
        space.add_lwpolyline([(-10, 0), (-14, 0, 1), (-14, 2)], format="xyb", close=True, dxfattribs=BELOW)

    part = drawn(tmp_path, draw)
    plate, cap = part.profiles
    assert plate.area == pytest.approx(8 + math.pi / 2 - math.pi / 4)
    assert np.allclose(plate.bounds, [(0, -1), (5, 1)], atol=0.1)
    assert cap.bounds[0, 0] == pytest.approx(10)


def test_an_ellipse_seen_from_below_turns_the_other_way(tmp_path):
    """The half from 0 to pi lies below the major axis."""

    def draw(space):
        space.add_ellipse((0, 0), (5, 0), 0.4, 0, math.pi, dxfattribs=BELOW)
        space.add_line((-5, 0), (5, 0))

    bounds = drawn(tmp_path, draw).profiles[0].bounds
    assert bounds[0, 1] == pytest.approx(-2, abs=0.05)
    assert bounds[1, 1] == pytest.approx(0, abs=1e-12)


def test_what_is_tilted_is_reported(tmp_path):
    """A circle that stands upright bounds nothing in the plane."""
    part = drawn(tmp_path, lambda space: space.add_circle((1, 2), 3, dxfattribs={"extrusion": (1, 0, 0)}))
    assert codes(part) == ["entity-tilted"]
    assert part.profiles == ()


def test_slanted_lines_are_projected_and_reported(tmp_path):
    """A rectangle whose far side lies higher."""
    corners = [(0, 0, 0), (9, 0, 0), (9, 5, 3), (0, 5, 3)]

    def draw(space):
        for first, last in zip(corners, corners[1:] + corners[:1], strict=True):
            space.add_line(first, last)

    part = drawn(tmp_path, draw)
    assert part.profiles[0].area == pytest.approx(45)
    (finding,) = [finding for finding in part.findings if finding.code == "entity-height"]
    assert "2 curves are not level" in finding.text


@pytest.mark.parametrize("degree", [2, 3, 4])
def test_splines_by_control_points(tmp_path, degree):
    """An open spline and its chord; poles and knots are those of the file."""
    poles = [(0, 0), (2, 6), (5, 1), (8, 7), (10, 0)]

    def draw(space):
        space.add_open_spline(poles, degree=degree)
        space.add_line((10, 0), (0, 0))

    spline = next(edge for edge in drawn(tmp_path, draw).profiles[0].edges if not isinstance(edge, Line))
    assert spline.degree == degree
    assert {tuple(pole) for pole in spline.poles} == set(poles)


def test_closed_splines(tmp_path):
    """Periodic and closed, plain and rational: the curve ends where it starts."""

    def draw(space):
        space.add_spline().set_closed([(x, y, 0) for x, y in RING], degree=3)
        space.add_spline().set_closed_rational([(x + 20, y, 0) for x, y in RING], [1, 2] * 4, degree=3)

    part = drawn(tmp_path, draw)
    assert len(part.profiles) == 2
    assert all(np.linalg.norm(edge.end - edge.start) < 1e-12 for edge in part.profiles[0].edges)


def test_a_periodic_spline_without_its_repeated_poles(tmp_path):
    """Some writers give n poles and n + 2 degree + 1 knots."""

    def draw(space):
        spline = space.add_spline(dxfattribs={"degree": 3, "flags": 11})
        spline.control_points, spline.knots = [(x, y, 0) for x, y in RING], range(len(RING) + 7)

    assert drawn(tmp_path, draw).profiles[0].area == pytest.approx(63, rel=0.1)


def test_splines_by_fit_points(tmp_path):
    """Open ones run through their points with their end tangents, closed ones without a corner anywhere."""
    points = [(0, 0), (3, 4), (7, 3), (10, 0)]

    def draw(space):
        space.add_spline(points, dxfattribs={"start_tangent": (0, 1, 0), "end_tangent": (0, -1, 0)})
        space.add_line((10, 0), (0, 0))
        space.add_spline([(x + 30, y) for x, y in RING]).closed = True

    part = drawn(tmp_path, draw)
    ring, cap = part.profiles if part.profiles[0].bounds[0, 0] > 20 else part.profiles[::-1]
    (ring_edge,) = ring.edges
    ends = ring_edge.derivatives([0.0, 1.0])[:, 1]
    assert np.allclose(ends[0] / np.linalg.norm(ends[0]), ends[1] / np.linalg.norm(ends[1]), atol=1e-9)
    spline = next(edge for edge in cap.edges if not isinstance(edge, Line))
    assert min(np.linalg.norm(spline.point(np.linspace(0, 1, 4000)) - points[1], axis=1)) < 1e-2
    assert abs(spline.derivatives([0.0])[0, 1, 0]) < 1e-9


def test_a_spline_whose_numbers_make_no_curve_is_reported(tmp_path):
    """Falling knots: the other entities are read all the same."""

    def draw(space):
        spline = space.add_spline(dxfattribs={"degree": 3})
        spline.control_points, spline.knots = [(0, 0, 0), (1, 1, 0), (2, 0, 0), (3, 1, 0)], [0, 0, 0, 0, 1, 0.5, 0.2, 0]
        space.add_circle((9, 9), 1)

    part = drawn(tmp_path, draw)
    assert codes(part) == ["entity-invalid"]
    assert len(part.profiles) == 1


@pytest.mark.parametrize("bad", [math.nan, math.inf, 1e300])
def test_coordinates_that_are_no_numbers_cost_their_entity_only(tmp_path, bad):
    """Not a number, infinite, or beyond all measure."""

    def draw(space):
        space.add_circle((0, 0), 1)
        space.add_circle((bad, 0), 1)
        space.add_circle((0, 0), bad)
        space.add_line((0, 0), (bad, 1))

    part = drawn(tmp_path, draw)
    assert set(codes(part)) == {"entity-invalid"}
    assert sum(finding.count for finding in part.findings if finding.code == "entity-invalid") == 3
    assert len(part.profiles) == 1


def test_entities_without_extent_are_reported(tmp_path):
    """A circle without radius, a polyline of one vertex, a spline in one point."""

    def draw(space):
        space.add_circle((0, 0), 0)
        space.add_lwpolyline([(1, 1)])
        space.add_spline([(1, 1), (1, 1), (1, 1)])

    part = drawn(tmp_path, draw)
    assert codes(part) == ["entity-degenerate"] * 3
    assert part.profiles == ()
