"""What bounds no domain is refused, with its kind and its place."""

from contextlib import suppress

import numpy as np
import pytest
from catalogue import NAMED, box, circle, polygon, profile_of, slot
from invariants import check_axis
from oracle import check_restored

from mashape_cad.errors import InvalidProfileError
from mashape_cad.geometry.edge import Arc, BSpline, Line, Similarity
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.tour import tour
from mashape_cad.medial.validity import check_simple, first_contact


def _refused(profile: Profile) -> InvalidProfileError:
    with pytest.raises(InvalidProfileError) as caught:
        medial_axis(profile)
    assert str(caught.value)
    assert "\n" not in str(caught.value)
    return caught.value


_BOX = box(0, 0, 10, 6)
_CROSSED = {
    "bow tie": (Profile(polygon([(0, 0), (4, 4), (4, 0), (0, 4)])), (2, 2)),
    "ear": (Profile(polygon([(0, 0), (10, 0), (10, 6), (4, 6), (4, -1), (3, -1), (3, 6), (0, 6)])), (3.5, 0)),
    "hole across the outline": (Profile.of(_BOX, [circle(10, 3, 1)]), (10, 3)),
    "holes across one another": (Profile.of(_BOX, [circle(3, 3, 1), circle(4.5, 3, 1)]), (3.75, 3)),
    "hole that touches the outline": (Profile.of(_BOX, [circle(9, 3, 1)]), (10, 3)),
    "holes that touch": (Profile.of(_BOX, [circle(3, 3, 1), circle(5, 3, 1)]), (4, 3)),
    "vertex on a side": (Profile(polygon([(0, 0), (10, 0), (10, 6), (6, 6), (5, 0), (4, 6), (0, 6)])), (5, 0)),
    "vertex on a vertex": (Profile(polygon([(0, 0), (2, 2), (4, 0), (4, 4), (2, 2), (0, 4)])), (2, 2)),
    "hole with its vertex on the outline": (Profile.of(_BOX, [polygon([(10, 3), (8, 2), (8, 4)])]), (10, 3)),
    "two holes in one place": (Profile.of(_BOX, [circle(3, 3, 1), circle(3, 3, 1, 1.0)]), None),
    "line on a line": (Profile(polygon([(0, 0), (6, 0), (6, 2), (2, 2), (2, 0), (1, 0), (1, 4), (0, 4)])), None),
}


@pytest.mark.parametrize("name", _CROSSED)
def test_crossing_and_touching(name):
    """Refused, with a place near the crossing."""
    profile, place = _CROSSED[name]
    error = _refused(profile)
    assert error.kind in {"crossing", "touching"}
    assert error.place is not None
    if place is not None:
        assert np.hypot(*np.subtract(error.place, place)) <= 1.5


@pytest.mark.parametrize("name", _CROSSED)
def test_crossing_in_another_pose(name):
    """Moved far away, turned and mirrored it is as wrong, and the place moves along."""
    similarity = Similarity.of(1e-2, 0.8, (300, -20), mirror=True)
    profile, place = _CROSSED[name]
    error = _refused(profile.transformed(similarity))
    if place is not None:
        assert np.hypot(*np.subtract(error.place, similarity.apply(place))) <= 1.5e-2


def test_one_spline_that_crosses_itself():
    """A loop within a single curve."""
    poles = [(0, 0), (8, 0), (10, 6), (2, 6), (3, 1), (7, 8), (0, 8)]
    knots = [0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4]
    outer = Loop((BSpline.of(3, knots, poles), Line.of((0, 8), (0, 0))))
    curve = outer.edges[0].flattened(200)
    assert not _is_simple(curve)
    assert _refused(Profile.of(outer)).kind == "crossing"


def _is_simple(points: np.ndarray) -> bool:
    import shapely

    return bool(shapely.LineString(points).is_simple)


@pytest.mark.parametrize("hole", [circle(30, 3, 1), circle(-4, -4, 2), circle(10.5, 6.5, 0.6)])
def test_a_hole_outside(hole):
    """Told by its own name."""
    error = _refused(Profile.of(_BOX, [hole]))
    assert error.kind == "hole-outside"
    assert error.place is not None


def test_a_hole_around_the_outline():
    """Outer loop and hole were mixed up."""
    assert _refused(Profile.of(circle(5, 3, 2), [_BOX])).kind == "hole-outside"


def test_a_hole_inside_a_hole():
    """An island's hole without its island."""
    assert _refused(Profile.of(_BOX, [circle(5, 3, 2), circle(5, 3, 1)])).kind in {"hole-outside", "crossing"}


def test_an_edge_without_length():
    """And where it is."""
    edges = [Line.of((0, 0), (4, 0)), Line.of((4, 0), (4, 0)), Line.of((4, 0), (4, 3)), Line.of((4, 3), (0, 0))]
    error = _refused(Profile(Loop(tuple(edges))))
    assert error.kind == "zero-length"
    assert error.place == pytest.approx((4, 0))


def test_an_open_loop():
    """A gap that no reader closed."""
    edges = [Line.of((0, 0), (4, 0)), Line.of((4, 0.01), (4, 3)), Line.of((4, 3), (0, 0))]
    error = _refused(Profile(Loop(tuple(edges))))
    assert error.kind == "open"
    assert error.place == pytest.approx((4, 0), abs=0.02)


def test_a_cusp():
    """Two arcs that leave a vertex in the same direction: the domain has no width there."""
    between_half_circles = (
        Arc.of((-1, 0), 1, np.pi, -np.pi),
        Arc.of((1, 0), 1, np.pi, -np.pi),
        Arc.of((0, 0), 2, 0, np.pi),
    )
    error = _refused(Profile.of(Loop(between_half_circles)))
    assert error.kind == "cusp"
    assert abs(error.place[0]) == pytest.approx(2)


def test_a_line_that_runs_out_and_back():
    """A spike, or a slit, without width."""
    assert _refused(Profile(polygon([(0, 0), (4, 0), (2, 0), (2, 2), (0, 2)]))).kind in {"cusp", "crossing"}
    slit = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 1), (2, 2), (0, 2)]
    assert _refused(Profile(polygon(slit))).kind in {"cusp", "crossing"}


@pytest.mark.parametrize("poles", [[(1, 0), (-1, 1), (1, 1), (-1, 0)], [(1, 0), (1, 0), (0.5, 1), (-1, 0)]])
def test_a_curve_that_stands_still(poles):
    """Inside (a cusp of its own), or at its end (two poles in one place): refused, or done right."""
    cap = BSpline.of(3, [0, 0, 0, 0, 1, 1, 1, 1], poles)
    below = (Line.of((-1, 0), (-1, -2)), Line.of((-1, -2), (1, -2)), Line.of((1, -2), (1, 0)))
    profile = Profile.of(Loop((cap, *below)))
    with suppress(InvalidProfileError):
        axis = medial_axis(profile)
        check_axis(profile, axis)
        check_restored(profile, axis)


@pytest.mark.parametrize("profile", [Profile(_BOX.reversed()), Profile(_BOX, (circle(5, 3, 1),))])
def test_a_loop_that_runs_the_wrong_way(profile):
    """The interior has to lie on the left; `Profile.of` sees to that, the bare constructor does not."""
    assert isinstance(_refused(profile), InvalidProfileError)


_PLATE = polygon([(0, 0), (8, 0), (8, 5), (3, 5), (3, 4), (0, 4)])


@pytest.mark.parametrize(
    ("profile", "place"),
    [
        (Profile(_PLATE.reversed()), (0, 0)),
        (Profile(circle(5, 3, 2).reversed()), (7, 3)),
        (Profile(_PLATE, (circle(5, 2, 1),)), (6, 2)),
        (Profile(_PLATE, (circle(2, 2, 0.5).reversed(), circle(5, 2, 1), circle(7, 4, 0.5).reversed())), (6, 2)),
    ],
)
def test_the_loop_that_runs_the_wrong_way_is_told(profile, place):
    """With its first point, also among others that run the right way, and also when the part is mirrored."""
    for similarity in (Similarity.of(), Similarity.of(1e-2, 0.8, (300, -20), mirror=True)):
        error = _refused(profile.transformed(similarity))
        assert error.kind == "degenerate"
        assert "the wrong way round" in str(error)
        start = profile.transformed(similarity).outer.edges[0].start
        if error.place == pytest.approx(start, rel=1e-9):
            assert np.allclose(place, profile.outer.edges[0].start)
        else:
            assert error.place == pytest.approx(similarity.apply(place), rel=1e-9, abs=1e-9)


def _hole_and_place(profile: Profile) -> tuple[str, tuple[float, float]]:
    error = _refused(profile)
    assert error.kind == "hole-outside"
    return str(error), error.place


@pytest.mark.parametrize("bad", range(3))
def test_the_hole_that_lies_outside_is_told(bad):
    """Its own point among several holes; a hole in a bay of the outline lies outside though inside its box."""
    holes = [circle(1, 1, 0.5), circle(5, 2, 1), box(6.5, 3, 1, 1)]
    holes[bad] = circle(1, 4.6, 0.3)
    text, place = _hole_and_place(Profile.of(_PLATE, holes))
    assert "outside the outer loop" in text
    assert np.hypot(*np.subtract(place, (1, 4.6))) == pytest.approx(0.3)


@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("inner", [circle(5, 2, 0.5), circle(5.4, 2, 0.5), box(4.8, 1.8, 0.4, 0.4)])
def test_the_hole_inside_a_hole_is_told(inner, order):
    """The inner one, in whichever order they are given."""
    holes = [circle(1, 1, 0.5), circle(5, 2, 1), inner]
    text, place = _hole_and_place(Profile.of(_PLATE, holes[::order]))
    assert "inside another hole" in text
    assert np.hypot(*np.subtract(place, (5, 2))) < 0.95


def test_holes_beside_one_another_are_not_inside():
    """Nor in a bay of another hole."""
    crescent = Loop((Arc.of((5, 3), 2.0, 0.5, 4.0), Line.of(*_ends_of_crescent())))
    profile = Profile.of(_BOX, [crescent, circle(6.6, 2.2, 0.5), circle(1, 1, 0.5)])
    laid_out, frame = tour(profile)
    check_simple(laid_out, frame)


def _ends_of_crescent() -> tuple[tuple[float, float], tuple[float, float]]:
    """From the end of the arc back to its start."""
    a, b = 4.5, 0.5
    return (5 + 2 * np.cos(a), 3 + 2 * np.sin(a)), (5 + 2 * np.cos(b), 3 + 2 * np.sin(b))


# Halfway between two of the sixteen points that stand for a quarter circle.
_BETWEEN = np.pi / 64


def test_a_small_hole_near_a_round_wall_is_inside():
    """It lies between the wall and the chord of the wall's points, but not on it."""
    at = 4.9985
    profile = Profile.of(circle(0, 0, 5), [circle(at * np.cos(_BETWEEN), at * np.sin(_BETWEEN), 5e-4)])
    laid_out, frame = tour(profile)
    check_simple(laid_out, frame)


def test_a_small_hole_in_a_round_bay_is_outside():
    """It lies beyond the wall, though on this side of the chord of the wall's points."""
    sides = polygon([(-3, 0), (-5, 0), (-5, -5), (5, -5), (5, 0), (3, 0)]).edges[:-1]
    bay = Loop((*sides, Arc.of((0, 0), 3, 0, -np.pi)))
    profile = Profile.of(bay, [circle(2.9985 * np.cos(_BETWEEN), -2.9985 * np.sin(_BETWEEN), 4e-4)])
    laid_out, frame = tour(profile)
    with pytest.raises(InvalidProfileError):
        check_simple(laid_out, frame)


def test_a_hole_that_nearly_fills_a_hole_is_inside():
    """Also where its points lie beyond the chords of the other's."""
    profile = Profile.of(_BOX, [circle(5, 3, 2), circle(5, 3, 1.9995, _BETWEEN)])
    laid_out, frame = tour(profile)
    with pytest.raises(InvalidProfileError):
        check_simple(laid_out, frame)


def test_a_profile_of_no_size():
    """Lines there and back."""
    assert _refused(Profile(polygon([(0, 0), (4, 0)]))).kind in {"cusp", "degenerate", "crossing"}


@pytest.mark.parametrize("name", NAMED)
def test_valid_profiles_pass(name):
    """No false alarm at joins, fillets, tangent arcs and narrow places."""
    laid_out, frame = tour(profile_of(name))
    check_simple(laid_out, frame)
    assert first_contact(laid_out) is None


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-6])
def test_near_is_not_touching(gap):
    """A hole a little off the wall, a slot a little off a hole: valid."""
    medial_axis(Profile.of(_BOX, [circle(9 - gap, 3, 1)]))
    medial_axis(Profile.of(_BOX, [slot(3, 3, 1, 0.5), circle(5 + gap, 3, 0.5)]))
    medial_axis(Profile(polygon([(0, 0), (10, 0), (10, 6), (6, 6), (5, gap), (4, 6), (0, 6)])))


@pytest.mark.parametrize("turn", [0.1, 1e-2, 1e-3])
def test_a_sharp_spike_is_not_a_cusp(turn):
    """A convex vertex with a small angle is one branch."""
    axis = medial_axis(Profile(polygon([(0, 0), (4, 0), (4, 2), (0.0, 2), (2, 1 + turn), (2 + turn, 0.9), (0, 0.9)])))
    assert axis.nodes.kind.count("end") >= 5
