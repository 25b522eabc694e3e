"""Random edges of every kind for tests: wild ones, as no designer would draw them."""

import numpy as np

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Line, frozen


def random_spline(rng: np.random.Generator, degree: int | None = None) -> BSpline:
    """A spline of any degree to 5, rational or not, with even or uneven knots of any scale."""
    degree = degree or int(rng.integers(1, 6))
    count = int(rng.integers(degree + 1, 30))
    inner = np.sort(rng.random(count - degree - 1)) if rng.random() < 0.5 else np.arange(1, count - degree) / 30
    knots = np.concatenate([np.zeros(degree + 1), inner, np.ones(degree + 1)]) * rng.choice([1e-3, 1.0, 1e3])
    weights = rng.uniform(0.2, 3.0, count) if rng.random() < 0.5 else None
    return BSpline.of(degree, knots, 50 * rng.normal(size=(count, 2)), weights)


def random_arc(rng: np.random.Generator) -> Arc:
    """An arc of any sense and length, from any angle."""
    return Arc.of(30 * rng.normal(size=2), rng.uniform(1, 50), rng.uniform(-10, 10), rng.uniform(-6, 6))


def random_ellipse_arc(rng: np.random.Generator) -> EllipseArc:
    """An arc of an ellipse, either axis the longer one, left-handed or not."""
    axis_a = 10 * rng.normal(size=2)
    axis_b = np.array([-axis_a[1], axis_a[0]]) * rng.uniform(0.2, 3) * rng.choice([-1, 1])
    centre = frozen(30 * rng.normal(size=2))
    return EllipseArc(centre, frozen(axis_a), frozen(axis_b), rng.uniform(-10, 10), rng.uniform(-6, 6))


def random_line(rng: np.random.Generator) -> Line:
    """A line anywhere."""
    return Line.of(*(50 * rng.normal(size=(2, 2))))


def random_edges(rng: np.random.Generator) -> list[Edge]:
    """One edge of each kind, and three splines."""
    splines: list[Edge] = [random_spline(rng) for _ in range(3)]
    return [*splines, random_arc(rng), random_ellipse_arc(rng), random_line(rng)]
