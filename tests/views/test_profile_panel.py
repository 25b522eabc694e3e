import numpy as np

from mashape_cad.views.colours import PAPER
from mashape_cad.views.drawing import Area, Circle, Difference, Placement
from mashape_cad.views.likeness import Likeness
from mashape_cad.views.profile_panel import axis_lines, junctions, maximal_discs, overlay

SQUARE = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)])
AS_IT_IS = Placement(1.0, 0.0, 0.0)


def discs(*branches):
    """The maximal discs that are drawn of these branches."""
    shapes = maximal_discs(Likeness((SQUARE,), branches), AS_IT_IS, PAPER)
    return [shape for shape in shapes if isinstance(shape, Circle) and shape.opacity < 1]


def test_the_largest_disc_comes_first_and_none_overlaps_another():
    """On a wedge: centres are farther apart than the radii together."""
    found = discs(np.array([(0.0, 0.0, 10.0), (100.0, 0.0, 1.0)]))
    assert (found[0].x, found[0].radius) == (0, 10)
    assert len(found) > 3
    for i, one in enumerate(found):
        for other in found[:i]:
            assert np.hypot(one.x - other.x, one.y - other.y) >= 0.98 * (one.radius + other.radius)


def test_discs_spread_over_the_axis():
    """A long thin branch gets some, although the wide one has room for larger ones."""
    wide = np.array([(0.0, 0.0, 10.0), (0.0, 300.0, 10.0)])
    thin = np.array([(0.0, 0.0, 10.0), (20.0, 0.0, 3.0), (300.0, 0.0, 3.0)])
    assert sum(each.x > 50 for each in discs(wide, thin)) >= 3


def test_specks_are_left_out():
    """A disc of a tenth of the largest explains nothing."""
    assert [each.radius for each in discs(np.array([(0, 0, 10.0)]), np.array([(50, 0, 1.0)]))] == [10]


def test_of_equal_discs_all_or_none_are_drawn():
    """A part with one large disc and twenty small ones of one size shows the large one alone."""
    small = [np.array([(30.0 * i, 50.0, 4.0)]) for i in range(20)]
    assert [each.radius for each in discs(np.array([(0.0, 0.0, 10.0)]), *small)] == [10]
    assert len(discs(np.array([(0.0, 0.0, 10.0)]), *small[:5])) == 6


def test_only_places_where_branches_meet_are_marked():
    """Three branches in one point are a junction, two are none, a loop on itself is none."""
    star = [np.array([(5.0, 5.0, 2.0), end]) for end in ((0.0, 5.0, 1.0), (10.0, 5.0, 1.0), (5.0, 0.0, 1.0))]
    ring = np.array([(20.0, 0.0, 1.0), (21.0, 0.0, 1.0), (20.0, 0.0, 1.0)])
    (mark,) = junctions(Likeness((SQUARE,), (*star, ring)), AS_IT_IS, PAPER, 2.0)
    assert (mark.x, mark.y) == (5, -5)


def test_the_axis_of_a_disc_is_a_dot():
    """One point, which no line would show."""
    dot, *lines = axis_lines(Likeness((SQUARE,), (np.array([(5.0, 5.0, 5.0)]),)), AS_IT_IS, PAPER, 2.0)
    assert (dot.x, dot.y) == (5, -5)
    assert all(not line.runs for line in lines)


def test_an_overlay_shows_both_outlines_and_what_only_one_covers():
    """In one scale, so that both fit into the box."""
    shapes = list(overlay(Likeness((SQUARE,)), Likeness((SQUARE + np.array([10.0, 0.0]),)), (0, 0, 40, 20), PAPER))
    (difference,) = (shape for shape in shapes if isinstance(shape, Difference))
    assert difference.one[0].tolist() == [[0, 20], [20, 20], [20, 0], [0, 0]]
    assert difference.other[0].tolist() == [[20, 20], [40, 20], [40, 0], [20, 0]]
    assert [shape.stroke for shape in shapes if isinstance(shape, Area) and shape.stroke] == [PAPER.ink, PAPER.muted]
