import numpy as np
import pytest

from mashape_cad.matching.scanlines import symmetric_difference

SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])


def ring(radius, count=4000):
    """A circle about the origin."""
    angle = 2 * np.pi * np.arange(count) / count
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def test_equal_sets_differ_by_nothing():
    """However their rings begin and run."""
    assert symmetric_difference([SQUARE], [np.roll(SQUARE[::-1], 1, axis=0)]) < 1e-12


@pytest.mark.parametrize("shift", [(0.5, 0.0), (0.0, 0.25), (1e-4, 0.0), (3.0, 0.0)])
def test_shifted_squares(shift):
    """Twice what is left of the square outside the overlap."""
    overlap = max(0.0, 1 - shift[0]) * max(0.0, 1 - shift[1])
    assert symmetric_difference([SQUARE], [SQUARE + shift]) == pytest.approx(2 * (1 - overlap), rel=2e-3)


def test_a_hole_counts():
    """A disc with and without a hole differ by the hole, which way round it may run."""
    for hole in (ring(0.3), ring(0.3)[::-1]):
        assert symmetric_difference([ring(1.0), hole], [ring(1.0)]) == pytest.approx(np.pi * 0.09, rel=2e-3)


def test_crossing_outlines():
    """A square turned by 45 degrees about its centre: eight triangles."""
    turned = (SQUARE - 0.5) @ np.array([[1, 1], [-1, 1]]) / np.sqrt(2) + 0.5
    octagon = 2 * (np.sqrt(2) - 1)  # area shared by the two
    assert symmetric_difference([SQUARE], [turned]) == pytest.approx(2 * (1 - octagon), rel=2e-3)
