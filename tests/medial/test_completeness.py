"""Discs of the axis against those of the definition."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of

from mashape_cad.geometry.edge import BSpline, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.completeness import completeness


def _held(axis, per_span):
    return completeness(axis, axis.profile.diagonal, per_span)


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_axes_of_the_catalogue_have_the_discs_that_the_kernel_finds(name):
    """At seven places of every span, to ten digits."""
    axis = axis_of(name)
    found = _held(axis, 7)
    assert not found.objections
    assert found.error.max() <= 1e-10 * axis.profile.diagonal
    assert len(found.error) == 7 * np.count_nonzero(axis.tour.degree)


def test_a_piece_with_the_wrong_twin_is_noticed():
    """Where stations lie on it, the largest error first."""
    axis = axis_of("rectangle")
    pieces = axis.pieces
    longest = int(np.argmax((pieces.high - pieces.low).min(axis=1)))
    element = pieces.element.copy()
    element[longest, 1] = axis.tour.after[element[longest, 0]]
    found = _held(replace(axis, pieces=replace(pieces, element=element)), 7)
    assert found.objections
    assert found.error.max() > 1e-2
    place = found.place[np.argmax(found.error)]
    assert found.objections[0].place == pytest.approx(tuple(place))


def _rounded_kink() -> Profile:
    """A quartic with a kink that is rounded within a few hundred-thousandths of its length, by knots close together."""
    knots = [0.0] * 5 + [0.4997712, 0.4999944, 0.5004096, 0.5081144] + [1.0] * 5
    poles = [(-0.3274, 0.3778), (-0.3594, 0.3631), (-0.3611, 0.3158), (-0.3844, 0.289), (-0.4034, 0.2594),
             (-0.4215, 0.2292), (-0.4376, 0.1978), (-0.4598, 0.1702), (-0.4794, 0.141)]  # fmt: skip
    side = BSpline.of(4, knots, poles)
    corners = [poles[-1], (0.12, 0.04), (0.27, 0.48), poles[0]]
    return Profile.of(Loop((side, *(Line.of(p, q) for p, q in pairwise(corners)))))


def test_places_beside_an_end_that_was_taken_for_an_arc():
    """The boundary leaves the end's circle by less than rounding, up to a knot: that is one contact.

    The maximal discs of places there lie on the branch, up to some hundred-thousandths of the size away from the end;
    they were held against the end's disc alone, and the axis was refused.
    """
    axis = medial_axis(_rounded_kink())
    found = _held(axis, 100)
    assert not found.objections
    assert found.error.max() <= 1e-8 * axis.profile.diagonal
