import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mashape_cad.geometry.edge import Arc, Line
from mashape_cad.geometry.nesting import Nested, looks_like_frame, nest
from mashape_cad.geometry.profile import Loop


def circle(x, y, radius):
    """A full circle."""
    return Loop((Arc.of((x, y), radius),))


def rectangle(x, y, width, height):
    """A rectangle as four lines."""
    corners = np.array([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], float)
    return Loop(tuple(Line.of(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)))


def test_holes_belong_to_the_loop_around_them_and_islands_are_profiles():
    """Plate, hole in it, island in the hole, hole in the island; another plate beside."""
    loops = [circle(0, 0, 1), rectangle(-9, -9, 18, 18), circle(0, 0, 2), rectangle(20, 0, 5, 5), circle(0, 0, 5)]
    assert nest(loops) == (Nested(1, (4,), 0), Nested(3, (), 0), Nested(2, (0,), 2))


def test_orientation_does_not_matter():
    """A hole that runs the same way round as its outline is a hole."""
    loops = [rectangle(0, 0, 9, 9), circle(4, 4, 1).reversed()]
    assert nest(loops) == nest([loop.reversed() for loop in loops]) == (Nested(0, (1,), 0),)


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-6])
def test_a_small_hole_close_to_a_large_arc_lies_on_the_right_side(gap):
    """Closer than any chord of a polyline: the answer comes from the curve, not from its flattening."""
    radius = 1e-3
    inside, outside = (
        circle(*(distance * np.array([np.cos(0.1), np.sin(0.1)])), radius)
        for distance in (100 - radius - gap, 100 + radius + gap)
    )
    assert nest([circle(0, 0, 100), inside]) == (Nested(0, (1,), 0),)
    assert nest([circle(0, 0, 100), outside]) == (Nested(0, (), 0), Nested(1, (), 0))


def test_a_hole_that_touches_its_outline_is_a_hole():
    """In a point, or along part of a side: most of it lies inside."""
    assert nest([rectangle(0, 0, 9, 9), circle(1, 4, 1)])[0].holes == (1,)
    assert nest([rectangle(0, 0, 9, 9), rectangle(0, 2, 2, 2)])[0].holes == (1,)


def test_neighbours_that_share_a_side_are_two_profiles():
    """A corner or a side on the outline does not put a loop inside."""
    assert [each.holes for each in nest([rectangle(0, 0, 9, 9), rectangle(9, 2, 2, 2)])] == [(), ()]


def test_crossing_loops_are_told_apart_by_their_larger_part():
    """No crash and no loop lost; that they cross is found by the medial axis."""
    nested = nest([rectangle(0, 0, 9, 9), circle(9, 4, 2), circle(8, 8, 2), circle(0, 0, 3)])
    assert sorted(number for each in nested for number in (each.outer, *each.holes)) == [0, 1, 2, 3]


def test_no_loops_no_profiles():
    """An empty drawing is no special case for the caller."""
    assert nest([]) == ()
    assert looks_like_frame([], ()) is None


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_depth_counts_the_circles_around(data):
    """Circles in circles in any order: even depths are profiles, odd ones holes of the one just around."""
    parents, circles = [], []
    for i in range(data.draw(st.integers(1, 12))):
        parent = data.draw(st.integers(-1, i - 1))
        siblings = sum(1 for other in parents if other == parent)
        x, y, radius = circles[parent] if parent >= 0 else (0.0, 0.0, 1e4)
        step = radius / 12
        parents.append(parent)
        circles.append((x - 0.8 * radius + (siblings + 0.5) * step, y, 0.4 * step))
    order = data.draw(st.permutations(range(len(circles))))
    nested = nest([circle(*circles[i]) for i in order])
    depth = []
    for parent in parents:
        depth.append(0 if parent < 0 else depth[parent] + 1)
    found = {order[each.outer]: {order[hole] for hole in each.holes} for each in nested}
    expected = {
        i: {j for j, parent in enumerate(parents) if parent == i} for i in range(len(circles)) if depth[i] % 2 == 0
    }
    assert found == expected


def test_a_rectangle_around_parts_with_holes_looks_like_a_frame_and_a_plate_does_not():
    """Three parts with holes in a rectangle: suspicious. A plate with three round holes: a plate."""
    parts = [loop for x in (0, 10, 20) for loop in (rectangle(x, 0, 8, 8), circle(x + 4, 4, 1))]
    sheet = [rectangle(-1, -1, 30, 10), *parts]
    plate = [rectangle(-1, -1, 30, 10), *(circle(x, 4, 2) for x in (4, 14, 24))]
    assert looks_like_frame(sheet, nest(sheet)) == nest(sheet)[0]
    assert looks_like_frame(plate, nest(plate)) is None
