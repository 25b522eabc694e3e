"""Discs with three contacts, against circles that geometry knows."""

import numpy as np
import pytest
from catalogue import box, circle, polygon, profile_of

from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.junction import junction_disc
from mashape_cad.medial.tour import site, tour


def _solved(profile, elements, start=(0.5, 0.5, 0.5), low=(0, 0, 0), high=(1, 1, 1)):
    laid_out, frame = tour(profile)
    found, x, y, r, t = junction_disc(
        laid_out, np.array(elements), np.array(low, float), np.array(high, float), np.array(start, float)
    )
    centre = np.array([x, y]) * frame.size + frame.middle
    return found, centre, r * frame.size, t


def test_the_incircle_of_a_triangle():
    """Radius = twice the area by the perimeter, whatever the first guess."""
    profile = Profile.of(polygon([(0, 0), (4, 0), (0, 3)]))
    for start in ((0.5, 0.5, 0.5), (0.1, 0.9, 0.2), (0.99, 0.01, 0.5)):
        found, centre, r, t = _solved(profile, [0, 1, 2], start)
        assert found
        assert (*centre, r) == pytest.approx((1, 1, 1), abs=1e-14)
        assert t == pytest.approx((0.25, 0.6, 2 / 3))


def test_two_walls_and_a_reflex_vertex():
    """The ell's bend: |(r, r) - (w, w)| = r."""
    laid_out, _ = tour(profile_of("ell"))
    (cone,) = np.flatnonzero(laid_out.degree == 0).tolist()
    found, centre, r, t = _solved(profile_of("ell"), [0, cone, 6])
    assert found
    assert r == pytest.approx(1.3 * (2 - np.sqrt(2)), abs=1e-14)
    assert centre == pytest.approx((r, r), abs=1e-13)
    assert t[1] == pytest.approx(0.5)


def test_two_walls_and_a_round_hole():
    """(a - r)^2 + (b - r)^2 = (r + hole)^2 in the corner of a plate."""
    profile = Profile.of(box(-5, -3, 10, 6), [circle(0, 0, 0.6)])
    laid_out, _ = tour(profile)
    for hole in np.flatnonzero(laid_out.loop == 1).tolist():
        x, y = np.sign(site(laid_out, hole, 0.5)[:2])
        walls = [1 if x > 0 else 3, 2 if y > 0 else 0]
        found, centre, r, _ = _solved(profile, [*walls, hole])
        assert found
        assert r == pytest.approx(8.6 - np.sqrt(8.6**2 - 34 + 0.36), abs=1e-12)
        assert np.abs(centre) == pytest.approx((5 - r, 3 - r), abs=1e-12)


def test_three_round_holes():
    """The circle of Apollonius between three equal ones on a regular triangle."""
    places = [(2 * np.cos(t), 2 * np.sin(t)) for t in np.pi / 2 + np.pi * np.array([0, 2, 4]) / 3]
    profile = Profile.of(box(-5, -5, 10, 10), [circle(x, y, 0.7) for x, y in places])
    laid_out, _ = tour(profile)
    elements = []
    for loop, (x, y) in enumerate(places, start=1):
        inward = [
            e
            for e in np.flatnonzero(laid_out.loop == loop).tolist()
            if np.dot(site(laid_out, e, 0.5)[:2], (-y, x)) ** 2 < 1 and _faces_middle(laid_out, e)
        ]
        elements.append(inward[0])
    found, centre, r, _ = _solved(profile, elements)
    assert found
    assert (*centre, r) == pytest.approx((0, 0, 1.3), abs=1e-12)


def _faces_middle(laid_out, e):
    """Whether a span's foot nearest to the origin lies on it."""
    angles = [np.dot(site(laid_out, e, t)[2:4], np.array(site(laid_out, e, t)[:2])) for t in (0.0, 1.0)]
    turns = [np.cross([*site(laid_out, e, t)[:2], 0], [*site(laid_out, e, t)[2:4], 0])[2] for t in (0.0, 1.0)]
    return min(angles) < 0 and turns[0] * turns[1] <= 1e-12


def test_feet_keep_to_their_stretches():
    """The incircle's foot on the first side is at a quarter: a stretch that begins later holds none."""
    profile = Profile.of(polygon([(0, 0), (4, 0), (0, 3)]))
    assert not _solved(profile, [0, 1, 2], (0.6, 0.5, 0.5), low=(0.3, 0, 0))[0]
    assert _solved(profile, [0, 1, 2], (0.6, 0.5, 0.5), low=(0.2, 0, 0))[0]


def test_no_disc_touches_three_stretches_that_do_not_face_one_another():
    """Parallel sides and nothing else, or one stretch thrice."""
    profile = profile_of("rectangle")
    assert not _solved(profile, [0, 0, 0])[0]
    assert not _solved(profile, [0, 2, 2], (0.5, 0.4, 0.6))[0]


@pytest.mark.parametrize("turn", [1e-2, 1e-4])
def test_a_slight_vertex(turn):
    """Two sides that meet at nearly 180 degrees and the side across: the feet lie r * turn / 2 from the vertex."""
    profile = Profile.of(polygon([(-2, 0), (0, -2 * turn / 2), (2, 0), (2, 2), (-2, 2)]))
    half = 1.0 * turn / 2 / 2
    found, centre, r, t = _solved(profile, [0, 1, 3], (1 - half, half, 0.5))
    assert found
    assert centre[0] == pytest.approx(0, abs=1e-9)
    assert 2 * (1 - t[0]) == pytest.approx(r * np.tan(np.arctan(turn / 2)), rel=1e-2)
