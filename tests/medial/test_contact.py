"""When two contacts of a disc are one."""

from itertools import permutations

import numpy as np
import pytest
from catalogue import KNOWN, polygon, profile_of

from mashape_cad.geometry.edge import Arc, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.contact import TOUCH, apart, one_contact
from mashape_cad.medial.emptiness import nearest_on_stretch
from mashape_cad.medial.tour import site, tour

_SIZE = 7.0  # of the rectangle


def _laid_out(name):
    return tour(profile_of(name))[0]


def _both_ways(laid_out, first, second, disc):
    """Whether two places are one contact; whichever is named first."""
    told = {bool(one_contact(laid_out, *a, *b, *disc)) for a, b in permutations((first, second))}
    assert len(told) == 1
    return told.pop()


def _arc_disc(laid_out, e):
    """Disc that fills the arc of an element."""
    return (*laid_out.round_centre[e], laid_out.round_radius[e])


@pytest.mark.parametrize("name", KNOWN)
def test_how_far_apart_places_are(name):
    """The distance of the points; nought at a border, however it is named, and on one cone."""
    laid_out = _laid_out(name)
    for e in range(len(laid_out.degree)):
        after = int(laid_out.after[e])
        assert apart(laid_out, e, 1.0, after, 0.0) <= 1e-15
        p, q = (np.array(site(laid_out, *place)[:2]) for place in ((e, 0.2), (after, 0.7)))
        assert apart(laid_out, e, 0.2, after, 0.7) == pytest.approx(np.hypot(*(p - q)), abs=1e-15)
        assert laid_out.degree[e] > 0 or apart(laid_out, e, 0.1, e, 0.9) == 0.0


def test_places_that_coincide_are_one():
    """To what feet are known; also at a border, under both its names."""
    laid_out = _laid_out("rectangle")
    disc = (0.0, 0.0, 1.5 / _SIZE)
    assert _both_ways(laid_out, (0, 0.5), (0, 0.5 + 1e-7), disc)
    assert _both_ways(laid_out, (0, 1.0), (1, 0.0), disc)
    assert not _both_ways(laid_out, (0, 0.5), (2, 0.5), disc)


@pytest.mark.parametrize(("step", "one"), [(1e-5, True), (0.015, True), (0.025, False), (0.9, False)])
def test_near_places_on_an_arc_that_the_disc_fills_are_one(step, one):
    """Up to a fiftieth of the radius; farther apart they are two, whatever lies between."""
    laid_out = _laid_out("stadium")
    e = int(np.flatnonzero(laid_out.degree == 2)[0])
    # A quarter circle is passed with about pi / 2 radii per parameter; in its middle with 4 (sqrt(2) - 1).
    second = 0.5 + step / (4 * (np.sqrt(2) - 1))
    assert _both_ways(laid_out, (e, 0.5), (e, second), _arc_disc(laid_out, e)) == one


def test_near_places_either_side_of_a_smooth_border_are_one():
    """The circle goes on across it; also across the seam of the loop, from the last element to the first."""
    laid_out = _laid_out("disc")
    for e in range(len(laid_out.degree)):
        following = int(laid_out.after[e])
        assert _both_ways(laid_out, (e, 1 - 2e-3), (following, 2e-3), _arc_disc(laid_out, e))


def test_an_arc_that_runs_into_a_line_is_left():
    """Near the join the line is still on the circle, farther on no more."""
    laid_out = _laid_out("stadium")
    e = next(e for e in np.flatnonzero(laid_out.degree == 2) if laid_out.degree[laid_out.after[e]] == 1)
    disc, line = _arc_disc(laid_out, e), int(laid_out.after[e])
    length = apart(laid_out, line, 0.0, line, 1.0)
    # A tangent leaves the circle by s^2 / 2 r: by 1e-11, which is touching still, at about 1.7e-6.
    for off, one in ((5e-12, True), (2e-11, False)):
        assert _both_ways(laid_out, (e, 0.999), (line, np.sqrt(2 * disc[2] * off) / length), disc) == one


@pytest.mark.parametrize("turn", [1e-2, 1e-3, 3e-5])
def test_contacts_either_side_of_a_flat_vertex_are_two(turn):
    """The disc touches both sides near the vertex, and the vertex lies outside it: there a branch begins."""
    rise = 5 * np.tan(turn / 2)
    laid_out, frame = tour(Profile.of(polygon([(-5, rise), (0, 0), (5, rise), (5, 8), (-5, 8)])))
    height = 2.0
    r = height * np.cos(turn / 2)
    x, y = (np.array([0.0, height]) - frame.middle) / frame.size
    first, second = int(laid_out.before[1]), 1
    share = height * np.sin(turn / 2) / (5 / np.cos(turn / 2))
    left, right = (first, 1 - share), (second, share)
    disc = (float(x), float(y), r / frame.size)
    for place in (left, right):
        px, py, *_ = site(laid_out, *place)
        assert np.hypot(px - x, py - y) == pytest.approx(disc[2], abs=1e-14)
    assert apart(laid_out, *left, *right) <= 0.02 * disc[2]
    assert not _both_ways(laid_out, left, right, disc)


def test_walls_that_are_near_to_one_another_are_two():
    """Over a narrow slit its two edges are near against the disc's radius, but no boundary joins them on the circle."""
    tip = 0.01
    slit = [(-tip / 2, 0), (-tip / 2, -2), (tip / 2, -2), (tip / 2, 0)]
    laid_out, frame = tour(Profile.of(polygon([(-3, 0), *slit, (3, 0), (3, 4), (-3, 4)])))
    cones = np.flatnonzero(laid_out.degree == 0).tolist()
    assert len(cones) == 2
    x, y = (np.array([0.0, 1.0]) - frame.middle) / frame.size
    disc = (float(x), float(y), float(np.hypot(1.0, tip / 2)) / frame.size)
    assert apart(laid_out, cones[0], 0.01, cones[1], 0.99) <= 0.02 * disc[2]
    assert not _both_ways(laid_out, (cones[0], 0.01), (cones[1], 0.99), disc)


def test_an_osculating_foot_stays_on_its_circle_for_a_while():
    """At the tip of an ellipse the boundary leaves by the fourth power: feet too far apart to coincide are one."""
    laid_out, frame = tour(profile_of("ellipse"))  # a = 2, b = 1, radius of curvature 1 / 2 at the tips
    disc = (*((np.array([1.5, 0.0]) - frame.middle) / frame.size).tolist(), 0.5 / frame.size)

    def at_angle(angle):
        point = (np.array([2 * np.cos(angle), np.sin(angle)]) - frame.middle) / frame.size
        rows = [nearest_on_stretch(laid_out, e, 0.0, 1.0, *point) for e in range(len(laid_out.degree))]
        e = int(np.argmin([distance for _, distance in rows]))
        assert rows[e][1] <= 1e-12
        return e, rows[e][0]

    # With the angle u of the ellipse's parameter |q - c| - r is 3 u^4 / 8 to first order, in mm.
    for angle, one in ((2e-3, True), (4e-3, False)):
        above, below = at_angle(angle), at_angle(-angle)
        off = np.hypot(*(np.array(site(laid_out, *above)[:2]) - disc[:2])) - disc[2]
        assert (abs(off) <= TOUCH) == one
        assert 3e-6 * disc[2] < apart(laid_out, *above, *below) <= 0.02 * disc[2]
        assert _both_ways(laid_out, above, below, disc) == one


def test_the_ends_of_an_arc_that_the_disc_fills_are_one():
    """Over a narrow neck they are near; what joins them is the arc all round, and that is on the circle."""
    half = 0.005
    angle = float(np.arcsin(half))
    edges = (
        Arc.of((0, 0), 1.0, -np.pi / 2 + angle, 2 * np.pi - 2 * angle),
        Line.of((-half, -np.cos(angle)), (-half, -2)),
        Line.of((-half, -2), (half, -2)),
        Line.of((half, -2), (half, -np.cos(angle))),
    )
    laid_out, _ = tour(Profile.of(Loop(edges)))
    arcs = np.flatnonzero(laid_out.degree == 2).tolist()
    first, last = (arcs[0], 0.0), (arcs[-1], 1.0)
    assert apart(laid_out, *first, *last) <= 0.02 * laid_out.round_radius[arcs[0]]
    assert _both_ways(laid_out, first, last, _arc_disc(laid_out, arcs[0]))
