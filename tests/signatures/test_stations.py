"""Points of the axis at equal steps along the boundary."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, box, polygon, profile_of

from mashape_cad.geometry.edge import EllipseArc, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.signatures.stations import stations


def _corners(name):
    return sum(r == 0 for r in axis_of(name).nodes.radius)


@pytest.mark.parametrize("name", [name for name in (*KNOWN, *NAMED) if name != "wedged room"])
def test_every_edge_has_as_many_stations(name):
    """Readings 1, 3 and 6: so many on each edge of every loop, however long, and one point for each convex vertex."""
    sampled = stations(axis_of(name), 10)
    assert len(sampled.radius) == 10 * len(profile_of(name).edges) + _corners(name)
    assert len(sampled.foot_distance) == len(sampled.tangent) == len(sampled.run) == len(sampled.radius)


def test_edges_of_holes_count_like_outer_ones():
    """Reading 1: a square hole doubles the stations of a square."""
    axis = medial_axis(Profile.of(box(0, 0, 4, 4), [box(1, 1, 2, 2)]))
    assert len(stations(axis, 25).radius) == 8 * 25 + 4


def test_stations_lie_in_the_middle_of_equal_steps():
    """Reading 1: four steps on a side of length 4 put them at 0.5, 1.5, 2.5 and 3.5."""
    sampled = stations(medial_axis(Profile.of(box(0, 0, 4, 2))), 4)
    assert sorted(sampled.radius.tolist()) == pytest.approx([0.0] * 4 + [0.25] * 4 + [0.5] * 4 + [0.75] * 4 + [1.0] * 4)


def test_steps_are_equal_in_arc_length():
    """Reading 1: not in the parameter. On half an ellipse the foot (X, Y) has the clearance sqrt(1 - 3 X^2 / 16)."""
    upper = EllipseArc(frozen([0, 0]), frozen([2, 0]), frozen([0, 1]), 0.0, np.pi)
    lower = EllipseArc(frozen([0, 0]), frozen([2, 0]), frozen([0, 1]), np.pi, np.pi)
    sampled = stations(medial_axis(Profile.of(Loop((upper, lower)))), 40)
    table = upper.point(np.linspace(0, 1, 100001))
    length = np.array([0, *np.cumsum(np.hypot(*np.diff(table, axis=0).T))])
    x = np.interp((np.arange(40) + 0.5) / 40 * length[-1], length, table[:, 0])
    expected = np.sqrt(1 - 3 * x**2 / 16)
    assert np.sort(sampled.radius) == pytest.approx(np.sort(np.concatenate([expected, expected])), abs=1e-4)


def test_half_the_step_has_twice_the_stations():
    """Reading 2: 0.01 means 100 on an edge, 0.02 means 50."""
    axis = axis_of("rectangle")
    assert len(stations(axis, 100).radius) - 4 == 2 * (len(stations(axis, 50).radius) - 4) == 400


def test_convex_vertices_come_with_nothing():
    """Reading 6: RF = 0, DF = 0, and no tangent."""
    sampled = stations(axis_of("rectangle"), 10)
    sharp = sampled.radius == 0
    assert np.count_nonzero(sharp) == 4
    assert np.all(sampled.foot_distance[sharp] == 0)
    assert np.all(np.isnan(sampled.tangent[sharp]))
    assert np.all(sampled.run[sharp] == -1)


def test_an_arc_that_is_touched_as_a_whole():
    """Reading 8: all its stations have the arc's radius and the largest distance between two contacts, its chord."""
    axis = axis_of("rounded rectangle")
    sampled = stations(axis, 10)
    on_arc = sampled.run == -1
    assert np.count_nonzero(on_arc) == 40
    assert sampled.radius[on_arc] == pytest.approx(0.8)
    assert sampled.foot_distance[on_arc] == pytest.approx(0.8 * np.sqrt(2))


def test_the_largest_distance_on_more_than_half_a_circle():
    """Reading 8: a diameter, not the chord of the arc's ends."""
    sampled = stations(axis_of("keyhole"), 10)
    assert sampled.foot_distance[sampled.run == -1].max() == pytest.approx(2.0)


def test_a_full_disc_is_one_point():
    """Reading 8: every station gives the same point, two radii apart."""
    sampled = stations(axis_of("disc"), 50)
    assert sampled.radius == pytest.approx(np.full(50, 1.7))
    assert sampled.foot_distance == pytest.approx(np.full(50, 3.4))
    assert np.all(sampled.run == -1)


@pytest.mark.parametrize("name", [name for name in (*KNOWN, *NAMED) if name != "disc"])
def test_two_feet_are_no_further_apart_than_a_diameter(name):
    """And at the two feet of a disc of radius r the walls enclose what their distance says."""
    sampled = stations(axis_of(name), 30)
    assert np.all(sampled.foot_distance <= 2 * sampled.radius * (1 + 1e-9) + 1e-12)
    assert np.all(sampled.radius >= 0)


@pytest.mark.parametrize("name", [name for name in (*KNOWN, *NAMED) if name != "disc"])
def test_tangents_are_unit_vectors_on_branches_only(name):
    """Where a station lies on no branch there is none."""
    sampled = stations(axis_of(name), 30)
    on_branch = sampled.run >= 0
    assert np.linalg.norm(sampled.tangent[on_branch], axis=1) == pytest.approx(1.0)
    assert np.isnan(sampled.tangent[~on_branch]).all()


def test_the_tangent_of_the_axis():
    """Reading 11: along the ell's parabola, which has the reflex corner as focus, the slope is (s - w) / w."""
    w, sampled = 1.3, stations(axis_of("ell"), 200)
    flat = sampled.tangent[np.abs(sampled.tangent[:, 0]) > 0.9]  # of the level leg; diagonals run at 45 degrees
    slope = np.abs(flat[:, 1] / flat[:, 0])
    s = (np.arange(200) + 0.5) / 200 * 4.5
    expected = (w - s)[(s > w * (2 - np.sqrt(2))) & (s < w)] / w
    assert np.sort(slope[slope > 1e-9]) == pytest.approx(np.sort(expected), abs=1e-9)


def test_a_branch_between_reflex_vertices_has_stations_of_its_own():
    """Reading 10: no place on an edge reaches it; it gets as many points as one edge, evenly in the angle."""
    axis = axis_of("wedged room")
    edges, count = len(profile_of("wedged room").edges), 12
    sampled = stations(axis, count)
    assert len(sampled.radius) == (edges + 1) * count + _corners("wedged room")
    # The tips are 0.2 apart: seen from a tip at an angle a from the middle the clearance is 0.1 / cos a.
    joins = np.sort(axis.nodes.radius[axis.nodes.degree > 2])
    widest = np.arccos(0.1 / joins[-1])
    angles = (np.arange(count) + 0.5) / count * 2 * widest - widest
    for expected in 0.1 / np.cos(angles):
        assert np.abs(sampled.radius - expected).min() <= 1e-9


def test_runs_do_not_pass_a_junction():
    """Reading 12: the middle branch and the corner's branch of a rectangle are two runs, on each long side three."""
    sampled = stations(axis_of("rectangle"), 100)
    runs = sampled.run[sampled.run >= 0]
    assert len(np.unique(runs)) == 6  # four corners, each met from both of its sides in one go, and the middle twice
    for run in np.unique(runs):
        mine = np.flatnonzero(sampled.run == run)
        assert np.array_equal(mine, np.arange(mine[0], mine[-1] + 1))


def test_a_hole_inside_keeps_runs_apart():
    """A ring's one branch is walked twice, along each loop once."""
    sampled = stations(axis_of("eccentric ring"), 60)
    assert [np.count_nonzero(sampled.run == run) for run in np.unique(sampled.run)] == [60, 60]


def test_points_are_the_same_wherever_the_loop_starts():
    """Reading 21: a polygon's stations are told by its edges, not by which comes first."""
    corners = [(0.0, 0.0), (5.0, 0.0), (5.0, 2.0), (2.0, 1.5), (0.0, 4.0)]
    rows = []
    for shift in range(5):
        sampled = stations(medial_axis(Profile.of(polygon(corners[shift:] + corners[:shift]))), 20)
        rows.append(np.sort(sampled.radius))
    for row in rows[1:]:
        assert row == pytest.approx(rows[0], abs=1e-12)
