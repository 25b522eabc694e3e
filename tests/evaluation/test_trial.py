import numpy as np
import pytest

from mashape_cad.evaluation.trial import coarser, tried
from mashape_cad.options import PartOptions


def test_half_as_many_stations_are_the_papers_coarser_step():
    """0.02 for 0.01 (reading 2)."""
    assert coarser(100) == 50
    assert coarser(3) == 1


@pytest.mark.slow
def test_a_trial_times_the_steps_and_keeps_the_coarse_signature(freeform80):
    """The very numbers that half the stations give."""
    from mashape_cad import medial_axis, read, signature

    path = freeform80 / "rect-1.dxf"
    found = tried(path, "hash", 0, PartOptions())
    expected = signature(medial_axis(read(path).profiles[0]), per_edge=50).vectors
    for name, vector in expected.items():
        np.testing.assert_array_equal(found.coarse[name], vector)
    seconds = found.seconds
    assert min(seconds.reading, seconds.axis, seconds.signature, seconds.coarse_signature) > 0
