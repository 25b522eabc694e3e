"""The medial axis as a value: a graph of branches and nodes over arrays of maximal discs.

Coordinates are those of the profile, mm. Footpoints are given by the number of their edge in ``profile.edges`` and its
parameter ``u``; places of the tour (``element + t``) serve the modules of this package.
"""

from dataclasses import dataclass

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.tour import Frame, Ints, Tour

__all__ = ["Branch", "Contacts", "Discs", "MedialAxis", "Nodes", "Pieces"]


@dataclass(frozen=True, slots=True, eq=False)
class Nodes:
    """Vertices of the graph.

    Attributes
    ----------
    centre : (v, 2) array
    radius : (v,) array
        Clearance, mm; 0 at a convex vertex.
    degree : (v,) array
        Number of branches that meet here.
    kind : tuple of str
        ``junction`` (degree 3 and more), ``end`` (1), ``seam`` (2: an arbitrary point of a branch that closes on
        itself) or ``disc`` (0: the whole domain is one disc).
    disc : (v,) array
        Number of the node's disc.
    """

    centre: Floats
    radius: Floats
    degree: Ints
    kind: tuple[str, ...]
    disc: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Discs:
    """All maximal discs that were settled: those of the nodes, and points inside branches.

    Attributes
    ----------
    centre : (m, 2) array
    radius : (m,) array
    degree : (m,) array
        Number of contacts.
    foot : (m, 2, 2) array
        Two footpoints; they coincide at ends.
    foot_edge, foot_u : (m, 2) arrays
        Edges and parameters of the footpoints.
    tolerance : (m,) array
        How far contacts were allowed to lie off the circle when the disc was settled, mm.
    clearance : (m,) array
        The kernel's distance from the centre to the whole boundary, mm.
    """

    centre: Floats
    radius: Floats
    degree: Ints
    foot: Floats
    foot_edge: Ints
    foot_u: Floats
    tolerance: Floats
    clearance: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """Contacts of all discs in the order of the tour.

    Attributes
    ----------
    first, last : (c, 2) arrays
        Places (element, t) where the contact starts and ends; they differ for an arc.
    disc : (c,) array
        The disc that touches here.
    piece, side : (c,) arrays
        The piece of a branch whose boundary starts behind this contact, and which of its sides that is.
    """

    first: Floats
    last: Floats
    disc: Ints
    piece: Ints
    side: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Stretches of branches between two settled discs, each bounded by two stretches of single elements.

    Attributes
    ----------
    element : (p, 2) array
        Elements of the two sides.
    low, high : (p, 2) arrays
        Their parameters. Along side 0 the piece runs from disc 0 to disc 1, along side 1 back.
    disc : (p, 2) array
        The discs at its ends.
    """

    element: Ints
    low: Floats
    high: Floats
    disc: Ints


@dataclass(frozen=True, slots=True)
class Branch:
    """A branch from node to node.

    Attributes
    ----------
    start, end : int
        Nodes.
    pieces : tuple of (int, bool)
        Pieces in order; whether each is run through from its disc 0 to its disc 1.
    """

    start: int
    end: int
    pieces: tuple[tuple[int, bool], ...]


@dataclass(frozen=True, slots=True, eq=False)
class MedialAxis:
    """The medial axis of a profile; made by `mashape_cad.medial.axis.medial_axis`."""

    profile: Profile
    nodes: Nodes
    branches: tuple[Branch, ...]
    discs: Discs
    contacts: Contacts
    pieces: Pieces
    tour: Tour
    frame: Frame

    @property
    def components(self) -> int:
        """Number of connected parts of the graph."""
        parent = list(range(len(self.nodes.radius)))
        for branch in self.branches:
            a, b = _root(parent, branch.start), _root(parent, branch.end)
            parent[a] = b
        return sum(parent[node] == node for node in range(len(parent)))

    @property
    def cycles(self) -> int:
        """Number of independent cycles: as many as the profile has holes."""
        return len(self.branches) - len(self.nodes.radius) + self.components


def _root(parent: list[int], node: int) -> int:
    while parent[node] != node:
        node = parent[node]
    return node
