import numpy as np
import pytest
from matching.shapes import bracket, flange, gear

from mashape_cad.geometry.edge import Similarity
from mashape_cad.geometry.profile import Profile
from mashape_cad.matching.outline import Outline
from mashape_cad.matching.turning import candidate_turns

FULL = 2 * np.pi


def turns(profile, angle, most=32):
    """Candidates for laying a profile that was turned by an angle back over itself."""
    turned = Outline(profile.transformed(Similarity.of(3.0, angle, (5.0, 8.0))))
    return candidate_turns(Outline(profile).spectrum, turned.spectrum, most)


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.9, 4.4])
def test_the_first_candidate_undoes_a_turn(angle):
    """To a tenth of a degree, whatever move and scale came with it."""
    off = (turns(bracket(), angle)[0] + angle + np.pi) % FULL - np.pi
    assert abs(off) < np.radians(0.1)


@pytest.mark.parametrize(("profile", "fold"), [(flange(6), 6), (gear(14), 14)])
def test_a_symmetric_shape_has_a_candidate_for_each_turn_into_itself(profile, fold):
    """Evenly around."""
    found = np.sort(turns(profile, 0.4) % FULL)
    nearest = [np.min(np.abs((found + 0.4 - k * FULL / fold + np.pi) % FULL - np.pi)) for k in range(fold)]
    assert max(nearest) < np.radians(0.2)


def test_of_a_disc_no_turn_is_better():
    """And one will do."""
    from catalogue import circle

    assert len(turns(Profile.of(circle(0, 0, 5.0)), 1.0, most=1)) == 1
