"""Default signatures in one matrix product."""

import numpy as np
import pytest

from mashape_cad.library.shapes import UNIT, Shapes


@pytest.fixture
def rows():
    """Whole numbers of norm 400, about."""
    drawn = np.random.default_rng(4).normal(size=(50, 256))
    return np.clip(np.rint(drawn / np.linalg.norm(drawn, axis=1)[:, None] * UNIT), -127, 127)


def test_distances_are_euclidean(rows):
    """In units of the norm."""
    expected = np.linalg.norm(rows - rows[3], axis=1) / UNIT
    assert Shapes.of(rows).distances(rows[3].tolist()) == pytest.approx(expected, abs=1e-6)
    assert Shapes.of(rows).pairs()[3] == pytest.approx(expected, abs=1e-12)


def test_equal_signatures_are_at_distance_0_exactly(rows):
    """In whatever order sums are added up: even the largest stay below 2^24."""
    for signature in (rows[0], np.full(256, 90.0)):
        assert Shapes.of([signature, rows[1]]).distances(signature)[0] == 0.0
