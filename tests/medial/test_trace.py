"""Axes as samples: nodes and branches with the numbers that files have."""

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of

from mashape_cad.medial.pruning import simplify
from mashape_cad.medial.trace import trace


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_a_trace_has_what_the_axis_has(name):
    """Nodes in their order, branches from node to node, neighbours no further apart than the step."""
    axis = axis_of(name)
    step = 0.02 * axis.frame.size
    found = trace(axis, step)
    assert np.array_equal(found.centre, axis.nodes.centre)
    assert np.array_equal(found.degree, axis.nodes.degree)
    assert found.kind == axis.nodes.kind
    assert [(branch.start, branch.end) for branch in found.branches] == [(b.start, b.end) for b in axis.branches]
    for branch in found.branches:
        assert np.array_equal(branch.centre[[0, -1]], found.centre[[branch.start, branch.end]])
        assert np.array_equal(branch.radius[[0, -1]], found.radius[[branch.start, branch.end]])
        assert np.hypot(*np.diff(branch.centre, axis=0).T).max() <= step * (1 + 1e-9)
        assert branch.spline is None


def test_the_nodes_of_a_pruned_axis_are_numbered_anew():
    """Of the rectangle's six nodes two are left, numbers 0 and 1, and the branch between them."""
    found = trace(simplify(axis_of("rectangle"), min_thickness=1.0), 0.1)
    (branch,) = found.branches
    assert (branch.start, branch.end) == (0, 1)
    assert found.kind == ("end", "end")
    assert found.degree.tolist() == [1, 1]
    assert sorted(found.centre[:, 0].tolist()) == pytest.approx([1.5, 5.5])
    assert found.radius == pytest.approx(1.5)


def test_splines_are_fitted_when_asked_for():
    """To the accuracy that is asked for."""
    coarse, fine = (trace(axis_of("blob"), 0.1, accuracy).branches for accuracy in (1e-2, 1e-8))
    for few, many in zip(coarse, fine, strict=True):
        assert len(few.spline.poles) < len(many.spline.poles)
