# ruff: noqa: RUF001  -- the sign of multiplication is meant

import numpy as np
import pytest

from mashape_cad.views.drawing import Placement, dimensions, printable


def test_a_part_is_centred_and_as_large_as_it_gets():
    """A box of 4 x 2 mm in 100 x 100 pixels at (10, 20) is 25 pixels to the mm, and y runs downwards."""
    placement = Placement.fitting(np.array([(1.0, 1.0), (5.0, 3.0)]), 10, 20, 100, 100)
    assert placement.scale == 25
    corners = placement.apply(np.array([(1.0, 1.0), (5.0, 3.0)]))
    assert corners.tolist() == [[10.0, 95.0], [110.0, 45.0]]


def test_a_part_of_no_size_still_has_a_place():
    """Its points land in the middle of the rectangle."""
    placement = Placement.fitting(np.zeros((2, 2)), 0, 0, 100, 60)
    assert placement.apply(np.zeros((1, 2))).tolist() == [[50.0, 30.0]]


@pytest.mark.parametrize(
    ("size", "text"),
    [((98.04, 7.0), "98.0 × 7.00 mm"), ((1234.5, 0.25), "1234 × 0.250 mm"), ((100.4, 99.96), "100 × 100 mm")],
)
def test_sizes_have_three_digits(size, text):
    """Large ones are not written with an exponent."""
    assert dimensions(*size) == text


def test_names_lose_what_cannot_be_shown():
    """Control characters, halves of characters and line breaks, which file names may hold."""
    assert printable("a\x00b\udce4c\nd\u00a0e") == "a\ufffdb\ufffdc d e"


def test_long_names_lose_their_middle():
    """Beginning and end tell files apart."""
    short = printable("a" * 20 + "-left.dxf", 12)
    assert len(short) == 12
    assert short == "aaaaaa…t.dxf"
    assert printable("short.dxf", 12) == "short.dxf"
