import numpy as np
import pytest
from random_edges import random_spline
from scipy.spatial import cKDTree

from mashape_cad.geometry.edge import Arc, BSpline, Edge, Line
from mashape_cad.geometry.spline import pieces_without_kinks, spline_edges

HALF = np.sqrt(0.5)
# The nine-pole circle of every textbook: four quarters, joined at double knots.
CIRCLE_KNOTS = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
CIRCLE_POLES = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
CIRCLE_WEIGHTS = [1, HALF, 1, HALF, 1, HALF, 1, HALF, 1]
# Two smooth cubic Bezier curves, the second of which starts where the first ends.
TRIPLE = [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2]


def kinds(edges: tuple[Edge, ...]) -> list[str]:
    """Kinds of edges, in order."""
    return [type(edge).__name__ for edge in edges]


def same_curve(edges: tuple[Edge, ...], spline: BSpline) -> bool:
    """Whether edges in order run through the same places as the spline."""
    u = np.linspace(0, 1, 5000)
    whole, parts = spline.point(u), np.concatenate([edge.point(u) for edge in edges])
    step = np.linalg.norm(np.diff(whole, axis=0), axis=1).max()
    return bool(max(cKDTree(parts).query(whole)[0].max(), cKDTree(whole).query(parts)[0].max()) <= step)


def test_a_circle_written_as_a_rational_spline_is_one_full_arc():
    """Centre, radius, start and sense come back."""
    (arc,) = spline_edges(2, CIRCLE_KNOTS, 5 * np.array(CIRCLE_POLES) + (10, 20), CIRCLE_WEIGHTS)
    assert isinstance(arc, Arc)
    assert arc.radius == pytest.approx(5.0, rel=1e-12)
    assert np.allclose(arc.centre, (10, 20), rtol=0, atol=1e-11)
    assert np.allclose(arc.start, (15, 20), rtol=0, atol=1e-11)
    assert arc.sweep == 2 * np.pi


def test_three_quarters_of_a_circle_run_backwards_are_one_arc_that_turns_right():
    """Neighbouring arcs of one circle are put together."""
    poles, weights = CIRCLE_POLES[6::-1], CIRCLE_WEIGHTS[6::-1]
    (arc,) = spline_edges(2, [0, 0, 0, 1, 1, 2, 2, 3, 3, 3], poles, weights)
    assert isinstance(arc, Arc)
    assert arc.sweep == pytest.approx(-1.5 * np.pi, rel=1e-12)
    assert np.allclose(arc.start, (0, -1), rtol=0, atol=1e-12)


def test_a_slot_written_as_one_spline_is_two_lines_and_two_arcs():
    """Smooth joints between lines and arcs are found, though the direction does not change there."""
    right, left = np.array([*CIRCLE_POLES[6:], *CIRCLE_POLES[1:3]]) + np.array([4, 0]), np.array(CIRCLE_POLES[2:7])
    poles = np.concatenate([[(0, -1), (2, -1)], right, [(2, 1)], left])
    weights = [1, 1, *CIRCLE_WEIGHTS[6:], *CIRCLE_WEIGHTS[1:3], 1, *CIRCLE_WEIGHTS[2:7]]
    knots = np.concatenate([[0], np.repeat(np.arange(7), 2), [6]])
    edges = spline_edges(2, knots, poles, weights)
    assert kinds(edges) == ["Line", "Arc", "Line", "Arc"]
    assert [edge.length() for edge in edges] == pytest.approx([4, np.pi, 4, np.pi], rel=1e-12)


def test_a_spline_is_cut_at_a_kink_and_only_there():
    """Cubic with two inner triple knots: one smooth, one with a corner."""
    poles = [(0, 0), (1, 2), (2, 3), (3, 3), (4, 3), (5, 2), (6, 2), (6, 3), (7, 4), (9, 4)]
    spline = BSpline.of(3, [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3], poles)
    pieces = pieces_without_kinks(spline)
    assert len(pieces) == 2
    assert np.allclose(pieces[0].end, (6, 2))
    assert np.allclose(pieces[1].start, (6, 2))
    assert same_curve(pieces, spline)


def test_coincident_poles_that_hide_a_corner_are_a_kink():
    """Three equal poles of a cubic stop the curve on a simple knot; it may go on in any direction."""
    spline = BSpline.of(3, [0, 0, 0, 0, 1, 2, 3, 3, 3, 3], [(0, 0), (2, 0), (4, 0), (4, 0), (4, 0), (4, 2)])
    pieces = pieces_without_kinks(spline)
    assert [tuple(piece.start) for piece in pieces] == [(0, 0), (4, 0)]
    assert np.allclose(pieces[-1].end, (4, 2))


def test_a_stretch_without_length_leaves_no_edge():
    """A Bezier piece whose poles all coincide is dropped between two that have length."""
    poles = [(0, 0), (1, 1), (2, 1), (3, 0), (3, 0), (3, 0), (3, 0), (4, -1), (5, -1), (6, 0)]
    edges = spline_edges(3, [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3], poles)
    assert [tuple(np.round(edge.start, 12)) for edge in edges] == [(0, 0), (3, 0)]


def test_a_spline_that_is_interrupted_becomes_two_edges():
    """A knot of multiplicity degree + 1 with different poles on both sides is a jump."""
    poles = [(0, 0), (1, 1), (2, 1), (3, 0), (5, 0), (6, 1), (7, 1), (8, 0)]
    edges = spline_edges(3, [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2], poles)
    assert [tuple(edge.start) for edge in edges] == [(0, 0), (5, 0)]
    assert [tuple(edge.end) for edge in edges] == [(3, 0), (8, 0)]


def test_a_jump_that_only_repeats_a_pole_is_none():
    """Some writers use multiplicity degree + 1 where degree would do; a smooth curve stays one edge."""
    poles = [(0, 0), (1, 1), (2, 2), (3, 2), (3, 2), (4, 2), (5, 1), (6, 0)]
    assert kinds(spline_edges(3, [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2], poles)) == ["BSpline"]


def test_degree_one_becomes_lines():
    """A polyline written as a spline; a repeated point gives no line."""
    edges = spline_edges(1, [0, 0, 1, 2, 3, 3], [(0, 0), (1, 0), (1, 0), (1, 1)])
    assert kinds(edges) == ["Line", "Line"]
    assert tuple(edges[1].last) == (1, 1)


def test_a_straight_cubic_becomes_a_line():
    """Elevated in degree, unevenly spaced, still a line."""
    (line,) = spline_edges(3, TRIPLE, [(0, 0), (1, 1), (1.5, 1.5), (2, 2), (4, 4), (5, 5), (6, 6)])
    assert isinstance(line, Line)
    assert tuple(line.last) == (6, 6)


def test_a_curve_that_is_almost_straight_does_not_become_an_arc_of_a_giant_circle():
    """Middle pole off by a file's digits: the arc's radius of 24 km moved its ends, and the area by 0.1 mm2."""
    first, last = np.array([5.513829, 23.166527]), np.array([9.678535, 19.204743])
    middle = (first + last) / 2 + 1.7e-7
    (edge,) = spline_edges(2, [0, 0, 0, 1, 1, 1], [first, middle, last])
    assert edge.area_integral() == pytest.approx(Line.of(first, last).area_integral(), abs=1e-5)
    assert np.linalg.norm([edge.start - first, edge.end - last]) <= 1e-14


def test_a_straight_curve_that_turns_back_stays_a_spline():
    """Its poles lie on a line, but it runs past its end and returns."""
    edges = spline_edges(2, [0, 0, 0, 1, 1, 1], [(0, 0), (10, 0), (6, 0)])
    assert "Line" not in kinds(edges)


@pytest.mark.parametrize("seed", range(12))
def test_any_spline_is_the_same_curve_afterwards(seed):
    """Nothing is lost and nothing is added, whatever the knots and weights."""
    spline = random_spline(np.random.default_rng(seed))
    assert same_curve(spline_edges(spline.degree, spline.knots, spline.poles, spline.weights), spline)


def test_an_unclamped_periodic_spline_closes():
    """Uniform knots and wrapped poles: the curve ends where it starts."""
    ring = [(np.cos(t), np.sin(t)) for t in np.linspace(0, 2 * np.pi, 8, endpoint=False)]
    (edge,) = spline_edges(3, np.arange(15.0), [*ring, *ring[:3]])
    assert np.allclose(edge.start, edge.end, rtol=0, atol=1e-14)


def test_knots_that_digits_rounded_apart_are_one():
    """A falling or split knot within rounding does not cost the spline."""
    poles = [(0, 0), (1, 2), (2, 3), (3, 3), (4, 3), (5, 2), (6, 0)]
    knots = [0, 0, 0, 1e-13, 1, 1 - 1e-13, 1 + 1e-13, 2, 2, 2 - 1e-13, 2]
    (edge,) = spline_edges(3, knots, poles)
    assert isinstance(edge, BSpline)
    assert len(np.unique(edge.knots)) == 3


def test_all_poles_in_one_point_leave_nothing():
    """No edge, no complaint: chaining has nothing to count then."""
    assert spline_edges(3, [0, 0, 0, 0, 1, 1, 1, 1], [(2, 2)] * 4) == ()


def test_knots_that_really_fall_are_refused():
    """Numbers that make no spline raise, they are not bent into one."""
    with pytest.raises(ValueError, match="fall"):
        spline_edges(3, [0, 0, 0, 0, 1, 0.5, 2, 2, 2, 2], [(0, 0), (1, 1), (2, 0), (3, 1), (4, 0), (5, 1)])
