"""Discs that tie holes to other loops."""

import numpy as np
import pytest
from catalogue import NAMED, box, circle, polygon, profile_of, rounded, slot

from mashape_cad.geometry.edge import Similarity
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.ends import ends, settle_ends
from mashape_cad.medial.faces import blank_faces, settled_discs
from mashape_cad.medial.links import links, settle_links
from mashape_cad.medial.tour import site, tour

_HOLED = [name for name in NAMED if profile_of(name).holes]
_PLATES = {
    "square holes": Profile.of(box(0, 0, 9, 4), [box(1, 1, 1, 1), box(4, 1, 2, 2), box(7, 1.5, 1, 1)]),
    "slots": Profile.of(box(0, 0, 9, 4), [slot(3, 1, 1, 0.5), slot(3, 3, 1, 0.5), slot(7, 2, 0.5, 0.7)]),
    "stars": Profile.of(circle(0, 0, 5), [polygon([(1, 0), (3, 2), (2, 0), (3, -2)]), circle(-2, 0, 1)]),
}


def check_links(profile: Profile) -> None:
    """One empty disc for each hole, that touches it and another loop; together they tie all loops to the outer one."""
    laid_out, frame = tour(profile)
    found = links(laid_out)
    assert len(found) == len(profile.holes)
    query = DistanceQuery(profile)
    tied = {0}
    ties = []
    for disc in found:
        centre = np.array([disc.x, disc.y]) * frame.size + frame.middle
        assert query.distances([centre])[0] == pytest.approx(disc.r * frame.size, abs=1e-10 * frame.size)
        touched = {int(laid_out.loop[e]) for (e, _), _ in disc.contacts}
        assert len(touched) >= 2
        ties.append(touched)
    for _ in ties:
        for touched in ties:
            tied |= touched if touched & tied else set()
    assert tied == set(range(len(profile.loops)))


@pytest.mark.parametrize("name", _HOLED)
def test_every_hole_is_tied(name):
    """By one disc, without leaving any loop out."""
    check_links(profile_of(name))


@pytest.mark.parametrize("angle", np.linspace(0, 6, 9))
@pytest.mark.parametrize("name", _PLATES)
def test_every_hole_is_tied_whichever_way_the_part_is_turned(name, angle):
    """The highest point of a hole may be a vertex, on an arc, on a spline."""
    check_links(_PLATES[name].transformed(Similarity.of(angle=float(angle))))


def test_without_holes_nothing_is_tied():
    """No disc."""
    assert links(tour(profile_of("ell"))[0]) == []


@pytest.mark.parametrize("name", [*_HOLED, *_PLATES])
def test_links_are_added_to_what_is_settled(name):
    """Discs of ends stay what they are, but may get contacts; whatever a link touches, the faces' discs touch too."""
    laid_out, _ = tour(_PLATES[name] if name in _PLATES else profile_of(name))
    faces = blank_faces(laid_out)
    settle_ends(laid_out, faces)
    settle_links(laid_out, faces)
    together, first = settled_discs(faces), ends(laid_out)
    for before, after in zip(first, together, strict=False):
        assert (before.x, before.y, before.r, before.kind, before.tol) == (
            after.x,
            after.y,
            after.r,
            after.kind,
            after.tol,
        )
        assert set(before.contacts) <= set(after.contacts)
    for link in links(laid_out):
        (same,) = [d for d in together if max(abs(d.x - link.x), abs(d.y - link.y), abs(d.r - link.r)) <= 1e-9]
        if same not in first:
            assert len(same.contacts) >= len(link.contacts)


def _fillet_over_a_hole(reach):
    """A plate with one round corner, and a hole whose highest point, as links see it, is `reach` off its disc."""
    up = np.array([np.cos(1.1), np.sin(1.1)])  # the first direction that links try
    x, y = np.array([5.0, 3.0]) - (1.0 + 0.4 + reach) * up
    plate = rounded([(0, 0), (6, 0), (6, 4), (0, 4)], [0, 0, 1.0, 0])
    return Profile.of(plate, [circle(float(x), float(y), 0.4)])


def test_a_link_that_is_the_disc_of_an_arc_is_settled_once():
    """The disc that fills a fillet and touches the hole at its highest point: an end with the hole as contact."""
    profile = _fillet_over_a_hole(0.0)
    laid_out, frame = tour(profile)
    faces = blank_faces(laid_out)
    settle_ends(laid_out, faces)
    before = settled_discs(faces)
    settle_links(laid_out, faces)
    assert settled_discs(faces) == before
    (arc,) = [disc for disc in before if disc.kind == "arc"]
    assert (arc.x, arc.y, arc.r) == pytest.approx((2 / frame.size, 1 / frame.size, 1 / frame.size), abs=1e-12)
    assert {int(laid_out.loop[e]) for (e, _), _ in arc.contacts} == {0, 1}
    assert len(arc.contacts) == 2
    check_links(profile)


@pytest.mark.parametrize("reach", [1e-3, 1e-6, 1e-7])
def test_a_link_near_the_disc_of_an_arc_is_another(reach):
    """A little lower the hole is tied by a disc of its own, to the fillet or beside it."""
    laid_out, _ = tour(_fillet_over_a_hole(reach))
    faces = blank_faces(laid_out)
    settle_ends(laid_out, faces)
    before = settled_discs(faces)
    settle_links(laid_out, faces)
    *same, link = settled_discs(faces)
    assert same == before
    assert link.kind == "station"
    for place, _ in link.contacts:
        x, y, *_ = site(laid_out, *place)
        assert np.hypot(x - link.x, y - link.y) == pytest.approx(link.r, abs=1e-11)
    assert {int(laid_out.loop[e]) for (e, _), _ in link.contacts} == {0, 1}
