"""Settled discs are measured anew: by the kernel, and at every contact, along and across its normal."""

from dataclasses import replace

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of

from mashape_cad.medial.confirmation import confirmation


def _confirmed(axis):
    return confirmation(axis, axis.profile.diagonal)


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_discs_of_the_catalogue_are_confirmed_to_rounding(name):
    """Distance, contacts and normals alike."""
    axis = axis_of(name)
    found = _confirmed(axis)
    assert not found.objections
    assert max(found.disc.max(), found.foot.max()) <= 1e-14 * axis.profile.diagonal
    assert found.slant.max() <= 1e-14 * axis.profile.diagonal


def test_a_centre_that_slides_along_a_corridor_is_noticed():
    """Both walls of a stadium are as near as before; only the normals of its contacts tell."""
    axis = axis_of("stadium")
    centre = axis.discs.centre.copy()
    centre[0, 0] -= 1e-6 * np.sign(centre[0, 0]) * axis.profile.diagonal
    found = _confirmed(replace(axis, discs=replace(axis.discs, centre=centre)))
    assert found.disc[0] <= 1e-12 * axis.profile.diagonal
    assert found.slant[0] == pytest.approx(1e-6 * axis.profile.diagonal, rel=1e-3)
    assert {objection.check for objection in found.objections} == {"foot"}
    assert np.hypot(*(np.array(found.objections[0].place) - centre[0])) <= 1e-12


def test_a_centre_on_the_wrong_side_is_noticed():
    """As far from the wall, on the outside: the kernel's distance to a lone wall does not tell, the normal does."""
    axis = axis_of("rectangle")
    centre = axis.discs.centre.copy()
    disc = int(np.argmax(axis.discs.radius * (axis.discs.degree > 2)))
    centre[disc, 1] -= 2 * axis.discs.radius[disc]
    found = _confirmed(replace(axis, discs=replace(axis.discs, centre=centre)))
    assert any(objection.check == "foot" and f"disc {disc} " in objection.text for objection in found.objections)


def test_a_footpoint_that_is_not_where_its_edge_says_is_noticed():
    """A parameter that is off by a thousandth."""
    axis = axis_of("bracket")
    u = axis.discs.foot_u.copy()
    u[3, 0] = abs(u[3, 0] - 1e-3)
    [objection] = _confirmed(replace(axis, discs=replace(axis.discs, foot_u=u))).objections
    assert "a footpoint of disc 3" in objection.text
    assert objection.place == pytest.approx(tuple(axis.discs.foot[3, 0]))


def test_what_a_disc_has_on_record_is_granted():
    """A disc settled within 1e-3 may be off by that."""
    axis = axis_of("bracket")
    radius = axis.discs.radius + 5e-4
    off = replace(axis.discs, radius=radius)
    assert _confirmed(replace(axis, discs=off)).objections
    granted = replace(off, tolerance=axis.discs.tolerance + 1e-3)
    assert not _confirmed(replace(axis, discs=granted)).objections
