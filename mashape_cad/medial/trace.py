"""A medial axis as samples along its branches, ready to be written or drawn: `Trace`."""

from dataclasses import dataclass

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.branch import sampled_branches
from mashape_cad.medial.branch_spline import BranchSpline, branch_spline
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.pruning import PrunedAxis, simplify
from mashape_cad.medial.tour import Ints

__all__ = ["Trace", "TracedBranch", "trace"]


@dataclass(frozen=True, slots=True, eq=False)
class TracedBranch:
    """Samples along a branch, its two nodes included.

    Attributes
    ----------
    start, end : int
        Nodes, as the trace counts them.
    centre : (n, 2) array
        mm.
    radius : (n,) array
        Clearance, mm.
    spline : BranchSpline or None
        The branch as one curve, where one was asked for.
    """

    start: int
    end: int
    centre: Floats
    radius: Floats
    spline: BranchSpline | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """Nodes and sampled branches of a medial axis.

    Attributes
    ----------
    centre : (v, 2) array
        Of the nodes, mm.
    radius : (v,) array
    degree : (v,) array
    kind : tuple of str
        As `mashape_cad.medial.graph.Nodes` names them.
    branches : tuple of TracedBranch
    """

    centre: Floats
    radius: Floats
    degree: Ints
    kind: tuple[str, ...]
    branches: tuple[TracedBranch, ...]


def trace(axis: MedialAxis | PrunedAxis, step: float, accuracy: float | None = None) -> Trace:
    """Sample all branches of an axis, or of what is left of one; its nodes are numbered anew.

    Parameters
    ----------
    axis : MedialAxis or PrunedAxis
    step : float
        Largest distance between neighbouring samples, mm.
    accuracy : float, optional
        mm. Fit a spline to each branch that is no further off; see `branch_spline`.
    """
    pruned = simplify(axis) if isinstance(axis, MedialAxis) else axis
    exact, number = pruned.axis, pruned.nodes
    place = {int(node): k for k, node in enumerate(number)}
    samples = sampled_branches(exact, step, pruned.branches)
    branches = tuple(
        TracedBranch(
            place[branch.start],
            place[branch.end],
            run.centre,
            run.radius,
            None if accuracy is None else branch_spline(exact, branch, accuracy),
        )
        for branch, run in zip(pruned.branches, samples, strict=True)
    )
    return Trace(exact.nodes.centre[number], exact.nodes.radius[number], pruned.degree, pruned.kind, branches)
