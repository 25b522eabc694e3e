"""Exact edges: one parameter convention, Bezier spans that are the same curve, lengths and areas."""

from dataclasses import fields

import numpy as np
import pytest

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Line, Similarity, frozen

_RNG = np.random.default_rng(7)
_POLES = np.array([(0, 0), (1, 2), (3, 2.5), (4, 1), (6, 0), (7, 2), (9, 2)]) + _RNG.uniform(-0.3, 0.3, (7, 2))
EDGES = {
    "line": Line.of((1, 2), (4, 6)),
    "arc": Arc.of((1, 2), 3, 0.3, 4.0),
    "clockwise arc": Arc.of((1, 2), 3, 0.3, -1.1),
    "circle": Arc.of((0.5, -2), 1.5),
    "elliptic arc": EllipseArc(frozen((1, 1)), frozen((2, 1)), frozen((-0.5, 1)), 0.2, 2.5),
    "rational spline": BSpline.of(3, [0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3], _POLES, _RNG.uniform(0.5, 2, 7)),
    "unclamped closed spline": BSpline.of(3, np.arange(12.0), np.concatenate([_POLES[:5], _POLES[:3]])),
    "quintic": BSpline.of(5, [0] * 6 + [1] * 6, _POLES[:6]),
}


@pytest.fixture(params=EDGES)
def edge(request):
    """Each kind in turn."""
    return EDGES[request.param]


def _casteljau(control, t):
    while len(control) > 1:
        control = (1 - t) * control[:-1] + t * control[1:]
    return control[0, :2] / control[0, 2]


def test_spans_run_along_the_edge(edge):
    """Their ends lie at the breaks, and their inner points on the curve."""
    control, breaks = edge.spans()
    assert breaks[0] == 0.0
    assert breaks[-1] == 1.0
    for k, span in enumerate(control):
        assert _casteljau(span, 0.0) == pytest.approx(edge.point(breaks[k])[0], abs=1e-12)
        assert _casteljau(span, 1.0) == pytest.approx(edge.point(breaks[k + 1])[0], abs=1e-12)
        if not isinstance(edge, EllipseArc):  # there the span's parameter is not linear in the angle
            middle = breaks[k] + 0.3 * (breaks[k + 1] - breaks[k])
            assert _casteljau(span, 0.3) == pytest.approx(edge.point(middle)[0], abs=1e-12)


@pytest.mark.parametrize("name", ["arc", "clockwise arc", "circle"])
def test_spans_of_an_arc_lie_on_its_circle(name):
    """To the last digits."""
    arc = EDGES[name]
    for span in arc.spans()[0]:
        points = np.array([_casteljau(span, t) for t in np.linspace(0, 1, 9)])
        assert np.hypot(*(points - arc.centre).T) == pytest.approx(arc.radius, rel=1e-14)


def test_derivatives_are_those_of_the_positions(edge):
    """Against differences of the positions."""
    h = 1e-5
    before, here, after = edge.derivatives([0.31 - h, 0.31, 0.31 + h])
    assert (after[0] - before[0]) / (2 * h) == pytest.approx(here[1], abs=1e-5)
    assert (after[1] - before[1]) / (2 * h) == pytest.approx(here[2], rel=1e-4, abs=1e-4)


def test_a_reversed_edge_runs_backwards(edge):
    """Same points, other direction."""
    u = np.linspace(0, 1, 7)
    assert edge.reversed().point(u) == pytest.approx(edge.point(1 - u), abs=1e-12)


def test_halves_of_a_split_edge_are_the_edge(edge):
    """Each half is run through at its own pace, and lengths add up."""
    left, right = edge.split(0.4)
    u = np.linspace(0, 1, 5)
    assert left.point(u) == pytest.approx(edge.point(0.4 * u), abs=1e-12)
    assert right.point(u) == pytest.approx(edge.point(0.4 + 0.6 * u), abs=1e-12)
    assert left.length() + right.length() == pytest.approx(edge.length(), rel=1e-8)


def test_an_image_has_the_image_of_every_point(edge):
    """Mirrored, turned, scaled and moved; the kind stays."""
    similarity = Similarity.of(2.5, 0.5, (1, 2), mirror=True)
    image = edge.transformed(similarity)
    assert type(image) is type(edge)
    assert image.point([0.0, 0.3, 1.0]) == pytest.approx(similarity.apply(edge.point([0.0, 0.3, 1.0])), abs=1e-12)
    assert image.length() == pytest.approx(2.5 * edge.length(), rel=1e-9)


def test_length_and_area_integral_are_those_of_fine_polylines(edge):
    """Closed forms and quadrature alike."""
    points = edge.point(np.linspace(0, 1, 40001))
    (x, y), (dx, dy) = points[:-1].T, np.diff(points, axis=0).T
    assert edge.length() == pytest.approx(np.hypot(dx, dy).sum(), rel=1e-6)
    assert edge.length_up_to(0.25) == pytest.approx(np.hypot(dx, dy)[:10000].sum(), rel=1e-6)
    assert edge.area_integral() == pytest.approx((x * dy - y * dx).sum() / 2, rel=1e-6, abs=1e-6)


def test_the_area_beside_a_flat_arc_keeps_its_digits():
    """The sector of a giant circle less its triangle cancelled all of them."""
    chord, bow = 6.0, 1e-4
    radius = chord**2 / (8 * bow)
    half = np.arcsin(chord / 2 / radius)
    arc = Arc.of([1.0, 2.0 - radius], radius, np.pi / 2 + half, -2 * half)
    under = Line.of(arc.end, arc.start).area_integral() + arc.area_integral()
    assert under == pytest.approx(-2 / 3 * chord * bow, rel=1e-6)


def test_bounds_hold_the_curve_and_are_tight(edge):
    """Never too small, and at most a hundredth too large."""
    points = edge.point(np.linspace(0, 1, 2001))
    low, high = edge.bounds()
    assert np.all(low <= points.min(axis=0) + 1e-12)
    assert np.all(high >= points.max(axis=0) - 1e-12)
    assert np.max(high - low) <= 1.02 * np.max(np.ptp(points, axis=0))


def test_an_unclamped_spline_is_clamped_and_stays_the_curve():
    """Its ends are points of the curve; a periodic one is closed."""
    assert EDGES["unclamped closed spline"].is_closed
    assert not EDGES["rational spline"].is_closed


@pytest.mark.parametrize(
    ("degree", "knots", "poles", "weights"),
    [
        (3, [0, 0, 0, 0, 1, 1, 1, 1], [(0, 0), (1, 1), (2, 0)], None),
        (1, [0, 0, 1, 1], [(0, 0), (1, 1)], [1, -1]),
        (1, [0, 1, 0, 1], [(0, 0), (1, 1)], None),
        (1, [0, 0, 1, 1], [(0, 0), (np.nan, 1)], None),
    ],
)
def test_numbers_that_make_no_spline_are_refused(degree, knots, poles, weights):
    """Too few poles, a negative weight, falling knots, a pole that is no number."""
    with pytest.raises(ValueError, match=r"must|make"):
        BSpline.of(degree, knots, poles, weights)


def test_a_similarity_carries_two_points_onto_two():
    """And keeps angles: the third point of a triangle follows."""
    similarity = Similarity.carrying(((0, 0), (1, 0)), ((2, 3), (2, 5)))
    assert similarity.apply([(0, 0), (1, 0), (0, 1)]) == pytest.approx(np.array([(2, 3), (2, 5), (0, 3)]))
    assert similarity.scale == pytest.approx(2)
    assert not similarity.mirrors


def test_edges_are_frozen(edge):
    """Neither fields nor arrays change."""
    assert isinstance(edge, Edge)
    with pytest.raises(AttributeError):
        setattr(edge, fields(edge)[0].name, None)
