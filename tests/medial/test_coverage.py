"""The spokes of an axis fill the profile."""

from dataclasses import replace

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of

from mashape_cad.medial.coverage import coverage


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_discs_of_the_catalogue_cover_their_profile_and_no_more(name):
    """To ten digits and more, each piece its own region."""
    axis = axis_of(name)
    whole = axis.profile.area
    found = coverage(axis, whole)
    assert not found.objections
    assert found.area == pytest.approx(whole, rel=1e-10)
    assert np.abs(found.excess).max(initial=0.0) <= 1e-10 * whole


def test_twins_on_the_wrong_stretch_sweep_more_than_there_is():
    """The long walls of a rectangle, paired with its short ones: radii can only grow, and so does the area."""
    axis = axis_of("rectangle")
    pieces = axis.pieces
    lines = [axis.profile.edges[e].length() for e in axis.tour.edge]
    corridor = next(p for p, pair in enumerate(pieces.element) if {round(lines[e]) for e in pair} == {7})
    side = next(e for e in range(4) if round(lines[e]) == 3)
    element, low, high = pieces.element.copy(), pieces.low.copy(), pieces.high.copy()
    element[corridor, 1], low[corridor, 1], high[corridor, 1] = side, 0.0, 1.0
    wrong = replace(axis, pieces=replace(pieces, element=element, low=low, high=high))
    found = coverage(wrong, axis.profile.area)
    assert found.objections
    assert f"piece {corridor}," in found.objections[0].text


def test_the_place_of_a_fault_is_that_of_its_piece():
    """A disc too far out at the end of a piece changes its region."""
    axis = axis_of("bracket")
    centre = axis.discs.centre.copy()
    centre[5] += 0.01
    found = coverage(replace(axis, discs=replace(axis.discs, centre=centre)), axis.profile.area)
    concerned = np.flatnonzero((axis.pieces.disc == 5).any(axis=1))
    assert set(np.flatnonzero(np.abs(found.excess) > 1e-6)) <= set(concerned)
    assert found.objections
