"""What a disc touches and whether it is empty, against dense samples."""

import numpy as np
import pytest
from catalogue import profile_of

from mashape_cad.medial.contact import TOUCH
from mashape_cad.medial.emptiness import (
    EMPTY,
    cone_turn,
    distance_minima,
    nearest_on_stretch,
    normal_form,
    spans_near,
    touching,
)
from mashape_cad.medial.faces import SETTLED
from mashape_cad.medial.tour import site, tour

_SOME = ["ellipse", "rectangle", "ell", "bracket", "blob with holes", "plate with holes", "keyhole", "wave", "cross"]


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
        count, element, place, depth = distance_minima(laid_out, *centre, 0.3, 1e-9, -1, np.inf)
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


@pytest.mark.parametrize("name", _SOME)
def test_one_witness_ends_the_search(name):
    """The last place found is deeper than asked for, those before are not; without such a place nothing is left out."""
    laid_out, _ = tour(profile_of(name))
    rng = np.random.default_rng(7)
    for centre in rng.uniform(-0.4, 0.4, (20, 2)):
        count, element, t, depth = distance_minima(laid_out, *centre, 0.3, 1e-9, -1, np.inf)
        for floor in (1e-13, 0.02, 0.1):
            few, *rows = distance_minima(laid_out, *centre, 0.3, 1e-9, -1, floor)
            for row, whole in zip(rows, (element, t, depth), strict=True):
                assert np.array_equal(row[:few], whole[:few])
            witnesses = np.flatnonzero(depth[:count] < -floor)
            # All places of the element on which the witness lies are given.
            expected = element[:count].searchsorted(element[witnesses[0]], "right") if len(witnesses) else count
            assert few == expected


@pytest.mark.parametrize("name", _SOME)
def test_spans_near_a_disc(name):
    """Those that come as near as asked for in dense samples are told, others not; pairs stand disc by disc."""
    laid_out, _ = tour(profile_of(name))
    rng = np.random.default_rng(9)
    centre, r, tol = rng.uniform(-0.5, 0.5, (30, 2)), rng.uniform(0.01, 0.3, 30), rng.choice([1e-11, 0.05], 30)
    settled = np.zeros(30, SETTLED).view(np.recarray)
    settled.x, settled.y, settled.r, settled.tol = *centre.T, r, tol
    slack = 1e-9
    disc, element = spans_near(laid_out, settled, slack)
    slack += tol
    assert np.all(np.diff(disc) >= 0)
    pairs = set(zip(disc.tolist(), element.tolist(), strict=True))
    assert len(pairs) == len(disc)
    t = np.linspace(0, 1, 1001)
    for e in range(len(laid_out.degree)):
        if laid_out.degree[e] == 0:
            assert e not in element
            continue
        points = np.array([site(laid_out, e, s)[:2] for s in t])
        gap = np.hypot(*np.diff(points, axis=0).T).max()
        least = np.hypot(*(centre[:, None] - points).T).min(axis=0) - r - slack
        for d in range(30):
            assert (d, e) in pairs or least[d] > 0
            assert (d, e) not in pairs or least[d] <= gap


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


def test_directions_in_a_cone():
    """0 where the normal of the edge before points, 1 where that of the edge after does, outside beyond."""
    laid_out, _ = tour(profile_of("ell"))
    (cone,) = np.flatnonzero(laid_out.degree == 0)
    vx, vy = laid_out.control[cone, 0, :2]
    for s in (-0.4, 0.0, 0.3, 1.0, 1.5):
        angle = laid_out.cone[cone, 0] + s * laid_out.cone[cone, 1]
        assert cone_turn(laid_out, int(cone), vx + 0.2 * np.cos(angle), vy + 0.2 * np.sin(angle)) == pytest.approx(s)


def test_the_end_of_an_element_is_the_start_of_the_next():
    """Places at a border have one name."""
    laid_out, _ = tour(profile_of("rectangle"))
    assert normal_form(laid_out, 1, 1.0 - 1e-12) == (2, 0.0)
    assert normal_form(laid_out, 3, 1.0) == (0, 0.0)
    assert normal_form(laid_out, 2, 1e-12) == (2, 0.0)
    assert normal_form(laid_out, 2, 0.3) == (2, 0.3)
