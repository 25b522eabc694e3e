"""Distances to the pieces that a point may touch, against the distances to the whole boundary."""

import numpy as np
import pytest
from catalogue import axis_of, profile_of
from random_edges import random_arc, random_edges, random_ellipse_arc, random_line, random_spline

from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line, frozen
from mashape_cad.kernel import DistanceQuery, clearances, distances

_SQUARE = [Line.of(*ends) for ends in [((0, 0), (4, 0)), ((4, 0), (4, 4)), ((4, 4), (0, 4)), ((0, 4), (0, 0))]]
# Shapes with lines, arcs, ellipses and splines of all kinds, with holes and without.
_SHAPES = ["rectangle", "ellipse", "stadium", "bracket", "plate with holes", "blob", "blob with holes", "rational blob"]
_SHAPES += ["wave", "keyhole", "symmetric cap", "half disc"]


def _with_breaks(edges):
    """Each edge with the parameters at the ends of its spans."""
    return [(edge, edge.spans()[1]) for edge in edges]


def _all_pairs(edges, points):
    """Pairs of every point and every piece."""
    pieces = sum(len(breaks) - 1 for _, breaks in _with_breaks(edges))
    return np.repeat(np.arange(len(points)), pieces), np.tile(np.arange(pieces), len(points))


def _of_all_pieces(edges, points):
    points = np.array(points, float)
    return clearances(_with_breaks(edges), points, *_all_pairs(edges, points))


@pytest.mark.parametrize("name", _SHAPES)
def test_discs_of_an_axis_are_as_large_as_the_whole_boundary_tells(name):
    """On shapes as designers draw them nothing is overlooked: at every centre the two agree."""
    profile, discs = profile_of(name), axis_of(name).discs
    assert _of_all_pieces(profile.edges, discs.centre) == pytest.approx(
        DistanceQuery(profile).distances(discs.centre), abs=1e-12
    )


@pytest.mark.parametrize("make", [random_line, random_arc, random_ellipse_arc])
@pytest.mark.parametrize("seed", range(8))
def test_random_discs_of_lines_arcs_and_ellipses(make, seed):
    """Any centre, near the curve, far from it, or right on it."""
    rng = np.random.default_rng(seed)
    edges = [make(rng) for _ in range(3)]
    on = np.concatenate([edge.point(rng.random(5)) for edge in edges])
    near = on + rng.normal(size=on.shape) * 10.0 ** rng.uniform(-10, 0, (len(on), 1))
    points = np.concatenate([40 * rng.normal(size=(60, 2)), on, near])
    assert _of_all_pieces(edges, points) == pytest.approx(distances(edges, points), rel=1e-9, abs=1e-11)


@pytest.mark.parametrize("seed", range(8))
def test_random_discs_of_splines(seed):
    """The kernel may overlook a nearest point of a wild curve: never too small, and too large but seldom."""
    rng = np.random.default_rng(seed)
    edges = [random_spline(rng) for _ in range(3)]
    points = np.concatenate([40 * rng.normal(size=(100, 2)), *[edge.point(rng.random(9)) for edge in edges]])
    found, true = _of_all_pieces(edges, points), distances(edges, points)
    assert np.all(found >= true - 1e-9)
    assert np.mean(found <= true + 1e-9) >= 0.97


def test_only_the_pieces_of_a_point_count():
    """In any order of the pairs; pieces are numbered through over all edges."""
    edges = random_edges(np.random.default_rng(3))
    counts = [len(breaks) - 1 for _, breaks in _with_breaks(edges)]
    first = np.concatenate([[0], np.cumsum(counts)])
    points = np.array([edge.point([0.4])[0] + (0.3, -0.2) for edge in edges])
    row = np.concatenate([np.full(count, k) for k, count in enumerate(counts)])
    piece = np.arange(first[-1])
    expected = [distances([edge], [point])[0] for edge, point in zip(edges, points, strict=True)]
    order = np.random.default_rng(4).permutation(len(row))
    for rows in (np.arange(len(row)), order):
        found = clearances(_with_breaks(edges), points, row[rows], piece[rows])
        assert found == pytest.approx(expected, rel=1e-9)


def test_pieces_of_an_arc_are_told_apart():
    """A quarter of a circle is as near as its own points and ends are."""
    circle = [(Arc.of((0, 0), 2.0), np.linspace(0, 1, 5))]
    points = np.array([(1.0, 1.0)] * 4)
    found = clearances(circle, points, np.arange(4), np.arange(4))
    side, far = np.hypot(1, 1), np.hypot(3, 1)
    assert found == pytest.approx([2 - side, side, far, side], abs=1e-14)


def test_beyond_the_end_of_a_piece_its_end_is_nearest():
    """The kernel reports no stationary point there."""
    assert _of_all_pieces(_SQUARE, [(-3, -4), (7, 8)]) == pytest.approx([5, 5], abs=1e-14)
    bend = BSpline.of(2, [0, 0, 0, 1, 1, 1], [(0, 0), (1, 1), (2, 0)])
    assert _of_all_pieces([bend], [(-3, -4)]) == pytest.approx([5], abs=1e-14)


def test_centre_of_a_circle_is_its_radius_away():
    """The kernel reports a failure there, which means that all points are as far; on a whole circle and on arcs."""
    for arc in (Arc.of((1, 2), 3.0), Arc.of((1, 2), 3.0, 1.0, -0.5), Arc.of((1, 2), 3.0, 0.3, 4.0)):
        assert _of_all_pieces([arc], [(1, 2), (1, 2 + 1e-14)]) == pytest.approx([3, 3], rel=1e-14)
    round_ellipse = EllipseArc(frozen([0, 0]), frozen([2, 0]), frozen([0, 2]), 0.0, 2 * np.pi)
    assert _of_all_pieces([round_ellipse], [(0, 0)]) == pytest.approx([2], rel=1e-14)


def test_a_failure_of_the_kernel_does_not_carry_over():
    """After a circle's centre the next point, and the next piece, are measured as ever."""
    edges = [Arc.of((2, 2), 1.0), *_SQUARE]
    assert _of_all_pieces(edges, [(2, 2), (2, 0.25), (2, 2)]) == pytest.approx([1, 0.25, 1], abs=1e-14)


def test_discs_of_an_ellipse_touch_it():
    """On the axis of the ellipse a = 2, b = 1 the distance is b sqrt(1 - x^2 / (a^2 - b^2)), also at its end."""
    ellipse = EllipseArc(frozen([0, 0]), frozen([2, 0]), frozen([0, 1]), 0.0, 2 * np.pi)
    x = np.linspace(-1.5, 1.5, 41)
    found = _of_all_pieces([ellipse], np.column_stack([x, 0 * x]))
    assert found == pytest.approx(np.sqrt(1 - x**2 / 3), abs=1e-13)


def test_a_point_without_pieces_is_infinitely_far():
    """Nothing is known to be near; the others are not affected."""
    found = clearances(_with_breaks(_SQUARE), np.array([(1.0, 2.0)] * 3), np.array([1]), np.array([3]))
    assert found.tolist() == [np.inf, 1.0, np.inf]
    none = np.zeros(0, np.int64)
    assert clearances(_with_breaks(_SQUARE), np.zeros((0, 2)), none, none).shape == (0,)


@pytest.mark.parametrize("beyond", [3e-8, 9e-8, 1e-6])
def test_lines_and_arcs_end_where_they_end(beyond):
    """The kernel takes both for 1e-7 longer than they are."""
    line, arc = Line.of((-1, 0), (0, 0)), Arc.of((0, -2), 2.0, np.pi / 2, 0.5)  # both have their end at the right
    for edge in (line, arc):
        assert _of_all_pieces([edge], [(beyond, 1e-6)]) == pytest.approx([np.hypot(beyond, 1e-6)], rel=1e-6)
