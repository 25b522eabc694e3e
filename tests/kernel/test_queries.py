import numpy as np
import pytest
from catalogue import polygon
from random_edges import random_edges
from scipy.spatial import cKDTree

from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.kernel import DistanceQuery, distances, pieces, queries

_SQUARE = [Line.of(*ends) for ends in [((0, 0), (4, 0)), ((4, 0), (4, 4)), ((4, 4), (0, 4)), ((0, 4), (0, 0))]]


def _sampled(edges, points, per_span=1500):
    """Distances to samples: never smaller than the true ones; and the widest gap between samples."""
    lines = [edge.flattened(per_span) for edge in edges]
    gap = max(np.linalg.norm(np.diff(line, axis=0), axis=1).max() for line in lines)
    return cKDTree(np.concatenate(lines)).query(points)[0], gap


def _probes(rng, edges, count):
    """Points all over, near the edges, and at all centres."""
    along = np.concatenate([edge.point(rng.random(5)) for edge in edges])
    centres = [edge.centre for edge in edges if isinstance(edge, EllipseArc)]
    near = along + rng.normal(size=along.shape) * 10.0 ** rng.uniform(-12, 0, len(along))[:, None]
    return np.concatenate([40 * rng.normal(size=(count, 2)), along, near, *[centre[None] for centre in centres]])


@pytest.mark.parametrize("seed", range(6))
def test_nearest_point_is_never_missed(seed):
    """On wild curves the answer is never larger than the distance to dense samples, nor smaller than they allow."""
    rng = np.random.default_rng(seed)
    edges = random_edges(rng)
    points = _probes(rng, edges, 300)
    actual = distances(edges, points)
    sampled, gap = _sampled(edges, points)
    assert np.all(actual <= sampled + 1e-11)
    # A chord of length `gap` passes the curve's nearest point at most half its length away.
    assert np.all(np.hypot(actual, gap) >= sampled - 1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 160))
def test_nearest_point_is_never_missed_in_long(seed):
    """The same over many more curves and points."""
    rng = np.random.default_rng(seed)
    edges = random_edges(rng)
    points = _probes(rng, edges, 1500)
    assert np.all(distances(edges, points) <= _sampled(edges, points)[0] + 1e-11)


def test_an_extremum_that_the_kernel_overlooks_is_found_by_the_proof(monkeypatch):
    """Even if the kernel reports no stationary point of free curves at all, the answers stay the same."""
    rng = np.random.default_rng(5)
    edges = random_edges(rng)
    points = 40 * rng.normal(size=(100, 2))
    expected = distances(edges, points)
    asked = pieces.Piece.nearest

    def blind(self, place):
        return (np.inf, 0.5) if self.is_bezier else asked(self, place)

    monkeypatch.setattr(pieces.Piece, "nearest", blind)
    assert distances(edges, points) == pytest.approx(expected, rel=1e-9)


def test_distances_inside_outside_and_beyond_corners_of_a_square():
    """Sides, corners and the middle, where four sides are as near."""
    points = [(2, 2), (1, 2), (2, -3), (-3, -4), (4, 0), (2, 0)]
    assert distances(_SQUARE, points) == pytest.approx([2, 1, 3, 5, 0, 0], abs=1e-15)


def test_centre_of_a_circle_is_its_radius_away():
    """The kernel reports a failure there, which means that all points are as far; the same on an arc."""
    assert distances([Arc.of((1, 2), 3.0)], [(1, 2), (1, 2 + 1e-14)]) == pytest.approx([3, 3], rel=1e-14)
    assert distances([Arc.of((1, 2), 3.0, 1.0, -0.5)], [(1, 2)]) == pytest.approx([3], rel=1e-14)


def test_centre_of_an_ellipse_and_of_one_that_is_a_circle():
    """The nearest vertex; equal semi-axes are a circle by another name."""
    ellipse = EllipseArc(frozen([0, 0]), frozen([2, 0]), frozen([0, 1]), 0.0, 2 * np.pi)
    circle = EllipseArc(frozen([0, 0]), frozen([2, 0]), frozen([0, 2]), 0.0, 2 * np.pi)
    assert distances([ellipse], [(0, 0)]) == pytest.approx([1], rel=1e-14)
    assert distances([circle], [(0, 0)]) == pytest.approx([2], rel=1e-14)


def test_discs_of_an_ellipse_touch_it():
    """On the axis of the ellipse a = 2, b = 1 the distance is b sqrt(1 - x^2 / (a^2 - b^2)), also at its end."""
    ellipse = EllipseArc(frozen([0, 0]), frozen([2, 0]), frozen([0, 1]), 0.0, 2 * np.pi)
    x = np.linspace(-1.5, 1.5, 41)
    expected = np.sqrt(1 - x**2 / 3)
    assert distances([ellipse], np.column_stack([x, 0 * x])) == pytest.approx(expected, abs=1e-14)


def test_a_spline_that_is_nearly_a_circle_is_nearly_its_radius_from_the_centre():
    """All points of the boundary are nearly as near: the proof ends, and the smallest distance is found."""
    kappa = 0.5522847498
    quarter = np.array([(1, 0), (1, kappa), (kappa, 1), (0, 1)])
    turn = np.array([[0, -1], [1, 0]])
    quarters = [BSpline.of(3, [0] * 4 + [1] * 4, quarter @ np.linalg.matrix_power(turn.T, k)) for k in range(4)]
    middle = float(np.hypot(*quarters[0].point([0.5])[0]))  # 1 - 1.6e-11
    assert distances(quarters, [(0, 0)]) == pytest.approx([middle], abs=1e-14)


def test_points_on_the_boundary_are_at_no_distance():
    """To rounding of the coordinates."""
    edges = random_edges(np.random.default_rng(3))
    points = np.concatenate([edge.point(np.linspace(0, 1, 9)) for edge in edges])
    assert distances(edges, points).max() <= 1e-12 * np.abs(points).max()


@pytest.mark.parametrize("offset", [1e3, 1e7])
@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_answers_move_and_scale_with_the_boundary(offset, scale):
    """Far from the origin only the digits of the coordinates are lost."""
    rng = np.random.default_rng(11)
    edges, points = random_edges(rng), 40 * rng.normal(size=(50, 2))
    map_ = Similarity.of(scale, 0.7, (offset, -offset))
    moved = distances([edge.transformed(map_) for edge in edges], map_.apply(points))
    assert moved == pytest.approx(scale * distances(edges, points), rel=1e-9, abs=1e-14 * (offset + 300 * scale))


def test_far_points_are_answered_too():
    """A million sizes away nothing but rounding is lost."""
    edges = random_edges(np.random.default_rng(2))
    points = np.array([(1e8, 2e8), (-3e8, 0)])
    sampled, _ = _sampled(edges, points)
    assert distances(edges, points) == pytest.approx(sampled, rel=1e-12)


def test_many_points_are_taken_in_batches(monkeypatch):
    """The size of a batch does not show."""
    rng = np.random.default_rng(4)
    edges, points = random_edges(rng), 40 * rng.normal(size=(200, 2))
    expected = distances(edges, points)
    monkeypatch.setattr(queries, "_CHUNK", 500)
    assert np.array_equal(distances(edges, points), expected)


def test_a_profile_is_asked_with_its_holes():
    """All loops count."""
    hole = Loop((Arc.of((2, 2), 1.0),))
    profile = Profile.of(Loop(tuple(_SQUARE)), [hole])
    query = DistanceQuery(profile)
    assert query.distances([(2, 2), (0.4, 2)]) == pytest.approx([1.0, 0.4], rel=1e-14)
    assert query.distances([(3.5, 2)]) == pytest.approx([0.5], rel=1e-14)


def test_no_points_give_no_distances():
    """An empty list is answered by an empty array."""
    assert distances(_SQUARE, []).shape == (0,)


@pytest.mark.parametrize("seed", range(4))
def test_the_nearest_point_lies_on_the_boundary_at_the_distance(seed):
    """On edges of all kinds, from all over."""
    rng = np.random.default_rng(seed)
    edges = random_edges(rng)
    points = _probes(rng, edges, 200)
    query = DistanceQuery(edges)
    distance, nearest = query.nearest(points)
    assert np.array_equal(distance, query.distances(points))
    size = np.abs(points).max()
    assert np.linalg.norm(nearest - points, axis=1) == pytest.approx(distance, abs=1e-9 * size)
    assert query.distances(nearest).max() <= 1e-12 * size


def test_the_nearest_point_of_an_arc_is_not_that_of_its_circle():
    """An arc that no normal reaches is touched at its end; so is one asked from its centre."""
    query = DistanceQuery([Arc.of((0, 0), 1.0, np.pi, 0.5)])
    _, nearest = query.nearest([(2, 0.1), (0, 0)])
    end = (np.cos(np.pi + 0.5), np.sin(np.pi + 0.5))
    assert nearest[0] == pytest.approx(end)
    assert query.distances(nearest) == pytest.approx([0, 0], abs=1e-15)
    assert query.nearest([])[1].shape == (0, 2)


def test_no_edges_are_refused():
    """So are edges without length."""
    with pytest.raises(ValueError, match="at least one edge"):
        distances([], [(0, 0)])
    with pytest.raises(ValueError, match="length"):
        distances([Line.of((0, 0), (0, 0))], [(0, 0)])


@pytest.mark.parametrize("beyond", [3e-8, 9e-8, 1e-6])
@pytest.mark.parametrize("height", [0.0, 1e-6, 1e-3])
def test_lines_and_arcs_end_where_they_end(beyond, height):
    """The kernel takes both for 1e-7 longer; a bump of a millionth of the size had discs that were too small by it."""
    expected = np.hypot(beyond, height)
    assert distances([Line.of((0, 0), (1, 0))], [(1 + beyond, height), (-beyond, height)]) == pytest.approx(expected)
    arc = Arc.of((0, -2), 2.0, np.pi / 2, 0.5)  # from (0, 0) to the left
    assert distances([arc, arc.reversed()], [(beyond, height)]) == pytest.approx([expected], rel=1e-6)


@pytest.mark.parametrize("aside", [1e-8, 1e-7])
def test_places_nearest_to_points_a_hair_beside_a_vertex(aside):
    """The kernel overshoots the end of a line there; the place given was that of another point, far away."""
    shape = [(0, 0), (80, 0), (80, 18), (20, 18), (20, 50), (0, 50)]
    corners = Similarity.of(2.0, 0.4, (3.0, 4.0), mirror=True).apply(shape)
    query = DistanceQuery(Profile.of(polygon([(float(x), float(y)) for x, y in corners])))
    angle = np.random.default_rng(0).uniform(0, 2 * np.pi, 400)
    points = (corners[:, None] + aside * np.column_stack([np.cos(angle), np.sin(angle)])).reshape(-1, 2)
    distance, nearest = query.nearest(points)
    assert np.linalg.norm(nearest - points, axis=1) == pytest.approx(distance, abs=1e-6)
