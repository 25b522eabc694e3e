"""The paper's histograms, on shapes where they can be told by hand."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, box, profile_of, rounded

from mashape_cad.geometry.edge import Line, Similarity
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.signatures.distance import distances
from mashape_cad.signatures.paper import (
    BINS,
    curvature_function,
    footpoint_distance,
    histogram,
    radius_function,
    signature,
)
from mashape_cad.signatures.stations import stations

_ALL = [*KNOWN, *NAMED]
_FUNCTIONS = ("df", "rf", "cf")


def _counts(vector, total):
    """Bins that are not empty, and how many values they hold."""
    counts = np.rint(vector * total).astype(int)
    return {int(k): int(counts[k]) for k in np.flatnonzero(counts)}


def test_a_rectangle_by_hand():
    """Sides 4 and 2, four stations on each: RF and DF have five values each, CF has none but 0."""
    vectors = signature(medial_axis(Profile.of(box(0, 0, 4, 2))), per_edge=4).vectors
    # On long sides at 0.5, 1.5, 2.5, 3.5 from a corner, on short ones at 0.25, 0.75, 1.25, 1.75; four corners.
    # RF: 0, 1/4, 1/2, 3/4 of the largest, 1, and 1; bins of 1/64.
    assert _counts(vectors["rf"], 20) == {0: 4, 16: 4, 32: 4, 48: 4, 63: 4}
    # DF: near a corner the feet are s sqrt(2) apart, of 2 at most; between long sides 2.
    assert _counts(vectors["df"], 20) == {
        0: 4,
        int(64 * 0.25 * np.sqrt(2) / 2): 4,
        int(64 * 0.5 * np.sqrt(2) / 2): 4,
        int(64 * 0.75 * np.sqrt(2) / 2): 4,
        63: 4,
    }
    assert _counts(vectors["cf"], 1) == {0: 1}


def test_a_stadium_is_one_bin_each():
    """Reading 8: constant width, so DF and RF are 1 throughout; a straight branch, so CF is 0."""
    vectors = signature(axis_of("stadium")).vectors
    assert [_counts(vectors[name], 400) for name in ("df", "rf")] == [{63: 400}] * 2
    assert _counts(vectors["cf"], 1) == {0: 1}


def test_a_disc_is_one_bin_each():
    """Reading 8 and 13: one point; no tangent at all."""
    vectors = signature(axis_of("disc")).vectors
    assert [_counts(vectors[name], 100) for name in _FUNCTIONS] == [{63: 100}, {63: 100}, {0: 100}]


def test_a_concentric_ring():
    """Constant width; the axis turns by a constant angle from station to station."""
    axis = axis_of("concentric ring")
    sampled = stations(axis, 100)
    assert radius_function(sampled) == pytest.approx(0.95)
    assert footpoint_distance(sampled) == pytest.approx(1.9)
    assert curvature_function(sampled) == pytest.approx(2 * np.sin(np.pi / 100), rel=1e-2)
    assert _counts(signature(axis).vectors["rf"], 200) == {63: 200}


@pytest.mark.parametrize("name", ["rectangle", "square", "3-gon", "5-gon", "12-gon", "stadium", "rounded rectangle"])
def test_straight_branches_have_no_curvature(name):
    """Reading 13: all values are 0, so bin 0 holds everything and rounding is not blown up."""
    assert curvature_function(stations(axis_of(name), 100)).max() <= 1e-9
    assert _counts(signature(axis_of(name)).vectors["cf"], 1) == {0: 1}


def test_the_curvature_of_a_parabola():
    """Readings 11 and 12: |T(i+1) - T(i)| along the ell's bend, T from the closed form; nothing across junctions."""
    count, w, length = 100, 1.3, 4.5
    bend = w * (2 - np.sqrt(2))
    actual = np.sort(curvature_function(stations(axis_of("ell"), count)))[::-1]
    # On the outer walls, from the bend on: dr/ds = (s - w) / w under the corner, 0 beyond.
    s = (np.arange(count) + 0.5) / count * length
    s = s[(s > bend) & (s < length - w / 2)]
    slope = np.minimum((s - w) / w, 0.0)
    tangent = np.column_stack([np.ones_like(s), slope]) / np.hypot(1, slope)[:, None]
    change = np.linalg.norm(np.diff(tangent, axis=0), axis=1)
    expected = np.sort(np.concatenate([change, change]))[::-1]  # both legs
    expected = expected[expected > 1e-9]
    assert actual[: len(expected)] == pytest.approx(expected, abs=1e-9)
    assert actual[len(expected) :] == pytest.approx(0.0, abs=1e-9)


def test_osculating_ends_are_points_like_others():
    """Reading 7: near the tip of an ellipse RF tends to the radius of curvature b^2 / a and DF to 0."""
    sampled = stations(axis_of("ellipse"), 2000)
    near = np.argmin(sampled.radius)
    assert sampled.radius[near] == pytest.approx(0.5, abs=1e-4)
    assert sampled.foot_distance[near] <= 0.02


def test_two_feet_of_an_ellipse():
    """Along the whole branch: feet lie above one another, so RF^2 = 1 - x^2 / 3 and DF = 2 b sqrt(1 - X^2 / a^2)."""
    sampled = stations(axis_of("ellipse"), 200)
    x_sq = 3 * (1 - sampled.radius**2)
    foot_x_sq = x_sq * (16 / 9)  # the normal at X meets the long axis at X (a^2 - b^2) / a^2
    assert sampled.foot_distance == pytest.approx(2 * np.sqrt(np.maximum(1 - foot_x_sq / 4, 0)), abs=1e-6)


@pytest.mark.parametrize("name", _ALL)
def test_histograms_sum_to_1(name):
    """Reading 4, and no bin is negative; read-only, so that nobody changes a signature."""
    found = signature(axis_of(name), 30)
    assert (found.name, found.version) == ("paper", 1)
    assert tuple(found.vectors) == _FUNCTIONS
    for vector in found.vectors.values():
        assert vector.shape == (BINS,)
        assert vector.sum() == pytest.approx(1.0, abs=1e-12)
        assert vector.min() >= 0
        with pytest.raises(ValueError, match="read-only"):
            vector[0] = 1.0


def test_values_are_divided_by_their_maximum():
    """Reading 4: 64 equal bins over [0, 1], the last one closed."""
    vector = histogram(np.array([0.0, 1.0, 2.0, 4.0, 4.0]))
    assert _counts(vector, 5) == {0: 1, 16: 1, 32: 1, 63: 2}
    values = np.linspace(0.0, 1.0, 6401)[:-1]
    assert np.array_equal(_counts(histogram(np.append(values, 1.0)), 6401), {k: 100 + (k == 63) for k in range(64)})


def test_values_on_the_edge_of_a_bin_belong_to_the_upper_one():
    """Reading 5: also when rounding leaves them a little below, so that a motion does not move them."""
    for value in (0.25, 0.25 - 1e-13, 0.25 + 1e-13):
        assert _counts(histogram(np.array([value, 1.0])), 2) == {16: 1, 63: 1}
    assert _counts(histogram(np.array([0.25 - 1e-6, 1.0])), 2) == {15: 1, 63: 1}


def test_a_function_that_is_0_everywhere():
    """Reading 13: bin 0; the same without any value."""
    assert _counts(histogram(np.zeros(7)), 7) == {0: 7}
    assert _counts(histogram(np.full(7, 1e-15)), 7) == {0: 7}
    assert histogram(np.zeros(0)).tolist() == [1.0] + [0.0] * 63


_POSES = {
    "moved": Similarity.of(offset=(812.7, -3041.9)),
    "turned": Similarity.of(angle=np.deg2rad(37)),
    "in inches": Similarity.of(25.4),
    "mirrored": Similarity.of(mirror=True),
    "all at once": Similarity.of(1 / 25.4, np.deg2rad(-143), (5.5, 0.3), mirror=True),
}


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", _ALL)
def test_neither_motion_nor_scale_nor_a_mirror_shows(name, pose):
    """Readings 19 and 20."""
    axis = medial_axis(profile_of(name).transformed(_POSES[pose]))
    found = distances(signature(axis_of(name)), signature(axis))
    assert max(found.values()) <= 1e-2  # a value near the edge of a bin may change over


@pytest.mark.parametrize("name", [name for name in _ALL if len(profile_of(name).outer.edges) > 1])
def test_where_a_loop_starts_and_which_way_it_runs_does_not_show(name):
    """Reading 21."""
    profile = profile_of(name)
    edges = profile.outer.edges
    later = Profile.of(Loop(edges[2:] + edges[:2]), profile.holes)
    back = Profile.of(profile.outer.reversed(), [hole.reversed() for hole in profile.holes])
    for other in (later, back):
        found = distances(signature(axis_of(name)), signature(medial_axis(other)))
        assert max(found.values()) <= 1e-2


def test_splitting_an_edge_shows():
    """Reading 3: a side in two halves weighs twice; a weakness of the paper that its signature keeps."""
    plain = box(0, 0, 7, 3)
    halves = Profile.of(Loop((*plain.edges[0].split(0.5), *plain.edges[1:])))
    found = distances(signature(medial_axis(Profile.of(plain))), signature(medial_axis(halves)))
    assert found["rf"] > 0.05
    assert found["df"] > 0.05
    assert found["cf"] == 0.0


def test_the_reflex_vertex_itself_gets_no_station():
    """Reading 10: rounded a little it becomes an edge, and then it counts."""
    corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)]
    sharp = stations(medial_axis(Profile.of(rounded(corners, [0.0] * 6))), 50)
    blunt = stations(medial_axis(Profile.of(rounded(corners, [0.0] * 3 + [0.05] + [0.0] * 2))), 50)
    assert len(blunt.radius) - len(sharp.radius) == 50


def test_one_far_disc_moves_all_bins():
    """Reading 4: the division by the maximum is a weakness of the paper that its signature keeps."""
    corridor = [Line.of((0, 0), (8, 0)), Line.of((8, 0), (8, 1)), Line.of((8, 1), (0, 1)), Line.of((0, 1), (0, 0))]
    room = [(0, 0), (8, 0), (8, -2), (12, -2), (12, 3), (8, 3), (8, 1), (0, 1)]
    ends = [Line.of(p, room[(k + 1) % len(room)]) for k, p in enumerate(room)]
    alone = signature(medial_axis(Profile.of(Loop(tuple(corridor))))).vectors["rf"]
    with_room = signature(medial_axis(Profile.of(Loop(tuple(ends))))).vectors["rf"]
    assert alone[63] > 0.3
    assert with_room[63] < 0.1
