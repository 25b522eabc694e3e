import numpy as np
import pytest

from mashape_cad.kernel.emptiness import witnesses

# A parabola through (-1, 1), (0, 0), (1, 1): its osculating disc at the vertex has radius 1/2.
_PARABOLA = np.array([[-1.0, 1.0, 1.0], [0.0, -1.0, 1.0], [1.0, 1.0, 1.0]])


def _witness(control, centre, radius, contact=0.5, tol=1e-12):
    arrays = (np.array([control]), np.array([centre], float), np.array([radius]), np.array([contact]), np.array([tol]))
    return witnesses(*arrays)[0]


@pytest.mark.parametrize("contact", [0.0, 0.5, 1.0, 0.123])
def test_touching_disc_is_proven_empty_wherever_it_is_thought_to_touch(contact):
    """Discs inside the parabola, up to the osculating one, hold none of its points."""
    for radius in (0.1, 0.4, 0.5):
        assert np.isnan(_witness(_PARABOLA, (0, radius), radius, contact))


def test_a_larger_disc_has_a_witness_inside():
    """The point at the parameter lies deeper than the tolerance."""
    u = _witness(_PARABOLA, (0, 0.6), 0.6)
    x = 2 * u - 1
    assert np.hypot(x, x**2 - 0.6) < 0.6


def test_depth_within_the_tolerance_does_not_count():
    """A disc that reaches over by 1e-6 is empty to 1e-5, not to 1e-7."""
    assert np.isnan(_witness(_PARABOLA, (0, 0.3), 0.3 + 1e-6, tol=1e-5))
    assert not np.isnan(_witness(_PARABOLA, (0, 0.3), 0.3 + 1e-6, tol=1e-7))


def test_a_dip_between_samples_is_found():
    """A disc that a curve enters for a millionth of its length has a witness."""
    t = np.linspace(0, 1, 5)
    control = _interpolated(t, ((t - 0.3) ** 2 - 1e-12) * 4 + 1)  # down to 1 - 4e-12 at 0.3
    assert not np.isnan(_witness(control, (0.3, 0), 1 - 1e-12, contact=0.9, tol=1e-13))


def _interpolated(t, heights):
    """Control points of the polynomial curve (t, height(t))."""
    from scipy.special import comb

    degree = len(t) - 1
    basis = np.array([[comb(degree, i) * x**i * (1 - x) ** (degree - i) for i in range(degree + 1)] for x in t])
    return np.column_stack([np.linspace(0, 1, degree + 1), np.linalg.solve(basis, heights), np.ones(degree + 1)])


@pytest.mark.parametrize("seed", range(5))
def test_many_pairs_at_once_agree_with_dense_samples(seed):
    """Rational cubics and discs at random: a witness exactly where samples enter, but for grazing ones."""
    rng = np.random.default_rng(seed)
    weights = rng.uniform(0.3, 3, (400, 4, 1))
    control = np.concatenate([rng.normal(size=(400, 4, 2)) * weights, weights], axis=2)
    centre, radius = rng.normal(size=(400, 2)), rng.uniform(0.01, 2, 400)
    found = witnesses(control, centre, radius, rng.random(400), np.full(400, 1e-12))
    t = np.linspace(0, 1, 2001)
    basis = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3])
    homogeneous = np.einsum("it,kic->ktc", basis, control)
    points = homogeneous[..., :2] / homogeneous[..., 2:]
    depth = radius - np.linalg.norm(points - centre[:, None], axis=2).min(axis=1)
    assert np.all(~np.isnan(found[depth > 0]))
    assert np.all(np.isnan(found[depth < -1e-3]))
