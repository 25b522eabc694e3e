"""Whether discs hold points of Bezier pieces: a proof, or a witness.

With ``X = (x, y, w)`` the homogeneous control points, ``x^2 + y^2 - r^2 w^2`` (centre at the origin) is a polynomial of
twice the degree, negative exactly where the piece runs inside the disc. In Bernstein form it lies above its smallest
coefficient, which proves most pieces outside at once; else the piece is halved. Where the piece touches the disc the
coefficients approach zero from below only quadratically; cut at the point of contact, they are clear of it at once.

References
----------
R. T. Farouki, The Bernstein polynomial basis: a centennial retrospective, CAGD 29 (2012), sections 4 and 5.
"""

import numpy as np
from scipy.special import comb

from mashape_cad.geometry.edge import Floats

__all__ = ["witnesses"]

# Halvings before a piece without a witness counts as outside: its coefficients then are its values to rounding.
_HALVINGS = 40


def witnesses(control: Floats, centre: Floats, radius: Floats, contact: Floats, tol: Floats) -> Floats:
    """Return for each pair of a piece and a disc a parameter where the piece runs inside the disc.

    Parameters
    ----------
    control : (k, degree + 1, 3) array
        Homogeneous control points.
    centre : (k, 2) array
    radius : (k,) array
    contact : (k,) array
        Parameter of the point where the piece is thought to touch the disc; only speed depends on it.
    tol : (k,) array
        Depth inside the disc that does not count.

    Returns
    -------
    (k,) array
        Parameters in [0, 1]; nan where no point is deeper inside than that.
    """
    found = np.full(len(control), np.nan)
    pair = np.repeat(np.arange(len(control)), 2)
    moved = control - control[..., 2:] * np.pad(centre, ((0, 0), (0, 1)))[:, None]
    parts = _cut(moved, contact)
    low, high = _interleaved(np.zeros_like(contact), contact), _interleaved(contact, np.ones_like(contact))
    floor = -(2 * radius + tol) * tol * control[..., 2].min(axis=1) ** 2
    for _ in range(_HALVINGS):
        power = _power(parts, radius[pair])
        inside = power[:, [0, -1]] < floor[pair, None]
        found[pair[inside[:, 1]]] = high[inside[:, 1]]
        found[pair[inside[:, 0]]] = low[inside[:, 0]]
        undecided = np.flatnonzero((power.min(axis=1) < floor[pair]) & np.isnan(found[pair]))
        if len(undecided) == 0:
            break
        middle = (low[undecided] + high[undecided]) / 2
        low, high = _interleaved(low[undecided], middle), _interleaved(middle, high[undecided])
        parts, pair = _cut(parts[undecided], np.full(len(undecided), 0.5)), np.repeat(pair[undecided], 2)
    return found


def _power(parts: Floats, radius: Floats) -> Floats:
    """Bernstein coefficients of ``x^2 + y^2 - r^2 w^2``: (n, 2 degree + 1)."""
    degree = parts.shape[1] - 1
    scaled = parts * comb(degree, np.arange(degree + 1))[:, None]
    other = scaled * np.stack([np.ones_like(radius), np.ones_like(radius), -(radius**2)], axis=1)[:, None]
    products = scaled @ other.swapaxes(1, 2)
    power = np.zeros((len(parts), 2 * degree + 1))
    for i in range(degree + 1):
        power[:, i : i + degree + 1] += products[:, i]
    return power / comb(2 * degree, np.arange(2 * degree + 1))


def _cut(parts: Floats, at: Floats) -> Floats:
    """Cut pieces (k, d + 1, 3), each at its own parameter, by de Casteljau: (2 k, d + 1, 3), both parts in turn."""
    t = at[:, None, None]
    left, right, row = [parts[:, 0]], [parts[:, -1]], parts
    while row.shape[1] > 1:
        row = (1 - t) * row[:, :-1] + t * row[:, 1:]
        left.append(row[:, 0])
        right.append(row[:, -1])
    return np.stack([np.stack(left, axis=1), np.stack(right[::-1], axis=1)], axis=1).reshape(-1, *parts.shape[1:])


def _interleaved(first: Floats, second: Floats) -> Floats:
    return np.stack([first, second], axis=1).ravel()
