import numpy as np
import pytest

from mashape_cad.views.likeness import Likeness


def test_a_record_is_unpacked_to_millimetres(plate):
    """Corner plus pitch times grid point; radii too."""
    likeness = Likeness.of_record(plate)
    assert likeness.loops[0].tolist() == [[10, 5], [60, 5], [60, 25], [10, 25]]
    assert likeness.loops[1][0].tolist() == pytest.approx([50, 13])
    assert likeness.branches[0].tolist() == [[10, 5, 0], [20, 15, 10]]
    assert likeness.bounds.tolist() == [[10, 5], [60, 25]]
    assert likeness.largest_radius == 10


def test_nothing_has_no_size():
    """A record of a profile without extent holds no loops."""
    assert Likeness(()).bounds.tolist() == [[0, 0], [0, 0]]
    assert Likeness(()).largest_radius == 0


def test_an_outline_is_laid_elsewhere_by_six_numbers():
    """A point (p, q) lies at (a p + b q + x, c p + d q + y)."""
    laid = Likeness((np.array([(1.0, 2.0)]),)).placed((0.0, -1.0, 1.0, 0.0, 10.0, 20.0))
    assert laid.loops[0].tolist() == [[8.0, 21.0]]
    assert laid.branches == ()
