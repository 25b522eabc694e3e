import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mashape_cad.geometry.cycles import find_cycles


def test_a_ring_is_one_cycle_whatever_the_direction_of_its_edges():
    """Steps follow one another, and say which edges are run through backwards."""
    found = find_cycles(np.array([[0, 1], [2, 1], [2, 3], [0, 3]]))
    assert found.cycles == (((0, False), (1, True), (2, False), (3, True)),)
    assert found.dangling == found.tangles == ()


def test_two_parallel_edges_are_a_cycle_and_an_edge_closed_in_itself_is_one():
    """A lens of two arcs; a circle."""
    assert find_cycles(np.array([[0, 1], [0, 1]])).cycles == (((0, False), (1, True)),)
    assert find_cycles(np.array([[5, 5]])).cycles == (((0, False),),)


def test_what_hangs_on_a_ring_does_not_cost_the_ring():
    """A triangle with a tail of two edges, and a loose edge elsewhere: two groups are left over."""
    found = find_cycles(np.array([[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [8, 9]]))
    assert [{edge for edge, _ in cycle} for cycle in found.cycles] == [{0, 1, 2}]
    assert found.dangling == ((3, 4), (5,))


def test_a_line_from_one_ring_to_another_belongs_to_neither():
    """Two triangles and a bridge."""
    found = find_cycles(np.array([[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 5], [5, 3]]))
    assert sorted({edge for edge, _ in cycle} == {0, 1, 2} for cycle in found.cycles) == [False, True]
    assert found.dangling == ((3,),)


def test_two_rings_that_share_a_point_are_two_cycles():
    """A figure of eight in the graph is no tangle."""
    found = find_cycles(np.array([[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0]]))
    assert len(found.cycles) == 2
    assert found.tangles == ()


def test_a_ring_with_a_chord_is_a_tangle():
    """Three ways from one point to another: which two bound the part, the graph cannot say."""
    found = find_cycles(np.array([[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]))
    assert found.cycles == ()
    assert found.tangles == ((0, 1, 2, 3, 4),)


def test_only_the_edges_asked_for_are_looked_at():
    """Without its chord the ring is a cycle again."""
    nodes = np.array([[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]])
    assert find_cycles(nodes, [0, 1, 3, 4]).cycles == (((0, False), (1, False), (3, False), (4, False)),)


def test_a_ring_of_a_hundred_thousand_edges_needs_no_recursion():
    """Deep search, flat stack."""
    nodes = np.arange(100_000)
    (cycle,) = find_cycles(np.column_stack([nodes, np.roll(nodes, -1)])).cycles
    assert len(cycle) == 100_000


@settings(max_examples=200, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), min_size=1, max_size=14))
def test_every_edge_is_in_exactly_one_place_and_cycles_close(pairs):
    """For any graph: a partition of its edges; each cycle ends where it starts; a tangle has a branch."""
    nodes = np.array(pairs)
    found = find_cycles(nodes)
    in_cycles = [edge for cycle in found.cycles for edge, _ in cycle]
    others = [edge for group in (*found.dangling, *found.tangles) for edge in group]
    assert sorted(in_cycles + others) == list(range(len(pairs)))
    for cycle in found.cycles:
        path = [(int(nodes[edge, int(back)]), int(nodes[edge, 1 - int(back)])) for edge, back in cycle]
        assert all(end == start for (_, end), (start, _) in zip(path, [*path[1:], path[0]], strict=True))
        assert len({start for start, _ in path}) == len(path)
    for tangle in found.tangles:
        assert np.bincount(nodes[list(tangle)].ravel()).max() > 2


@pytest.mark.parametrize("seed", range(5))
def test_numbering_and_direction_do_not_change_what_is_found(seed):
    """Shuffle and turn edges: the same sets come out."""
    rng = np.random.default_rng(seed)
    nodes = np.array([[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 5], [5, 3], [5, 6], [7, 8], [8, 9], [9, 7], [9, 8]])
    order = rng.permutation(len(nodes))
    turned = nodes[order].copy()
    flip = rng.random(len(nodes)) < 0.5
    turned[flip] = turned[flip, ::-1]
    plain, shuffled = find_cycles(nodes), find_cycles(turned)
    assert {frozenset(edge for edge, _ in cycle) for cycle in plain.cycles} == {
        frozenset(int(order[edge]) for edge, _ in cycle) for cycle in shuffled.cycles
    }
    assert {frozenset(tangle) for tangle in plain.tangles} == {
        frozenset(int(order[edge]) for edge in tangle) for tangle in shuffled.tangles
    }
