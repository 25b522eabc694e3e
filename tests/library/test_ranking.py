"""How far signatures are apart."""

import numpy as np
import pytest

from mashape_cad.library import ranking
from mashape_cad.library.ranking import Stack, rising


def _signature(*vectors):
    return dict(zip(("df", "rf"), vectors, strict=True))


def test_distance_is_the_sum_of_parts_each_over_its_median():
    """Three signatures: df apart by 1, 3 and 4, rf by 10, 30 and 40; the medians are 3 and 30."""
    stack = Stack.of([_signature([0.0, 0.0], [0.0]), _signature([1.0, 0.0], [10.0]), _signature([4.0, 0.0], [40.0])])
    assert stack.scales == {"df": 3.0, "rf": 30.0}
    expected = [0.0, 1 / 3 + 1 / 3, 4 / 3 + 4 / 3]
    np.testing.assert_allclose(stack.distances(_signature([0.0, 0.0], [0.0])), expected)


def test_no_function_outweighs_the_others():
    """Histograms that all differ a hundred times as much rank the same."""
    rows = np.random.default_rng(1).random((20, 8))
    plain = Stack.of([_signature(row, row[::-1]) for row in rows])
    blown = Stack.of([_signature(100 * row, row[::-1]) for row in rows])
    query, blown_query = _signature(rows[3], rows[3][::-1]), _signature(100 * rows[3], rows[3][::-1])
    np.testing.assert_allclose(plain.distances(query), blown.distances(blown_query))


def test_equal_signatures_are_exactly_at_zero():
    """No rounding comes between equal numbers."""
    rows = np.random.default_rng(2).random((50, 64))
    stack = Stack.of([_signature(row, row) for row in rows])
    assert stack.distances(_signature(rows[7], rows[7]))[7] == 0.0


def test_one_function_that_is_the_same_for_all():
    """Rectangles have one CF; it neither divides by zero nor counts."""
    stack = Stack.of([_signature([float(i)], [1.0]) for i in range(5)])
    assert stack.scales["rf"] == 1.0
    np.testing.assert_allclose(stack.distances(_signature([0.0], [1.0])), np.arange(5) / stack.scales["df"])


def test_one_function_that_is_the_same_for_most():
    """The median is that of the pairs that differ, when most do not."""
    stack = Stack.of([_signature([0.0], [0.0])] * 9 + [_signature([2.0], [6.0])])
    assert stack.scales == {"df": 2.0, "rf": 6.0}


def test_one_part_alone():
    """A library of one has no pairs."""
    assert Stack.of([_signature([1.0], [2.0])]).distances(_signature([1.0], [4.0])) == [2.0]


@pytest.mark.parametrize("count", [30, 31])
def test_large_libraries_are_sampled_alike_each_time(monkeypatch, count):
    """The scale of many is that of evenly spread few, the same in every run."""
    monkeypatch.setattr(ranking, "_MOST_FOR_MEDIAN", 10)
    rows = np.random.default_rng(3).random((count, 4))
    chosen = rows[np.linspace(0, count - 1, 10).astype(int)]
    many, few = ([_signature(row, row) for row in each] for each in (rows, chosen))
    assert Stack.of(many).scales == Stack.of(many).scales == Stack.of(few).scales


@pytest.mark.parametrize("count", [0, 1, 2, 1000])
@pytest.mark.parametrize("different", [1, 7, 10**9])
def test_equal_values_keep_their_order(count, different):
    """As a stable sort leaves them."""
    values = np.random.default_rng(count).integers(0, different, count) / 3
    for each in (values, values.astype(np.float32)):
        assert rising(each).tolist() == np.argsort(each, kind="stable").tolist()


def test_weights_are_factors_of_the_functions():
    """What weighs nothing is not looked at."""
    stack = Stack.of([{"df": (0.0,), "rf": (0.0,)}, {"df": (1.0,), "rf": (5.0,)}])
    asked = {"df": (0.0,), "rf": (0.0,)}
    assert stack.distances(asked).tolist() == [0.0, 2.0]
    assert stack.distances(asked, {"df": 0.0, "rf": 3.0}).tolist() == [0.0, 3.0]
