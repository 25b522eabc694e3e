"""Regular shapes with noise on their coordinates: events that would coincide nearly coincide."""

from collections.abc import Callable

import numpy as np
from catalogue import box, circle, polygon

from mashape_cad.geometry.edge import Arc, Floats, Line
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["SHAPES", "noisy"]


def _regular(count: int) -> Profile:
    angle = 2 * np.pi * np.arange(count) / count
    return Profile.of(polygon([(float(np.cos(a)), float(np.sin(a))) for a in angle]))


def _plus() -> Profile:
    arm = [(3, 1), (1, 1), (1, 3), (-1, 3), (-1, 1), (-3, 1), (-3, -1), (-1, -1), (-1, -3), (1, -3), (1, -1), (3, -1)]
    return Profile.of(polygon([(float(x), float(y)) for x, y in arm]))


def _hole_grid() -> Profile:
    return Profile.of(box(0, 0, 3, 3), [circle(x + 0.5, y + 0.5, 0.25) for x in range(3) for y in range(3)])


SHAPES: dict[str, Callable[[], Profile]] = {
    "24-gon": lambda: _regular(24),
    "64-gon": lambda: _regular(64),
    "plus": _plus,
    "square": lambda: Profile.of(box(0, 0, 1, 1)),
    "hole grid": _hole_grid,
}


def noisy(profile: Profile, level: float, seed: int) -> Profile:
    """Move every vertex of a profile of lines and full circles by up to `level` times its larger side, circles too."""
    rng = np.random.default_rng(seed)
    reach = level * float(np.max(profile.bounds[1] - profile.bounds[0]))

    def shift() -> Floats:
        return rng.uniform(-reach, reach, 2)

    def moved(loop: Loop) -> Loop:
        if isinstance(loop.edges[0], Arc):
            (arc,) = loop.edges
            return Loop((Arc.of(arc.centre + shift(), arc.radius + float(shift()[0])),))
        corners = [edge.start + shift() for edge in loop.edges]
        return Loop(tuple(Line.of(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)))

    return Profile.of(moved(profile.outer), [moved(hole) for hole in profile.holes])
