"""Candidates for ends: all of them, and none that is not one."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, box, circle, periodic_spline, profile_of, regular

from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.kernel import DistanceQuery, KernelCurve
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.bezier import product
from mashape_cad.medial.ends import ends, falling_roots, settle_ends
from mashape_cad.medial.faces import blank_faces, settled_discs
from mashape_cad.medial.tour import site, tour


def _settled(profile):
    laid_out, frame = tour(profile)
    return laid_out, frame, ends(laid_out)


def _kinds(profile):
    return sorted(disc.kind for disc in _settled(profile)[2])


def test_corners_of_polygons():
    """Every convex vertex is a disc of radius 0, a reflex vertex is none."""
    assert _kinds(profile_of("ell")) == ["corner"] * 5
    assert _kinds(Profile.of(box(0, 0, 4, 4), [box(1, 1, 1, 1)])) == ["corner"] * 4
    assert _kinds(Profile.of(regular(64))) == ["corner"] * 64


def test_the_ellipse_has_an_end_at_each_tip_of_its_long_axis():
    """Where curvature is largest; where it is smallest there is none."""
    _, frame, found = _settled(profile_of("ellipse"))
    assert [disc.kind for disc in found] == ["osculating"] * 2
    assert sorted(disc.x * frame.size for disc in found) == pytest.approx([-1.5, 1.5], abs=1e-9)
    assert [disc.r * frame.size for disc in found] == pytest.approx([0.5, 0.5], abs=1e-9)


def test_arcs_that_are_touched_as_a_whole():
    """One disc for each end of the stadium, though the tour cuts a half circle in two."""
    laid_out, frame, found = _settled(profile_of("stadium"))
    assert [disc.kind for disc in found] == ["arc"] * 2
    for disc in found:
        (first, last), *others = disc.contacts
        assert not others
        a, b = (np.array(site(laid_out, *place)[:2]) * frame.size for place in (first, last))
        assert np.hypot(*(a - b)) == pytest.approx(1.5)


def _half_circle_over(floor):
    sides = [Line.of((-2, floor), (2, floor)), Line.of((2, floor), (2, 0)), Line.of((-2, 0), (-2, floor))]
    return Profile.of(Loop((*sides[:2], Arc.of((0, 0), 2.0, 0, np.pi), sides[2])))


def test_an_arc_whose_disc_is_cut_is_no_end():
    """A half circle over a flat rectangle: its disc would reach through the floor."""
    assert _kinds(_half_circle_over(-0.1)) == ["corner", "corner"]


def test_an_arc_that_just_fits():
    """The same half circle over a floor that its disc touches: one disc with two contacts."""
    (arc,) = [disc for disc in _settled(_half_circle_over(-2))[2] if disc.kind == "arc"]
    assert len(arc.contacts) == 2


def test_the_keyholes_arc_touches_its_disc_and_the_axis_goes_on():
    """An arc of more than half a circle is one contact; its end into the neck is no contact of its own."""
    _, _, found = _settled(profile_of("keyhole"))
    (arc,) = [disc for disc in found if disc.kind == "arc"]
    assert len(arc.contacts) == 1


def test_a_full_disc_is_told_at_once():
    """Also when its circle is drawn as several arcs."""
    whole = profile_of("disc")
    halves = Profile.of(Loop(whole.outer.edges[0].split(0.3)))
    for profile in (whole, halves):
        laid_out, frame, (disc,) = _settled(profile)
        faces = blank_faces(laid_out)
        assert settle_ends(laid_out, faces)
        assert settled_discs(faces) == [disc]
        assert disc.contacts == (((0, 0.0), (0, 0.0)),)  # from its loop's start to its start
        assert disc.r * frame.size == pytest.approx(1.7)


@pytest.mark.parametrize("name", [name for name in (*KNOWN, *NAMED) if name != "disc"])
def test_no_other_domain_is_taken_for_a_disc(name):
    """Not even those that have an arc of more than half a circle, or a circle with a hole in it."""
    laid_out, _ = tour(profile_of(name))
    assert not settle_ends(laid_out, blank_faces(laid_out))


def test_the_outer_circle_of_a_ring_is_no_end():
    """A hole lies in its disc."""
    assert _settled(profile_of("eccentric ring"))[2] == []


def test_arcs_of_one_circle_share_one_disc():
    """Two opposite arcs of one circle joined by chords bent inwards: one centre, two contacts."""
    a, b = 0.6, np.pi - 0.6
    bays = [
        Arc.of((0, 0), 1.0, -a, 2 * a),
        Line.of((np.cos(a), np.sin(a)), (np.cos(b), np.sin(b))),
        Arc.of((0, 0), 1.0, b, 2 * a),
        Line.of((np.cos(b), -np.sin(b)), (np.cos(a), -np.sin(a))),
    ]
    profile = Profile.of(Loop(tuple(bays)))
    assert [d for d in _settled(profile)[2] if d.kind == "arc"] == []  # the chords cut the circle's disc
    wide = [
        Arc.of((0, 0), 1.0, -0.6, 1.2),
        Line.of((np.cos(0.6), np.sin(0.6)), (np.cos(0.6), 2)),
        Line.of((np.cos(0.6), 2), (-np.cos(0.6), 2)),
        Line.of((-np.cos(0.6), 2), (-np.cos(0.6), np.sin(0.6))),
        Arc.of((0, 0), 1.0, np.pi - 0.6, 1.2),
        Line.of((-np.cos(0.6), -np.sin(0.6)), (-np.cos(0.6), -2)),
        Line.of((-np.cos(0.6), -2), (np.cos(0.6), -2)),
        Line.of((np.cos(0.6), -2), (np.cos(0.6), -np.sin(0.6))),
    ]
    arcs = [d for d in _settled(Profile.of(Loop(tuple(wide))))[2] if d.kind == "arc"]
    assert [len(disc.contacts) for disc in arcs] == [2]


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_every_disc_is_empty_and_touches(name):
    """The kernel finds the boundary one radius from the centre, and each contact lies on the circle."""
    profile = profile_of(name)
    laid_out, frame, found = _settled(profile)
    query = DistanceQuery(profile)
    for disc in found:
        centre = np.array([disc.x, disc.y]) * frame.size + frame.middle
        assert query.distances([centre])[0] / frame.size == pytest.approx(disc.r, abs=1e-10)
        for place in (place for contact in disc.contacts for place in contact):
            x, y, *_ = site(laid_out, *place)
            assert np.hypot(x - disc.x, y - disc.y) == pytest.approx(disc.r, abs=1e-10)


@pytest.mark.parametrize("name", ["blob", "rational blob", "blob with holes", "wave"])
def test_no_maximum_of_curvature_is_forgotten(name):
    """Every maximum among dense samples whose disc the kernel finds empty is an end."""
    profile = profile_of(name)
    laid_out, frame, found = _settled(profile)
    query = DistanceQuery(profile)
    rows = []
    for e in np.flatnonzero(laid_out.degree > 1).tolist():
        rows += [site(laid_out, e, t)[:5] for t in np.linspace(0, 1, 400, endpoint=False)]
    rows = np.array(rows)
    bend = rows[:, 4]
    top = np.flatnonzero((bend > np.roll(bend, 1)) & (bend >= np.roll(bend, -1)) & (bend > 0))
    centres = rows[top, :2] + rows[top, 2:4] / bend[top, None]
    empty = query.distances(centres * frame.size + frame.middle) / frame.size >= 1 / bend[top] - 1e-4
    inside = np.array([not np.isnan(c).any() for c in centres])
    ours = np.array([(disc.x, disc.y) for disc in found])
    for centre in centres[empty & inside]:
        assert np.hypot(*(ours - centre).T).min() <= 2e-2


def test_a_bulge_that_another_wall_cuts_is_no_end():
    """The disc of a wide bulge reaches through a hole; the hole is the witness."""
    flat = EllipseArc(frozen([0, 0]), frozen([3, 0]), frozen([0, 2]), 0.0, 2 * np.pi)
    plain = _kinds(Profile.of(Loop((flat,))))
    pierced = _kinds(Profile.of(Loop((flat,)), [circle(1.9, 0, 0.3)]))
    assert plain == ["osculating"] * 2
    assert pierced == ["osculating"]


def test_an_end_at_a_smooth_join_where_curvature_jumps():
    """An ellipse's flank runs into a flatter curve: curvature is largest right at the join."""
    pointed = EllipseArc(frozen([0, 0]), frozen([1, 0]), frozen([0, 2]), 0.0, np.pi)  # tip at (0, 2)
    half = Loop((Arc.of((0, 0), 1.0, np.pi, np.pi), *pointed.split(0.5)))
    _, frame, found = _settled(Profile.of(half))
    kinds = sorted(disc.kind for disc in found)
    assert kinds == ["arc", "osculating"]
    (tip,) = [disc for disc in found if disc.kind == "osculating"]
    assert tip.r * frame.size == pytest.approx(0.5)


def test_a_symmetric_spline_has_symmetric_ends():
    """No end is found twice, once from each side of a knot."""
    angle = 2 * np.pi * np.arange(8) / 8
    radius = np.where(np.arange(8) % 2, 1.0, 1.6)
    profile = Profile.of(periodic_spline(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])))
    _, _, found = _settled(profile)
    assert [disc.kind for disc in found] == ["osculating"] * 4
    assert axis_of("blob").nodes.kind.count("end") == 3


def _with_roots(roots, extra):
    polynomial = np.array(extra, float)
    for root in roots:
        polynomial = product(polynomial, np.array([-root, 1.0 - root]))
    return polynomial


@pytest.mark.parametrize(
    "roots",
    [
        (0.3,),
        (0.25, 0.75),
        (0.1, 0.4, 0.9),
        (0.2, 0.2001, 0.7),
        (0.05, 0.3, 0.3001, 0.6, 0.95),
        (0.1, 0.3, 0.5, 0.8),
        (0.125, 0.25, 0.5, 0.75, 0.875),
        tuple(np.linspace(0.04, 0.96, 9).tolist()),
    ],
)
def test_planted_roots_are_found_where_the_polynomial_falls(roots):
    """Every other one of simple roots, to the last digits that the coefficients hold."""
    for sign in (1.0, -1.0):
        polynomial = sign * _with_roots(roots, [1.0, 2.0, 1.5])
        rises_first = sign * (-1) ** len(roots) < 0  # the sign before the first root
        expected = roots[1::2] if rises_first else roots[::2]
        assert sorted(falling_roots(polynomial)) == pytest.approx(sorted(expected), abs=1e-7)


def test_roots_that_do_not_count():
    """A double root does not change the sign; a polynomial without roots has none; nor has zero."""
    assert len(falling_roots(_with_roots((), [1.0, 0.2, 3.0]))) == 0
    assert len(falling_roots(-_with_roots((), [1.0, 0.2, 3.0]))) == 0
    assert len(falling_roots(np.zeros(6))) == 0
    assert len(falling_roots(_with_roots((1.7, -0.3), [1.0]))) == 0


def test_curvature_at_a_found_end_is_a_maximum():
    """Neighbours bend less."""
    profile = profile_of("blob")
    laid_out, frame, found = _settled(profile)
    curve = KernelCurve(profile.edges[0])
    for disc in found:
        _, u = foot(laid_out, disc.contacts[0][0])
        before, here, after = curve.curvature([u - 1e-4, u, u + 1e-4])
        assert max(before, after) < here == pytest.approx(1 / (disc.r * frame.size))


def test_a_symmetric_cap_ends_at_its_tip():
    """A cubic whose curvature is largest exactly in the middle of its parameter, with two minima beside it."""
    cap = BSpline.of(3, [0, 0, 0, 0, 1, 1, 1, 1], [(1, 0), (0.74, 1.22), (-0.74, 1.22), (-1, 0)])
    box_below = (Line.of((-1, 0), (-1, -2)), Line.of((-1, -2), (1, -2)), Line.of((1, -2), (1, 0)))
    _, frame, found = _settled(Profile.of(Loop((cap, *box_below))))
    (tip,) = [disc for disc in found if disc.kind == "osculating"]
    assert (tip.x, tip.r * frame.size) == pytest.approx((0, 0.9306147541))
