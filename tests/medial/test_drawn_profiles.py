"""Profiles of everything, drawn by Hypothesis: certified, and by brute force too; where they cross they are refused."""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from mixed import crossings, is_simple
from oracle import check_definition, check_densely
from strategies import crossing_profiles, profiles, similarities

from mashape_cad.errors import InvalidProfileError
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import STATIONS, certificate
from mashape_cad.medial.tour import tour
from mashape_cad.medial.validity import check_simple

_FEW = settings(
    max_examples=10, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck)
)
_ON_DEMAND = pytest.mark.skipif(not os.environ.get("MASHAPE_ALL"), reason="takes half an hour: MASHAPE_ALL=1")
_MANY = settings(_FEW, max_examples=2000)


def check(profile: Profile, places: int) -> None:
    """The axis is certified, and brute force agrees; a profile that is refused crosses or touches itself where it says.

    What fine polygons find to cross is refused in any case.
    """
    refused = _refused(profile)
    if refused is not None:
        met = crossings(profile)
        assert refused.kind in {"crossing", "touching"}, refused
        assert len(met), refused
        assert np.hypot(*(met - refused.place).T).min() <= 1e-3 * profile.diagonal, refused
        return
    axis = medial_axis(profile)
    assert is_simple(profile)
    assert certificate(axis, STATIONS).reason == ""
    check_densely(profile, axis)
    check_definition(profile, axis, seed=len(profile.edges), count=places)


def _refused(profile: Profile) -> InvalidProfileError | None:
    """What the search for crossings says, which comes first."""
    try:
        check_simple(*tour(profile))
    except InvalidProfileError as error:
        return error
    return None


@given(profiles())
@_FEW
def test_some_profiles_of_everything(profile):
    """Lines, arcs, splines of degree 2 to 5, rational, tiny and smooth corners, up to six holes."""
    check(profile, 4)


@pytest.mark.slow
@_ON_DEMAND
@given(profiles())
@_MANY
def test_two_thousand_profiles_of_everything(profile):
    """None is left out."""
    check(profile, 1)


@given(profiles(), similarities())
@_FEW
def test_profiles_of_everything_in_any_pose(profile, similarity):
    """Scaled by a thousandth to ten thousand, moved, turned, mirrored."""
    check(profile.transformed(similarity), 2)


@given(crossing_profiles())
@_FEW
def test_some_profiles_that_may_cross_themselves(profile):
    """Refused with the place, or certified."""
    check(profile, 1)


@pytest.mark.slow
@_ON_DEMAND
@given(crossing_profiles())
@settings(_FEW, max_examples=50)
def test_many_profiles_that_may_cross_themselves(profile):
    """The same, five times as many."""
    check(profile, 1)
