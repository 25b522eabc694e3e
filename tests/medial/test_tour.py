"""The boundary as a tour of spans and cones."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, box, polygon, profile_of

from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.kernel import KernelCurve
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.tour import site, tour

_ALL = [*KNOWN, *NAMED]


@pytest.mark.parametrize("name", _ALL)
def test_elements_follow_one_another(name):
    """Each ends where the next one starts, to the last bit, and loops close."""
    laid_out, _ = tour(profile_of(name))
    for e, after in enumerate(laid_out.after):
        assert laid_out.before[after] == e
        assert laid_out.loop[after] == laid_out.loop[e]
        assert site(laid_out, e, 1.0)[:2] == site(laid_out, int(after), 0.0)[:2]


@pytest.mark.parametrize("name", _ALL)
def test_the_larger_side_has_length_1_and_the_middle_lies_in_the_origin(name):
    """So that tolerances are pure numbers."""
    laid_out, frame = tour(profile_of(name))
    outer = laid_out.box[laid_out.loop == 0]
    assert frame.size == pytest.approx(np.max(profile_of(name).bounds[1] - profile_of(name).bounds[0]))
    assert np.abs(laid_out.sample[:, :2]).max() <= 0.5 + 1e-12
    assert outer[:, 2:].max() >= 0.45


@pytest.mark.parametrize("name", _ALL)
def test_places_are_those_of_edge_and_kernel(name):
    """Position, inward normal and curvature at a place, scaled back, are the edge's and the kernel's own."""
    profile = profile_of(name)
    laid_out, frame = tour(profile)
    for e in np.flatnonzero(laid_out.degree > 0).tolist():
        for t in (0.0, 0.3, 0.77, 1.0):
            x, y, nx, ny, curvature, _ = site(laid_out, e, t)
            number, u = foot(laid_out, (e, t))
            point = np.array([x, y]) * frame.size + frame.middle
            curve = KernelCurve(profile.edges[number])
            position, tangent = curve.derivatives([u])[0, :2]
            assert point == pytest.approx(position, abs=1e-12 * frame.size)
            assert profile.edges[number].point([u])[0] == pytest.approx(position, abs=1e-12 * frame.size)
            normal = np.array([-tangent[1], tangent[0]]) / np.hypot(*tangent)
            assert (nx, ny) == pytest.approx(normal, abs=1e-9)
            assert curvature / frame.size == pytest.approx(curve.curvature([u])[0], rel=1e-7, abs=1e-9 / frame.size)


def test_a_kink_inside_a_spline_is_found_where_it_is():
    """Its cone has the spline's parameter there, not that of the spline's start: footpoints were 27 mm off for that."""
    points = [(4, 0), (4, 3), (2, 1), (0, 3), (0, 0)]
    around = BSpline.of(1, [0, 0, 1, 2, 3, 4, 4], points)
    profile = Profile.of(Loop((around, Line.of((0, 0), (4, 0)))))
    laid_out, _ = tour(profile)
    [cone] = np.flatnonzero(laid_out.degree == 0)
    number, u = foot(laid_out, (int(cone), 0.5))
    assert profile.edges[number].point([u])[0] == pytest.approx((2, 1))


@pytest.mark.parametrize("name", _ALL)
def test_inward_normals_point_inwards(name):
    """Off the outer loop and off holes alike: the kernel finds the boundary right behind."""
    import shapely

    profile = profile_of(name)
    laid_out, frame = tour(profile)
    outline = shapely.Polygon(profile.outer.flattened(64), [hole.flattened(64) for hole in profile.holes])
    for e in range(len(laid_out.degree)):
        x, y, nx, ny, _, _ = site(laid_out, e, 0.5)
        point = (np.array([x, y]) + 5e-3 * np.array([nx, ny])) * frame.size + frame.middle
        assert outline.contains(shapely.Point(point))


def test_vertices_of_the_ell():
    """Five convex vertices, and a cone of -90 degrees at the sixth; a cone is no convex border."""
    laid_out, _ = tour(profile_of("ell"))
    assert int(laid_out.convex.sum()) == 5
    (cone,) = np.flatnonzero(laid_out.degree == 0)
    assert laid_out.cone[cone, 1] == pytest.approx(-np.pi / 2)
    before, after = int(laid_out.before[cone]), int(laid_out.after[cone])
    assert site(laid_out, cone, 0.0)[2:4] == pytest.approx(site(laid_out, before, 1.0)[2:4])
    assert site(laid_out, cone, 1.0)[2:4] == pytest.approx(site(laid_out, after, 0.0)[2:4])
    assert site(laid_out, cone, 0.5)[4] == -np.inf
    assert not laid_out.convex[cone]
    assert not laid_out.convex[after]


def test_a_convex_corner_of_a_hole_is_a_reflex_vertex():
    """Reading 26: the angle is measured inside the shape."""
    laid_out, _ = tour(Profile.of(box(0, 0, 4, 4), [box(1, 1, 1, 1)]))
    assert np.count_nonzero(laid_out.degree == 0) == 4
    assert np.all(laid_out.loop[laid_out.degree == 0] == 1)
    assert np.count_nonzero(laid_out.convex) == 4
    assert np.all(laid_out.loop[laid_out.convex] == 0)


@pytest.mark.parametrize(("kink", "is_corner"), [(1e-9, False), (5e-8, False), (2e-7, True), (1e-3, True)])
def test_kinks(kink, is_corner):
    """A join that turns by less than 1e-7 is smooth; a larger one is a vertex, convex or reflex."""
    for sign, convex in ((1, 5), (-1, 4)):
        corners = [(0.0, 0.0), (1.0, -sign * kink / 2), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]
        laid_out, _ = tour(Profile.of(polygon(corners)))
        assert int(laid_out.convex.sum()) == (convex if is_corner else 4)
        assert np.count_nonzero(laid_out.degree == 0) == int(is_corner and sign < 0)


def test_edges_are_numbered_through_all_loops():
    """As `Profile.edges` numbers them; spans of one edge share its number and divide its parameter."""
    profile = profile_of("bracket")
    laid_out, _ = tour(profile)
    assert set(laid_out.edge.tolist()) == set(range(len(profile.edges)))
    for number in range(len(profile.edges)):
        spans = np.flatnonzero((laid_out.edge == number) & (laid_out.degree > 0))
        assert laid_out.edge_from[spans[0]] == 0.0
        assert laid_out.edge_to[spans[-1]] == 1.0
        assert np.array_equal(laid_out.edge_to[spans[:-1]], laid_out.edge_from[spans[1:]])


def test_circular_spans_know_their_circle():
    """Where they bend inwards; holes bend outwards and need none, ellipses have none."""
    (span,), _ = Arc.of((0, 0), 2.0, 0.3, 1.2).spans()
    as_spline = BSpline.of(2, [0, 0, 0, 1, 1, 1], span[:, :2] / span[:, 2:], span[:, 2])
    sector = Profile.of(Loop((as_spline, Line.of(as_spline.end, (0, 0)), Line.of((0, 0), as_spline.start))))
    laid_out, frame = tour(sector)
    (e,) = np.flatnonzero(~np.isnan(laid_out.round_radius))
    assert laid_out.round_radius[e] * frame.size == pytest.approx(2.0, rel=1e-12)
    assert laid_out.round_centre[e] * frame.size + frame.middle == pytest.approx((0, 0), abs=1e-12)
    hole = tour(profile_of("concentric ring"))[0]
    assert np.isnan(hole.round_radius[hole.loop == 1]).all()
    assert not np.isnan(hole.round_radius[hole.loop == 0]).any()
    assert np.isnan(tour(profile_of("ellipse"))[0].round_radius).all()


def test_an_ellipse_by_name_that_is_a_circle_is_round():
    """Equal semi-axes."""
    whole = EllipseArc(frozen([1, 2]), frozen([0, 3]), frozen([-3, 0]), 0.0, 2 * np.pi)
    laid_out, frame = tour(Profile.of(Loop((whole,))))
    assert laid_out.round_radius * frame.size == pytest.approx(3.0)


def test_feet_on_arcs_are_given_by_the_angle():
    """An edge's parameter is linear in the angle, a rational span's is not; they agree at ends and middle only."""
    profile = Profile.of(Loop((Arc.of((0, 0), 1.0, 0.0, np.pi), Line.of((-1, 0), (1, 0)))))
    laid_out, frame = tour(profile)
    for e in np.flatnonzero(laid_out.degree == 2).tolist():
        for t in (0.0, 0.1, 0.5, 0.9):
            number, u = foot(laid_out, (e, t))
            point = np.array(site(laid_out, e, t)[:2]) * frame.size + frame.middle
            assert profile.edges[number].point([u])[0] == pytest.approx(point, abs=1e-14)


@pytest.mark.parametrize("similarity", [Similarity.of(1e-3), Similarity.of(1e4, 1.0, (1e5, 1e5))])
def test_the_tour_does_not_depend_on_the_pose(similarity):
    """The same elements, cones and circles."""
    plain, _ = tour(profile_of("bracket"))
    moved, _ = tour(profile_of("bracket").transformed(similarity))
    assert np.array_equal(plain.degree, moved.degree)
    assert np.array_equal(plain.convex, moved.convex)
    assert np.array_equal(np.isnan(plain.round_radius), np.isnan(moved.round_radius))
    assert axis_of("bracket").tour.cone[:, 1] == pytest.approx(moved.cone[:, 1], nan_ok=True, abs=1e-9)
