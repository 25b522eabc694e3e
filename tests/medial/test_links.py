"""Discs that tie holes to other loops."""

import numpy as np
import pytest
from catalogue import NAMED, box, circle, polygon, profile_of, slot

from mashape_cad.geometry.edge import Similarity
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.links import links
from mashape_cad.medial.tour import tour

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
