import numpy as np
import pytest
from random_edges import random_edges

from mashape_cad.geometry.affine import affine_image, ellipse_arc
from mashape_cad.geometry.edge import Arc, EllipseArc

U = np.linspace(0.0, 1.0, 17)


@pytest.mark.parametrize("seed", range(6))
def test_every_point_of_the_image_is_the_image_of_the_point(seed):
    """Sheared, unevenly scaled or mirrored, an edge keeps its parameter: image(u) = map(point(u))."""
    rng = np.random.default_rng(seed)
    matrix, offset = rng.normal(size=(2, 2)), 100 * rng.normal(size=2)
    for edge in random_edges(rng):
        expected = edge.point(U) @ matrix.T + offset
        assert np.allclose(affine_image(edge, matrix, offset).point(U), expected, rtol=0, atol=1e-9)


def test_an_arc_stays_an_arc_when_only_moved_turned_mirrored_and_scaled():
    """A matrix that keeps shapes keeps kinds."""
    turn = 2.5 * np.array([[np.cos(1), np.sin(1)], [np.sin(1), -np.cos(1)]])
    image = affine_image(Arc.of((1, 2), 3.0, 0.5, 2.0), turn, np.array([5.0, 6.0]))
    assert isinstance(image, Arc)
    assert image.radius == pytest.approx(7.5, rel=1e-14)
    assert not image.is_counter_clockwise


def test_an_arc_scaled_unevenly_becomes_an_arc_of_an_ellipse_with_perpendicular_axes():
    """The image of a circle under diag(2, 1), turned: semi-axes 2 r and r."""
    image = affine_image(Arc.of((0, 0), 3.0, 0.3, 1.0), np.array([[2.0, 0.4], [0.0, 1.0]]), np.zeros(2))
    assert type(image) is EllipseArc
    assert image.axis_a @ image.axis_b == pytest.approx(0.0, abs=1e-13)
    assert np.hypot(*image.axis_a) * np.hypot(*image.axis_b) == pytest.approx(18.0, rel=1e-14)


def test_two_conjugate_half_diameters_of_a_circle_make_an_arc():
    """An ELLIPSE with ratio 1 is an arc, and keeps its angles to the last digit."""
    arc = ellipse_arc(np.array([1.0, 1.0]), np.array([3.0, 4.0]), np.array([-4.0, 3.0]), 0.25, 1.5)
    assert isinstance(arc, Arc)
    assert arc.radius == 5.0
    assert (arc.start_angle, arc.sweep) == (0.25, 1.5)
