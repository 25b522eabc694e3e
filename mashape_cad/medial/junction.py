"""Discs with three contacts: Newton's method on three stretches of boundary.

Given parameters t_i with feet q_i and inward unit normals m_i, the three equations ``m_i.c - r = m_i.q_i`` are linear
in centre and radius, and exact for straight edges; each foot then moves along its tangent to where the centre's foot
lies on the circle of curvature. A reflex vertex takes part as a curve without length whose normal turns to face the
centre.
"""

import math

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.emptiness import cone_turn
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


@compiled
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
        solved, x, y, r = _solved(nx, ny, rhs)
        if not solved:
            return False, 0.0, 0.0, 0.0, t
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
            pace = speed[i] if speed[i] > 0.0 else r * abs(tour.element[element[i]].cone_turn)
            moved = max(moved, abs(s - t[i]) * pace)
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


@compiled
def _solved(nx: Floats, ny: Floats, rhs: Floats) -> tuple[bool, float, float, float]:
    """Solve ``n_i . c - r = rhs_i`` by elimination with full pivoting.

    Two of the normals may be almost parallel, at a vertex that turns by 1e-7: then the centre is not well determined
    along the boundary, but with pivoting the three equations still hold to rounding, so the disc touches all three.
    """
    system = np.empty((3, 4))
    for i in range(3):
        system[i, 0], system[i, 1], system[i, 2], system[i, 3] = nx[i], ny[i], -1.0, rhs[i]
    column = np.arange(3)
    for k in range(3):
        row, pick, largest = k, k, 0.0
        for i in range(k, 3):
            for j in range(k, 3):
                if abs(system[i, j]) > largest:
                    row, pick, largest = i, j, abs(system[i, j])
        if largest < _PARALLEL:
            return False, 0.0, 0.0, 0.0
        for j in range(4):
            system[k, j], system[row, j] = system[row, j], system[k, j]
        for i in range(3):
            system[i, k], system[i, pick] = system[i, pick], system[i, k]
        column[k], column[pick] = column[pick], column[k]
        for i in range(k + 1, 3):
            factor = system[i, k] / system[k, k]
            for j in range(k, 4):
                system[i, j] -= factor * system[k, j]
    solution = np.empty(3)
    for k in range(2, -1, -1):
        rest = system[k, 3]
        for j in range(k + 1, 3):
            rest -= system[k, j] * solution[column[j]]
        solution[column[k]] = rest / system[k, k]
    return True, solution[0], solution[1], solution[2]
