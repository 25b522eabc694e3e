"""Maximal discs at single places, against brute force and the kernel."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, profile_of
from oracle import Oracle

from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.disc import maximal_disc, twin_on_stretch
from mashape_cad.medial.tour import site, tour

_SOME = ["ellipse", "rectangle", "ell", "bracket", "blob with holes", "plate with holes", "keyhole", "wave", "cross"]


def _places(laid_out, seed, count):
    """Places anywhere but on arcs that one disc may touch as a whole: there no search for a twin can end."""
    rng = np.random.default_rng(seed)
    for e in rng.choice(np.flatnonzero(np.isnan(laid_out.round_radius)), count):
        yield int(e), float(rng.uniform(0.01, 0.99))


@pytest.mark.parametrize("name", [name for name in (*KNOWN, *NAMED) if name not in {"disc", "lens"}])
def test_the_maximal_disc_is_empty_and_touches_its_twin(name):
    """The kernel finds nothing nearer to the centre than p; the twin is as near. So no larger disc at p is empty."""
    profile = profile_of(name)
    laid_out, frame = tour(profile)
    query = DistanceQuery(profile)
    for e, t in _places(laid_out, 4, 20):
        x, y, r, ok, count, element, twin = maximal_disc(laid_out, e, t)
        assert ok
        px, py, nx, ny, curvature, _ = site(laid_out, e, t)
        assert (x - r * nx, y - r * ny) == pytest.approx((px, py), abs=1e-14)
        clearance = query.distances([np.array([x, y]) * frame.size + frame.middle])[0] / frame.size
        assert clearance == pytest.approx(r, abs=1e-12)
        for k in range(count):
            qx, qy, *_ = site(laid_out, int(element[k]), float(twin[k]))
            assert np.hypot(qx - x, qy - y) == pytest.approx(r, abs=1e-10)
        if not count:
            assert r * curvature == pytest.approx(1.0)


@pytest.mark.parametrize("name", _SOME)
def test_the_maximal_disc_is_the_one_of_brute_force(name):
    """Its radius is the smallest |q - p|^2 / (2 n.(q - p)) of the boundary."""
    profile = profile_of(name)
    laid_out, frame = tour(profile)
    oracle = Oracle(profile)
    for e, t in _places(laid_out, 5, 15):
        if laid_out.degree[e] > 0:
            number, u = foot(laid_out, (e, t))
            assert maximal_disc(laid_out, e, t)[2] * frame.size == pytest.approx(oracle.radius(number, u), rel=1e-7)


def test_the_discs_of_an_ellipse():
    """At the end of the long axis the disc of curvature b^2 / a, at the end of the short one r = b."""
    laid_out, frame = tour(profile_of("ellipse"))
    for e in range(len(laid_out.degree)):
        for t in np.linspace(0.05, 0.95, 7):
            x, y, r, ok, *_ = maximal_disc(laid_out, e, float(t))
            x, y = np.array([x, y]) * frame.size + frame.middle
            assert ok
            assert abs(y) <= 1e-12
            assert r * frame.size == pytest.approx(np.sqrt(1 - x * x / 3), abs=1e-12)


def test_between_parallel_walls_the_twin_lies_opposite():
    """Where the normals are opposite to one another the quotient has a minimum like any other."""
    laid_out, frame = tour(profile_of("rectangle"))
    x, y, r, _, count, element, t = maximal_disc(laid_out, 0, 0.5)
    assert (x * frame.size, y * frame.size, r * frame.size) == pytest.approx((0, 0, 1.5), abs=1e-14)
    assert count == 1
    assert site(laid_out, int(element[0]), float(t[0]))[:2] == pytest.approx((0, 1.5 / frame.size), abs=1e-14)


def test_the_twin_on_a_known_stretch():
    """The same disc as the search over the whole boundary finds."""
    laid_out, _ = tour(profile_of("ellipse"))
    x, y, r, _, count, element, t = maximal_disc(laid_out, 0, 0.4)
    assert count == 1
    assert twin_on_stretch(laid_out, 0, 0.4, int(element[0]), 0.0, 1.0) == pytest.approx((x, y, r, t[0]), abs=1e-11)
