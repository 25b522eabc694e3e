"""What pictures show of one profile: its outline, and its medial axis with radii, as polylines in mm.

It comes from a sidecar's light picture, or finer from the exact values; both are drawn by the same code.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mashape_cad.library.polylines import branches_of, loops_of
from mashape_cad.library.record import ProfileRecord
from mashape_cad.views.drawing import Floats

if TYPE_CHECKING:
    from mashape_cad.geometry.profile import Profile
    from mashape_cad.library.tracing import TracedProfile
    from mashape_cad.medial.axis import MedialAxis

__all__ = ["Likeness"]

# Spacing of points on branches, as a fraction of the larger side: a third of a pixel's error on a large picture.
_STEP = 0.004
_PER_SPAN = 24


@dataclass(frozen=True, slots=True, eq=False)
class Likeness:
    """Polylines of a profile and its axis.

    Attributes
    ----------
    loops : tuple of (n, 2) arrays
        Outer loop first, then the holes; the first point is not repeated.
    branches : tuple of (n, 3) arrays
        x, y, radius from node to node; a disc's axis is one point. Empty without an axis.
    """

    loops: tuple[Floats, ...]
    branches: tuple[Floats, ...] = ()

    @classmethod
    def of_record(cls, record: ProfileRecord) -> "Likeness":
        """Unpack the light picture of a sidecar."""
        return cls(loops_of(record.thumbnail), branches_of(record.thumbnail))

    @classmethod
    def of_axis(cls, profile: "Profile", axis: "MedialAxis") -> "Likeness":
        """Sample the exact values as finely as a large picture shows."""
        # Pictures that come from sidecars must not load the medial axis and its compiler.
        from mashape_cad.medial.branch import sampled_branches  # noqa: PLC0415

        loops = tuple(loop.flattened(_PER_SPAN) for loop in profile.loops)
        if not axis.branches:
            return cls(loops, (np.column_stack([axis.nodes.centre, axis.nodes.radius]),))
        samples = sampled_branches(axis, _STEP * profile.diagonal)
        return cls(loops, tuple(np.column_stack([each.centre, each.radius]) for each in samples))

    @classmethod
    def of_traces(cls, traced: Sequence["TracedProfile"]) -> "Likeness":
        """Take the samples of traced profiles, all in one picture."""
        loops = (loop.flattened(_PER_SPAN) for each in traced for loop in each.profile.loops)
        branches: list[Floats] = []
        for trace in (each.trace for each in traced):
            branches += [np.column_stack([branch.centre, branch.radius]) for branch in trace.branches]
            if not trace.branches:
                branches.append(np.column_stack([trace.centre, trace.radius]))
        return cls(tuple(loops), tuple(branches))

    def placed(self, placement: tuple[float, float, float, float, float, float]) -> "Likeness":
        """Return the outline laid elsewhere, as `Relation.placement` says, without its axis."""
        a, b, c, d, x, y = placement
        return Likeness(tuple(loop @ np.array([[a, c], [b, d]]) + (x, y) for loop in self.loops))

    @property
    def bounds(self) -> Floats:
        """Box of the outline, mm: ((xmin, ymin), (xmax, ymax)); of no size if there is no outline."""
        points = np.concatenate([*self.loops, np.zeros((0, 2))])
        if not len(points):
            return np.zeros((2, 2))
        return np.array([points.min(axis=0), points.max(axis=0)])

    @property
    def largest_radius(self) -> float:
        """Radius of the largest disc, mm; 0 without an axis."""
        return max((float(branch[:, 2].max()) for branch in self.branches), default=0.0)
