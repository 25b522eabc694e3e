"""An axis with a fault is refused, whatever the fault, and the reason names its place."""

import os
import re
from functools import partial

import numpy as np
import pytest
from catalogue import axis_of, profile_of
from mutations import mutations, without_end

from mashape_cad import read
from mashape_cad.errors import AxisError
from mashape_cad.medial import cutting
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import certificate
from mashape_cad.medial.confirmation import confirmation
from mashape_cad.medial.coverage import coverage
from mashape_cad.medial.ends import ends
from mashape_cad.medial.faces import OSCULATING, add_contact, add_disc
from mashape_cad.medial.pairing import pairing_objections

_SHAPES = [
    "rectangle", "ell", "12-gon", "ellipse", "stadium", "rounded rectangle", "frame", "eccentric ring", "blob",
    "blob with holes", "bracket", "hole grid", "cross", "keyhole", "rational blob", "symmetric cap", "wave",
]  # fmt: skip
_SAMPLES = ["airplane-4", "bracket-2", "chassis-3", "ell-1", "gear-2"]
# Real parts, the larger one with 54 slots and round holes.
_REAL = ["step/cadquery__red_cube_blue_cylinder.step"]
# Of the mutations of one shape, so many are tried in the fast group, of one sample or real part in the slow one.
_FEW, _MANY, _SOME = 12, 150, 40


def _drawn(axis, count):
    """So many mutations, drawn at random from all, the same in every run."""
    every = list(mutations(axis))
    return [every[k] for k in np.random.default_rng(len(every)).permutation(len(every))[:count]]


def _check(mutation):
    """It is refused, and the place in the reason is one of those concerned, to the reason's six digits."""
    found = certificate(mutation.axis)
    assert not found.ok, mutation.name
    assert found.reason, mutation.name
    place = re.search(r"near \((.*), (.*)\) mm$", found.reason)
    assert place, (mutation.name, found.reason)
    x, y = map(float, place.groups())
    off = np.hypot(*(mutation.places - (x, y)).T).min()
    size = mutation.axis.profile.diagonal + np.abs(mutation.axis.profile.bounds).max()
    assert off <= 1e-5 * size, (mutation.name, found.reason, off)


@pytest.mark.parametrize("name", _SHAPES)
def test_some_mutations_are_refused(name):
    """Drawn at random from all: nodes and branches that are gone, moved, swapped, holes that were overlooked."""
    for mutation in _drawn(axis_of(name), _FEW):
        _check(mutation)


@pytest.mark.slow
@pytest.mark.parametrize("name", _SHAPES)
def test_all_mutations_are_refused(name):
    """Every node, every branch, every piece and every hole of a shape."""
    for mutation in mutations(axis_of(name)):
        _check(mutation)


@pytest.mark.slow
def test_many_mutations_of_samples_are_refused(drawn, freeform80):
    """The same for outlines as they come from files, which have too many nodes for all."""
    for name in drawn(_SAMPLES, 2):
        axis = medial_axis(read(freeform80 / f"{name}.dxf").profiles[0])
        for mutation in _drawn(axis, _MANY):
            _check(mutation)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(4 if os.environ.get("MASHAPE_ALL") else 1))
def test_all_mutations_of_an_outline_are_refused(part, freeform80):
    """Of the coast of a continent, 38 nodes: each of 496, to the end with `MASHAPE_ALL=1`, else every fourth."""
    axis = medial_axis(read(freeform80 / "map-1.dxf").profiles[0])
    for mutation in list(mutations(axis))[part::4]:
        _check(mutation)


@pytest.mark.slow
@pytest.mark.parametrize("name", _REAL)
def test_some_mutations_of_real_parts_are_refused(name, corpus, drawn):
    """Drawn anew in every run. All take a quarter of an hour; they have been tried."""
    axis = medial_axis(read(corpus / name).profiles[0])
    for mutation in drawn(list(mutations(axis)), _SOME):
        _check(mutation)


@pytest.mark.parametrize("name", ["blob", "blob with holes", "bracket", "rational blob", "wave"])
def test_an_end_that_was_forgotten_with_its_junction_is_named(name):
    """Junctions and ends still agree in number; the candidate that nothing rejects is the reason."""
    axis = axis_of(name)
    for number in range(len(axis.branches)):
        for mutation in without_end(axis, number):
            found = certificate(mutation.axis)
            assert found.reason.startswith("candidate: "), (mutation.name, found.reason)
            assert found.euler_ok, mutation.name
            assert not found.counting_ok, mutation.name
            _check(mutation)


def test_an_axis_in_which_all_else_agrees_is_refused_for_the_end_it_lacks():
    """All of its discs are maximal, the boundary is paired without a gap, the sum holds; and yet a branch is missing.

    That is seen twice: by the list of candidates, and by the discs of the piece that took the branch's place.
    """
    axis = axis_of("symmetric cap")
    cap = next(n for n, b in enumerate(axis.branches) if "end" in _kinds(axis, b) and min(_radii(axis, b)) > 0)
    for mutation in without_end(axis, cap):
        assert not confirmation(mutation.axis, axis.profile.diagonal).objections
        assert not list(pairing_objections(mutation.axis))
        assert coverage(mutation.axis, axis.profile.area).objections
        found = certificate(mutation.axis, stations=8)
        assert found.euler_ok
        assert found.area_error > 1e-3
        assert found.completeness_error > 1e-3
        assert found.reason.startswith("candidate: the curvature maximum on edge 0 at u = 0.5 ends no branch")


@pytest.mark.parametrize("name", ["symmetric cap", "ellipse", "stadium", "blob", "rational blob", "bracket", "keyhole"])
def test_a_tracer_that_overlooks_an_end_is_refused(name, monkeypatch):
    """Traced with all candidates but one, an axis is not completed, or it is refused for that one."""
    profile = profile_of(name)
    every = ends(axis_of(name).tour)
    for number in range(len(every)):
        monkeypatch.setattr(cutting, "settle_ends", partial(_settle, every[:number] + every[number + 1 :]))
        try:
            axis = medial_axis(profile)
        except AxisError:
            continue
        found = certificate(axis)
        assert not found.ok
        assert found.reason.startswith("candidate: "), found.reason


def _settle(discs, tour, faces):
    """Add these discs, and no others, as those of all ends."""
    for disc in discs:
        number = add_disc(faces, disc.x, disc.y, disc.r, OSCULATING, disc.tol)
        for (e, t), (f, s) in disc.contacts:
            add_contact(faces, number, e, t, f, s)
    return False


def _kinds(axis, branch):
    return {axis.nodes.kind[n] for n in (branch.start, branch.end)}


def _radii(axis, branch):
    return [axis.nodes.radius[n] for n in (branch.start, branch.end)]
