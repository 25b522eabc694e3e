"""Branches in frames of their own: closed forms, and what moving, turning, scaling and mirroring do to them."""

import numpy as np
import pytest
from catalogue import polygon, profile_of
from lights import branches_of

from mashape_cad.geometry.edge import Floats, Similarity
from mashape_cad.geometry.profile import Profile
from mashape_cad.matching.frames import Frames, frames

# A rectangle of 4 by 2: a ridge of constant radius 1, and four branches that run down to the corners.
_RIDGE = np.array([(-1.0, 0.0, 1.0), (1.0, 0.0, 1.0)])
_CORNERS = [np.array([(x, 0.0, 1.0), (2 * x, y, 0.0)]) for x in (-1.0, 1.0) for y in (-1.0, 1.0)]


def _turned(branches: list[Floats], pose: Similarity) -> list[Floats]:
    return [np.column_stack([pose.apply(run[:, :2]), run[:, 2] * pose.scale]) for run in branches]


def _sorted(signature: Floats) -> Floats:
    return signature[np.lexsort(np.round(signature, 6).T)]


def test_a_rectangle_has_three_frames_at_each_junction():
    """Of the ridge from both ends, of each corner's branch from its junction; corners have no unit of length."""
    found = frames([_RIDGE, *_CORNERS])
    assert len(found.radius) == 6
    assert found.radius == pytest.approx(np.ones(6))
    ridge = np.flatnonzero(np.abs(found.direction[:, 1]) < 1e-12)
    assert len(ridge) == 2
    # Straight ahead, to the ridge's end at last; the radius stays; corners three quarters of a half turn aside.
    expected = [0.5, 1, 1.5, 2, 2, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 0.75, 0.75]
    assert found.signature[ridge] == pytest.approx(np.array([expected, expected]), abs=1e-12)


def test_a_ring_that_was_cut_open_has_no_frame():
    """Where the cut lies is arbitrary."""
    t = np.linspace(0, 2 * np.pi, 50)
    ring = np.column_stack([np.cos(t), np.sin(t), np.full(50, 0.2)])
    ring[-1] = ring[0]
    assert len(frames([ring]).radius) == 0


def test_a_disc_has_none():
    """Its axis is one point."""
    assert len(frames([np.array([(0.0, 0.0, 1.0)])]).radius) == 0
    assert frames([]).signature.shape == (0, 17)


@pytest.mark.parametrize("pose", [Similarity.of(2.5, 0.8, (3, -1)), Similarity.of(0.1, -2.9, (0, 50))])
def test_a_similarity_leaves_the_signatures_alone(pose):
    """Places, directions and radii go with it."""
    branches = branches_of(profile_of("bracket"))
    before, after = frames(branches), frames(_turned(branches, pose))
    assert after.signature == pytest.approx(before.signature, abs=1e-9)
    assert after.radius == pytest.approx(before.radius * pose.scale)
    assert after.origin == pytest.approx(pose.apply(before.origin))
    assert after.direction == pytest.approx(before.direction @ pose.matrix.T / pose.scale)


def test_a_mirror_image_has_the_mirrored_signatures():
    """Those of the same branches, left and right exchanged."""
    branches = branches_of(profile_of("bracket"))
    flipped = frames(_turned(branches, Similarity.of(mirror=True)))
    assert isinstance(flipped, Frames)
    assert flipped.signature == pytest.approx(frames(branches).mirrored, abs=1e-9)
    assert _sorted(flipped.signature) != pytest.approx(_sorted(frames(branches).signature), abs=1e-3)


def test_a_small_notch_far_away_changes_nothing_here():
    """The frames at the left end of a bar are the same whatever its right end is."""
    plain = _frames_of([(0, 0), (12, 0), (12, 2), (0, 2)])
    cut = _frames_of([(0, 0), (12, 0), (12, 1.2), (11.5, 2), (0, 2)])
    left, same = (each.signature[each.origin[:, 0] < 2] for each in (plain, cut))
    assert len(left) == 3
    assert _sorted(left) == pytest.approx(_sorted(same), abs=1e-6)


def _frames_of(corners: list[tuple[float, float]]) -> Frames:
    return frames(branches_of(Profile.of(polygon(corners))))
