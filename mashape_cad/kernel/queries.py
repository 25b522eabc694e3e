"""How far points lie from a boundary, settled by the kernel: `DistanceQuery`, `distances`.

The kernel's point-to-curve extrema (`Extrema_ExtPC2d`) are asked for every piece of the boundary that can hold the
nearest point (`pieces`). Which pieces can is decided by bounds that never fail. Let ``width`` be the distance of the
furthest control point from the piece's chord. The piece lies in the convex hull of its control points, so no point of
it is further than ``width`` from the chord; and as it runs from one end of the chord to the other, no point of the
chord is further than ``width`` from the piece. So the distance to the piece differs by at most ``width`` from that to
the chord. The kernel reports stationary points only, so the pieces' ends are added.

Notes
-----
The kernel finds extrema of free curves by sampling, and can overlook the nearest one. So each answer is proven: the
disc with that radius must be empty (`emptiness`). Where it is not, a local search by the kernel from the witness takes
over, until the disc is empty.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from OCP.gp import gp_Pnt2d
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from mashape_cad.geometry.edge import Edge, Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel.emptiness import witnesses
from mashape_cad.kernel.pieces import pieces_of

__all__ = ["DistanceQuery", "distances"]

Indices = NDArray[np.intp]

# Points times pieces held at once, for memory; the answers do not depend on it.
_CHUNK = 2_000_000
# Relative to the coordinates: rounding allowed for where bounds are compared, and depth of the discs' proof.
_EPS = 1e-12


def distances(boundary: Profile | Sequence[Edge], points: ArrayLike) -> Floats:
    """Return the smallest distance of each point to a boundary, by the kernel.

    Parameters
    ----------
    boundary : Profile or sequence of Edge
        All edges that count.
    points : (m, 2) array_like
        mm.

    Returns
    -------
    (m,) array
        mm. For several calls on one boundary keep a `DistanceQuery`.
    """
    return DistanceQuery(boundary).distances(points)


@dataclass(frozen=True, slots=True, eq=False)
class _Pairs:
    """Points with the pieces that may hold their nearest point; those of one point stand together, the nearest first.

    `below` bounds the distance of point `row` to piece `piece` from below.
    """

    row: Indices
    piece: Indices
    below: Floats


class DistanceQuery:
    """A boundary that is asked for distances; its kernel curves are made once.

    Parameters
    ----------
    boundary : Profile or sequence of Edge
        All edges that count.

    Raises
    ------
    ValueError
        If there is no edge, or one without length.
    """

    __slots__ = ("_chords", "_degrees", "_pieces", "_size", "_tree", "_widths")

    def __init__(self, boundary: Profile | Sequence[Edge]) -> None:
        edges = boundary.edges if isinstance(boundary, Profile) else tuple(boundary)
        if not edges:
            raise ValueError("a boundary needs at least one edge")
        self._pieces = [piece for edge in edges for piece in pieces_of(edge)]
        self._chords = np.stack([piece.samples[[0, -1]] for piece in self._pieces])
        self._widths = np.array([_width(piece.control) for piece in self._pieces])
        self._degrees = np.array([len(piece.control) - 1 if piece.is_bezier else 0 for piece in self._pieces])
        samples = np.concatenate([piece.samples for piece in self._pieces])
        self._tree = cKDTree(samples)
        self._size = float(np.max(np.abs(samples)))

    def distances(self, points: ArrayLike) -> Floats:
        """Return the smallest distance of each point to the whole boundary.

        Parameters
        ----------
        points : (m, 2) array_like
            mm. Ask in batches: a call costs as much as some twenty points.

        Returns
        -------
        (m,) array
            mm.
        """
        batches = [self._batch(batch)[0] for batch in self._batches(points)]
        return np.concatenate([np.empty(0), *batches])

    def nearest(self, points: ArrayLike) -> tuple[Floats, Floats]:
        """Return the distance of each point, (m,), and the boundary point nearest to it, (m, 2), mm.

        The distance is proven. Where two boundary points are as near, either is given.
        """
        distance, nearest = [np.empty(0)], [np.empty((0, 2))]
        for batch in self._batches(points):
            best, pairs, contact = self._batch(batch)
            distance.append(best)
            nearest.append(self._points_of(batch, pairs, contact, best))
        return np.concatenate(distance), np.concatenate(nearest)

    def _batches(self, points: ArrayLike) -> Iterator[Floats]:
        array = np.asarray(points, float).reshape(-1, 2)
        rows = max(1, _CHUNK // len(self._pieces))
        return (array[start : start + rows] for start in range(0, len(array), rows))

    def _batch(self, points: Floats) -> tuple[Floats, _Pairs, Floats]:
        """Return the distances, and for whom it matters the pairs with the kernel's parameters of contact."""
        pairs = self._candidates(points)
        to_ends = np.linalg.norm(points[pairs.row, None] - self._chords[pairs.piece], axis=2)
        best = np.full(len(points), np.inf)
        np.minimum.at(best, pairs.row, to_ends.min(axis=1))
        contact = self._ask(points, pairs, best)
        self._prove(points, pairs, contact, best)
        return best, pairs, contact

    def _points_of(self, points: Floats, pairs: _Pairs, contact: Floats, best: Floats) -> Floats:
        """Return the nearest of all points of contact and ends of pieces that belong to each point."""
        # The kernel takes a foot a hair beyond the end of a piece for one on it, and then the distance can fall below
        # all bounds. The piece with the lowest bound has that end too.
        is_first = np.diff(pairs.row, prepend=-1) != 0
        kept = np.flatnonzero((pairs.below <= best[pairs.row]) | is_first)
        row, piece = pairs.row[kept], pairs.piece[kept]
        touched = [self._pieces[k].point(at) for k, at in zip(piece.tolist(), contact[kept].tolist(), strict=True)]
        candidates = np.concatenate([self._chords[piece], np.array(touched).reshape(-1, 1, 2)], axis=1).reshape(-1, 2)
        row = np.repeat(row, 3)
        order = np.lexsort((np.linalg.norm(candidates - points[row], axis=1), row))
        first = order[np.searchsorted(row[order], np.arange(len(points)))]
        return candidates[first]

    def _candidates(self, points: Floats) -> _Pairs:
        above, _ = self._tree.query(points)
        slack = _EPS * self._size
        middles = self._chords.mean(axis=1)
        radii = np.linalg.norm(self._chords[:, 1] - middles, axis=1) + self._widths + slack
        row, piece = np.nonzero(cdist(points, middles) - radii <= above[:, None])
        to_chord = _distance_to_segments(points[row], self._chords[piece])
        np.minimum.at(above, row, to_chord + self._widths[piece])
        below = to_chord - self._widths[piece] - slack
        kept = np.flatnonzero(below <= above[row])
        kept = kept[np.lexsort((below[kept], row[kept]))]
        return _Pairs(row[kept], piece[kept], below[kept])

    def _ask(self, points: Floats, pairs: _Pairs, best: Floats) -> Floats:
        """Ask the kernel about each pair that can still matter, lowering `best`; return the points of contact."""
        contact = [0.5] * len(pairs.row)
        place, coordinates, known = gp_Pnt2d(), points.tolist(), best.tolist()
        rows, pieces, bounds = pairs.row.tolist(), pairs.piece.tolist(), pairs.below.tolist()
        for pair, (row, piece, bound) in enumerate(zip(rows, pieces, bounds, strict=True)):
            if bound <= known[row]:
                place.SetCoord(*coordinates[row])
                distance, contact[pair] = self._pieces[piece].nearest(place)
                known[row] = min(known[row], distance)
        best[:] = known
        return np.array(contact)

    def _prove(self, points: Floats, pairs: _Pairs, contact: Floats, best: Floats) -> None:
        """Lower `best` until no piece of the pairs runs inside the discs with these radii."""
        degrees = self._degrees[pairs.piece]
        matters = pairs.below <= best[pairs.row]
        for degree in np.unique(degrees[degrees > 0]).tolist():
            unproven = np.flatnonzero((degrees == degree) & matters)
            while len(unproven):
                row = pairs.row[unproven]
                control = np.stack([self._pieces[piece].control for piece in pairs.piece[unproven].tolist()])
                tol = _EPS * (self._size + best[row])
                at = witnesses(control, points[row], best[row], contact[unproven], tol)
                entered = unproven[~np.isnan(at)]
                contact[entered] = at[~np.isnan(at)]
                unproven = self._lowered(points, pairs, entered, contact, best)

    def _lowered(self, points: Floats, pairs: _Pairs, unproven: Indices, contact: Floats, best: Floats) -> Indices:
        """Search nearer points from the parameters of contact; return the pairs for which one was found."""
        lowered = []
        for pair in unproven.tolist():
            row = pairs.row[pair]
            place = gp_Pnt2d(*points[row].tolist())
            distance, contact[pair] = self._pieces[pairs.piece[pair]].nearest_from(place, float(contact[pair]))
            if distance < best[row]:
                best[row] = distance
                lowered.append(pair)
        return np.array(lowered, np.intp)


def _width(control: Floats) -> float:
    """Distance of the furthest control point from the chord."""
    points = control[:, :2] / control[:, 2:]
    return float(_distance_to_segments(points, np.broadcast_to(points[[0, -1]], (len(points), 2, 2))).max())


def _distance_to_segments(points: Floats, segments: Floats) -> Floats:
    """Distance of point i, (k, 2), to segment i, (k, 2, 2)."""
    start, chord = segments[:, 0], segments[:, 1] - segments[:, 0]
    offset = points - start
    square = np.maximum(np.einsum("ij,ij->i", chord, chord), np.finfo(float).tiny)
    along = np.clip(np.einsum("ij,ij->i", offset, chord) / square, 0.0, 1.0)
    return np.linalg.norm(offset - along[:, None] * chord, axis=1)
