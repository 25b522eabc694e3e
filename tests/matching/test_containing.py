"""Outlines that have a portion in common, and outlines that have not."""

import numpy as np
import pytest
from catalogue import box, circle, profile_of
from hooks import bare, with_hook
from lights import branches_of, loops_of

from mashape_cad.geometry.edge import Similarity
from mashape_cad.geometry.profile import Profile
from mashape_cad.matching.containing import Contour, common_portion
from mashape_cad.matching.frames import frames
from mashape_cad.matching.portion import Portion


def _common(query: Profile, hit: Profile) -> Portion | None:
    contours = [Contour.of(loops_of(each)) for each in (query, hit)]
    own, known = (frames(branches_of(each)) for each in (query, hit))
    return common_portion(contours[0], own, contours[1], known)


def test_stations_stand_for_the_whole_outline():
    """Of a square: a quarter of the weight at its corners and what is near, normals inwards, from holes outwards."""
    contour = Contour.of(
        [np.array([(0, 0), (2, 0), (2, 2), (0, 2)]), np.array([(0.9, 0.9), (0.9, 1.1), (1.1, 1.1), (1.1, 0.9)])]
    )
    assert contour.weight.sum() == pytest.approx(1.0)
    assert contour.size == pytest.approx(np.sqrt(8))
    inside = contour.point + 0.05 * contour.normal
    assert np.all((inside > 0) & (inside < 2))
    hole = contour.loop == 1
    assert np.all(np.abs(inside[hole] - 1).max(axis=1) > np.abs(contour.point[hole] - 1).max(axis=1))


@pytest.mark.parametrize(
    "pose", [Similarity.of(), Similarity.of(3.7, 2.2, (5, 80)), Similarity.of(0.4, -1.0, (1, 1), mirror=True)]
)
@pytest.mark.parametrize("name", ["bracket", "blob with holes", "gear with a bore"])
def test_an_outline_contains_itself(name, pose):
    """In any pose: as a whole, laid where it lies."""
    profile = profile_of(name)
    found = _common(profile, profile.transformed(pose))
    assert found is not None
    assert found.share > 0.999
    assert found.placement.scale == pytest.approx(pose.scale, rel=2e-3)
    assert found.placement.mirrors == pose.mirrors or name == "gear with a bore"


@pytest.mark.parametrize(("one", "other"), [("block", "flag"), ("flag", "comb"), ("comb", "block")])
def test_parts_with_the_same_hook(one, other):
    """It is found on another body, in its place and size, and nothing else is taken for common."""
    pose = Similarity.of(1.8, 0.9, (40, -3))
    found = _common(with_hook(one), with_hook(other).transformed(pose))
    assert found is not None
    assert found.placement.scale == pytest.approx(1.8, rel=5e-3)
    back = np.linalg.inv(pose.matrix)
    stretches = [(stretch - pose.offset) @ back.T for stretch in found.stretches]
    where = np.concatenate(stretches)
    assert where[:, 0].min() == pytest.approx(-9, abs=0.1)
    assert np.mean(where[:, 0] < 0.1) > 0.9
    tip = np.array([(-5.0, -4.0), (-5.0, -3.0), (-9.0, 2.0), (-7.2, 0.0)])
    assert np.linalg.norm(tip[:, None] - where, axis=2).min(axis=1).max() < 0.3


def test_the_hook_counts_for_what_it_is():
    """Half of the length and half of the turning of the block's outline are the hook's; little is shared without it."""
    query = with_hook("block")
    hooked = _common(query, with_hook("comb"))
    alone = _common(query, bare("comb"))
    assert hooked is not None
    assert hooked.share == pytest.approx(0.5, abs=0.06)  # a corner where it ends belongs to it by half
    assert alone is None or alone.share < 0.35


def test_what_has_no_branch_has_no_portion():
    """A disc, and a rectangle that has nothing of it."""
    disc, plate = Profile.of(circle(0, 0, 3)), Profile.of(box(0, 0, 6, 2))
    assert _common(disc, plate) is None
    assert _common(plate, disc) is None
