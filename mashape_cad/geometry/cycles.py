"""Cycles in a graph of edges and nodes: what closes beyond doubt, what hangs loose, what branches.

Terminology
-----------
block
    Edges of which any two lie on a common cycle (a biconnected component). A block whose nodes all have two ends is
    a cycle; any other one is a *tangle*: several cycles share edges, and the graph alone cannot tell which are meant.
dangling
    An edge through which no cycle runs (a bridge): it leads to a loose end, or from one cycle to another.

References
----------
J. Hopcroft, R. Tarjan, Algorithm 447: efficient algorithms for graph manipulation, CACM 16 (1973).
"""

from collections import defaultdict
from dataclasses import dataclass

from mashape_cad.geometry.joining import Nodes

__all__ = ["Cycles", "find_cycles"]

Step = tuple[int, bool]  # edge, and whether it is run through backwards


@dataclass(frozen=True, slots=True)
class Cycles:
    """What a graph consists of, as numbers of its edges.

    Attributes
    ----------
    cycles : tuple of tuple of (int, bool)
        Edges in order, each with whether it is run through backwards.
    dangling : tuple of tuple of int
        Edges through which no cycle runs, in groups that hang together.
    tangles : tuple of tuple of int
        Blocks that hold more than one cycle.
    """

    cycles: tuple[tuple[Step, ...], ...]
    dangling: tuple[tuple[int, ...], ...]
    tangles: tuple[tuple[int, ...], ...]


def find_cycles(nodes: Nodes, edges: list[int] | None = None) -> Cycles:
    """Take a graph apart.

    Parameters
    ----------
    nodes : (n, 2) array of int
        Nodes at the start and end of each edge; the same node twice for an edge that is closed in itself.
    edges : list of int, optional
        The edges to look at; all of them if not given.
    """
    ends = {
        edge: (int(nodes[edge, 0]), int(nodes[edge, 1])) for edge in (range(len(nodes)) if edges is None else edges)
    }
    closed = [edge for edge, (start, end) in ends.items() if start == end]
    open_ends = {edge: pair for edge, pair in ends.items() if pair[0] != pair[1]}
    blocks = _blocks(open_ends)
    cycles: list[tuple[Step, ...]] = [((edge, False),) for edge in closed]
    dangling, tangles = [], []
    for block in blocks:
        if len(block) == 1:
            dangling += block
        elif _is_cycle(block, open_ends):
            cycles.append(_walk(block, open_ends))
        else:
            tangles.append(tuple(sorted(block)))
    return Cycles(tuple(sorted(cycles)), tuple(_groups(dangling, open_ends)), tuple(sorted(tangles)))


def _around(edges: list[int], ends: dict[int, tuple[int, int]]) -> dict[int, list[int]]:
    """Return the edges at each node."""
    around = defaultdict(list)
    for edge in edges:
        for node in ends[edge]:
            around[node].append(edge)
    return around


def _blocks(ends: dict[int, tuple[int, int]]) -> list[list[int]]:
    """Split into biconnected components; a dangling edge is a block of its own."""
    around = _around(list(ends), ends)
    depth: dict[int, int] = {}
    blocks: list[list[int]] = []
    for root in around:
        if root not in depth:
            _search(root, ends, around, depth, blocks)
    return blocks


def _search(
    root: int,
    ends: dict[int, tuple[int, int]],
    around: dict[int, list[int]],
    depth: dict[int, int],
    blocks: list[list[int]],
) -> None:
    """Depth-first search from `root`, without recursion: drawings have chains of many thousand edges."""
    depth[root] = 0
    low = {root: 0}
    taken: set[int] = set()
    pile: list[int] = []  # edges met and not yet in a block
    path = [(root, -1, 0, iter(around[root]))]  # node, edge that led here, size of the pile before it, edges to try
    while path:
        node, _, _, untried = path[-1]
        for edge in untried:
            if edge in taken:
                continue
            taken.add(edge)
            pile.append(edge)
            other = ends[edge][0] if ends[edge][1] == node else ends[edge][1]
            if other in depth:
                low[node] = min(low[node], depth[other])
                continue
            depth[other] = low[other] = depth[node] + 1
            path.append((other, edge, len(pile) - 1, iter(around[other])))
            break
        else:
            _, _, size, _ = path.pop()
            if not path:
                return
            parent = path[-1][0]
            low[parent] = min(low[parent], low[node])
            if low[node] >= depth[parent]:
                blocks.append(pile[size:])
                del pile[size:]


def _is_cycle(block: list[int], ends: dict[int, tuple[int, int]]) -> bool:
    return all(len(edges) == 2 for edges in _around(block, ends).values())


def _walk(block: list[int], ends: dict[int, tuple[int, int]]) -> tuple[Step, ...]:
    """Order the edges of a cycle from its first edge on, which keeps its direction."""
    around = _around(block, ends)
    edge = min(block)
    start, node = ends[edge]
    steps = [(edge, False)]
    while node != start:
        first, second = around[node]
        edge = second if first == edge else first
        backwards = ends[edge][1] == node
        node = ends[edge][0] if backwards else ends[edge][1]
        steps.append((edge, backwards))
    return tuple(steps)


def _groups(edges: list[int], ends: dict[int, tuple[int, int]]) -> list[tuple[int, ...]]:
    """Gather edges that hang together."""
    around = _around(edges, ends)
    left = set(edges)
    groups = []
    for seed in sorted(edges):
        if seed not in left:
            continue
        left.remove(seed)
        group, front = [seed], [seed]
        while front:
            for node in ends[front.pop()]:
                found = [edge for edge in around[node] if edge in left]
                left.difference_update(found)
                group += found
                front += found
        groups.append(tuple(sorted(group)))
    return groups
