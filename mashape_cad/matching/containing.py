"""What two outlines have in common: the portion of one that occurs in the other as well.

A pair of frames that look alike (`frames`) says how one outline would have to be laid over the other. Whether the
outlines then agree is seen from their stations: those that come to lie on the other outline, running the same way, in
stretches long enough not to be chance. A few rounds of point-to-tangent least squares (Chen and Medioni 1992) over what
agrees make the placement precise.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from mashape_cad.geometry.edge import Floats, Similarity, frozen
from mashape_cad.matching.frames import Frames
from mashape_cad.matching.portion import Portion

__all__ = ["Contour", "common_portion"]

# Stations on all loops of an outline together.
_STATIONS = 400
# Half a station's weight is its share of the length, half its share of the turning: a straight line is like any other.
# Deviations, in sizes of the query, within which stations agree: in the first rounds, and in the last.
_NEAR = (0.03, 0.02, 0.01, 0.01)
# Outlines run the same way if their normals differ by less (cosine).
_SAME_WAY = np.cos(np.radians(20.0))
# A stretch that agrees but weighs less is chance.
_CHANCE = 0.05
# Pairs of frames that are tried for two outlines: the most alike first.
_TRIED = 16
# Of these the most promising are refined.
_KEPT = 3
# A change of scale beyond this ratio in one refinement leads astray.
_WILD = 1.3


@dataclass(frozen=True, slots=True, eq=False)
class Contour:
    """An outline as stations, evenly along its loops.

    Attributes
    ----------
    point, normal : (n, 2) arrays
        mm; the normals point inwards.
    weight : (n,) array
        How much of the outline each stands for, of 1 in all.
    loop : (n,) array
        Number of its loop.
    size : float
        Diagonal of the box, mm.
    """

    point: Floats
    normal: Floats
    weight: Floats
    loop: NDArray[np.intp]
    size: float

    @classmethod
    def of(cls, loops: Sequence[Floats]) -> "Contour":
        """Place stations on closed polylines (n, 2), mm: the outer one counter-clockwise, holes clockwise."""
        rings = [np.concatenate([loop, loop[:1]]) for loop in loops]
        lengths = [float(np.hypot(*np.diff(ring, axis=0).T).sum()) for ring in rings]
        parts = [
            _evenly(ring, max(8, round(_STATIONS * n / sum(lengths)))) for ring, n in zip(rings, lengths, strict=True)
        ]
        point = np.concatenate(parts)
        loop = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
        tangents = [np.roll(part, -1, axis=0) - np.roll(part, 1, axis=0) for part in parts]
        turning = np.concatenate([_turning(part) for part in parts])
        share = np.repeat(
            [n / sum(lengths) / len(part) for part, n in zip(parts, lengths, strict=True)], [len(p) for p in parts]
        )
        tangent = np.concatenate(tangents)
        tangent /= np.maximum(np.linalg.norm(tangent, axis=1), np.finfo(float).tiny)[:, None]
        normal = np.column_stack([-tangent[:, 1], tangent[:, 0]])
        return cls(point, normal, (share + turning / turning.sum()) / 2, loop, float(np.hypot(*np.ptp(point, axis=0))))


def common_portion(query: Contour, asked: Frames, hit: Contour, known: Frames) -> Portion | None:
    """Return the largest portion of a query that a hit contains, in any pose and scale; None if there is none.

    Parameters
    ----------
    query : Contour
    asked : Frames
        The query's.
    hit : Contour
    known : Frames
        The hit's.
    """
    tree = cKDTree(hit.point)
    first = sorted(_placements(asked, known), key=lambda placement: -_promise(query, hit, tree, placement))
    found = (_agreeing(query, hit, tree, placement) for placement in first[:_KEPT])
    return max((each for each in found if each is not None), key=lambda each: each.share, default=None)


def _promise(query: Contour, hit: Contour, tree: cKDTree, placement: Similarity) -> float:
    """Return how much of the query agrees roughly, by every fourth of its stations."""
    few = Contour(query.point[::4], query.normal[::4], query.weight[::4], query.loop[::4], query.size)
    _, _, fits = _feet(few, hit, tree, placement, _NEAR[0] * query.size * placement.scale)
    return float(few.weight[fits].sum())


def _placements(asked: Frames, known: Frames) -> Iterator[Similarity]:
    """Yield how the query would lie if two frames were one, the most alike first."""
    apart = np.stack([cdist(signature, known.signature) for signature in (asked.signature, asked.mirrored)])
    for mirror, q, h in zip(*np.unravel_index(np.argsort(apart, axis=None)[:_TRIED], apart.shape), strict=True):
        (px, py), (qx, qy) = asked.direction[q], known.direction[h]
        py = -py if mirror else py
        cos, sin = px * qx + py * qy, px * qy - py * qx
        matrix = np.array([[cos, -sin], [sin, cos]]) * (known.radius[h] / asked.radius[q])
        matrix = matrix @ np.diag([1.0, -1.0]) if mirror else matrix
        yield Similarity(frozen(matrix), frozen(known.origin[h] - matrix @ asked.origin[q]))


def _agreeing(query: Contour, hit: Contour, tree: cKDTree, first: Similarity) -> Portion | None:
    placement = first
    for near in _NEAR:
        limit = near * query.size * placement.scale
        place, foot, fits = _feet(query, hit, tree, placement, limit)
        if not fits.any():
            return None
        placement, fitted = _refined(placement, place[fits], hit.point[foot[fits]], hit.normal[foot[fits]]), placement
        if not 1 / _WILD < placement.scale / fitted.scale < _WILD:
            return None
    place, _, fits = _feet(query, hit, tree, placement, _NEAR[-1] * query.size * placement.scale)
    kept = list(_stretches(query, fits))
    if not kept:
        return None
    share = float(sum(query.weight[stretch].sum() for stretch in kept))
    return Portion(share, placement, tuple(place[stretch] for stretch in kept))


def _feet(
    query: Contour, hit: Contour, tree: cKDTree, placement: Similarity, limit: float
) -> tuple[Floats, NDArray[np.intp], NDArray[np.bool_]]:
    """Return where the query's stations lie, the nearest station of the hit, and whether the outlines agree there."""
    place, normal = placement.apply(query.point), query.normal @ placement.matrix.T / placement.scale
    _, foot = tree.query(place)
    way = place - hit.point[foot]
    across = np.abs(np.sum(way * hit.normal[foot], axis=1))
    along = np.abs(way[:, 0] * hit.normal[foot, 1] - way[:, 1] * hit.normal[foot, 0])
    # The hit's stations are about this far apart, unless its outline is longer than four times its box' diagonal.
    step = 4 * hit.size / _STATIONS
    same_way = np.sum(normal * hit.normal[foot], axis=1) >= _SAME_WAY
    return place, foot, (across <= limit) & (along <= step + limit) & same_way


def _refined(placement: Similarity, place: Floats, foot: Floats, normal: Floats) -> Similarity:
    """Move by the small similarity that brings places nearest to the tangents at their feet."""
    centre = place.mean(axis=0)
    x, y = (place - centre).T
    # Columns: a growth, a turn, a shift; each by how far it moves a place along the normal of its foot.
    columns = [x * normal[:, 0] + y * normal[:, 1], x * normal[:, 1] - y * normal[:, 0], normal[:, 0], normal[:, 1]]
    off = np.sum((foot - place) * normal, axis=1)
    (grow, turn, *shift), *_ = np.linalg.lstsq(np.column_stack(columns), off, rcond=1e-6)
    change = np.array([[1 + grow, -turn], [turn, 1 + grow]])
    offset = change @ (placement.offset - centre) + centre + shift
    return Similarity(frozen(change @ placement.matrix), frozen(offset))


def _stretches(query: Contour, fits: NDArray[np.bool_]) -> Iterator[NDArray[np.intp]]:
    """Yield the stations of each run of agreement that weighs enough; loops are closed."""
    for number in range(int(query.loop[-1]) + 1):
        stations = np.flatnonzero(query.loop == number)
        agree = fits[stations]
        if not agree.all():
            start = int(np.argmin(agree))  # a place that does not: no run goes over it
            stations, agree = np.roll(stations, -start), np.roll(agree, -start)
        borders = np.flatnonzero(np.diff(np.concatenate([[False], agree, [False]])))
        for low, high in borders.reshape(-1, 2):
            if query.weight[stations[low:high]].sum() >= _CHANCE:
                yield stations[low:high]


def _evenly(ring: Floats, count: int) -> Floats:
    """Return so many points evenly along a closed polyline whose last point is its first."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(ring, axis=0).T))])
    at = np.linspace(0.0, along[-1], count, endpoint=False)
    return np.column_stack([np.interp(at, along, ring[:, k]) for k in (0, 1)])


def _turning(points: Floats) -> Floats:
    """Return by how much a closed polyline turns at each point, radians."""
    after = np.roll(points, -1, axis=0) - points
    before = np.roll(after, 1, axis=0)
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.abs(np.arctan2(cross, np.sum(before * after, axis=1)))
