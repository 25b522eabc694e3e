import numpy as np
import pytest
from random_edges import random_arc, random_ellipse_arc, random_line, random_spline

from mashape_cad.geometry.edge import Arc, BSpline, EllipseArc, Line, frozen
from mashape_cad.kernel import KernelCurve

_KINDS = (random_line, random_arc, random_ellipse_arc, random_spline)


@pytest.mark.parametrize("make", _KINDS, ids=lambda make: make.__name__)
@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("backwards", [False, True])
def test_kernel_agrees_with_the_edge_in_value_and_both_derivatives(make, seed, backwards):
    """Position to rounding, derivatives to 1e-11 of their largest, by the edge's own parameter."""
    rng = np.random.default_rng(seed)
    edge = make(rng).reversed() if backwards else make(rng)
    u = np.sort(np.append(rng.random(30), [0.0, 1.0]))
    expected, actual = edge.derivatives(u), KernelCurve(edge).derivatives(u)
    scale = np.abs(expected).max(axis=(0, 2), keepdims=True) + 1e-300
    assert actual.shape == (32, 3, 2)
    assert np.all(np.abs(actual - expected) <= np.array([1e-14, 1e-12, 1e-11])[:, None] * scale)


def test_curvature_is_positive_where_the_edge_turns_left():
    """An arc of radius 4 has curvature 1/4 to the left, -1/4 run through backwards, a line none."""
    left = Arc.of((3, 1), 4.0, 0.3, 1.2)
    assert KernelCurve(left).curvature([0, 0.5, 1]) == pytest.approx([0.25] * 3, rel=1e-14)
    assert KernelCurve(left.reversed()).curvature([0.5]) == pytest.approx([-0.25], rel=1e-14)
    assert KernelCurve(Line.of((0, 0), (3, 4))).curvature([0.5]) == pytest.approx([0.0], abs=1e-300)


def test_curvature_at_the_vertices_of_an_ellipse():
    """At the end of semi-axis a it is a / b^2, whichever axis is the longer one."""
    for a, b in ((3.0, 2.0), (2.0, 3.0)):
        whole = EllipseArc(frozen([1, 2]), frozen([a, 0]), frozen([0, b]), 0.0, 2 * np.pi)
        assert KernelCurve(whole).curvature([0, 0.25]) == pytest.approx([a / b**2, b / a**2], rel=1e-13)


def test_curvature_where_a_curve_stands_still_is_not_a_number():
    """A double end pole gives no tangent, so no curvature, and no warning."""
    edge = BSpline.of(2, [0, 0, 0, 1, 1, 1], [[0, 0], [0, 0], [1, 1]])
    assert np.isnan(KernelCurve(edge).curvature([0.0])[0])


@pytest.mark.parametrize(
    "edge",
    [
        Line.of((1, 1), (1, 1)),
        Arc.of((0, 0), 0.0),
        EllipseArc(frozen([0, 0]), frozen([1, 0]), frozen([0, 0]), 0.0, 1.0),
    ],
)
def test_edge_without_length_has_no_kernel_curve(edge):
    """It is refused with an error of Python's, not of the kernel's."""
    with pytest.raises(ValueError, match="length"):
        KernelCurve(edge)
