"""Spokes: equal steps along the boundary, and the significant disc of each."""

import numpy as np
import pytest
from catalogue import axis_of, circle, ellipse, polygon, profile_of

from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.signatures.boundary_steps import equal_steps
from mashape_cad.signatures.spokes import spokes

# In the hole grid places lie on the quadrants of circles, where one element of the boundary ends and the next starts:
# taken for the end of the one, they had been given a disc of the other's far end.
_NAMES = (
    "ellipse",
    "bracket",
    "blob with holes",
    "plate with holes",
    "hole grid",
    "keyhole",
    "stadium",
    "rational blob",
)


@pytest.mark.parametrize("name", [*_NAMES, "disc"])
def test_steps_are_equal_and_measure_the_perimeter_and_the_area(name):
    """Weights are shares of the perimeter, and the area comes out of the same pass."""
    profile, axis = profile_of(name), axis_of(name)
    steps = equal_steps(axis, 400)
    assert steps.weight.sum() == pytest.approx(1.0)
    assert steps.area * axis.frame.size**2 == pytest.approx(profile.area, rel=1e-5)
    lengths = np.bincount(steps.loop, steps.weight) * profile.perimeter
    assert lengths == pytest.approx([loop.length for loop in profile.loops], rel=1e-5)


def test_steps_on_a_circle_are_all_alike():
    """Each is as far from the next."""
    steps = equal_steps(medial_axis(Profile.of(circle(3, 4, 2.0))), 100)
    chord = np.hypot(*(steps.point - np.roll(steps.point, 1, axis=0)).T)
    assert np.ptp(chord) < 1e-5


@pytest.mark.parametrize("name", _NAMES)
def test_without_a_threshold_discs_are_the_maximal_ones(name):
    """They touch the boundary at their feet, spokes are normals, and distances along the axis are no shorter."""
    shape = spokes(axis_of(name), 200, thickness=0.0)
    reach = np.hypot(*(shape.centre - shape.foot).T)
    assert reach == pytest.approx(shape.radius, abs=2e-3)
    straight = np.hypot(*(shape.centre[:, None] - shape.centre[None]).transpose(2, 0, 1))
    assert np.isfinite(shape.geodesic).all()
    assert (shape.geodesic >= straight - 2e-3).all()
    assert (shape.geodesic == shape.geodesic.T).all()


def test_small_bumps_are_retracted():
    """A bump's branch goes; its spokes reach to where the rest of the axis is."""
    corners = [(0.0, 0.0), (4.9, 0.0), (5.0, -0.05), (5.1, 0.0), (10.0, 0.0), (10.0, 4.0), (0.0, 4.0)]
    axis = medial_axis(Profile.of(polygon(corners)))
    shape = spokes(axis, 400)
    foot = shape.foot * axis.frame.size + axis.frame.middle
    on_bump = foot[:, 1] < -0.001
    assert on_bump.sum() >= 2
    assert shape.radius[on_bump] * axis.frame.size == pytest.approx(2.0, abs=0.05)


def test_a_rectangle_keeps_the_ridge_between_its_corners():
    """Erosion thickness is (sqrt 2 - 1) r on the branches into corners: their tips go, no more."""
    shape = spokes(axis_of("rectangle"), 400, thickness=0.05)
    size, area = 7.0, 21.0
    least = 0.05 * np.sqrt(area) / (np.sqrt(2) - 1) / size
    assert shape.radius.min() == pytest.approx(least, rel=0.02)
    assert shape.radius.max() == pytest.approx(1.5 / size, rel=1e-6)


def test_the_disc_has_one_centre():
    """No branch, no distances."""
    shape = spokes(axis_of("disc"), 100)
    assert not shape.geodesic.any()
    assert np.ptp(shape.centre, axis=0) == pytest.approx(0.0, abs=1e-12)


def test_what_is_nearly_round_shrinks_to_one_disc():
    """Both ends of the only branch are below the threshold: one centre between them is left."""
    shape = spokes(medial_axis(ellipse(2.0, 1.99).profile), 100)
    assert np.ptp(shape.centre, axis=0) == pytest.approx(0.0, abs=1e-9)
    assert not shape.geodesic.any()
