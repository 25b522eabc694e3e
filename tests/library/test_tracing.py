"""From profiles to traced axes: all of them, whatever becomes of one."""

import numpy as np
import pytest
from catalogue import polygon, profile_of

from mashape_cad.errors import KernelUnavailableError
from mashape_cad.geometry.profile import Profile
from mashape_cad.library import tracing
from mashape_cad.library.tracing import traced_profiles
from mashape_cad.options import AxisOptions

CROSSED = Profile(polygon([(0, 0), (4, 4), (4, 0), (0, 3)]))


def test_a_refused_profile_costs_no_other():
    """The one that crosses itself is on record with kind and place, the others keep their numbers."""
    profiles = [(3, profile_of("rectangle")), (5, CROSSED), (8, profile_of("ellipse"))]
    traced, refused = traced_profiles(profiles, AxisOptions())
    assert [each.number for each in traced] == [3, 8]
    assert [(each.number, each.refused.kind) for each in refused] == [(5, "crossing")]
    assert refused[0].profile is CROSSED


def test_a_fault_of_ours_costs_one_profile_and_a_missing_kernel_all(monkeypatch):
    """The former is told as such; the latter is no fault of the file."""

    def broken(profile):
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(tracing, "medial_axis", broken)
    _, (refused,) = traced_profiles([(0, CROSSED)], AxisOptions())
    assert refused.refused.kind == "internal"

    def unavailable(profile):
        raise KernelUnavailableError("no kernel")

    monkeypatch.setattr(tracing, "medial_axis", unavailable)
    with pytest.raises(KernelUnavailableError):
        traced_profiles([(0, CROSSED)], AxisOptions())


def _largest_step(profile, **options):
    ((each,), _) = traced_profiles([(0, profile)], AxisOptions(**options))
    return max(np.hypot(*np.diff(branch.centre, axis=0).T).max() for branch in each.trace.branches)


def test_the_step_is_a_share_of_the_diagonal_unless_given():
    """0.5 %, and never further apart; a step in mm if one is given."""
    profile = profile_of("blob")
    assert 0.0025 < _largest_step(profile) / profile.diagonal <= 0.005 * (1 + 1e-9)
    assert 0.1 < _largest_step(profile, step=0.2) <= 0.2


def test_thresholds_are_degrees_and_millimetres():
    """The rectangle's corner branches have an object angle of 45 degrees and stick out by 0.62 mm."""
    for options, count in (
        ({"min_angle": 44.9}, 5),
        ({"min_angle": 45.1}, 1),
        ({"min_thickness": 0.62}, 5),
        ({"min_thickness": 0.63}, 1),
    ):
        ((each,), _) = traced_profiles([(0, profile_of("rectangle"))], AxisOptions(**options))
        assert len(each.trace.branches) == count


def test_splines_are_good_to_a_millionth_of_the_diagonal():
    """What DXF files promise."""
    profile = profile_of("ellipse")
    ((each,), _) = traced_profiles([(0, profile)], AxisOptions(), splines=True)
    from scipy.interpolate import BSpline

    (spline,) = (branch.spline for branch in each.trace.branches)
    x, y, r = BSpline(spline.knots, spline.poles, 3)(np.linspace(0, spline.knots[-1], 1000)).T
    assert np.abs(y).max() <= 1e-6 * profile.diagonal
    assert np.abs(r - np.sqrt(1 - x**2 / 3)).max() <= 1.5e-6 * profile.diagonal
