"""Equal steps along the boundary, whatever its division into edges: `equal_steps`.

What is seen from a place jumps at a corner. So steps are counted from corner to corner, and on a loop without corners
from where the largest disc of a node touches it, farthest from the other nodes: from places that belong to the
shape, not to its file.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.tour import Ints, Tour, loop_count, site
from mashape_cad.signatures.compiled import compiled

__all__ = ["BoundarySteps", "equal_steps"]

# Parts into which a span is cut to measure its length: Simpson's rule on each is good to 1e-6 for spans as files have
# them.
_PARTS = 8
# Least number of steps on a loop, so that a small hole is seen; where there are many loops the steps are shared out.
_LEAST, _FEWEST = 24, 6
# A turn of more than this is a corner, radians: on outlines of many short lines nothing is.
_CORNER = 0.5
# Largest share of steps that corners may take; where there are more they are noise, and ignored.
_MOST_CORNERS = 0.5
# Numbers of steps are rounded here, where no ratio of lengths of a drawing is likely to lie, so that the last digits do
# not decide.
_ROUNDED_AT = 0.4877
# Newton's steps to the place where a part of a span has some length.
_NEWTON = 3
# Parameters this close to the end of an element are the start of the next.
_BORDER = 1e-9
# Radii are equal up to this many digits of the size.
_DIGITS = 9


@dataclass(frozen=True, slots=True, eq=False)
class BoundarySteps:
    """The middles of equal steps of arc length on every loop, in the tour's scale.

    Attributes
    ----------
    element : (n,) array
    t : (n,) array
        Places of the tour.
    point : (n, 2) array
    normal : (n, 2) array
        Inward unit normals.
    loop : (n,) array
        Numbers of the loops.
    weight : (n,) array
        Share of the perimeter that each step is; the sum is 1.
    area : float
        Of the domain.
    """

    element: Ints
    t: Floats
    point: Floats
    normal: Floats
    loop: Ints
    weight: Floats
    area: float


def equal_steps(axis: MedialAxis, count: int) -> BoundarySteps:
    """Divide every loop into equal steps.

    Parameters
    ----------
    axis : MedialAxis
    count : int
        Steps on all loops together, shared out by length; a few more where loops or stretches are short.
    """
    tour = axis.tour
    parts, area = _lengths(tour)
    start = np.append(0.0, np.cumsum(parts.ravel()))
    first = np.searchsorted(tour.loop, np.arange(loop_count(tour) + 1))
    loop_start = start[first * _PARTS]
    begin, width, loop = _stretches(axis, start, first, count)
    length = np.diff(loop_start)
    wanted = np.maximum(np.clip(count // len(length), _FEWEST, _LEAST), count * length / length.sum())
    steps = np.maximum(1, np.floor(width * (wanted / length)[loop] + 1.0 - _ROUNDED_AT)).astype(np.int64)
    number = np.arange(steps.sum()) - np.repeat(np.cumsum(steps) - steps, steps)
    loop = np.repeat(loop, steps)
    along = np.repeat(begin, steps) + (number + 0.5) * np.repeat(width / steps, steps)
    at = loop_start[loop] + np.mod(along - loop_start[loop], length[loop])
    part = np.searchsorted(start, at, side="right") - 1
    rows = _places(tour, part, (at - start[part]) / parts.ravel()[part])
    weight = np.repeat(width / steps, steps) / length.sum()
    # The end of an element is the start of the next one, whatever rounding says: behind it lies another disc's piece.
    ended = rows[:, 0] > 1.0 - _BORDER
    element = np.where(ended, tour.after[part // _PARTS], part // _PARTS)
    t = np.where(ended, 0.0, rows[:, 0])
    return BoundarySteps(element, t, rows[:, 1:3].copy(), rows[:, 3:].copy(), loop, weight, area)


def _stretches(axis: MedialAxis, start: Floats, first: Ints, count: int) -> tuple[Floats, Floats, Ints]:
    """Return where stretches without corners begin (length from the first element), their lengths and loops."""
    corners = np.flatnonzero(_turns(axis.tour) > _CORNER)
    if len(corners) > _MOST_CORNERS * count:
        corners = corners[:0]
    begin, width, loops = [], [], []
    for loop, (low, high) in enumerate(pairwise(first.tolist())):
        mine = corners[(corners >= low) & (corners < high)]
        places = start[mine * _PARTS] if len(mine) else np.array([_touched(axis, start, loop, low)])
        begin.append(places)
        width.append(np.diff(places, append=places[0] + start[high * _PARTS] - start[low * _PARTS]))
        loops.append(np.full(len(places), loop))
    return np.concatenate(begin), np.concatenate(width), np.concatenate(loops)


def _touched(axis: MedialAxis, start: Floats, loop: int, first: int) -> float:
    """Return where the largest disc of a node touches a loop, as length from the first element."""
    tour, contacts = axis.tour, axis.contacts
    element = np.minimum(contacts.first[:, 0].astype(np.int64), len(tour.element) - 1)
    is_node = axis.discs.degree[contacts.disc] != 2  # a disc of two contacts lies inside a branch
    mine = np.flatnonzero((tour.loop[element] == loop) & is_node)
    if not len(mine):
        return float(start[first * _PARTS])
    radius = np.round(axis.discs.radius[contacts.disc[mine]] / axis.frame.size, _DIGITS)
    largest = mine[radius == radius.max()]
    # It touches at several places, whose order a mirror turns round: the one farthest from all nodes is taken.
    away = np.round([_away_from_nodes(axis, int(contact)) for contact in largest], _DIGITS)
    e, t = contacts.first[largest[np.argmax(away)]]
    return float(start[int(e) * _PARTS] + _length_to(tour, int(e), t))


def _away_from_nodes(axis: MedialAxis, contact: int) -> float:
    """Return the sum of the distances from where a disc touches to all nodes."""
    e, t = axis.contacts.first[contact]
    x, y = site(axis.tour, int(e), t)[:2]
    nodes = (axis.nodes.centre - axis.frame.middle) / axis.frame.size
    return float(np.hypot(nodes[:, 0] - x, nodes[:, 1] - y).sum())


@compiled
def _lengths(tour: Tour) -> tuple[Floats, float]:
    """Return the length of each part of each element, (n, _PARTS), and the area."""
    out = np.zeros((len(tour.element), _PARTS))
    area = 0.0
    speed, flux = np.empty(3), np.empty(3)
    for e in range(len(tour.element)):
        if tour.element[e].degree == 0:
            continue
        for k in range(_PARTS):
            for j in range(3):
                x, y, nx, ny, _, speed[j] = site(tour, e, (k + j / 2) / _PARTS)
                flux[j] = -(x * nx + y * ny) * speed[j]
            out[e, k] = (speed[0] + 4 * speed[1] + speed[2]) / (6 * _PARTS)
            area += (flux[0] + 4 * flux[1] + flux[2]) / (12 * _PARTS)
    return out, area


@compiled
def _turns(tour: Tour) -> Floats:
    """Return the angle by which the boundary turns at the start of each span; 0 for cones."""
    out = np.zeros(len(tour.element))
    for e in range(len(tour.element)):
        if tour.element[e].degree == 0:
            continue
        before = tour.element[e].before
        if tour.element[before].degree == 0:
            before = tour.element[before].before
        _, _, nx, ny, _, _ = site(tour, before, 1.0)
        _, _, mx, my, _, _ = site(tour, e, 0.0)
        out[e] = abs(math.atan2(nx * my - ny * mx, nx * mx + ny * my))
    return out


@compiled
def _places(tour: Tour, part: Ints, share: Floats) -> Floats:
    """Return parameter, point and normal up to which a share of a part's length lies: (n, 5)."""
    out = np.empty((len(part), 5))
    for k in range(len(part)):
        e, number = part[k] // _PARTS, part[k] % _PARTS
        a, b, c = _speed(tour, e, number)
        wanted = share[k] * (a + b / 2 + c / 3)
        x = share[k]
        for _ in range(_NEWTON):
            slope = a + b * x + c * x * x
            if slope <= 0.0:
                break
            x = min(max(x - (a * x + b * x * x / 2 + c * x**3 / 3 - wanted) / slope, 0.0), 1.0)
        out[k, 0] = min((number + x) / _PARTS, 1.0)
        out[k, 1], out[k, 2], out[k, 3], out[k, 4], _, _ = site(tour, e, out[k, 0])
    return out


@compiled
def _length_to(tour: Tour, e: int, t: float) -> float:
    """Return the length of an element up to a parameter."""
    total = 0.0
    for part in range(_PARTS):
        x = min(max(t * _PARTS - part, 0.0), 1.0)
        if x > 0.0 and tour.element[e].degree > 0:
            a, b, c = _speed(tour, e, part)
            total += (a * x + b * x * x / 2 + c * x**3 / 3) / _PARTS
    return total


@compiled
def _speed(tour: Tour, e: int, part: int) -> tuple[float, float, float]:
    """Return the parabola a + b x + c x^2 that the speed is taken for on a part, x from 0 to 1."""
    v0 = site(tour, e, part / _PARTS)[5]
    v1 = site(tour, e, (part + 0.5) / _PARTS)[5]
    v2 = site(tour, e, (part + 1) / _PARTS)[5]
    return v0, -3 * v0 + 4 * v1 - v2, 2 * v0 - 4 * v1 + 2 * v2
