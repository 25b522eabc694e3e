"""From polygons with many corners to profiles of lines and splines."""

import numpy as np
from scipy import interpolate
from shapely.geometry import Polygon

from mashape_cad.geometry.edge import BSpline, Edge, Line
from mashape_cad.geometry.profile import Loop, Profile

# A turn of more than this within `REACH` is a corner, radians.
CORNER = 0.75
REACH = 1.2
# Distance of a spline's points, and how far a line may be off, in hundredths of the size.
SPACING = 2.5
FLAT = 0.12


def profile(shape: Polygon) -> Profile:
    """Lines and cubic splines through the corners and some points between."""
    outer, *holes = (_loop(np.array(ring.coords)[:-1]) for ring in (shape.exterior, *shape.interiors))
    return Profile.of(outer, holes)


def _loop(points: np.ndarray) -> Loop:
    keep = np.hypot(*(points - np.roll(points, 1, axis=0)).T) > 1e-6
    points = points[keep]
    closed = np.vstack([points, points[:1]])
    s = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    corners = _corners(closed, s)
    if not len(corners):
        return Loop((_periodic(closed, s),))
    edges: list[Edge] = []
    starts = s[corners]
    for a, b in zip(starts, np.append(starts[1:], starts[0] + s[-1]), strict=True):
        edges.append(_stretch(closed, s, a, b))
    return Loop(tuple(edges))


def _at(closed: np.ndarray, s: np.ndarray, where: np.ndarray) -> np.ndarray:
    where = np.mod(where, s[-1])
    return np.column_stack([np.interp(where, s, closed[:, 0]), np.interp(where, s, closed[:, 1])])


def _corners(closed: np.ndarray, s: np.ndarray) -> np.ndarray:
    here = closed[:-1]
    reach = min(REACH, s[-1] / 12)
    before, after = here - _at(closed, s, s[:-1] - reach), _at(closed, s, s[:-1] + reach) - here
    turn = np.abs(np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1)))
    found = []
    for k in np.argsort(-turn, kind="stable"):
        if turn[k] < CORNER:
            break
        gap = np.abs(s[found] - s[k]) if found else np.array([np.inf])
        if np.minimum(gap, s[-1] - gap).min() > reach:
            found.append(int(k))
    return np.sort(np.array(found, dtype=int))


def _stretch(closed: np.ndarray, s: np.ndarray, a: float, b: float) -> Edge:
    inside = np.linspace(a, b, max(5, int(np.ceil((b - a) / SPACING)) + 1))
    points = _at(closed, s, inside)
    chord = points[-1] - points[0]
    off = np.abs((points - points[0]) @ np.array([-chord[1], chord[0]])) / max(np.hypot(*chord), 1e-9)
    if off.max() < FLAT:
        return Line.of(points[0], points[-1])
    spline = interpolate.make_interp_spline(inside - a, points, k=3)
    return BSpline.of(3, spline.t, spline.c)


def _periodic(closed: np.ndarray, s: np.ndarray) -> Edge:
    where = np.linspace(0, s[-1], max(9, int(np.ceil(s[-1] / SPACING)) + 1))
    points = _at(closed, s, where)
    points[-1] = points[0]
    spline = interpolate.make_interp_spline(where, points, k=3, bc_type="periodic")
    return BSpline.of(3, spline.t, spline.c)
