import numpy as np
import pytest

from mashape_cad.views.colours import PAPER, runs_by_colour


def length(run):
    """Sum of the chords, mm."""
    return float(np.hypot(*np.diff(run, axis=0).T).sum())


def test_a_branch_is_cut_where_its_radius_passes_a_step():
    """From radius 0 to 4 along 8 mm, in four steps: four pieces of 2 mm, in order."""
    branch = np.array([(0.0, 0.0, 0.0), (8.0, 0.0, 4.0)])
    pieces = runs_by_colour((branch,), largest=4.0, count=4)
    assert [len(runs) for runs in pieces] == [1, 1, 1, 1]
    assert [run[:, 0].tolist() for (run,) in pieces] == [[0, 2], [2, 4], [4, 6], [6, 8]]


def test_nothing_of_a_branch_is_lost():
    """Up and down and level: the pieces are as long as the branch."""
    radii = [1.0, 3.0, 3.0, 0.2, 2.0, 4.0]
    branch = np.column_stack([np.arange(6.0), np.zeros(6), radii])
    runs = [run for runs in runs_by_colour((branch,), largest=4.0, count=7) for run in runs]
    assert sum(map(length, runs)) == pytest.approx(5.0)


def test_the_largest_radius_has_the_last_colour():
    """A branch that keeps its radius is one piece, of the last colour if none is larger."""
    branch = np.array([(0.0, 0.0, 2.0), (1.0, 0.0, 2.0), (2.0, 1.0, 2.0)])
    *lower, last = runs_by_colour((branch,), largest=2.0, count=5)
    assert [len(runs) for runs in lower] == [0, 0, 0, 0]
    assert last[0].tolist() == branch[:, :2].tolist()


def test_larger_radii_are_lighter():
    """So that the order survives grey print."""
    luminance = [np.dot([int(c[i : i + 2], 16) for i in (1, 3, 5)], [0.2126, 0.7152, 0.0722]) for c in PAPER.axis]
    assert luminance == sorted(luminance)
