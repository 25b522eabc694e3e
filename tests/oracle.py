"""The medial axis by its definition, slowly: maximal discs by brute force, and the area that discs cover.

Independent of how the axis is computed: boundary curves are sampled and minimised through `Edge` alone.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import shapely
from scipy.optimize import minimize_scalar
from scipy.spatial import cKDTree

from mashape_cad.geometry.edge import Edge, Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import KernelCurve
from mashape_cad.medial.branch import BranchSamples, contact_before, discs_on_piece, sampled_branches
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.tour import site

_PER_SPAN = 96
# What lies this close beside a place (spans) tells of its radius no more than the curvature there.
_BESIDE = 5e-4


class Oracle:
    """A boundary in dense samples, asked for the maximal disc at any of its places."""

    def __init__(self, profile: Profile) -> None:
        self.profile = profile
        self.curves = [KernelCurve(edge) for edge in profile.edges]
        self.u = [_parameters(edge) for edge in profile.edges]
        self.points = [edge.point(u) for edge, u in zip(profile.edges, self.u, strict=True)]
        self.beside = _neighbours(profile)

    def radius(self, number: int, u: float) -> float:
        """Radius of the maximal disc at a place: min |q - p|^2 / (2 n.(q - p)), at most the radius of curvature."""
        point, tangent = self.profile.edges[number].derivatives([u])[0, :2]
        normal = np.array([-tangent[1], tangent[0]]) / np.hypot(*tangent)
        bend = float(self.curves[number].curvature([u])[0])
        best = 1 / bend if bend > 0 else np.inf
        # Next to a vertex samples say little of how low the valley between them is.
        valleys = sorted(self._valleys(point, normal), key=lambda row: (row[1] not in self.beside[number], row[0]))
        for value, e, low, high in valleys:
            if value > 2 * best and e not in self.beside[number]:
                break
            # Right at p the quotient is 0 / 0; what it tends to is the radius of curvature, which is counted already.
            beside = _BESIDE * self._width_of_span(number, u)
            skip = (u - beside, u + beside) if e == number else (2.0, 2.0)
            best = min(best, self._refined(point, normal, e, (low, high), skip))
        return best

    def _width_of_span(self, number: int, u: float) -> float:
        """Of the span that holds a place of an edge; spans of a kink that is rounded in a spline are short."""
        _, breaks = self.profile.edges[number].spans()
        k = int(np.clip(np.searchsorted(breaks, u), 1, len(breaks) - 1))
        return float(breaks[k] - breaks[k - 1])

    def disc(self, number: int, u: float) -> Floats:
        """Centre and radius of the maximal disc at a place: (3,)."""
        point, tangent = self.profile.edges[number].derivatives([u])[0, :2]
        r = self.radius(number, u)
        return np.append(point + r * np.array([-tangent[1], tangent[0]]) / np.hypot(*tangent), r)

    def _valleys(self, point: Floats, normal: Floats) -> Iterator[tuple[float, int, float, float]]:
        """Yield local minima of the samples: value, edge, and the parameters between which the true one lies."""
        for e, (u, points) in enumerate(zip(self.u, self.points, strict=True)):
            f = _radius(point, normal, points)
            padded = np.concatenate([[np.inf], f, [np.inf]])
            low = np.flatnonzero(np.isfinite(f) & (f <= padded[:-2]) & (f <= padded[2:]))
            for k in low:
                yield float(f[k]), e, float(u[max(k - 1, 0)]), float(u[min(k + 1, len(u) - 1)])

    def _refined(
        self, point: Floats, normal: Floats, e: int, ends: tuple[float, float], skip: tuple[float, float]
    ) -> float:
        """Smallest value between two parameters, by finer and finer samples: a tiny edge makes a tiny valley."""
        edge, (low, high) = self.profile.edges[e], ends
        for _ in range(5):
            grid = np.linspace(low, high, 33)
            grid = grid[(grid < skip[0]) | (grid > skip[1])]
            if not len(grid):
                return np.inf
            f = _radius(point, normal, edge.point(grid))
            k = int(np.argmin(f))
            low, high = float(grid[max(k - 1, 0)]), float(grid[min(k + 1, len(grid) - 1)])
        if high - low < 1e-13 or (low < skip[1] and high > skip[0]):
            return float(f.min())
        found = minimize_scalar(
            lambda t: float(_radius(point, normal, edge.point([t]))[0]),
            bounds=(low, high),
            method="bounded",
            options={"xatol": 1e-13},
        )
        return min(float(f.min()), float(found.fun))


def _neighbours(profile: Profile) -> list[set[int]]:
    """Each edge with those before and after it on its loop."""
    first, found = 0, []
    for loop in profile.loops:
        count = len(loop.edges)
        found += [{first + (k + step) % count for step in (-1, 0, 1)} for k in range(count)]
        first += count
    return found


def _radius(point: Floats, normal: Floats, others: Floats) -> Floats:
    way = others - point
    height = way @ normal
    # Of points no further off than rounding nothing can be told.
    square = np.einsum("ij,ij->i", way, way)
    telling = height > 1e-12 * np.abs(point).max() + 1e-300
    return np.where(telling, square / (2 * np.where(telling, height, 1.0)), np.inf)


def _parameters(edge: Edge) -> Floats:
    _, breaks = edge.spans()
    inner = np.arange(_PER_SPAN) / _PER_SPAN
    return np.append((breaks[:-1, None] + inner * np.diff(breaks)[:, None]).ravel(), 1.0)


def check_definition(profile: Profile, axis: MedialAxis, seed: int, count: int) -> None:
    """At random places of the boundary the axis has the disc that brute force finds, on one of its branches."""
    oracle, diagonal = Oracle(profile), profile.diagonal
    step, tol = diagonal / 50, 1e-10 * diagonal + float(axis.discs.tolerance.max())
    tree = cKDTree(samples_of(sampled_branches(axis, step))[:, :2] if axis.branches else axis.nodes.centre)
    for element, t, number, u in random_places(axis, np.random.default_rng(seed), count):
        expected = oracle.disc(number, u)
        actual, twin = disc_of_axis(axis, element, t)
        assert np.max(np.abs(actual - expected)) <= 1e-6 * diagonal
        assert abs(np.hypot(*(twin - actual[:2])) - actual[2]) <= tol
        assert tree.query(expected[:2])[0] <= step


def check_densely(profile: Profile, axis: MedialAxis, per_span: int = 7) -> None:
    """All over the boundary the axis has a disc that touches there and elsewhere, or osculates, and holds no boundary.

    A disc that touches a place is at most as large as the maximal one there if no boundary lies inside it, and at least
    as large if it touches elsewhere. Samples stand for the boundary inside.
    """
    tour, frame, diagonal = axis.tour, axis.frame, profile.diagonal
    element = np.repeat(np.flatnonzero(tour.degree > 0), per_span)
    share = (np.arange(per_span) + 0.5) / per_span
    t = np.tile(share + 0.02 * np.sin(40 * share), len(element) // per_span)  # uneven: symmetric places coincide
    places = np.array([site(tour, int(e), float(at)) for e, at in zip(element, t, strict=True)])
    point, normal = places[:, :2] * frame.size + frame.middle, places[:, 2:4]
    discs, twin, tol = _discs_at(axis, element, t)
    boundary = np.concatenate([edge.point(_parameters(edge)) for edge in profile.edges])
    accuracy = 1e-9 * diagonal + tol
    assert np.all(discs[:, 2] >= 0)
    assert np.all(np.abs(point + discs[:, 2:] * normal - discs[:, :2]).max(axis=1) <= accuracy)
    assert np.all(cKDTree(boundary).query(discs[:, :2])[0] >= discs[:, 2] - accuracy)
    assert np.all(np.abs(np.linalg.norm(twin - discs[:, :2], axis=1) - discs[:, 2]) <= accuracy)
    # Two contacts close together say little: a disc through both has this radius; one that touches but once osculates.
    way, r = twin - point, discs[:, 2]
    apart = np.linalg.norm(way, axis=1)
    close = (apart <= 1e-3 * r) & (apart >= 1e-6 * diagonal)
    height = np.einsum("ij,ij->i", way, normal)[close]
    assert np.all(apart[close] ** 2 <= 2 * r[close] * height * (1 + 1e-2))
    together = apart < np.minimum(1e-3 * r, 1e-6 * diagonal)
    assert np.all(places[together, 4] / frame.size * r[together] >= 1 - 1e-2)


def _discs_at(axis: MedialAxis, element: np.ndarray, t: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the axis' discs at places of its tour, (n, 3), the twins, (n, 2), and what is on record of them, mm."""
    contact, on_arc = contact_before(axis, element, t)
    disc, size, middle = axis.contacts.disc[contact], axis.frame.size, axis.frame.middle
    found = np.column_stack([axis.discs.centre[disc], axis.discs.radius[disc]])
    twin, tol = axis.discs.foot[disc, 1].copy(), axis.discs.tolerance[disc].copy()
    piece, side = axis.contacts.piece[contact], axis.contacts.side[contact]
    for k in np.unique((2 * piece + side)[~on_arc]).tolist():
        here = np.flatnonzero((2 * piece + side == k) & ~on_arc)
        rows = discs_on_piece(axis, k // 2, t[here], k % 2)
        found[here] = rows[:, :3] * size
        found[here, :2] += middle
        other = int(axis.pieces.element[k // 2, 1 - k % 2])
        twin[here] = np.array([site(axis.tour, other, float(at))[:2] for at in rows[:, 3]]) * size + middle
        tol[here] = axis.discs.tolerance[axis.pieces.disc[k // 2]].max()
    return found, twin, tol


def check_restored(profile: Profile, axis: MedialAxis) -> None:
    """What the discs of all branches cover is the profile, no more and no less: nothing of the axis is missing."""
    outline = shapely.Polygon(profile.outer.flattened(200), [hole.flattened(200) for hole in profile.holes])
    restored = covered(axis, profile.diagonal / 90)  # what tangents between neighbours miss falls with the square
    assert outline.symmetric_difference(restored).area <= 2e-3 * outline.area


def disc_of_axis(axis: MedialAxis, element: int, t: float) -> tuple[Floats, Floats]:
    """Return the disc that the axis gives for a place of its tour, and the twin of the place, mm: (3,), (2,)."""
    contact, on_arc = contact_before(axis, np.array([element]), np.array([t]))
    number, size, middle = int(contact[0]), axis.frame.size, axis.frame.middle
    if on_arc[0]:
        disc = axis.contacts.disc[number]
        return np.append(axis.discs.centre[disc], axis.discs.radius[disc]), axis.discs.foot[disc, 1]
    piece, side = int(axis.contacts.piece[number]), int(axis.contacts.side[number])
    x, y, r, twin = discs_on_piece(axis, piece, np.array([t]), side)[0]
    other = np.array(site(axis.tour, int(axis.pieces.element[piece, 1 - side]), twin)[:2])
    return np.append(np.array([x, y]) * size + middle, r * size), other * size + middle


def random_places(axis: MedialAxis, rng: np.random.Generator, count: int) -> Iterator[tuple[int, float, int, float]]:
    """Yield places inside spans, as (element, t) of the tour and as (edge, u)."""
    tour, edges = axis.tour, axis.profile.edges
    spans = np.flatnonzero(tour.degree > 0)
    for element in rng.choice(spans, count):
        t = float(rng.uniform(0.02, 0.98))
        place = np.array(site(tour, int(element), t)[:2]) * axis.frame.size + axis.frame.middle
        number = int(tour.edge[element])
        u = _parameter_of(edges[number], place, float(tour.edge_from[element]), float(tour.edge_to[element]))
        yield int(element), t, number, u


def _parameter_of(edge: Edge, place: Floats, low: float, high: float) -> float:
    """Parameter of a point that lies on an edge between two parameters: the root of q'(q - point)."""
    u = np.linspace(low, high, 129)
    k = int(np.argmin(np.linalg.norm(edge.point(u) - place, axis=1)))
    at = float(u[k])
    for _ in range(30):
        point, tangent, second = edge.derivatives([at])[0]
        slope = tangent @ tangent + second @ (point - place)
        at = float(np.clip(at - tangent @ (point - place) / slope, low, high))
    return at


def covered(axis: MedialAxis, step: float) -> shapely.Geometry:
    """Area that the discs of sampled branches cover; between neighbours, what their common tangents enclose."""
    parts = []
    for run in sampled_branches(axis, step):
        discs = [shapely.Point(c).buffer(r, 64) for c, r in zip(run.centre, run.radius, strict=True)]
        parts += [shapely.union(a, b).convex_hull for a, b in pairwise(discs)]
    if not axis.branches:
        parts = [shapely.Point(axis.nodes.centre[0]).buffer(axis.nodes.radius[0], 256)]
    return shapely.union_all(parts)


def samples_of(runs: tuple[BranchSamples, ...]) -> Floats:
    """Stack branches: (n, 3), centre and radius."""
    return np.concatenate([np.column_stack([run.centre, run.radius]) for run in runs])
