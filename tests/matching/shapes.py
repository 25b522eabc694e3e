"""Profiles that are laid over one another in several tests."""

import numpy as np
from catalogue import box, circle, polygon

from mashape_cad.geometry.edge import Arc, BSpline, Line, Similarity
from mashape_cad.geometry.profile import Loop, Profile

TAU = 2 * np.pi
# A turn and a move that nothing about the shapes prefers.
ELSEWHERE = Similarity.of(1.0, 1.234, (70.0, -31.0))
MIRRORED = Similarity.of(1.0, -0.77, (12.0, 5.0), mirror=True)


def bracket(*, hole=(55.0, 9.0), radius=4.0, corner=80.0) -> Profile:
    """An L with three holes of different sizes: no symmetry at all."""
    outer = polygon([(0, 0), (corner, 0), (corner, 18), (20, 18), (20, 50), (0, 50)])
    return Profile.of(outer, [circle(10, 9, 5.0), circle(10, 38, 3.0), circle(*hole, radius)])


def plate(width=100.0, height=60.0) -> Profile:
    """A rectangle, its own mirror image."""
    return Profile.of(box(0, 0, width, height))


def flange(count=6, *, odd=0.0) -> Profile:
    """A disc with a bore and holes on a circle, one of them larger by `odd` mm: turned into itself otherwise."""
    angles = TAU * np.arange(count) / count
    holes = [circle(30 * np.cos(a), 30 * np.sin(a), 4.0 + odd * (k == 2)) for k, a in enumerate(angles)]
    return Profile.of(circle(0, 0, 42.0), [circle(0, 0, 12.0), *holes])


def gear(teeth=14, *, keyway=0.0) -> Profile:
    """A gear of straight teeth that lean to one side, with a keyway in its bore if asked."""
    step = TAU / teeth
    corners = [
        (r * np.cos(k * step + a * step), r * np.sin(k * step + a * step))
        for k in range(teeth)
        for r, a in ((40, 0.0), (40, 0.45), (50, 0.6), (50, 0.9))
    ]
    if not keyway:
        return Profile.of(polygon(corners), [circle(0, 0, 10.0)])
    half = float(np.arcsin(2.0 / 10.0))
    x = 10 * np.cos(half)
    bore = Loop(
        (
            Arc.of((0, 0), 10.0, half, TAU - 2 * half),
            Line.of((x, -2), (10 + keyway, -2)),
            Line.of((10 + keyway, -2), (10 + keyway, 2)),
            Line.of((10 + keyway, 2), (x, 2)),
        )
    )
    return Profile.of(polygon(corners), [bore])


def blob() -> Profile:
    """One closed spline without symmetry."""
    poles = [(0, 0), (30, -8), (55, 4), (60, 30), (34, 24), (20, 44), (-4, 36), (0, 0)]
    return Profile.of(Loop((BSpline.of(3, [0] * 4 + [1, 2, 3, 4] + [5] * 4, poles),)))


def with_edges_cut(profile: Profile) -> Profile:
    """The same with every edge cut in two, each loop begun elsewhere."""
    loops = []
    for loop in profile.loops:
        halves = [part for edge in loop.edges for part in edge.split(0.37)]
        loops.append(Loop(tuple(halves[1:] + halves[:1])))
    return Profile.of(loops[0], loops[1:])


def as_polylines(profile: Profile, count=500) -> Profile:
    """Each loop as a polyline of points evenly along it, corners cut."""
    loops = []
    for loop in profile.loops:
        points = np.concatenate([edge.flattened(400)[:-1] for edge in loop.edges])
        closed = np.concatenate([points, points[:1]])
        along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
        places = (np.arange(count) + 0.3) * along[-1] / count
        loops.append(polygon(np.column_stack([np.interp(places, along, closed[:, k]) for k in (0, 1)]).tolist()))
    return Profile.of(loops[0], loops[1:])


SHAPES = {"bracket": bracket, "plate": plate, "flange": flange, "gear": gear, "blob": blob}
