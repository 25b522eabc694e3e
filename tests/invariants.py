"""What holds for every medial axis, whatever the profile: `check_axis`.

Measured on the curves themselves: by `Edge`, and by the kernel's own evaluation and distance. Nothing of what the axis
was computed from (its tour, its scale) is used, only what it hands out.
"""

import math

import numpy as np
import pytest
import shapely

from mashape_cad.geometry.edge import Edge, Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery, KernelCurve
from mashape_cad.medial.branch import sampled_branches
from mashape_cad.medial.graph import MedialAxis

# Relative to the diagonal: what is promised is 1e-7, what is reached is 1e-15 to 1e-13.
ACCURACY = 1e-10
# Normals (radians): feet of discs that follow the boundary closely are known to the root of the distance's rounding.
_ANGLE = 2e-4
# Turns (radians): below the first one all joins are smooth, above the second all are vertices. Between them splines
# that were rounded by a file are mended; see docs/medial-axis.md.
_SMOOTH, _SHARP = 5e-8, 1e-5


def check_axis(profile: Profile, axis: MedialAxis, accuracy: float = ACCURACY) -> None:
    """Check all that can be said of an axis without knowing it.

    Parameters
    ----------
    profile : Profile
    axis : MedialAxis
    accuracy : float
        Relative to the diagonal; discs that carry a tolerance of their own are given that much more.
    """
    tol = accuracy * profile.diagonal + axis.discs.tolerance
    check_discs(profile, axis, tol)
    check_feet(profile, axis, tol)
    check_graph(profile, axis)
    check_ends(profile, axis)
    check_branches(profile, axis, float(tol.max()))


def check_discs(profile: Profile, axis: MedialAxis, tol: Floats) -> None:
    """Every disc lies inside, and its radius is the kernel's distance from its centre to the boundary."""
    discs = axis.discs
    measured = DistanceQuery(profile).distances(discs.centre)
    assert np.all(np.abs(measured - discs.radius) <= tol)
    assert np.all(np.abs(measured - discs.clearance) <= 1e-14 * profile.diagonal)
    outline, error = _flattened(profile)
    inner = discs.radius > error
    assert np.all(shapely.contains_xy(outline, *discs.centre[inner].T))
    assert np.all(discs.radius >= 0)


def check_feet(profile: Profile, axis: MedialAxis, tol: Floats) -> None:
    """Footpoints lie on their edges, as `Edge` and as the kernel see them, one radius from the centre, at right angles.

    The spoke points to the left of the boundary; at a vertex it lies between the normals of both sides.
    """
    discs, edges, diagonal = axis.discs, profile.edges, profile.diagonal
    curves = [KernelCurve(edge) for edge in edges]
    for k, centre in enumerate(discs.centre):
        for foot, number, u in zip(discs.foot[k], discs.foot_edge[k], discs.foot_u[k], strict=True):
            ours, kernels = edges[number].point([u])[0], curves[number].derivatives([u])[0, 0]
            assert np.hypot(*(ours - foot)) <= 1e-9 * diagonal
            assert np.hypot(*(kernels - foot)) <= 1e-9 * diagonal
            assert abs(np.hypot(*(centre - foot)) - discs.radius[k]) <= tol[k] + 1e-12 * diagonal
            if discs.radius[k] > 1e-6 * diagonal:
                assert _is_normal(profile, int(number), float(u), (centre - foot) / discs.radius[k])


def check_graph(profile: Profile, axis: MedialAxis) -> None:
    """Connected, as many cycles as holes, degrees as branches meet, and the sum that counts junctions against ends."""
    nodes, branches, holes = axis.nodes, axis.branches, len(profile.holes)
    meeting = np.bincount([n for b in branches for n in (b.start, b.end)], minlength=len(nodes.degree))
    assert np.array_equal(meeting, nodes.degree)
    assert axis.components == 1
    assert axis.cycles == holes == len(branches) - len(nodes.degree) + 1
    names = {0: "disc", 1: "end", 2: "seam"}
    assert nodes.kind == tuple(names.get(int(d), "junction") for d in nodes.degree)
    assert np.array_equal(nodes.centre, axis.discs.centre[nodes.disc])
    assert np.array_equal(nodes.radius, axis.discs.radius[nodes.disc])
    if nodes.kind == ("disc",):
        return
    ends = nodes.kind.count("end")
    assert sum(int(d) - 2 for d in nodes.degree if d > 2) == ends + 2 * holes - 2


def check_ends(profile: Profile, axis: MedialAxis) -> None:
    """Ends are the convex vertices, each once, and discs whose radius is the radius of curvature at their foot."""
    nodes, discs = axis.nodes, axis.discs
    is_end = np.array([kind == "end" for kind in nodes.kind])
    sharp = nodes.centre[is_end & (nodes.radius == 0.0)]
    for vertices, found in ((convex_vertices(profile, _SHARP), sharp), (sharp, convex_vertices(profile, _SMOOTH))):
        apart = np.linalg.norm(vertices[:, None] - found[None], axis=2).min(axis=1, initial=np.inf)
        assert np.all(apart <= 1e-9 * profile.diagonal)
    assert len(np.unique(sharp, axis=0)) == len(sharp)
    for node in np.flatnonzero(is_end & (nodes.radius > 0.0)):
        disc = nodes.disc[node]
        bends = [_curvature(profile, int(discs.foot_edge[disc, k]), float(discs.foot_u[disc, k])) for k in (0, 1)]
        # Curvature is a quotient of two derivatives, and less sure than the disc.
        assert max(bends) * nodes.radius[node] == pytest.approx(1.0, abs=1e-6)


def check_branches(profile: Profile, axis: MedialAxis, tol: float) -> None:
    """Sampled branches begin and end at their nodes, keep to the step, and their radii are the kernel's distances."""
    step = profile.diagonal / 40
    query = DistanceQuery(profile)
    sampled = sampled_branches(axis, step)
    assert len(sampled) == len(axis.branches)
    for branch, run in zip(axis.branches, sampled, strict=True):
        for node, at in ((branch.start, 0), (branch.end, -1)):
            assert np.array_equal(run.centre[at], axis.nodes.centre[node])
            assert run.radius[at] == axis.nodes.radius[node]
        chords = np.hypot(*np.diff(run.centre, axis=0).T)
        assert chords.max() <= step * (1 + 1e-9)
        # The clearance changes no faster than the centre moves.
        assert np.all(np.abs(np.diff(run.radius)) <= chords + 2 * tol)
        assert np.max(np.abs(query.distances(run.centre) - run.radius)) <= 2 * tol


def convex_vertices(profile: Profile, turn: float) -> Floats:
    """Points where the boundary turns left by more than an angle: (n, 2)."""
    found = []
    for loop in profile.loops:
        for before, after in zip((loop.edges[-1], *loop.edges[:-1]), loop.edges, strict=True):
            u, v = _tangent(before, 1.0), _tangent(after, 0.0)
            if np.arctan2(u[0] * v[1] - u[1] * v[0], u @ v) > turn:
                found.append(after.start)
    return np.array(found).reshape(-1, 2)


def _flattened(profile: Profile) -> tuple[shapely.Polygon, float]:
    """Return the profile as a polygon, and how far at most it is off, roughly."""
    loops = [loop.flattened(32) for loop in profile.loops]
    outline = shapely.Polygon(loops[0], loops[1:])
    sag = max(_sag(edge) for edge in profile.edges)
    return outline, 2 * sag + 1e-9 * profile.diagonal


def _sag(edge: Edge) -> float:
    fine = edge.flattened(64)
    chords = edge.flattened(32)
    return float(np.max(np.hypot(*(fine[1::2] - (chords[1:] + chords[:-1]) / 2).T)))


def _tangent(edge: Edge, u: float) -> Floats:
    derivative = edge.derivatives([u])[0, 1]
    return derivative / np.hypot(*derivative)


def _sides(profile: Profile, number: int, u: float) -> tuple[tuple[int, float], tuple[int, float]]:
    """The place itself, seen from before and from behind: two edges at a vertex."""
    first = 0
    for loop in profile.loops:
        count = len(loop.edges)
        if number < first + count:
            break
        first += count
    if u <= 1e-9:
        return (first + (number - first - 1) % count, 1.0), (number, 0.0)
    if u >= 1 - 1e-9:
        return (number, 1.0), (first + (number - first + 1) % count, 0.0)
    return (number, u), (number, u)


def _is_normal(profile: Profile, number: int, u: float, spoke: Floats) -> bool:
    """Whether a spoke lies between the inward normals of both sides of a place."""
    edges = profile.edges
    tangents = [_tangent(edges[e], at) for e, at in _sides(profile, number, u)]
    angles = [np.arctan2(t[0] * spoke[1] - t[1] * spoke[0], t @ spoke) - np.pi / 2 for t in tangents]
    before, after = (math.remainder(angle, math.tau) for angle in angles)
    return before <= _ANGLE and after >= -_ANGLE  # going round a reflex vertex normals turn clockwise


def _curvature(profile: Profile, number: int, u: float) -> float:
    """The kernel's curvature, the larger one where two edges meet."""
    return max(float(KernelCurve(profile.edges[e]).curvature([at])[0]) for e, at in _sides(profile, number, u))
