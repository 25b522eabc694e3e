"""Light pictures of profiles."""

import numpy as np
import pytest
import shapely

from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.library.thumbnail import GRID, exact_bounds, thumbnail


def _polygon(*corners):
    points = [np.array(corner, float) for corner in corners]
    return Loop(tuple(Line.of(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)))


WAVY = Loop(
    (
        BSpline.of(3, [0, 0, 0, 0, 1, 2, 3, 3, 3, 3], [[0, 0], [3, -4], [5, 5], [9, -3], [12, 4], [14, 0]]),
        Line.of([14, 0], [14, 9]),
        Line.of([14, 9], [0, 9]),
        Line.of([0, 9], [0, 0]),
    )
)


def _points(flat, width=2):
    return np.array(flat).reshape(-1, width)


@pytest.mark.parametrize("turn", [0.0, 0.3, 2.0])
def test_bounds_of_a_turned_ellipse(turn):
    """The box of curved edges is exact, not that of sampled points."""
    ellipse = EllipseArc(frozen([5, 3]), frozen([2, 0]), frozen([0, 1]), 0.1, 2 * np.pi)
    loop = Loop((ellipse,)).transformed(Similarity.of(angle=turn))
    centre = Similarity.of(angle=turn).apply([5.0, 3.0])
    half = np.hypot([2 * np.cos(turn), 2 * np.sin(turn)], [np.sin(turn), np.cos(turn)])
    np.testing.assert_allclose(exact_bounds(loop), [centre - half, centre + half], rtol=0, atol=1e-12)


def test_bounds_of_a_spline():
    """No point of the curve lies outside, and each side is touched."""
    low, high = exact_bounds(WAVY)
    points = WAVY.flattened(20_000)
    assert (points >= low - 1e-12).all()
    assert (points <= high + 1e-12).all()
    np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], [low, high], atol=1e-6)


@pytest.mark.parametrize("outer", [WAVY, Loop((Arc.of([3, 4], 7.0),)), _polygon((0, 0), (5, 1), (2, 8))])
def test_outline_is_good_to_about_a_two_thousandth(outer):
    """Drawn again in mm, the outline lies on the profile, with few points."""
    profile = Profile.of(outer)
    bounds = exact_bounds(profile.outer)
    picture = thumbnail(profile, bounds)
    drawn = shapely.Polygon(_points(picture.loops[0]) * picture.pitch + picture.corner)
    apart = drawn.exterior.hausdorff_distance(shapely.Polygon(outer.flattened(500)).exterior)
    assert apart < np.max(bounds[1] - bounds[0]) / 1500
    assert len(picture.loops[0]) < 2 * 150


def test_straight_edges_keep_their_corners_only():
    """A rectangle whose side is split in a hundred is four points."""
    side = [(x, 0.0) for x in np.linspace(0, 100, 101)]
    profile = Profile.of(_polygon(*side, (100.0, 50.0), (0.0, 50.0)))
    picture = thumbnail(profile, exact_bounds(profile.outer))
    assert picture.loops == ((0, 0, GRID, 0, GRID, GRID // 2, 0, GRID // 2),)


def test_holes_follow_the_outer_loop():
    """Each hole is a loop, however small."""
    profile = Profile.of(
        _polygon((0, 0), (9, 0), (9, 9), (0, 9)), [Loop((Arc.of([4, 4], 1e-6),)), Loop((Arc.of([7, 7], 1),))]
    )
    picture = thumbnail(profile, exact_bounds(profile.outer))
    assert len(picture.loops) == 3
    assert len(picture.loops[1]) >= 2


def test_branches_carry_their_radii_on_the_same_grid():
    """A straight branch is two points with their radii, a bent one as many as it needs."""
    profile = Profile.of(_polygon((10, 20), (20, 20), (20, 25), (10, 25)))
    straight = np.linspace([10, 20, 0], [12.5, 22.5, 2.5], 50)
    angle = np.linspace(0, 1, 50)
    bent = np.column_stack([12 + 2 * np.cos(angle), 22 + 2 * np.sin(angle), np.ones(50)])
    picture = thumbnail(profile, exact_bounds(profile.outer), [straight, bent])
    assert picture.branches[0] == (0, 0, 0, GRID // 4, GRID // 4, GRID // 4)
    assert 3 < len(_points(picture.branches[1], 3)) < 20


def test_a_discs_axis_is_one_point():
    """A branch of one point stays one point."""
    profile = Profile.of(Loop((Arc.of([0, 0], 5),)))
    picture = thumbnail(profile, exact_bounds(profile.outer), [np.array([[0.0, 0.0, 5.0]])])
    assert picture.branches == ((GRID // 2, GRID // 2, GRID // 2),)
