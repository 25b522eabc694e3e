"""Maximal discs at single places, and what a disc touches, against dense samples and the kernel."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, profile_of
from oracle import Oracle

from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.disc import maximal_disc, twin_on_stretch
from mashape_cad.medial.emptiness import (
    EMPTY,
    TOUCH,
    cone_turn,
    distance_minima,
    nearest_on_stretch,
    same_place,
    touching,
)
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
            number, u = foot(profile, laid_out, (e, t))
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


def test_at_a_junction_all_contacts_are_found():
    """The foot of the cross's centre: the four reflex corners, each seen as its cone."""
    laid_out, _ = tour(profile_of("cross"))
    deepest, count, element, t = touching(laid_out, 0.0, 0.0, 0.35 * np.sqrt(2) / 2.0, TOUCH, -1)
    assert abs(deepest) <= EMPTY
    assert count == 4
    assert sorted(laid_out.degree[element[:4]].tolist()) == [0, 0, 0, 0]
    assert t[:4] == pytest.approx(0.5)


@pytest.mark.parametrize("name", _SOME)
def test_minima_of_the_distance(name):
    """All local minima of dense samples within reach are found, each where it is, and none is deeper than the truth."""
    laid_out, _ = tour(profile_of(name))
    rng = np.random.default_rng(6)
    spans = np.flatnonzero(laid_out.degree > 0)
    t = np.linspace(0, 1, 2001)
    points = {e: np.array([site(laid_out, int(e), s)[:2] for s in t]) for e in spans[:24]}
    for centre in rng.uniform(-0.3, 0.3, (3, 2)):
        count, element, place, depth = distance_minima(laid_out, *centre, 0.3, 1e-9, -1)
        found = {(int(e), round(float(s), 2)): d for e, s, d in zip(element[:count], place, depth, strict=False)}
        for e, curve in points.items():
            d = np.hypot(*(curve - centre).T) - 0.3
            inner = np.flatnonzero((d[1:-1] < d[:-2]) & (d[1:-1] < d[2:]) & (d[1:-1] < -1e-4)) + 1
            mine = [k for k in range(count) if element[k] == e]
            if mine and min(depth[k] for k in mine) < -0.1:
                continue  # a stretch deep inside settles the question: others of the span are not looked for
            for k in inner:
                near = [j for j in mine if abs(place[j] - t[k]) <= 2e-3]
                assert near, (name, e, t[k], found)
                assert depth[near[0]] <= d[k] + 1e-12


def test_an_empty_disc_touches_nothing():
    """No contact, and nothing deeper."""
    laid_out, _ = tour(profile_of("rectangle"))
    deepest, count, *_ = touching(laid_out, 0.0, 0.0, 0.1, TOUCH, -1)
    assert (deepest, count) == (np.inf, 0)


def test_a_disc_that_is_cut_is_seen_as_cut():
    """By how much the boundary enters it."""
    laid_out, frame = tour(profile_of("rectangle"))
    deepest, *_ = touching(laid_out, 0.0, 0.0, 1.6 / frame.size, TOUCH, -1)
    assert deepest * frame.size == pytest.approx(-0.1, abs=1e-12)


@pytest.mark.parametrize("depth", [1e-9, 1e-11, 3e-13])
def test_even_a_shallow_cut_is_seen(depth):
    """Down to a thousandth of what counts as touching."""
    laid_out, frame = tour(profile_of("rectangle"))
    deepest, *_ = touching(laid_out, 0.1, 0.0, 1.5 / frame.size + depth, TOUCH, -1)
    assert deepest == pytest.approx(-depth, rel=0.01)
    assert deepest < -EMPTY


def test_nearest_place_of_a_stretch():
    """Inside, and at its ends when the nearest place lies beyond."""
    laid_out, frame = tour(profile_of("rectangle"))
    s, d = nearest_on_stretch(laid_out, 0, 0.0, 1.0, 0.7 / frame.size, 0.0)
    assert (s, d * frame.size) == pytest.approx((0.6, 1.5))
    s, d = nearest_on_stretch(laid_out, 0, 0.0, 0.5, 0.7 / frame.size, 0.0)
    assert (s, d * frame.size) == pytest.approx((0.5, np.hypot(0.7, 1.5)))


@pytest.mark.parametrize("name", ["blob", "rational blob", "ellipse"])
def test_nearest_place_of_a_curve(name):
    """Against dense samples."""
    laid_out, _ = tour(profile_of(name))
    rng = np.random.default_rng(8)
    t = np.linspace(0.2, 0.9, 4001)
    for e in range(len(laid_out.degree)):
        points = np.array([site(laid_out, e, s)[:2] for s in t])
        c = rng.uniform(-0.4, 0.4, 2)
        d = np.hypot(*(points - c).T)
        s, distance = nearest_on_stretch(laid_out, e, 0.2, 0.9, *c)
        assert d.min() - 1e-6 <= distance <= d.min() + 1e-15
        assert abs(s - t[d.argmin()]) <= 1e-3


def test_the_twin_on_a_known_stretch():
    """The same disc as the search over the whole boundary finds."""
    laid_out, _ = tour(profile_of("ellipse"))
    x, y, r, _, count, element, t = maximal_disc(laid_out, 0, 0.4)
    assert count == 1
    assert twin_on_stretch(laid_out, 0, 0.4, int(element[0]), 0.0, 1.0) == pytest.approx((x, y, r, t[0]), abs=1e-11)


def test_directions_in_a_cone():
    """0 where the normal of the edge before points, 1 where that of the edge after does, outside beyond."""
    laid_out, _ = tour(profile_of("ell"))
    (cone,) = np.flatnonzero(laid_out.degree == 0)
    vx, vy = laid_out.control[cone, 0, :2]
    for s in (-0.4, 0.0, 0.3, 1.0, 1.5):
        angle = laid_out.cone[cone, 0] + s * laid_out.cone[cone, 1]
        assert cone_turn(laid_out, int(cone), vx + 0.2 * np.cos(angle), vy + 0.2 * np.sin(angle)) == pytest.approx(s)


def test_the_same_place():
    """Near means near against the radius: feet of a large disc are known less well."""
    laid_out, frame = tour(profile_of("rectangle"))
    assert same_place(laid_out, 0, 0.5, 0, 0.5 + 1e-9 / 7 * frame.size, 0.0)
    assert not same_place(laid_out, 0, 0.5, 0, 0.5 + 1e-6, 0.0)
    assert same_place(laid_out, 0, 0.5, 0, 0.5 + 1e-6, 0.5)
    assert same_place(laid_out, 0, 1.0, 1, 0.0, 0.0)
