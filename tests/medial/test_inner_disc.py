"""One disc inside each piece."""

from dataclasses import replace

import pytest
from catalogue import KNOWN, NAMED, axis_of

from mashape_cad.geometry.edge import BSpline, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import certificate
from mashape_cad.medial.inner_disc import inner_disc_objections


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_discs_inside_the_pieces_of_the_catalogue_are_maximal(name):
    """Empty, with a foot on either stretch."""
    assert not list(inner_disc_objections(axis_of(name)))


def test_a_piece_whose_twins_lie_elsewhere_is_named():
    """Its other side cut in half."""
    axis = axis_of("ell")
    high, low = axis.pieces.high.copy(), axis.pieces.low
    high[2, 1] = low[2, 1] + (high[2, 1] - low[2, 1]) / 3
    found = list(inner_disc_objections(replace(axis, pieces=replace(axis.pieces, high=high))))
    assert [o.text for o in found if o.text.startswith("the disc inside piece 2,")]


@pytest.mark.parametrize("kink", [2e-7, 1e-6, 1e-4, 1e-2])
def test_thin_wedges_are_met(kink):
    """Two edges that turn by a millionth have a branch of their own, whose feet lie no further apart than that."""
    corners = [(0, 0), (2, -kink), (4, 0), (4, 3), (0, 3)]
    edges = [Line.of(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    axis = medial_axis(Profile.of(Loop(tuple(edges))))
    assert sum(kind == "end" for kind in axis.nodes.kind) == 5
    assert certificate(axis, stations=2).ok


def test_a_wedge_between_tightly_bent_edges_is_met():
    """An outline of an animal had one: half of the radius at its end is not near the middle of its stretches."""
    tip = BSpline.of(3, [0] * 4 + [1] * 4, [(2, 0), (1.2, 0.1), (0.5, 0.6), (0, 0)])
    back = BSpline.of(3, [0] * 4 + [1] * 4, [(0, 0), (0.6, -0.1), (1.4, -0.8), (2, -0.5)])
    profile = Profile.of(Loop((tip, back, Line.of((2, -0.5), (2, 0)))))
    assert certificate(medial_axis(profile), stations=3).ok
