"""One disc inside every piece of a branch: whether it is empty, and touches both stretches of the piece.

With the discs at its ends maximal, and no end of the axis inside, a piece is one branch if any disc of it is maximal
with one contact on either stretch.
"""

from collections.abc import Iterator

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.disc import twin_on_stretch
from mashape_cad.medial.emptiness import EMPTY, NO_SKIP, distance_minima
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.objection import Objection
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["inner_disc_objections"]

# The disc inside a piece is entered by no more than this, and its feet are off by no more (sizes), beyond what the
# discs at the ends have on record: the twin of a place close to an osculating end is known no better.
_INSIDE = 1e-9
_SHORT = 1e-6  # end discs that differ by less (sizes) have no room between them for a disc that tells more
# Newton's method for a disc of given radius: steps, at most; the least stiffness of a foot, which follows a circle of
# its own curvature without resistance; and the move (parameter) below which feet are at rest.
_STEPS, _STIFF, _AT_REST = 50, 1e-3, 1e-15


def inner_disc_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Yield pieces inside which a disc is not empty, or does not touch both stretches."""
    size, pieces = axis.frame.size, axis.pieces
    centre, radius = (axis.discs.centre - axis.frame.middle) / size, axis.discs.radius / size
    ends = np.concatenate([centre, radius[:, None]], axis=1)[pieces.disc]
    found = _inner_discs(axis.tour, pieces.element, pieces.low, pieces.high, ends)
    apart = np.abs(ends[:, 0] - ends[:, 1]).sum(axis=1)
    tol = _INSIDE + axis.discs.tolerance[pieces.disc].max(axis=1, initial=0.0) / size
    tol += np.where(apart < _SHORT, apart, 0.0)
    names = ("is entered by the boundary by", "misses its two stretches by")
    for error, name in zip(found[:, 2:].T, names, strict=True):
        for piece in np.flatnonzero(~(error <= tol)):
            sides = " and ".join(str(axis.tour.edge[e]) for e in pieces.element[piece])
            text = f"the disc inside piece {piece}, between edges {sides}, {name} {error[piece] * size:.2g} mm"
            yield Objection.at("piece", text, axis.discs.centre[pieces.disc[piece]].mean(axis=0))


@compiled
def _inner_discs(tour: Tour, element: Ints, low: Floats, high: Floats, ends: Floats) -> Floats:
    """Rows of centre x and y, how deep the boundary enters, and how far the feet are off: (p, 4)."""
    rows = np.empty((len(element), 4))
    for p in range(len(element)):
        rows[p] = _inner_disc(tour, element[p], low[p], high[p], ends[p, 0], ends[p, 1])
    return rows


@compiled
def _inner_disc(tour: Tour, element: Ints, low: Floats, high: Floats, first: Floats, last: Floats) -> Floats:
    """Figures of a disc inside a piece whose end discs (x, y, r) are given; see `_inner_discs`.

    It touches the middle of side 0. Of a piece whose end discs are nearly one, it is the mean of the two; so it is of a
    short piece beside an end at a reflex vertex, whose feet are too near one another to tell the radius. In a wedge,
    which ends in one convex vertex, the one of half the radius is tried too: where two edges turn by 1e-7 only, the
    radius tells the feet. Any disc inside the piece will do.
    """
    e, f = element[0], element[1]
    t = (low[0] + high[0]) / 2
    x, y, r = (first + last) / 2
    figures = _figures(tour, element, low, high, t, (low[1] + high[1]) / 2, x, y, r)
    if np.abs(first - last).sum() >= _SHORT and figures[2:].max() > _INSIDE:
        x, y, r, s = twin_on_stretch(tour, e, t, f, low[1], high[1])
        by_twin = _figures(tour, element, low, high, t, s, x, y, r)
        if by_twin[2:].max() < figures[2:].max():
            figures = by_twin
    if (first[2] == 0.0) != (last[2] == 0.0):
        x, y, r, t, s = _disc_of_radius(tour, e, t, f, (low[1] + high[1]) / 2, max(first[2], last[2]) / 2)
        by_radius = _figures(tour, element, low, high, t, s, x, y, r)
        if by_radius[2:].max() < figures[2:].max():
            figures = by_radius
    return figures


@compiled
def _figures(
    tour: Tour, element: Ints, low: Floats, high: Floats, t: float, s: float, x: float, y: float, r: float
) -> Floats:
    """Figures of one disc with its two feet; see `_inner_discs`."""
    found, _, _, depth = distance_minima(tour, x, y, r, 0.0, NO_SKIP, np.inf)
    deepest = 0.0
    for k in range(found):
        deepest = min(deepest, depth[k])
    off_here = _off_stretch(tour, element[0], t, low[0], high[0], x, y, r)
    off_there = _off_stretch(tour, element[1], s, low[1], high[1], x, y, r)
    return np.array([x, y, -deepest, max(off_here, off_there)])


@compiled
def _disc_of_radius(
    tour: Tour, e: int, t: float, f: int, s: float, r: float
) -> tuple[float, float, float, float, float]:
    """Return the disc of a radius that touches two spans, started from two feet: centre, radius, feet.

    As for a junction: the two equations ``m_i.c = r + m_i.q_i`` are linear in the centre; then each foot moves along
    its tangent to where the centre's foot lies on the circle of curvature.
    """
    x = y = 0.0
    for _ in range(_STEPS):
        ax, ay, mx, my, bend_e, speed_e = site(tour, e, t)
        bx, by, nx, ny, bend_f, speed_f = site(tour, f, s)
        cross = mx * ny - my * nx
        if cross == 0.0 or speed_e == 0.0 or speed_f == 0.0:
            break
        ra, rb = r + mx * ax + my * ay, r + nx * bx + ny * by
        x, y = (ra * ny - rb * my) / cross, (mx * rb - nx * ra) / cross
        move_t = (my * (x - ax) - mx * (y - ay)) / (speed_e * max(1.0 - bend_e * r, _STIFF))
        move_s = (ny * (x - bx) - nx * (y - by)) / (speed_f * max(1.0 - bend_f * r, _STIFF))
        t, s = min(max(t + move_t, 0.0), 1.0), min(max(s + move_s, 0.0), 1.0)
        if max(abs(move_t), abs(move_s)) < _AT_REST:
            break
    return x, y, r, t, s


@compiled
def _off_stretch(tour: Tour, e: int, t: float, low: float, high: float, x: float, y: float, r: float) -> float:
    """How far a disc is from touching a stretch at a place: distance, slant, or how far the place lies outside."""
    qx, qy, nx, ny, _, speed = site(tour, e, t)
    # Where the stretch ends is known as well as the feet of the discs there: to the root of the distance's rounding.
    outside = max(max(low - t, t - high, 0.0) * max(speed, r) - np.sqrt(8 * r * EMPTY), 0.0)
    return max(abs(np.hypot(x - qx, y - qy) - r), abs((x - qx) * nx + (y - qy) * ny - r), outside)
