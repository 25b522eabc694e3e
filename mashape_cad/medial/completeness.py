"""How far an axis is from the discs that the definition gives: `completeness`.

At stations of the boundary that know nothing of the axis the maximal disc is found anew: a ball that touches the
boundary there shrinks until the kernel finds no boundary point inside it. All balls shrink together, so that the kernel
is asked in batches. Neither emptiness proofs nor junctions nor pairings of the axis take part.

References
----------
J. Ma, S. W. Bae, S. Choi, 3D medial axis point approximation using nearest neighbors and the normal field, The Visual
Computer 28 (2012): the shrinking ball.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.branch import contact_before, discs_on_piece
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.objection import Objection
from mashape_cad.medial.tour import Ints, Tour

__all__ = ["Completeness", "completeness"]

# Largest distance, relative to the diagonal, of the maximal disc at a station from the axis; the same as for settled
# discs.
DEFINED = 1e-7
# Discs that differ by more than this (diagonals) are looked at again: they may be the same branch, further along.
_SLID = 1e-11
# Points along a piece, and how often their spacing is refined, when the nearest of its discs is looked for.
_ALONG, _REFINED = 17, 10
# Steps of a low-discrepancy sequence, the golden section's: stations fill an element evenly and avoid its symmetries.
_GOLDEN = (5**0.5 - 1) / 2
# Stations keep off the ends of their element by this share of it: right there the boundary has two normals, or bends
# two ways.
_MARGIN = 0.01
# A ball whose nearest boundary point is as near as its radius, to this much of the diagonal, is empty.
_EMPTY = 1e-13
_ROUNDS = 60


@dataclass(frozen=True, slots=True, eq=False)
class Completeness:
    """Stations and how far the discs of the axis are from those of the definition.

    Attributes
    ----------
    place : (n, 2) array
        Boundary points, mm.
    error : (n,) array
        Distance of the maximal disc from the branch that the axis has there: largest difference in a centre's
        coordinates or the radius, mm.
    objections : tuple of Objection
    """

    place: Floats
    error: Floats
    objections: tuple[Objection, ...]


def completeness(axis: MedialAxis, diagonal: float, per_span: int) -> Completeness:
    """Hold an axis against the definition at some stations on each span, in a profile of that diagonal, mm."""
    element, t = _stations(axis.tour, per_span)
    edge, u = _feet(axis, element, t)
    point, normal, bend = _boundary_at(axis.profile, edge, u)
    expected = _maximal_discs(axis.profile, diagonal, point, normal, bend)
    found, ends = _discs_of_axis(axis, element, t)
    error = np.abs(expected - found).max(axis=1)
    for k in np.flatnonzero(error > _SLID * diagonal):
        error[k] = min(error[k], _off_branch(axis, ends[k], expected[k]))
    objections = tuple(_objections(axis, diagonal, edge, u, point, error))
    return Completeness(point, error, objections)


def _objections(
    axis: MedialAxis, diagonal: float, edge: Ints, u: Floats, point: Floats, error: Floats
) -> Iterator[Objection]:
    limit = DEFINED * diagonal + float(axis.discs.tolerance.max())
    for k in np.argsort(-error, kind="stable"):
        if error[k] <= limit:
            return
        text = f"at u = {u[k]:.6g} of edge {edge[k]} the axis' disc is {error[k]:.2g} mm off the maximal one"
        yield Objection.at("definition", text, point[k])


def _stations(tour: Tour, per_span: int) -> tuple[Ints, Floats]:
    element = np.repeat(np.flatnonzero(tour.degree > 0).astype(np.int64), per_span)
    t = np.asarray(_GOLDEN * np.arange(1, len(element) + 1), dtype=np.float64) % 1.0
    return element, _MARGIN + (1 - 2 * _MARGIN) * t


def _feet(axis: MedialAxis, element: Ints, t: Floats) -> tuple[Ints, Floats]:
    rows = [foot(axis.tour, place) for place in zip(element.tolist(), t.tolist(), strict=True)]
    return np.array([edge for edge, _ in rows], dtype=np.int64), np.array([u for _, u in rows], dtype=float)


def _boundary_at(profile: Profile, edge: Ints, u: Floats) -> tuple[Floats, Floats, Floats]:
    """Return points, inward unit normals and curvatures, from the edges themselves."""
    values = np.empty((len(u), 3, 2))
    edges = profile.edges
    for number in np.unique(edge).tolist():
        values[edge == number] = edges[number].derivatives(u[edge == number])
    tangent, second = values[:, 1], values[:, 2]
    speed = np.hypot(tangent[:, 0], tangent[:, 1])
    normal = np.column_stack([-tangent[:, 1], tangent[:, 0]]) / speed[:, None]
    bend = (tangent[:, 0] * second[:, 1] - tangent[:, 1] * second[:, 0]) / speed**3
    return values[:, 0], normal, np.asarray(bend, dtype=float)


def _maximal_discs(profile: Profile, diagonal: float, point: Floats, normal: Floats, bend: Floats) -> Floats:
    """Shrink a ball at each place until it is empty: centres and radii, (n, 3)."""
    query = DistanceQuery(profile)
    with np.errstate(divide="ignore"):
        radius = np.where(bend * diagonal > 1.0, 1 / bend, diagonal)
    going = np.arange(len(radius))
    for _ in range(_ROUNDS):
        centre = point[going] + radius[going, None] * normal[going]
        distance, nearest = query.nearest(centre)
        way = nearest - point[going]
        height = np.einsum("ij,ij->i", way, normal[going])
        square = np.einsum("ij,ij->i", way, way)
        through = square / np.maximum(2 * height, np.finfo(float).tiny)
        smaller = (distance < radius[going] - _EMPTY * diagonal) & (through < radius[going])
        radius[going[smaller]] = through[smaller]
        going = going[smaller]
        if not len(going):
            break
    return np.column_stack([point + radius[:, None] * normal, radius])


def _discs_of_axis(axis: MedialAxis, element: Ints, t: Floats) -> tuple[Floats, Ints]:
    """Return the discs that an axis has at places of its tour.

    Returns
    -------
    discs : (n, 3) array
        Centres and radii, mm.
    ends : (n, 2) array
        The settled discs at the ends of the piece that they are on; twice the same where the contact is an arc.
    """
    contact, on_arc = contact_before(axis, element, t)
    disc = axis.contacts.disc[contact]
    found = np.column_stack([axis.discs.centre[disc], axis.discs.radius[disc]])
    piece, side = axis.contacts.piece[contact], axis.contacts.side[contact]
    for number in np.unique(2 * piece + side).tolist():
        here = np.flatnonzero((2 * piece + side == number) & ~on_arc)
        if number >= 0 and len(here):
            found[here] = discs_on_piece(axis, number // 2, t[here], number % 2)[:, :3] * axis.frame.size
            found[here, :2] += axis.frame.middle
    ends = np.repeat(disc[:, None], 2, axis=1)
    between = ~on_arc & (piece >= 0)
    ends[between] = axis.pieces.disc[piece[between]]
    return found, ends


def _off_branch(axis: MedialAxis, ends: Ints, disc: Floats) -> float:
    """Distance of a disc, (3,), from the pieces that end at some settled discs, mm.

    Near an osculating end, discs of neighbouring places hardly differ, and which of them touches a place is known to
    the root of the rounding only, and whether it is the end's: the disc is on the branch all the same. One of the sides
    may start a little further on, where the end's contact was taken for an arc.
    """
    beside = np.flatnonzero(np.isin(axis.pieces.disc, ends).any(axis=1)).tolist()
    return min((_off_piece(axis, number, side, disc) for number in beside for side in (0, 1)), default=np.inf)


def _off_piece(axis: MedialAxis, piece: int, side: int, disc: Floats) -> float:
    low, high = axis.pieces.low[piece, side], axis.pieces.high[piece, side]
    best = np.inf
    for _ in range(_REFINED):
        t = np.linspace(low, high, _ALONG)
        rows = discs_on_piece(axis, piece, t, side)[:, :3] * axis.frame.size
        rows[:, :2] += axis.frame.middle
        off = np.abs(rows - disc).max(axis=1)
        k = int(np.argmin(off))
        best = min(best, float(off[k]))
        low, high = t[max(k - 1, 0)], t[min(k + 1, _ALONG - 1)]
    return best
