"""From a distance to a score."""

import numpy as np

from mashape_cad.library.score import scores


def test_a_copy_has_100_and_the_score_falls_with_the_distance():
    """It stays between 0 and 100."""
    found = scores(np.linspace(0.0, 2.0, 41))
    assert found[0] == 100.0
    assert (np.diff(found) < 0).all()
    assert found[-1] >= 0.0


def test_what_does_not_show_leaves_99():
    """Up to a twentieth of the usual distance to the nearest shape a part is taken for the same."""
    assert scores(0.03) >= 99.0
