"""A medial axis as samples along its branches, ready to be written or drawn: `Trace`."""

from dataclasses import dataclass

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.branch import sampled_branches
from mashape_cad.medial.graph import MedialAxis
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
    """

    start: int
    end: int
    centre: Floats
    radius: Floats


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


def trace(axis: MedialAxis, step: float) -> Trace:
    """Sample all branches of an axis.

    Parameters
    ----------
    axis : MedialAxis
    step : float
        Largest distance between neighbouring samples, mm.
    """
    nodes = axis.nodes
    branches = tuple(
        TracedBranch(branch.start, branch.end, run.centre, run.radius)
        for branch, run in zip(axis.branches, sampled_branches(axis, step), strict=True)
    )
    return Trace(nodes.centre, nodes.radius, nodes.degree, nodes.kind, branches)
