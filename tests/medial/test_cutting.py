"""Cutting until each face holds one piece of a branch."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, TAU, box, circle, polygon, profile_of
from laid_out import all_faces, gaps_of, stretch_of

from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.cutting import cut
from mashape_cad.medial.faces import is_laid_out, settled_discs
from mashape_cad.medial.tour import site, tour

_CUT = [name for name in (*KNOWN, *NAMED) if name != "disc"]


def _cut(laid_out):
    faces, is_disc = cut(laid_out)
    assert not is_disc
    return faces


def check_faces(laid_out, faces):
    """Each face has two gaps on one element each, and there are as many faces as the discs' contacts say."""
    found = all_faces(faces)
    holes = int(laid_out.loop.max())
    assert all(len(face) == 2 and all(stretch_of(laid_out, faces, gap) for gap in face) for face in found)
    assert all(is_laid_out(laid_out, faces, gap) for gap in gaps_of(faces))
    assert len(found) == 1 - holes + sum(len(disc.contacts) - 1 for disc in settled_discs(faces))


def check_discs(profile, laid_out, frame, faces):
    """Each disc is empty and touches at its contacts, and at least two of these or an end lie on the circle."""
    discs = settled_discs(faces)
    centres = np.array([(disc.x, disc.y) for disc in discs]) * frame.size + frame.middle
    clearance = DistanceQuery(profile).distances(centres) / frame.size
    for disc, distance in zip(discs, clearance, strict=True):
        assert distance == pytest.approx(disc.r, abs=1e-12 + disc.tol)
        for place in (place for contact in disc.contacts for place in contact):
            x, y, *_ = site(laid_out, *place)
            assert np.hypot(x - disc.x, y - disc.y) == pytest.approx(disc.r, abs=1e-10 + disc.tol)
        assert len(disc.contacts) > 1 or disc.kind in {"corner", "osculating", "arc"}


@pytest.mark.parametrize("name", _CUT)
def test_every_face_ends_with_two_gaps_on_one_element_each(name):
    """And there are as many faces as the discs' contacts say."""
    laid_out, _ = tour(profile_of(name))
    assert int(laid_out.loop.max()) == len(profile_of(name).holes)
    check_faces(laid_out, _cut(laid_out))


@pytest.mark.parametrize("name", _CUT)
def test_every_disc_on_the_way_is_maximal(name):
    """The kernel finds the boundary one radius off, and at least two contacts or an end lie on the circle."""
    profile = profile_of(name)
    laid_out, frame = tour(profile)
    check_discs(profile, laid_out, frame, _cut(laid_out))


@pytest.mark.parametrize("name", _CUT)
def test_gaps_lie_one_after_another_round_every_loop(name):
    """Each starts where a contact ends and ends where the next one starts: no boundary is left out or counted twice."""
    laid_out, _ = tour(profile_of(name))
    faces = _cut(laid_out)
    count = len(gaps_of(faces))
    gaps = [gap for face in all_faces(faces) for gap in face]
    assert sorted(gaps) == list(range(count))
    assert sorted(faces.contact[:count]["after"]) == list(range(count))
    assert sorted(faces.contact[:count]["clockwise"]) == list(range(count))
    assert all(faces.contact[faces.contact[gap]["clockwise"]]["disc"] == faces.contact[gap]["disc"] for gap in gaps)
    for loop in range(int(laid_out.loop.max()) + 1):
        mine = [c for c in gaps if laid_out.loop[faces.contact[c]["first_e"]] == loop]
        at, seen = mine[0], []
        while at not in seen:
            seen.append(at)
            at = int(faces.contact[at]["after"])
        assert sorted(seen) == sorted(mine)
        # In the order of their places, once round.
        places = [(faces.contact[c]["first_e"], faces.contact[c]["first_t"]) for c in seen]
        lowest = places.index(min(places))
        assert places[lowest:] + places[:lowest] == sorted(places)


def test_a_domain_that_is_one_disc_needs_no_cut():
    """It is returned as it is."""
    laid_out, frame = tour(profile_of("disc"))
    faces, is_disc = cut(laid_out)
    assert is_disc
    (disc,) = settled_discs(faces)
    assert disc.contacts == (((0, 0.0), (0, 0.0)),)
    assert disc.r * frame.size == pytest.approx(1.7)


@pytest.mark.parametrize(("name", "most"), [("rectangle", 8), ("ellipse", 8), ("12-gon", 14), ("plate with holes", 80)])
def test_few_discs_are_needed(name, most):
    """Ends, links, borders and junctions: stations beyond these would mean that junctions are not found at once."""
    laid_out, _ = tour(profile_of(name))
    assert len(settled_discs(_cut(laid_out))) <= most


def _nearly_regular(count, off):
    """A regular polygon whose corners are off by a little."""
    rng = np.random.default_rng(count)
    angle = 0.3 + TAU * np.arange(count) / count
    corners = np.column_stack([np.cos(angle), np.sin(angle)]) + off * rng.normal(size=(count, 2))
    return Profile.of(polygon([tuple(corner) for corner in corners.tolist()]))


def _nearly_square_grid(off):
    """Round holes nearly on a square grid."""
    rng = np.random.default_rng(9)
    places = [(x + off * rng.normal(), y + off * rng.normal()) for x in (-1, 0, 1) for y in (-1, 0, 1)]
    return Profile.of(box(-2, -2, 4, 4), [circle(x, y, 0.3) for x, y in places])


@pytest.mark.parametrize("off", [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7])
@pytest.mark.parametrize("count", [4, 5, 6, 8, 12])
def test_a_junction_that_is_found_again_gets_the_contacts_that_it_lacks(count, off):
    """Junctions that all but coincide are found as discs that are there already: these take more contacts, and none of
    them makes a face of one gap.
    """
    profile = _nearly_regular(count, off)
    laid_out, frame = tour(profile)
    faces = _cut(laid_out)
    check_faces(laid_out, faces)
    check_discs(profile, laid_out, frame, faces)
    # Only discs that all but coincide may be taken for one: the axis has as many ends and as few cycles as ever.
    degree = np.array([len(disc.contacts) for disc in settled_discs(faces)])
    assert np.count_nonzero(degree == 1) == count
    assert (degree - 2).sum() == -2


@pytest.mark.parametrize("off", [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7])
def test_junctions_between_loops_get_the_contacts_that_they_lack(off):
    """The same with holes: four junctions of degree four, or nearly."""
    profile = _nearly_square_grid(off)
    laid_out, frame = tour(profile)
    faces = _cut(laid_out)
    check_faces(laid_out, faces)
    check_discs(profile, laid_out, frame, faces)
    assert sum(len(disc.contacts) - 2 for disc in settled_discs(faces)) == 2 * 9 - 2
