"""Profiles as polylines, as portions are looked for in them."""

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.branch import sampled_branches

__all__ = ["branches_of", "loops_of"]


def loops_of(profile: Profile) -> list[Floats]:
    """Return the loops, each (n, 2)."""
    return [loop.flattened(24) for loop in profile.loops]


def branches_of(profile: Profile) -> list[Floats]:
    """Return the branches, each (n, 3): x, y and radius; those that meet share their end points exactly."""
    axis = medial_axis(profile)
    nodes = np.column_stack([axis.nodes.centre, axis.nodes.radius])
    runs = []
    for branch, run in zip(axis.branches, sampled_branches(axis, 0.004 * profile.diagonal), strict=True):
        runs.append(np.column_stack([run.centre, run.radius]))
        runs[-1][[0, -1]] = nodes[[branch.start, branch.end]]
    return runs
