"""Splines through branches, held against the kernel and against the branches themselves."""

from itertools import pairwise

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, profile_of
from scipy.interpolate import BSpline

from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.branch_curve import discs_on_branch
from mashape_cad.medial.branch_spline import BranchSpline, branch_spline
from mashape_cad.medial.graph import Branch, MedialAxis

_ALL = [*KNOWN, *NAMED]


def _points(spline: BranchSpline, per_span: int = 16) -> np.ndarray:
    knots = np.unique(spline.knots)
    u = np.unique(np.concatenate([np.linspace(a, b, per_span) for a, b in pairwise(knots)]))
    return BSpline(spline.knots, spline.poles, 3)(u)


def _off(axis: MedialAxis, branch: Branch, points: np.ndarray) -> float:
    """Largest distance of points (x, y, r) from the exact branch: from its discs, evaluated nearer and nearer."""
    s = np.linspace(0, len(branch.pieces), 60 * len(branch.pieces) + 1)
    worst = 0.0
    for point in points:
        low, high = 0.0, float(len(branch.pieces))
        grid = s
        for _ in range(6):
            discs = discs_on_branch(axis, branch, grid)
            away = np.linalg.norm(np.column_stack([discs.centre, discs.radius]) - point, axis=1)
            k = int(np.argmin(away))
            low, high = grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]
            grid = np.linspace(low, high, 21)
        worst = max(worst, float(away.min()))
    return worst


@pytest.mark.parametrize("accuracy", [1e-4, 1e-7])
@pytest.mark.parametrize("name", _ALL)
def test_splines_touch_the_boundary_all_along(name, accuracy):
    """All along, the distance from (x, y) to the boundary is r, but for what both may be off."""
    axis, diagonal = axis_of(name), profile_of(name).diagonal
    for branch in axis.branches:
        points = _points(branch_spline(axis, branch, accuracy * diagonal))
        measured = DistanceQuery(axis.profile).distances(points[:, :2])
        assert np.abs(measured - points[:, 2]).max() <= np.sqrt(2) * 1.05 * accuracy * diagonal


@pytest.mark.parametrize("name", ["ell", "ellipse", "blob", "wave", "eccentric ring"])
def test_splines_are_on_the_exact_branch(name):
    """Every point is within the accuracy of a disc that is evaluated there, centre and radius together."""
    axis, accuracy = axis_of(name), 1e-5 * profile_of(name).diagonal
    for branch in axis.branches:
        points = _points(branch_spline(axis, branch, accuracy), 3)
        assert _off(axis, branch, points) <= 1.05 * accuracy


@pytest.mark.parametrize("name", _ALL)
def test_splines_run_from_node_to_node(name):
    """Their end poles are the nodes, and they are clamped there."""
    axis = axis_of(name)
    for branch in axis.branches:
        spline = branch_spline(axis, branch, 1e-5 * axis.frame.size)
        nodes = [branch.start, branch.end]
        expected = np.column_stack([axis.nodes.centre[nodes], axis.nodes.radius[nodes]])
        assert np.array_equal(spline.poles[[0, -1]], expected)
        assert len(spline.knots) == len(spline.poles) + 4
        _, counts = np.unique(spline.knots, return_counts=True)
        assert counts.tolist() == [4, *[2] * (len(counts) - 2), 4]


def test_splines_have_no_corner():
    """The derivative by the knots' parameter is the same before and behind each knot: unit speed in x and y."""
    axis = axis_of("bracket")
    for branch in axis.branches:
        spline = branch_spline(axis, branch, 1e-6 * axis.frame.size)
        slope = BSpline(spline.knots, spline.poles, 3).derivative()
        for knot in np.unique(spline.knots)[1:-1]:
            step = 1e-9 * spline.knots[-1]
            assert slope(knot - step) == pytest.approx(slope(knot + step), abs=1e-5)
            assert np.hypot(*slope(knot)[:2]) == pytest.approx(1.0, abs=1e-6)


def test_straight_branches_are_told():
    """The diagonals of a rectangle are straight also in their radius; the axis of an ellipse is not."""
    rectangle, ellipse = axis_of("rectangle"), axis_of("ellipse")
    assert all(branch_spline(rectangle, branch, 1e-3).is_straight for branch in rectangle.branches)
    assert not branch_spline(ellipse, ellipse.branches[0], 1e-3).is_straight


def test_finer_takes_more_poles_by_the_fourth_root():
    """A hundred times finer takes about three times the poles."""
    axis = axis_of("eccentric ring")
    counts = [len(branch_spline(axis, axis.branches[0], accuracy).poles) for accuracy in (1e-4, 1e-6, 1e-8)]
    assert counts[0] < counts[1] < counts[2]
    assert counts[2] / counts[1] < 5
