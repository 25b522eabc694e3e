"""Rational Bezier spans, compiled: evaluation, splitting, and polynomials in Bernstein form.

A span is a homogeneous control array (n, 3) of rows (w x, w y, w), of which the first ``degree + 1`` rows count. A
polynomial in Bernstein form is a 1D array of its coefficients: it lies between their smallest and largest one, and it
has at most as many roots in (0, 1) as they change sign. Both facts carry the proofs of this package.

References
----------
G. Farin, Curves and Surfaces for CAGD, 5th ed., chapters 4 to 6 and 13; R. T. Farouki, The Bernstein polynomial basis:
a centennial retrospective, CAGD 29 (2012), sections 4 and 5 (arithmetic in Bernstein form).
"""

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import compiled

__all__ = [
    "curvature_sign",
    "curvature_slope",
    "derivative",
    "difference",
    "evaluate",
    "halve",
    "halves",
    "power_distance",
    "product",
    "speed_squared",
    "value",
]


@compiled
def binomials(n: int) -> Floats:
    """Row n of Pascal's triangle, computed each time: a table would be compiled into every function that uses it."""
    row = np.ones(n + 1)
    for k in range(1, n):
        row[k] = row[k - 1] * (n - k + 1) / k
    return row


@compiled
def evaluate(control: Floats, degree: int, t: float) -> tuple[float, float, float, float, float, float]:
    """Return position, first and second derivative at `t`: (x, y, x', y', x'', y''), by de Casteljau."""
    s = 1.0 - t
    if degree == 1:
        x0, y0, w0 = _between(control, 0, s, t)
        x1, y1, w1 = control[1, 0] - control[0, 0], control[1, 1] - control[0, 1], control[1, 2] - control[0, 2]
        x2 = y2 = w2 = 0.0
    else:
        row = control
        if degree > 2:
            row = _cut_short(control, degree, t)
        ax, ay, aw = _between(row, 0, s, t)
        bx, by, bw = _between(row, 1, s, t)
        x0, y0, w0 = s * ax + t * bx, s * ay + t * by, s * aw + t * bw
        x1, y1, w1 = degree * (bx - ax), degree * (by - ay), degree * (bw - aw)
        c = degree * (degree - 1.0)
        x2 = c * (row[0, 0] - 2 * row[1, 0] + row[2, 0])
        y2 = c * (row[0, 1] - 2 * row[1, 1] + row[2, 1])
        w2 = c * (row[0, 2] - 2 * row[1, 2] + row[2, 2])
    x, y = x0 / w0, y0 / w0
    dx, dy = (x1 - w1 * x) / w0, (y1 - w1 * y) / w0
    return x, y, dx, dy, (x2 - 2 * w1 * dx - w2 * x) / w0, (y2 - 2 * w1 * dy - w2 * y) / w0


@compiled
def _between(row: Floats, i: int, s: float, t: float) -> tuple[float, float, float]:
    return s * row[i, 0] + t * row[i + 1, 0], s * row[i, 1] + t * row[i + 1, 1], s * row[i, 2] + t * row[i + 1, 2]


@compiled
def _cut_short(control: Floats, degree: int, t: float) -> Floats:
    """Return the three points that de Casteljau's scheme leaves two steps before its end: (3, 3) or more rows."""
    s = 1.0 - t
    row = np.empty((degree, 3))
    for i in range(degree):
        for j in range(3):
            row[i, j] = s * control[i, j] + t * control[i + 1, j]
    for k in range(1, degree - 2):
        for i in range(degree - k):
            for j in range(3):
                row[i, j] = s * row[i, j] + t * row[i + 1, j]
    return row


@compiled
def value(coefficients: Floats, t: float) -> float:
    """Evaluate a polynomial in Bernstein form."""
    row = coefficients.copy()
    for k in range(len(row) - 1):
        for i in range(len(row) - 1 - k):
            row[i] = (1.0 - t) * row[i] + t * row[i + 1]
    return float(row[0])


@compiled
def halves(coefficients: Floats) -> tuple[Floats, Floats]:
    """Return the coefficients on [0, 1/2] and on [1/2, 1]."""
    left, right = np.empty_like(coefficients), np.empty_like(coefficients)
    halve(coefficients, left, right)
    return left, right


@compiled
def halve(coefficients: Floats, left: Floats, right: Floats) -> None:
    """Fill in the coefficients on [0, 1/2] and on [1/2, 1]."""
    n = len(coefficients)
    for i in range(n):
        right[i] = coefficients[i]
    for k in range(n):
        left[k] = right[0]
        for i in range(n - 1 - k):
            right[i] = (right[i] + right[i + 1]) / 2


@compiled
def product(a: Floats, b: Floats) -> Floats:
    """Multiply two polynomials."""
    m, n = len(a) - 1, len(b) - 1
    scaled_a, scaled_b = binomials(m) * a, binomials(n) * b
    result = np.zeros(m + n + 1)
    for i in range(m + 1):
        for j in range(n + 1):
            result[i + j] += scaled_a[i] * scaled_b[j]
    return result / binomials(m + n)


@compiled
def derivative(a: Floats) -> Floats:
    """Differentiate; a constant gives the constant 0."""
    if len(a) == 1:
        return np.zeros(1)
    return (len(a) - 1) * (a[1:] - a[:-1])


@compiled
def difference(a: Floats, b: Floats) -> Floats:
    """Subtract ``b`` from ``a``, raising degrees to the common one."""
    m, n = len(a) - 1, len(b) - 1
    if m < n:
        return product(a, np.ones(n - m + 1)) - b
    if n < m:
        return a - product(b, np.ones(m - n + 1))
    return a - b


@compiled
def power_distance(control: Floats, degree: int, cx: float, cy: float, r: float) -> Floats:
    """Coefficients of ``w^2 (|q - c|^2 - r^2)``: the power of the span's point q with respect to a disc.

    Negative exactly where the span runs inside the disc; near the circle about ``2 r w^2`` times the distance to it.
    """
    row = binomials(degree)
    result = np.zeros(2 * degree + 1)
    for i in range(degree + 1):
        wi = control[i, 2]
        xi, yi = control[i, 0] - cx * wi, control[i, 1] - cy * wi
        for j in range(degree + 1):
            wj = control[j, 2]
            xj, yj = control[j, 0] - cx * wj, control[j, 1] - cy * wj
            result[i + j] += row[i] * row[j] * (xi * xj + yi * yj - r * r * wi * wj)
    return result / binomials(2 * degree)


@compiled
def speed_squared(control: Floats, degree: int) -> Floats:
    """Coefficients of ``|w X' - X w'|^2``, the square of the speed times w^4."""
    x, y, w = control[: degree + 1, 0].copy(), control[: degree + 1, 1].copy(), control[: degree + 1, 2].copy()
    w1 = derivative(w)
    ax = difference(product(w, derivative(x)), product(x, w1))
    ay = difference(product(w, derivative(y)), product(y, w1))
    return product(ax, ax) + product(ay, ay)


@compiled
def curvature_sign(control: Floats, degree: int) -> Floats:
    """Coefficients of ``N = det[X, X', X'']``, which has the sign of the curvature; X = (x, y, w) is homogeneous."""
    x, y, w = control[: degree + 1, 0].copy(), control[: degree + 1, 1].copy(), control[: degree + 1, 2].copy()
    x1, y1, w1 = derivative(x), derivative(y), derivative(w)
    x2, y2, w2 = derivative(x1), derivative(y1), derivative(w1)
    minor_x = difference(product(y1, w2), product(w1, y2))
    minor_y = difference(product(w1, x2), product(x1, w2))
    minor_w = difference(product(x1, y2), product(y1, x2))
    det = difference(product(x, minor_x), -product(y, minor_y))
    return difference(det, -product(w, minor_w))


@compiled
def curvature_slope(control: Floats, degree: int) -> Floats:
    """Coefficients of a polynomial with the sign of the derivative of curvature.

    With N as in `curvature_sign` and ``A = w X' - X w'`` (its first two rows), curvature is ``N w^3 / |A|^3``, and its
    derivative has the sign of ``(N' w + 3 N w') |A|^2 - 3 N w A.A'``.
    """
    x, y, w = control[: degree + 1, 0].copy(), control[: degree + 1, 1].copy(), control[: degree + 1, 2].copy()
    x1, y1, w1 = derivative(x), derivative(y), derivative(w)
    det = curvature_sign(control, degree)
    ax, ay = difference(product(w, x1), product(x, w1)), difference(product(w, y1), product(y, w1))
    speed_sq = product(ax, ax) + product(ay, ay)
    slope = product(ax, derivative(ax)) + product(ay, derivative(ay))
    rising = difference(product(derivative(det), w), -3.0 * product(det, w1))
    return difference(product(rising, speed_sq), 3.0 * product(product(det, w), slope))
