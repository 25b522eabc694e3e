"""Bezier spans and polynomials in Bernstein form, against plain evaluation."""

import numpy as np
import pytest
from random_edges import random_ellipse_arc, random_spline

from mashape_cad.medial.bezier import (
    binomials,
    curvature_slope,
    derivative,
    difference,
    evaluate,
    halves,
    power_distance,
    product,
    value,
)

_T = np.linspace(0, 1, 13)


def _polynomial(rng, degree):
    return rng.normal(size=degree + 1)


def _values(coefficients, t=_T):
    return np.array([value(coefficients, s) for s in t])


@pytest.mark.parametrize("degree", range(1, 6))
def test_spans_of_splines_are_the_spline(degree):
    """Position and both derivatives, up to the span's share of the parameter; rational or not."""
    rng = np.random.default_rng(degree)
    for _ in range(4):
        spline = random_spline(rng, degree)
        control, breaks = spline.spans()
        for span, low, high in zip(control, breaks, breaks[1:], strict=False):
            inner = _T[1:-1]  # at a knot derivatives jump
            expected = spline.derivatives(low + inner * (high - low)) * ((high - low) ** np.arange(3))[:, None]
            actual = np.array([evaluate(span, degree, t) for t in inner]).reshape(-1, 3, 2)
            assert actual == pytest.approx(expected, abs=1e-9, rel=1e-9)


def test_spans_of_arcs_lie_on_their_ellipse():
    """As far from the centre as they have to be, and moving along the tangent; the parameter is another one."""
    rng = np.random.default_rng(1)
    for _ in range(10):
        arc = random_ellipse_arc(rng)
        control, _ = arc.spans()
        axes = np.column_stack([arc.axis_a, arc.axis_b])
        for span in control:
            for t in _T:
                x, y, dx, dy, _, _ = evaluate(span, 2, t)
                p, d = np.linalg.solve(axes, (x, y) - arc.centre), np.linalg.solve(axes, (dx, dy))
                assert np.hypot(*p) == pytest.approx(1, abs=1e-13)
                assert p @ d == pytest.approx(0, abs=1e-12)
                assert np.sign(p[0] * d[1] - p[1] * d[0]) == np.sign(arc.sweep)


def test_second_derivatives_of_a_rational_span():
    """Against differences of first ones."""
    span = np.array([(0, 0, 1), (2, 1, 0.5), (3, 3, 2), (1, 4, 1.5)])
    h = 1e-5
    for t in (0.2, 0.5, 0.9):
        before, after = (np.array(evaluate(span, 3, t + s)) for s in (-h, h))
        here = np.array(evaluate(span, 3, t))
        assert here[2:4] == pytest.approx((after[:2] - before[:2]) / (2 * h), rel=1e-8)
        assert here[4:6] == pytest.approx((after[2:4] - before[2:4]) / (2 * h), rel=1e-8)


def test_binomials_are_pascals_triangle():
    """Row by row."""
    assert [binomials(n).tolist() for n in range(5)] == [[1], [1, 1], [1, 2, 1], [1, 3, 3, 1], [1, 4, 6, 4, 1]]


def test_a_polynomial_is_evaluated_as_its_definition_says():
    """Sum of coefficients times Bernstein polynomials."""
    c = _polynomial(np.random.default_rng(2), 5)
    basis = np.array([binomials(5)[k] * _T**k * (1 - _T) ** (5 - k) for k in range(6)])
    assert _values(c) == pytest.approx(c @ basis, abs=1e-14)


@pytest.mark.parametrize(("m", "n"), [(0, 3), (1, 1), (2, 5), (7, 4), (13, 13)])
def test_product_and_difference(m, n):
    """Value by value, also of different degrees."""
    rng = np.random.default_rng(m + 20 * n)
    a, b = _polynomial(rng, m), _polynomial(rng, n)
    assert _values(product(a, b)) == pytest.approx(_values(a) * _values(b), abs=1e-12)
    assert _values(difference(a, b)) == pytest.approx(_values(a) - _values(b), abs=1e-12)
    assert _values(difference(b, a)) == pytest.approx(_values(b) - _values(a), abs=1e-12)
    assert len(product(a, b)) == m + n + 1
    assert len(difference(a, b)) == max(m, n) + 1


@pytest.mark.parametrize("degree", [0, 1, 2, 6])
def test_derivative(degree):
    """Against central differences."""
    c = _polynomial(np.random.default_rng(degree), degree)
    inner = _T[1:-1]
    expected = (_values(c, inner + 1e-6) - _values(c, inner - 1e-6)) / 2e-6
    assert _values(derivative(c), inner) == pytest.approx(expected, abs=1e-8)


def test_halves():
    """The left half runs at half the speed over the first half, the right one over the second."""
    c = _polynomial(np.random.default_rng(5), 7)
    left, right = halves(c)
    assert _values(left) == pytest.approx(_values(c, _T / 2), abs=1e-13)
    assert _values(right) == pytest.approx(_values(c, (1 + _T) / 2), abs=1e-13)
    assert left[-1] == right[0]


@pytest.mark.parametrize("degree", [1, 2, 3, 5])
def test_power_distance(degree):
    """The weighted power of the curve's points with respect to a disc, so negative where it runs inside."""
    rng = np.random.default_rng(degree)
    span = random_spline(rng, degree).spans()[0][0]
    cx, cy, r = 10.0, -5.0, 30.0
    coefficients = power_distance(span, degree, cx, cy, r)
    assert len(coefficients) == 2 * degree + 1
    points = np.array([evaluate(span, degree, t)[:2] for t in _T])
    weight = _values(np.ascontiguousarray(span[:, 2]))
    expected = weight**2 * (np.sum((points - (cx, cy)) ** 2, axis=1) - r * r)
    assert _values(coefficients) == pytest.approx(expected, rel=1e-10, abs=1e-9)


def _curvature(span, degree, t):
    _, _, dx, dy, ddx, ddy = evaluate(span, degree, t)
    return (dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3


@pytest.mark.parametrize("rational", [False, True])
@pytest.mark.parametrize("degree", [2, 3, 4, 5])
def test_the_sign_of_the_slope_of_curvature(degree, rational):
    """The polynomial rises and falls with the curvature, by finite differences."""
    rng = np.random.default_rng(10 * degree + rational)
    compared = 0
    for _ in range(20):
        points = rng.normal(size=(degree + 1, 2))
        weights = rng.uniform(0.5, 2.0, degree + 1) if rational else np.ones(degree + 1)
        span = np.column_stack([points * weights[:, None], weights])
        slope = curvature_slope(span, degree)
        for t in np.linspace(0.05, 0.95, 19):
            rise = (_curvature(span, degree, t + 1e-6) - _curvature(span, degree, t - 1e-6)) / 2e-6
            if abs(rise) > 1e-3 * abs(_curvature(span, degree, t)):
                assert np.sign(value(slope, t)) == np.sign(rise)
                compared += 1
    assert compared > 200


def test_a_circle_has_no_slope_of_curvature():
    """A quarter of a circle as a rational quadratic: nothing but rounding."""
    w = np.sqrt(0.5)
    quarter = np.array([(1, 0, 1), (w, w, w), (0, 1, 1)])
    assert np.abs(curvature_slope(quarter, 2)).max() <= 1e-14
