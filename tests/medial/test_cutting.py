"""Cutting until each face holds one piece of a branch."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, profile_of

from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.cutting import cut
from mashape_cad.medial.ends import SettledDisc
from mashape_cad.medial.tour import site, tour

_CUT = [name for name in (*KNOWN, *NAMED) if name != "disc"]


@pytest.mark.parametrize("name", _CUT)
def test_every_face_ends_with_two_gaps_on_one_element_each(name):
    """And there are as many faces as the discs' contacts say."""
    laid_out, _ = tour(profile_of(name))
    faces = cut(laid_out)
    holes = len(profile_of(name).holes)
    assert all(len(face) == 2 and all(faces.stretch(gap) for gap in face) for face in faces.faces)
    assert len(faces.faces) == 1 - holes + sum(len(disc.contacts) - 1 for disc in faces.discs)


@pytest.mark.parametrize("name", _CUT)
def test_every_disc_on_the_way_is_maximal(name):
    """The kernel finds the boundary one radius off, and at least two contacts or an end lie on the circle."""
    profile = profile_of(name)
    laid_out, frame = tour(profile)
    faces = cut(laid_out)
    centres = np.array([(disc.x, disc.y) for disc in faces.discs]) * frame.size + frame.middle
    clearance = DistanceQuery(profile).distances(centres) / frame.size
    for disc, distance in zip(faces.discs, clearance, strict=True):
        assert distance == pytest.approx(disc.r, abs=1e-12 + disc.tol)
        for place in (place for contact in disc.contacts for place in contact):
            x, y, *_ = site(laid_out, *place)
            assert np.hypot(x - disc.x, y - disc.y) == pytest.approx(disc.r, abs=1e-10 + disc.tol)
        assert len(disc.contacts) > 1 or disc.kind in {"corner", "osculating", "arc"}


@pytest.mark.parametrize("name", _CUT)
def test_gaps_lie_one_after_another_round_every_loop(name):
    """Each starts where a contact ends and ends where the next one starts: no boundary is left out or counted twice."""
    laid_out, _ = tour(profile_of(name))
    faces = cut(laid_out)
    gaps = [gap for face in faces.faces for gap in face]
    assert sorted(gaps) == list(range(len(faces.contact)))
    assert sorted(faces.after) == list(range(len(faces.contact)))
    for loop in range(int(laid_out.loop.max()) + 1):
        mine = [c for c in gaps if laid_out.loop[faces.contact[c][0][0]] == loop]
        at, seen = mine[0], []
        while at not in seen:
            seen.append(at)
            at = faces.after[at]
        assert sorted(seen) == sorted(mine)


def test_a_domain_that_is_one_disc_needs_no_cut():
    """It is returned as it is."""
    laid_out, _ = tour(profile_of("disc"))
    disc = cut(laid_out)
    assert isinstance(disc, SettledDisc)
    assert disc.is_full


@pytest.mark.parametrize(("name", "most"), [("rectangle", 8), ("ellipse", 8), ("12-gon", 14), ("plate with holes", 80)])
def test_few_discs_are_needed(name, most):
    """Ends, links, borders and junctions: stations beyond these would mean that junctions are not found at once."""
    laid_out, _ = tour(profile_of(name))
    assert len(cut(laid_out).discs) <= most
