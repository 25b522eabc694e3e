"""From faces to the graph: pieces, contacts, branches."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, profile_of

from mashape_cad.medial.branch import discs_on_piece
from mashape_cad.medial.tour import site

_CUT = [name for name in (*KNOWN, *NAMED) if name != "disc"]


@pytest.mark.parametrize("name", _CUT)
def test_every_piece_belongs_to_one_branch(name):
    """And the pieces of a branch follow one another from its start to its end."""
    axis = axis_of(name)
    used = sorted(piece for branch in axis.branches for piece, _ in branch.pieces)
    assert used == list(range(len(axis.pieces.disc)))
    for branch in axis.branches:
        at = axis.nodes.disc[branch.start]
        for piece, forward in branch.pieces:
            first, last = axis.pieces.disc[piece] if forward else axis.pieces.disc[piece][::-1]
            assert first == at
            at = last
        assert at == axis.nodes.disc[branch.end]


@pytest.mark.parametrize("name", _CUT)
def test_sides_of_a_piece_end_on_the_discs_at_its_ends(name):
    """Side 0 runs from disc 0 to disc 1, side 1 back."""
    axis = axis_of(name)
    centre = (axis.discs.centre - axis.frame.middle) / axis.frame.size
    radius = axis.discs.radius / axis.frame.size
    for piece, (a, b) in enumerate(axis.pieces.disc):
        for side, discs in ((0, (a, b)), (1, (b, a))):
            e = int(axis.pieces.element[piece, side])
            for t, disc in zip((axis.pieces.low[piece, side], axis.pieces.high[piece, side]), discs, strict=True):
                x, y, *_ = site(axis.tour, e, t)
                assert np.hypot(*((x, y) - centre[disc])) == pytest.approx(radius[disc], abs=1e-10)


@pytest.mark.parametrize("name", _CUT)
def test_discs_on_a_piece_lead_from_one_of_its_discs_to_the_other(name):
    """Near its ends the piece comes near their centres."""
    axis = axis_of(name)
    centre = (axis.discs.centre - axis.frame.middle) / axis.frame.size
    for piece, (a, b) in enumerate(axis.pieces.disc):
        low, high = axis.pieces.low[piece, 0], axis.pieces.high[piece, 0]
        ends = discs_on_piece(axis, piece, low + (high - low) * np.array([1e-4, 1 - 1e-4]))[:, :2]
        assert np.hypot(*(ends[0] - centre[a])) <= 2e-2
        assert np.hypot(*(ends[1] - centre[b])) <= 2e-2


@pytest.mark.parametrize("name", _CUT)
def test_contacts_stand_in_the_order_of_the_tour(name):
    """Each starts the piece whose side begins there."""
    axis = axis_of(name)
    contacts = axis.contacts
    places = [tuple(row) for row in contacts.first]
    assert places == sorted(places)
    for c in range(len(contacts.disc)):
        piece, side = contacts.piece[c], contacts.side[c]
        e, t = contacts.last[c]
        assert (axis.pieces.element[piece, side], axis.pieces.low[piece, side]) == (e, t)
        assert axis.pieces.disc[piece, side] == contacts.disc[c]
    assert np.array_equal(np.bincount(contacts.disc, minlength=len(axis.discs.radius)), axis.discs.degree)


def test_the_disc_of_a_whole_domain():
    """One node of degree 0, one contact all round, no piece."""
    axis = axis_of("disc")
    assert (axis.nodes.kind, axis.nodes.degree.tolist(), axis.branches) == (("disc",), [0], ())
    assert len(axis.pieces.disc) == 0
    assert axis.components == 1
    assert axis.cycles == 0


def test_nodes_are_what_is_not_in_the_middle_of_a_branch():
    """Discs with one contact are ends, with three and more junctions."""
    for name in _CUT:
        axis = axis_of(name)
        if "seam" not in axis.nodes.kind:
            assert np.array_equal(axis.nodes.disc, np.flatnonzero(axis.discs.degree != 2))
        assert len(axis.profile.holes) == len(profile_of(name).holes)
