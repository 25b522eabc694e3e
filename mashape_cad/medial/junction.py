"""Discs with three contacts: Newton's method on three stretches of boundary.

Given parameters t_i with feet q_i and inward unit normals m_i, the three equations ``m_i.c - r = m_i.q_i`` are linear
in centre and radius, and exact for straight edges; each foot then moves along its tangent to where the centre's foot
lies on the circle of curvature. A reflex vertex takes part as a curve without length whose normal turns to face the
centre.
"""

import math

import numpy as np
from numba import njit

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.disc import cone_turn
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["junction_disc"]

_STEPS = 40
# Feet may end this far (in the parameter) outside their stretch: they are put back on its end by whoever uses them.
_MARGIN = 1e-9
_SETTLED = 1e-13  # feet that move less are at rest (sizes of the shape)
_RESIDUAL = 1e-10  # a disc is accepted if its feet lie on it, and its spokes along their normals, this well
_PARALLEL = 1e-14  # three normals whose differences span less leave the centre undetermined
_WIDEST = 10.0  # a disc beyond this radius (sizes) has run away
_STIFF = 1e-12  # a circle of curvature this near to the disc lets its foot stay where it is


@njit(cache=True)
def junction_disc(
    tour: Tour, element: Ints, low: Floats, high: Floats, start: Floats
) -> tuple[bool, float, float, float, Floats]:
    """Find a disc that touches three stretches of boundary.

    Parameters
    ----------
    element, low, high : (3,) arrays
        The stretches: parameters `low` to `high` of an element.
    start : (3,) array
        First guess of the parameters.

    Returns
    -------
    found : bool
        Whether Newton's method converged inside the three stretches.
    x, y, r : float
    t : (3,) array
        The feet.
    """
    t = start.copy()
    nx, ny, rhs = np.empty(3), np.empty(3), np.empty(3)
    qx, qy, curvature, speed = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    x = y = r = 0.0
    best = math.inf
    for step in range(_STEPS):
        for i in range(3):
            qx[i], qy[i], nx[i], ny[i], curvature[i], speed[i] = site(tour, element[i], t[i])
            rhs[i] = nx[i] * qx[i] + ny[i] * qy[i]
        # Differences of the rows drop r: two equations in the centre.
        a, b, c = nx[1] - nx[0], ny[1] - ny[0], rhs[1] - rhs[0]
        d, e, f = nx[2] - nx[0], ny[2] - ny[0], rhs[2] - rhs[0]
        det = a * e - b * d
        if abs(det) < _PARALLEL:
            return False, 0.0, 0.0, 0.0, t
        x, y = (c * e - b * f) / det, (a * f - c * d) / det
        r = nx[0] * x + ny[0] * y - rhs[0]
        if not (0.0 < r < _WIDEST):
            return False, 0.0, 0.0, 0.0, t
        moved = 0.0
        for i in range(3):
            if speed[i] == 0.0:
                target = cone_turn(tour, element[i], x, y)
                change = target - t[i]
            else:
                along = ny[i] * (x - qx[i]) - nx[i] * (y - qy[i])
                stiffness = 1.0 - curvature[i] * r
                change = along / (speed[i] * stiffness) if abs(stiffness) > _STIFF else 0.0
            bound = 0.7 * (high[i] - low[i])
            change = min(max(change, -bound), bound)
            # A foot that wants out may lean a little over the end of its stretch, so that the others can settle.
            s = min(max(t[i] + change, low[i] - _MARGIN), high[i] + _MARGIN)
            moved = max(
                moved, abs(s - t[i]) * max(speed[i], r * abs(tour.cone[element[i], 1]) if speed[i] == 0.0 else 0.0)
            )
            t[i] = s
        if step > 3 and moved >= best and moved < _SETTLED:
            break
        best = min(best, moved)
        if moved == 0.0:
            break
    residual = 0.0
    for i in range(3):
        qx[i], qy[i], nx[i], ny[i], curvature[i], speed[i] = site(tour, element[i], t[i])
        along = ny[i] * (x - qx[i]) - nx[i] * (y - qy[i])
        residual = max(residual, abs(math.hypot(x - qx[i], y - qy[i]) - r))
        if speed[i] > 0.0:
            residual = max(residual, abs(along) * min(1.0, abs(1.0 - curvature[i] * r) + 1e-3))
    return residual < _RESIDUAL, x, y, r, t
