import numpy as np

from mashape_cad.geometry.duplicates import repeated_edges, repeated_loops
from mashape_cad.geometry.edge import Arc, BSpline, Line
from mashape_cad.geometry.profile import Loop

SPLINE = BSpline.of(3, [0, 0, 0, 0, 1, 2, 2, 2, 2], [(0, 0), (1, 2), (2, -1), (3, 3), (5, 0)])


def repeats(*edges, tolerance=1e-6):
    """Numbers of the edges that repeat another one."""
    return repeated_edges(edges, np.array([edge.length() for edge in edges]), tolerance)


def square(size=1.0, at=(0.0, 0.0), first=0):
    """A square as four lines, from any corner on."""
    corners = np.roll(size * np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) + at, -first, axis=0)
    return Loop(tuple(Line.of(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)))


def test_an_edge_drawn_again_in_either_direction_repeats_the_first():
    """Lines, arcs and splines; the first one stays."""
    edges = [Line.of((0, 0), (3, 4)), Arc.of((0, 0), 5.0, 0.2, 1.0), SPLINE]
    assert repeats(*edges, *(edge.reversed() for edge in edges)) == [3, 4, 5]
    assert repeats(edges[0], edges[0], edges[0]) == [1, 2]


def test_rounded_copies_repeat_and_neighbours_do_not():
    """1e-7 apart is a copy, 1e-3 apart is another line."""
    line = Line.of((0, 0), (3, 4))
    assert repeats(line, Line.of((0, 1e-7), (3, 4))) == [1]
    assert repeats(line, Line.of((0, 1e-3), (3, 4))) == []


def test_two_arcs_between_the_same_ends_are_two_edges():
    """A lens is not a duplicate."""
    assert repeats(Arc.of((0, 0), 5.0, 0.0, np.pi), Arc.of((0, 0), 5.0, 0.0, -np.pi)) == []


def test_tiny_edges_beside_one_another_are_no_copies():
    """However wide the tolerance, an edge must be close beside its own length."""
    assert repeats(Line.of((0, 0), (1e-6, 0)), Line.of((0, 1e-7), (1e-6, 1e-7)), tolerance=1e-3) == []


def test_a_loop_repeats_another_wherever_it_is_cut_and_whichever_way_it_runs():
    """A circle and its two halves run backwards; a square from another corner on."""
    circle = Loop((Arc.of((3, 3), 2.0, 0.0),))
    halves = Loop((Arc.of((3, 3), 2.0, 1.0, -np.pi), Arc.of((3, 3), 2.0, 1.0 - np.pi, -np.pi)))
    assert repeated_loops([circle, square(), halves, square(first=2)], 1e-6) == [2, 3]


def test_loops_of_the_same_length_and_area_elsewhere_do_not_repeat():
    """A hundred equal holes are a hundred holes; a turned square is another one."""
    holes = [square(at=(3.0 * i, 3.0 * j)) for i in range(10) for j in range(10)]
    turned = Loop(tuple(Arc.of((0.5, 0.5), 0.5**0.5, a, np.pi / 2) for a in (0, np.pi / 2, np.pi, -np.pi / 2)))
    diamond = Loop(tuple(Line.of(edge.start, edge.end) for edge in turned.edges))
    assert repeated_loops([*holes, diamond], 1e-6) == []


def test_concentric_loops_that_differ_by_more_than_the_tolerance_stay():
    """A wall of a thousandth of the size is a wall."""
    assert repeated_loops([square(), square(0.999, (0.0005, 0.0005))], 1e-6) == []
