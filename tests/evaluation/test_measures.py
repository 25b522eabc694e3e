"""Against tables made by hand, and against definitions written out in plain loops."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mashape_cad.evaluation.measures import Protocol, means, measures, ranking

# Six shapes on a line: their distances are easily ranked by hand.
PLACES = np.array([0.0, 1.0, 5.0, 2.1, 3.3, 9.5])
LABELS = ("a", "a", "a", "b", "b", "b")
DISTANCES = np.abs(PLACES[:, None] - PLACES[None, :])


def test_a_ranking_made_by_hand():
    """The query first, then the others by distance."""
    assert ranking(DISTANCES, LABELS).tolist() == [
        [0, 1, 3, 4, 2, 5],
        [1, 0, 3, 4, 2, 5],
        [2, 4, 3, 1, 5, 0],
        [3, 1, 4, 0, 2, 5],
        [4, 3, 2, 1, 0, 5],
        [5, 2, 4, 3, 1, 0],
    ]


def test_tiers_in_the_papers_protocol():
    """Classes of three: how many of them are among the first 3 and 6, the query counted."""
    found = measures(DISTANCES, LABELS, Protocol.PAPER)
    assert found.first_tier * 3 == pytest.approx([2, 2, 1, 2, 2, 2])
    assert found.second_tier == pytest.approx(np.ones(6))
    assert found.bulls_eye == pytest.approx(np.ones(6))


def test_tiers_in_the_princeton_protocol():
    """Two mates among the first 2 and 4 others."""
    found = measures(DISTANCES, LABELS, Protocol.PRINCETON)
    assert found.first_tier * 2 == pytest.approx([1, 1, 0, 1, 1, 1])
    assert found.second_tier * 2 == pytest.approx([2, 2, 1, 1, 1, 2])
    assert found.nearest_neighbour.tolist() == [1, 1, 0, 0, 1, 0]
    assert found.bulls_eye == pytest.approx(np.ones(6))


def test_average_precision_made_by_hand():
    """Mates of the first query lie at ranks 1 and 4 of the others, of the third at 3 and 5."""
    left_out = measures(DISTANCES, LABELS, Protocol.PRINCETON).average_precision
    assert left_out[[0, 2]] == pytest.approx([(1 + 2 / 4) / 2, (1 / 3 + 2 / 5) / 2])
    counted = measures(DISTANCES, LABELS, Protocol.PAPER).average_precision
    assert counted[[0, 2]] == pytest.approx([(1 + 1 + 3 / 5) / 3, (1 + 2 / 4 + 3 / 6) / 3])


def test_a_constant_distance_is_worst():
    """Ties never flatter: all others come before the mates."""
    labels = ("a",) * 3 + ("b",) * 9
    assert ranking(np.zeros((12, 12)), labels)[1].tolist() == [1, *range(3, 12), 0, 2]
    found = measures(np.zeros((12, 12)), labels, Protocol.PRINCETON)
    assert found.nearest_neighbour.sum() == 0
    assert found.second_tier[:3].tolist() == [0, 0, 0]


def test_the_query_is_its_own_first_hit_even_if_a_stranger_is_nearer():
    """As a distance after re-ranking may say; and if a copy of it is in another class."""
    distances = np.array([[5.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    assert ranking(distances, ("a", "b", "a"))[:, 0].tolist() == [0, 1, 2]
    assert ranking(distances, ("a", "b", "a"))[0].tolist() == [0, 1, 2]


def test_a_query_without_mates_says_nothing_but_stands_in_the_way():
    """It is left out of the means, and takes a rank from the others."""
    distances = np.array([[0.0, 2.0, 1.0], [2.0, 0.0, 1.0], [1.0, 1.0, 0.0]])
    found = measures(distances, ("a", "a", "alone"), Protocol.PRINCETON)
    assert np.isnan(found.first_tier).tolist() == [False, False, True]
    assert means(found)["first_tier"] == 0
    assert means(found)["second_tier"] == 1
    assert np.isnan(means(found, np.array([False, False, True]))["first_tier"])


def test_means_over_chosen_queries():
    """Those of one class."""
    found = measures(DISTANCES, LABELS)
    assert means(found)["first_tier"] == pytest.approx(11 / 18)
    assert means(found, np.array(LABELS) == "a")["first_tier"] == pytest.approx(5 / 9)


@pytest.mark.parametrize("distances", [np.zeros((2, 3)), np.zeros((3, 3)), np.full((2, 2), np.nan)])
def test_what_does_not_fit_is_refused(distances):
    """Rather than ranked somehow."""
    with pytest.raises(ValueError, match=r"labels need|not a number"):
        measures(distances, ("a", "b"))


def written_out(distances, labels, query, protocol):
    """The definitions, word by word, for one query."""
    others = [i for i in range(len(labels)) if i != query]
    others.sort(key=lambda i: (distances[query][i], labels[i] == labels[query], i))
    ranks = others if protocol is Protocol.PRINCETON else [query, *others]
    members = labels.count(labels[query])
    sought = members - (protocol is Protocol.PRINCETON)
    hits = [labels[i] == labels[query] for i in ranks]
    precisions = [sum(hits[: i + 1]) / (i + 1) for i, is_hit in enumerate(hits) if is_hit]
    eye = [labels[i] == labels[query] for i in [query, *others][: 2 * members]]
    return [
        float(labels[others[0]] == labels[query]),
        sum(hits[:sought]) / sought,
        sum(hits[: 2 * sought]) / sought,
        sum(precisions) / sought,
        sum(eye) / members,
    ]


@given(st.lists(st.sampled_from("abc"), min_size=2, max_size=9), st.randoms(use_true_random=False), st.booleans())
def test_all_measures_agree_with_their_definitions(labels, random, is_paper):
    """On random distances with many ties."""
    protocol = Protocol.PAPER if is_paper else Protocol.PRINCETON
    distances = np.array([[random.randrange(4) for _ in labels] for _ in labels], float)
    found = measures(distances, labels, protocol)
    values = np.array([getattr(found, name) for name in found.__slots__]).T
    for query, label in enumerate(labels):
        if labels.count(label) == 1:
            assert np.isnan(values[query]).all()
        else:
            assert values[query] == pytest.approx(written_out(distances, labels, query, protocol))


@given(st.lists(st.sampled_from("abcd"), min_size=2, max_size=12), st.integers(0, 2**32 - 1))
def test_the_order_of_shapes_does_not_matter_without_ties(labels, seed):
    """Each query has the same measures wherever it stands in the list."""
    random = np.random.default_rng(seed)
    distances, shuffled = random.random((len(labels), len(labels))), random.permutation(len(labels))
    found = measures(distances, labels)
    again = measures(distances[np.ix_(shuffled, shuffled)], [labels[i] for i in shuffled])
    for name in found.__slots__:
        np.testing.assert_array_equal(getattr(found, name)[shuffled], getattr(again, name))


@given(st.integers(2, 5), st.integers(2, 5))
def test_classes_that_lie_apart_are_found_whole(classes, members):
    """Every measure is 1."""
    labels = [str(i // members) for i in range(classes * members)]
    places = np.arange(len(labels)) + 1000.0 * (np.arange(len(labels)) // members)
    for protocol in Protocol:
        found = means(measures(np.abs(places[:, None] - places), labels, protocol))
        assert set(found.values()) == {1.0}
