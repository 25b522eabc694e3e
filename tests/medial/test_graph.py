"""Counting parts and cycles of a graph."""

from dataclasses import replace

import numpy as np
import pytest
from catalogue import axis_of

from mashape_cad.medial.graph import Branch, Nodes


def _graph(count, pairs):
    """An axis in name only: a graph of nodes and branches."""
    zeros = np.zeros(count, dtype=np.int64)
    nodes = Nodes(np.zeros((count, 2)), np.zeros(count), zeros, ("end",) * count, zeros)
    return replace(axis_of("rectangle"), nodes=nodes, branches=tuple(Branch(a, b, ()) for a, b in pairs))


@pytest.mark.parametrize(
    ("count", "pairs", "components", "cycles"),
    [
        (1, [], 1, 0),
        (2, [], 2, 0),
        (2, [(0, 1)], 1, 0),
        (1, [(0, 0)], 1, 1),
        (2, [(0, 1), (0, 1)], 1, 1),
        (3, [(0, 1), (1, 2), (2, 0)], 1, 1),
        (4, [(0, 1), (2, 3)], 2, 0),
        (6, [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3)], 2, 2),
        (4, [(0, 1), (0, 2), (0, 3), (1, 2), (2, 3), (3, 1)], 1, 3),
    ],
)
def test_parts_and_cycles(count, pairs, components, cycles):
    """Branches that begin and end at one node, and two that join the same nodes, make cycles."""
    graph = _graph(count, pairs)
    assert (graph.components, graph.cycles) == (components, cycles)
