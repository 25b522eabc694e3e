"""The boundary is paired, stretch by stretch."""

from dataclasses import replace

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of

from mashape_cad.medial import pairing
from mashape_cad.medial.pairing import next_contacts, pairing_objections, reference_objections


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_axes_of_the_catalogue_pair_their_boundary(name):
    """Nothing is referred to that is not there, either."""
    axis = axis_of(name)
    assert not list(reference_objections(axis))
    assert not list(pairing_objections(axis))


def test_contacts_follow_one_another_on_their_own_loop():
    """The last one of a loop is followed by its first."""
    axis = axis_of("blob with holes")
    after = next_contacts(axis.tour, axis.contacts)
    loop = axis.tour.loop[axis.contacts.first[:, 0].astype(int)]
    assert np.array_equal(np.sort(after), np.arange(len(loop)))
    assert np.array_equal(loop[after], loop)


def test_a_gap_that_two_pieces_share_is_noticed():
    """A piece that ends short of its disc, and one that reaches over."""
    axis = axis_of("bracket")
    high = axis.pieces.high.copy()
    high[4, 0] -= 1e-3
    texts = [str(o) for o in pairing_objections(replace(axis, pieces=replace(axis.pieces, high=high)))]
    assert any("is not the stretch of its piece" in text for text in texts)


def test_sides_that_are_crossed_over_are_noticed():
    """Each gap is paired and the discs are right, but twins lie on the same side of a corridor's end."""
    axis = axis_of("hole grid")
    at = np.flatnonzero(axis.contacts.disc == int(np.argmax(axis.discs.degree)))
    assert axis.discs.degree.max() == 4
    piece, side = axis.contacts.piece.copy(), axis.contacts.side.copy()
    piece[at[0]], piece[at[2]] = piece[at[2]], piece[at[0]]
    side[at[0]], side[at[2]] = side[at[2]], side[at[0]]
    crossed = replace(axis, contacts=replace(axis.contacts, piece=piece, side=side))
    assert list(pairing_objections(crossed))


def test_contacts_of_a_junction_in_the_wrong_order_are_noticed(monkeypatch):
    """Seen in a mirror, one would have to turn the other way: only discs with two contacts are the same both ways."""
    axis = axis_of("bracket")
    seen = pairing._spoke_angles
    monkeypatch.setattr(pairing, "_spoke_angles", lambda tour, places: -seen(tour, places))
    found = [objection for objection in pairing_objections(axis) if "clockwise" in objection.text]
    junctions = axis.discs.centre[axis.discs.degree > 2]
    assert {objection.place for objection in found} == {tuple(place) for place in junctions.tolist()}


def test_numbers_that_refer_to_nothing_are_noticed():
    """Before anything is looked up by them."""
    axis = axis_of("ell")
    disc = axis.pieces.disc.copy()
    disc[0, 0] = len(axis.discs.radius)
    [objection] = reference_objections(replace(axis, pieces=replace(axis.pieces, disc=disc)))
    assert "discs of pieces" in objection.text
