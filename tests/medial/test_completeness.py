"""Discs of the axis against those of the definition."""

from dataclasses import replace

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of

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
