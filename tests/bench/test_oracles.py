"""Peers as oracles: where another program is right, our junctions are its junctions."""

from contextlib import closing

import numpy as np
import pytest
from catalogue import axis_of, profile_of

from mashape_cad.workers import outcomes

# Bounded by lines and arcs. Left out: the kernel crashes on a disc and fails on a concentric ring.
_STRAIGHT_AND_ROUND = (
    "rectangle",
    "square",
    "ell",
    "5-gon",
    "12-gon",
    "rounded rectangle",
    "plate with a slot",
    "plate with a round hole",
    "frame",
    "plate with holes",
    "hole grid",
    "bracket",
    "cross",
    "keyhole",
    "dumbbell",
    "wedged room",
)
_STRAIGHT = ("rectangle", "square", "ell", "5-gon", "12-gon", "frame", "cross", "dumbbell", "wedged room")
_SPLINE = "blob"
# By the size; of Boost's integers, one is 5e-10 of it.
_KERNEL_ACCURACY, _BOOST_ACCURACY = 1e-12, 1e-9


@pytest.fixture(scope="module")
def located():
    """What the kernel's bisecting locus found of each profile, in a process of its own: it may crash."""
    from collection import PRELOAD
    from peers.occt import medial_axis

    names = {id(profile_of(name)): name for name in (*_STRAIGHT_AND_ROUND, _SPLINE)}
    profiles = [profile_of(name) for name in names.values()]
    work = outcomes(profiles, medial_axis, jobs=1, timeout=60, prepare=_nothing, preload=PRELOAD)
    with closing(work):
        return {names[id(profile)]: outcome for profile, outcome in work}


def _nothing():
    """Prepare nothing."""


@pytest.mark.slow
@pytest.mark.parametrize("name", _STRAIGHT_AND_ROUND)
def test_kernel_has_our_junctions(located, name):
    """Between lines and arcs the kernel's own locus has a node at each of our junctions."""
    assert _farthest(name, located[name].points) <= _KERNEL_ACCURACY


@pytest.mark.slow
def test_kernel_is_wrong_on_splines(located):
    """Inside a closed spline it has nodes and no complaint, and the one junction is far from all: no oracle there."""
    assert len(located[_SPLINE].points)
    assert _farthest(_SPLINE, located[_SPLINE].points) > 0.01


@pytest.mark.parametrize("name", _STRAIGHT)
def test_boost_has_our_junctions(name):
    """Of polygons Boost finds the same junctions; one of many branches may come apart, but counts for as many."""
    pytest.importorskip("pyvoronoi", reason="of the extra `bench`")
    from peers.boost import medial_axis
    from polygons import polygonised

    found, degree = medial_axis(polygonised(profile_of(name), 1.0)), axis_of(name).nodes.degree
    assert _farthest(name, found.junctions) <= _BOOST_ACCURACY
    assert (found.degree[found.degree > 2] - 2).sum() == (degree[degree > 2] - 2).sum()


def _farthest(name, points):
    """Largest distance of our junctions from the nearest of `points`, by the size."""
    nodes = axis_of(name).nodes
    junctions = nodes.centre[nodes.degree > 2]
    apart = np.linalg.norm(junctions[:, None] - points[None, :, :2], axis=2).min(axis=1)
    return apart.max() / np.ptp(profile_of(name).bounds, axis=0).max()
