"""Discs that tie every hole to another loop, so that cutting along them leaves simply connected faces.

At the highest point of a hole, in any fixed direction, the maximal disc lies above the hole; so it touches another
loop, whose own highest point is higher still. One such disc for each hole links all loops without a cycle.
"""

import math

import numpy as np

from mashape_cad.medial.disc import maximal_disc
from mashape_cad.medial.ends import Place, SettledDisc
from mashape_cad.medial.tour import Tour, site

__all__ = ["links"]

# Any direction serves; a crooked one seldom meets the symmetries of drawings, where discs have more than two contacts.
_UP = (math.cos(1.1), math.sin(1.1))


def links(tour: Tour) -> list[SettledDisc]:
    """Return one disc for each hole, touching it and another loop."""
    discs = []
    for loop in range(1, int(tour.loop.max()) + 1):
        place = _highest(tour, loop)
        x, y, r, ok, count, element, t = maximal_disc(tour, *place)
        if ok and count:
            places = [place, *((int(element[k]), float(t[k])) for k in range(count))]
            discs.append(SettledDisc(x, y, r, tuple((p, p) for p in places), "station"))
    return discs


def _highest(tour: Tour, loop: int) -> Place:
    """Place of a hole that is highest in direction `_UP`, with its normal in that direction."""
    elements = np.flatnonzero(tour.loop == loop)
    best: tuple[float, Place] = (-math.inf, (int(elements[0]), 0.0))
    for e in elements.tolist():
        t = _highest_on_cone(tour, e) if tour.degree[e] == 0 else _highest_on_span(tour, e)
        if t is not None:
            x, y, *_ = site(tour, e, t)
            # A cone wins over the ends of its neighbours: only its normals include the direction.
            height = _UP[0] * x + _UP[1] * y + (1e-12 if tour.degree[e] == 0 else 0.0)
            best = max(best, (height, (e, t)))
    return best[1]


def _highest_on_cone(tour: Tour, e: int) -> float | None:
    """Parameter at which a cone's normal points up, if it does."""
    middle = tour.cone[e, 1] / 2
    turned = math.remainder(math.atan2(_UP[1], _UP[0]) - tour.cone[e, 0] - middle, 2 * math.pi) + middle
    t = turned / tour.cone[e, 1]
    return t if 0.0 < t < 1.0 else None


def _highest_on_span(tour: Tour, e: int, count: int = 32) -> float | None:
    """Parameter of a span's highest interior point; its start if that is highest; None if its end is."""

    def climb(t: float) -> float:
        _, _, nx, ny, _, _ = site(tour, e, t)
        return float(ny * _UP[0] - nx * _UP[1])  # tangent . up

    steps = np.linspace(0.0, 1.0, count + 1)
    heights = [_UP[0] * x + _UP[1] * y for x, y, *_ in (site(tour, e, t) for t in steps)]
    k = int(np.argmax(heights))
    if k == count:
        return None
    low, high = float(steps[max(k - 1, 0)]), float(steps[k + 1])
    if climb(low) <= 0.0 or climb(high) >= 0.0:
        return 0.0 if k == 0 else float(steps[k])
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if climb(middle) > 0.0 else (low, middle)
    return (low + high) / 2
