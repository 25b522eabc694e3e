from itertools import pairwise

import pytest

from mashape_cad.views.colours import PAPER
from mashape_cad.views.drawing import Area, Label
from mashape_cad.views.histogram import histogram


def chart(heights, colours=("#111111",)):
    """A chart of 200 x 90 pixels, its foot at y = 140."""
    return list(histogram(heights, 100, 50, 200, 90, colours, PAPER))


def test_a_bar_is_as_tall_as_the_root_of_its_share():
    """The tallest fills the height; a quarter of its share is half as tall."""
    (bars,) = (shape for shape in chart([0.8, 0.2, 0.0, 0.0]) if isinstance(shape, Area))
    ring = bars.rings[0]
    assert ring[:, 0].min() == 100
    assert ring[:, 0].max() == 200  # the empty half has no bars
    assert sorted({round(140 - y, 6) for y in ring[:, 1]}) == [0, 45, 90]


def test_bins_take_their_colour_from_left_to_right():
    """Two colours on four bins, two each."""
    left, right = (shape for shape in chart([0.25] * 4, ("#111111", "#222222")) if isinstance(shape, Area))
    assert (left.fill, left.rings[0][:, 0].max()) == ("#111111", 200)
    assert (right.fill, right.rings[0][:, 0].min()) == ("#222222", 200)


@pytest.mark.parametrize("heights", [[1.0, 0.0], [0.02] * 50, [0.5, 0.3, 0.2], [0.0, 0.0]])
def test_numbers_at_the_side_do_not_touch(heights):
    """And none lies above the chart."""
    sides = sorted(shape.y for shape in chart(heights) if isinstance(shape, Label) and "%" in shape.text)
    assert all(lower - upper >= 15 for upper, lower in pairwise(sides))
    assert all(y >= 50 for y in sides)
