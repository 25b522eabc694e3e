"""Light pictures of profiles: few points, integers on a grid, good to about 1/2000 of the larger side.

For pictures, and for finding portions that parts have in common; whether parts are the same is computed from exact
curves alone.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mashape_cad.geometry.edge import Edge, Floats, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.library.record import Thumbnail

__all__ = ["exact_bounds", "thumbnail"]

# 1/5000 of the larger side is finer than a screen is wide; a finer grid costs digits in every sidecar.
GRID = 5000
# Largest distance, in grid steps, of a point left out from the chord that replaces it. At 2 facets show on a large
# picture; below 0.5 the rounding to the grid brings them back. A point costs about ten bytes in the sidecar.
_SLACK = 0.8
# Points per Bezier span before thinning: on a quarter circle the chord is off by 1/3300 of the radius.
_PER_SPAN = 32
# Halvings of an interval of 1/16 span: the parameter is good to 6e-8, an extreme value to the square of that.
_HALVINGS = 20


def exact_bounds(loop: Loop) -> Floats:
    """Return the bounding box of a loop, mm: ((xmin, ymin), (xmax, ymax)), good to 1e-12 of the size."""
    points = np.concatenate([_extreme_points(edge) for edge in loop.edges])
    return np.array([points.min(axis=0), points.max(axis=0)])


def thumbnail(profile: Profile, bounds: Floats, branches: Sequence[Floats] = ()) -> Thumbnail:
    """Return the light picture of a profile and its axis.

    Parameters
    ----------
    profile : Profile
    bounds : (2, 2) array
        Its box, mm.
    branches : sequence of (n, 3) arrays
        Points of the axis with their radii, from node to node, mm; closely spaced.
    """
    pitch = float(np.max(bounds[1] - bounds[0])) / GRID
    rings = [_thinned_ring((_flattened(loop) - bounds[0]) / pitch) for loop in profile.loops]
    runs = [_thinned((branch - [*bounds[0], 0.0]) / pitch) for branch in branches]
    return Thumbnail(
        corner=(float(bounds[0, 0]), float(bounds[0, 1])),
        pitch=pitch,
        loops=tuple(_on_grid(ring) for ring in rings),
        branches=tuple(_on_grid(run) for run in runs),
    )


def _flattened(loop: Loop) -> Floats:
    return np.concatenate([edge.flattened(1 if isinstance(edge, Line) else _PER_SPAN)[:-1] for edge in loop.edges])


def _thinned_ring(points: Floats) -> Floats:
    return _thinned(np.concatenate([points, points[:1]]))[:-1]


def _thinned(points: Floats) -> Floats:
    """Leave out points that lie within `_SLACK` of the chord over them (Ramer 1972, Douglas and Peucker 1973)."""
    kept = np.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        if last <= first + 1:
            continue
        away = _distances_to_chord(points[first + 1 : last], points[first], points[last])
        farthest = int(np.argmax(away))
        if away[farthest] > _SLACK:
            middle = first + 1 + farthest
            kept[middle] = True
            spans += [(first, middle), (middle, last)]
    return points[kept]


def _distances_to_chord(points: Floats, start: Floats, end: Floats) -> Floats:
    chord = end - start
    length_sq = float(chord @ chord)
    along = (points - start) @ chord / length_sq if length_sq > 0 else np.zeros(len(points))
    return np.linalg.norm(points - start - np.clip(along, 0.0, 1.0)[:, None] * chord, axis=1)


def _on_grid(points: Floats) -> tuple[int, ...]:
    return tuple(np.rint(points).astype(int).ravel().tolist())


def _extreme_points(edge: Edge) -> Floats:
    """Return ends, span ends and all points with a horizontal or vertical tangent."""
    if isinstance(edge, Line):
        return np.array([edge.start, edge.end])
    _, breaks = edge.spans()
    u = np.unique(np.concatenate([np.linspace(*span, 17) for span in pairwise(breaks)]))
    slopes = edge.derivatives(u)[:, 1]
    turns = [_zeros(edge, axis, u, slopes[:, axis]) for axis in (0, 1)]
    return edge.point(np.concatenate([u, *turns]))


def _zeros(edge: Edge, axis: int, u: Floats, slope: Floats) -> Floats:
    """Return where one component of the tangent changes sign, by halving all intervals at once."""
    change = np.flatnonzero(slope[:-1] * slope[1:] < 0)
    low, high, sign = u[change], u[change + 1], np.sign(slope[change])
    if not len(low):
        return low
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        below = np.sign(edge.derivatives(middle)[:, 1, axis]) == sign
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return (low + high) / 2
