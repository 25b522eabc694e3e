"""Distances worked out by hand."""

import numpy as np
import pytest

from mashape_cad.evaluation.modes import MODES, stacked
from mashape_cad.options import SearchOptions

# Three shapes on a line in DF (at 0, 1, 3), all alike in RF but the last, and two of a kind in CF.
VECTORS = [
    {"df": (0.0, 0.0), "rf": (0.0,), "cf": (5.0, 0.0)},
    {"df": (0.6, 0.8), "rf": (0.0,), "cf": (5.0, 0.0)},
    {"df": (1.8, 2.4), "rf": (7.0,), "cf": (0.0, 12.0)},
]
DF = np.array([[0, 1, 3], [1, 0, 2], [3, 2, 0]]) / 2.0  # the median of 1, 2, 3 is 2
RF = np.array([[0, 0, 7], [0, 0, 7], [7, 7, 0]]) / 7.0
CF = np.array([[0, 0, 1], [0, 0, 1], [1, 1, 0]])
EXPECTED = {
    "paper-df": DF,
    "paper-rf": RF,
    "paper-cf": CF,
    "paper-df-rf": DF + RF,
    "paper-df-cf": DF + CF,
    "paper-rf-cf": RF + CF,
    "paper-all": DF + RF + CF,
}


def test_the_papers_functions_and_all_their_combinations_are_there():
    """Each once."""
    names = [mode.name for mode in MODES]
    assert len(names) == len(set(names))
    assert set(EXPECTED) <= set(names)


@pytest.mark.parametrize("name", EXPECTED)
def test_distances_are_euclidean_and_added_up_over_their_medians(name):
    """Readings 15 and 16."""
    [mode] = [mode for mode in MODES if mode.name == name]
    vectors = {each: rows for each, rows in stacked(VECTORS).items() if each in mode.vectors}
    np.testing.assert_allclose(mode.distances(vectors), EXPECTED[name], atol=1e-12)


@pytest.mark.parametrize(("name", "asked"), [("paper-all", "paper"), ("default", "similar")])
def test_distances_are_those_of_a_search(folder, name, asked):
    """Evaluated is what `search` does."""
    from mashape_cad import Library
    from mashape_cad.evaluation.labelled import labelled_set

    shapes = labelled_set(folder).shapes
    [mode] = [mode for mode in MODES if mode.name == name]
    vectors = stacked([shape.record.compared for shape in shapes])
    distances = mode.distances({each: vectors[each] for each in mode.vectors})
    matches = Library(folder).search(shapes[2].path, options=SearchOptions(asked))
    found = {match.path: match.distance for match in matches}
    assert distances[2] == pytest.approx([found[shape.path] for shape in shapes])
