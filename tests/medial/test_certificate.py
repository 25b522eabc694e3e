"""A certificate says what is so, and does not pass what is not."""

from dataclasses import replace

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, profile_of

from mashape_cad.medial.certificate import STATIONS, certificate
from mashape_cad.medial.graph import Branch, MedialAxis, Nodes


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_a_complete_axis_is_certified(name):
    """Errors far below what is promised, one component, as many cycles as holes."""
    profile = profile_of(name)
    found = certificate(axis_of(name))
    assert found.ok
    assert found.connected
    assert max(found.max_disc_error, found.max_foot_error) <= 1e-12
    assert found.cycles == found.holes == len(profile.holes)
    assert found.edges == len(profile.edges)


def test_the_figures_of_a_rectangle():
    """All of them can be told without a computer."""
    found = certificate(axis_of("rectangle"))
    assert (found.branches, found.junctions, found.ends, found.cycles) == (5, 2, 4, 0)
    assert (found.area_mm2, found.perimeter_mm, found.max_radius_mm) == pytest.approx((21.0, 20.0, 1.5))


def test_the_figures_of_a_disc_and_of_a_ring():
    """Neither has an end or a junction; the ring has a cycle."""
    disc, ring = certificate(axis_of("disc")), certificate(axis_of("concentric ring"))
    assert (disc.branches, disc.junctions, disc.ends, disc.cycles, disc.ok) == (0, 0, 0, 0, True)
    assert (ring.branches, ring.junctions, ring.ends, ring.cycles, ring.ok) == (1, 0, 0, 1, True)
    assert disc.max_radius_mm == pytest.approx(1.7)
    assert ring.area_mm2 == pytest.approx(np.pi * (9 - 1.21))


def _without_branch(axis: MedialAxis, number: int) -> MedialAxis:
    """Forget one branch."""
    return replace(axis, branches=axis.branches[:number] + axis.branches[number + 1 :])


def _without_node(axis: MedialAxis, node: int) -> MedialAxis:
    """Forget a node and the branches that meet there; degrees of the others shrink, so that they agree again."""
    branches = [b for b in axis.branches if node not in {b.start, b.end}]
    kept = np.delete(np.arange(len(axis.nodes.degree)), node)
    new = {int(old): number for number, old in enumerate(kept)}
    meeting = np.bincount([n for b in branches for n in (b.start, b.end)], minlength=len(kept) + 1)
    nodes = Nodes(
        axis.nodes.centre[kept],
        axis.nodes.radius[kept],
        meeting[kept],
        tuple(axis.nodes.kind[k] for k in kept),
        axis.nodes.disc[kept],
    )
    renumbered = tuple(Branch(new[b.start], new[b.end], b.pieces) for b in branches)
    return replace(axis, nodes=nodes, branches=renumbered)


def _with_discs(axis: MedialAxis, **arrays: np.ndarray) -> MedialAxis:
    return replace(axis, discs=replace(axis.discs, **arrays))


_TREES = ["rectangle", "ell", "12-gon", "blob", "bracket", "hole grid"]


@pytest.mark.parametrize("name", _TREES)
def test_a_missing_branch_is_noticed(name):
    """Whichever it is."""
    axis = axis_of(name)
    for number in range(len(axis.branches)):
        assert not certificate(_without_branch(axis, number)).ok


@pytest.mark.parametrize("name", _TREES)
def test_a_missing_node_is_noticed(name):
    """An end with its branch, or a junction with all of its branches, although the degrees are made to agree."""
    axis = axis_of(name)
    for node in range(len(axis.nodes.degree)):
        assert not certificate(_without_node(axis, node)).ok


@pytest.mark.parametrize("name", [*_TREES, "ellipse", "stadium", "disc", "eccentric ring"])
def test_a_disc_out_of_place_is_noticed(name):
    """Its feet are no longer one radius away."""
    axis = axis_of(name)
    for disc in range(len(axis.discs.radius)):
        centre = axis.discs.centre.copy()
        centre[disc] += 1e-6 * axis.profile.diagonal
        assert not certificate(_with_discs(axis, centre=centre)).ok


@pytest.mark.parametrize("name", [*_TREES, "ellipse", "stadium", "disc", "eccentric ring"])
def test_a_disc_that_is_too_large_or_too_small_is_noticed(name):
    """The kernel's distance tells."""
    axis = axis_of(name)
    for change in (-1e-6, 1e-6):
        for disc in range(len(axis.discs.radius)):
            radius = axis.discs.radius.copy()
            radius[disc] += change * axis.profile.diagonal
            assert not certificate(_with_discs(axis, radius=radius)).ok


@pytest.mark.parametrize("name", ["ellipse", "disc", "blob with holes", "hole grid"])
def test_all_figures_of_a_certified_axis(name):
    """Both names of the verdict, both errors of area and definition, no reason; without stations one of them less."""
    found, short = certificate(axis_of(name), STATIONS), certificate(axis_of(name))
    assert (found.ok, found.certified, found.euler_ok, found.counting_ok, found.reason) == (True, True, True, True, "")
    assert max(found.area_error, found.completeness_error) <= 1e-10
    assert short.completeness_error is None
    assert short.area_error == found.area_error


def test_an_axis_that_makes_no_sense_is_refused_and_not_computed_with():
    """Numbers that refer to nothing."""
    axis = axis_of("ell")
    disc = axis.contacts.disc.copy()
    disc[0] = 99
    found = certificate(replace(axis, contacts=replace(axis.contacts, disc=disc)), STATIONS)
    assert not found.ok
    assert found.reason == "pairing: discs of contacts refer to what is not there"


def test_an_axis_in_two_parts_says_where_the_other_part_is():
    """The place is a node that no branch joins to the first one."""
    axis = _without_branch(axis_of("rectangle"), 0)
    found = certificate(axis)
    assert not found.connected
    assert not found.euler_ok


def test_what_the_kernel_does_not_confirm_is_noticed():
    """Centre, radius and feet agree with one another, but something else of the boundary is nearer."""
    axis = axis_of("bracket")
    clearance = axis.discs.clearance.copy()
    clearance[3] -= 1e-6 * axis.profile.diagonal
    assert not certificate(_with_discs(axis, clearance=clearance)).ok


def test_errors_below_what_is_promised_pass():
    """1e-8 of the diagonal is within 1e-7; the figure says how much it is."""
    axis = axis_of("bracket")
    clearance = axis.discs.clearance + 1e-8 * axis.profile.diagonal
    found = certificate(_with_discs(axis, clearance=clearance))
    assert found.ok
    assert found.max_disc_error == pytest.approx(1e-8, rel=1e-3)


def test_errors_are_relative_to_the_diagonal():
    """The same shape a thousand times as large has the same figures."""
    small = certificate(axis_of("ell"))
    assert small.max_disc_error * profile_of("ell").diagonal <= 1e-14
