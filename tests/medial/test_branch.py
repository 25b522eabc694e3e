"""Branches as curves, held against the definition of a maximal disc."""

from itertools import pairwise

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, profile_of
from oracle import check_definition, check_restored

from mashape_cad.geometry.edge import BSpline, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.branch import contact_before, discs_on_piece, sampled_branches
from mashape_cad.medial.tour import site

_ALL = [*KNOWN, *NAMED]


@pytest.mark.parametrize("name", _ALL)
def test_discs_are_those_of_the_definition(name):
    """Radius min |q - p|^2 / (2 n.(q - p)), by brute force over the whole boundary, and never off a branch."""
    check_definition(profile_of(name), axis_of(name), seed=7, count=12)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", _ALL)
def test_discs_are_those_of_the_definition_in_long(name, seed):
    """The same at many more places."""
    check_definition(profile_of(name), axis_of(name), seed, count=120)


@pytest.mark.parametrize("name", _ALL)
def test_the_discs_restore_the_area(name):
    """No branch is missing, and none is too much."""
    check_restored(profile_of(name), axis_of(name))


@pytest.mark.parametrize("step", [3.0, 0.5, 0.01])
def test_the_step_bounds_the_distance_of_neighbours(step):
    """Also where the centre hardly moves while the boundary runs on, and where it runs fast."""
    for name in ("wave", "blob", "bracket"):
        for run in sampled_branches(axis_of(name), step):
            assert np.hypot(*np.diff(run.centre, axis=0).T).max() <= step * (1 + 1e-12)


def test_branches_are_sampled_in_order():
    """Along the rectangle's middle branch x grows or falls, and nothing else happens."""
    axis = axis_of("rectangle")
    run = max(sampled_branches(axis, 0.05), key=lambda run: float(np.ptp(run.centre[:, 0])))
    steps = np.diff(run.centre[:, 0])
    assert np.all(steps > 0) or np.all(steps < 0)
    assert run.radius == pytest.approx(1.5, abs=1e-14)


def test_a_closed_branch_comes_back():
    """The ring's one branch begins and ends at its seam and goes once round."""
    axis = axis_of("eccentric ring")
    (run,) = sampled_branches(axis, 0.1)
    assert np.array_equal(run.centre[0], run.centre[-1])
    angle = np.unwrap(np.arctan2(*(run.centre - axis.profile.outer.edges[0].centre).T[::-1]))
    assert abs(angle[-1] - angle[0]) == pytest.approx(2 * np.pi)


def test_a_disc_has_no_branch_to_sample():
    """One node, no branch, no error."""
    assert sampled_branches(axis_of("disc"), 0.1) == ()


@pytest.mark.parametrize("name", ["blob with holes", "bracket", "cross", "frame"])
def test_both_sides_of_a_piece_see_the_same_discs(name):
    """From a place to its twin and back: the same disc, the same place."""
    axis = axis_of(name)
    for piece in range(len(axis.pieces.disc)):
        low, high = axis.pieces.low[piece], axis.pieces.high[piece]
        t = low[0] + (high[0] - low[0]) * np.array([0.2, 0.5, 0.8])
        there = discs_on_piece(axis, piece, t, side=0)
        back = discs_on_piece(axis, piece, there[:, 3], side=1)
        assert back[:, :3] == pytest.approx(there[:, :3], abs=1e-11)
        assert np.all((low[1] <= there[:, 3]) & (there[:, 3] <= high[1]))
        assert np.all(np.diff(there[:, 3]) <= 1e-9)  # the other side runs back


@pytest.mark.parametrize("name", ["blob with holes", "bracket", "stadium", "plate with holes"])
def test_the_contact_before_a_place(name):
    """It stands at or before the place on the same loop, none lies between, and it starts the piece of the place."""
    axis = axis_of(name)
    tour, contacts, pieces = axis.tour, axis.contacts, axis.pieces
    rng = np.random.default_rng(3)
    element = rng.choice(np.flatnonzero(tour.degree > 0), 200)
    t = rng.uniform(0, 1, 200)
    contact, on_arc = contact_before(axis, element, t)
    first = contacts.first.sum(axis=1)
    loop = tour.loop[contacts.first[:, 0].astype(int)]
    for e, s, c, arc in zip(element, t, contact, on_arc, strict=True):
        mine = first[loop == tour.loop[e]]
        earlier = mine[mine <= e + s + 1e-9]
        assert first[c] == (earlier.max() if len(earlier) else mine.max())
        if not arc:
            piece, side = contacts.piece[c], contacts.side[c]
            assert pieces.element[piece, side] == e
            assert pieces.low[piece, side] <= s + 1e-9
            assert s <= pieces.high[piece, side] + 1e-9


def test_a_place_on_a_contact_belongs_to_the_piece_that_follows():
    """Reading 9: at a junction's foot the branch is the next one round the boundary."""
    axis = axis_of("ell")
    for number, (e, t) in enumerate(axis.contacts.first):
        contact, on_arc = contact_before(axis, np.array([int(e)]), np.array([t]))
        assert (contact[0], bool(on_arc[0])) == (number, False)


def test_places_on_an_arc_that_is_touched_as_a_whole():
    """The stadium's ends: every place inside belongs to the arc's disc, and to no piece."""
    axis = axis_of("stadium")
    tour = axis.tour
    for e in np.flatnonzero(tour.degree > 1):
        contact, on_arc = contact_before(axis, np.array([e]), np.array([0.5]))
        assert on_arc[0]
        disc = axis.contacts.disc[contact[0]]
        foot = np.array(site(tour, int(e), 0.5)[:2]) * axis.frame.size + axis.frame.middle
        assert np.hypot(*(foot - axis.discs.centre[disc])) == pytest.approx(axis.discs.radius[disc], rel=1e-12)


def test_twins_next_to_a_bent_wedge_are_found():
    """A step of the search behind the boundary was taken for the end of it: radii of four sizes of the shape came out.

    An outline of a pocket had this wedge; its certificate said that the discs cover 69 mm2 too much.
    """
    knots = [0.0] * 4 + [1.0] * 4
    first = BSpline.of(3, knots, [(0.163, 0.016), (0.157, -0.105), (0.083, -0.07), (0.023, -0.004)])
    second = BSpline.of(3, knots, [(0.023, -0.004), (-0.25, 0.183), (-0.531, -0.097), (-0.823, -0.069)])
    around = [(-0.823, -0.069), (-0.823, -1.5), (0.4, -1.5), (0.4, 0.3), (0.163, 0.016)]
    lines = (Line.of(a, b) for a, b in pairwise(around))
    axis = medial_axis(Profile.of(Loop((first, second, *lines))))
    widest = axis.discs.radius.max() / axis.frame.size
    for piece in range(len(axis.pieces.disc)):
        for side in (0, 1):
            t = np.linspace(axis.pieces.low[piece, side], axis.pieces.high[piece, side], 1001)[1:-1]
            assert discs_on_piece(axis, piece, t, side)[:, 2].max() <= widest + 1e-9
