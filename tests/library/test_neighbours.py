"""Ranking again by the neighbours of neighbours."""

import numpy as np
import pytest

from mashape_cad.library.neighbours import neighbour_graph, relevance, reranked


def _apart(rows):
    return np.linalg.norm(rows[:, None] - rows[None], axis=2)


def _reranked(query, rows):
    """Return the rows' numbers in the order in which a query that is none of them finds them."""
    plain = np.argsort(np.linalg.norm(rows - query, axis=1), kind="stable")
    return plain[reranked(_apart(np.vstack([query, rows[plain]])), 0)[1:] - 1]


@pytest.fixture
def chains():
    """Two bent chains of 30: their ends come nearer to one another than to their own other ends."""
    t = np.linspace(0, np.pi, 30)
    upper = np.column_stack([np.cos(t), np.sin(t)])
    lower = np.column_stack([1 - np.cos(t), 0.35 - np.sin(t)])
    return np.vstack([upper, lower])


def test_a_chain_is_followed(chains):
    """From one end of a chain twice as much of it ranks before the other chain, though it is farther."""
    others = np.delete(chains, 0, axis=0)
    plain = np.argsort(np.linalg.norm(others - chains[0], axis=1))
    found = _reranked(chains[0], others)
    assert (found[:29] < 29).sum() >= 2 * (plain[:29] < 29).sum()


def test_the_two_nearest_stay_in_front(chains):
    """As by plain distance."""
    for number in range(0, len(chains), 17):
        query = chains[number]
        others = np.delete(chains, number, axis=0)
        plain = np.argsort(np.linalg.norm(others - query, axis=1), kind="stable")
        assert _reranked(query, others)[:2].tolist() == plain[:2].tolist()


@pytest.mark.parametrize("count", [1, 2, 3, 7, 60])
def test_every_entry_has_its_place_once(count):
    """Whatever the size of the library; copies too."""
    rng = np.random.default_rng(3)
    for rows in (rng.normal(size=(count, 4)), np.zeros((count, 3))):
        assert sorted(_reranked(rows[0], rows).tolist()) == list(range(count))


def test_what_flows_is_symmetric_and_stays_within_components():
    """Two far groups share nothing."""
    rng = np.random.default_rng(5)
    rows = np.vstack([rng.normal(size=(12, 2)), rng.normal(size=(12, 2)) + 100])
    apart = _apart(rows)
    graph = neighbour_graph(apart)
    assert abs(graph - graph.T).max() == pytest.approx(0.0, abs=1e-15)
    flow = relevance(graph, apart[3], 3)
    assert (flow[:12] > 0).all()
    assert not flow[12:].any()
