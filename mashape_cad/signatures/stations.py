"""Points of the medial axis at equal steps along the boundary (paper, sections 3.2 to 3.4 and 4.5).

Readings of the paper's unclear lines are cited by their number in ``docs/paper-readings.md``.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mashape_cad.geometry.edge import Arc, Edge, EllipseArc, Floats, Line
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.branch import contact_before, discs_on_piece
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.tour import Ints, Tour, site
from mashape_cad.signatures.compiled import compiled

__all__ = ["Stations", "stations"]

# Table from which arc length is inverted: on a span cut in 32 parts linear interpolation is good to 1e-3 of a step.
_TABLE = 32
# Parameters this close to the end of an element are the start of the next.
_BORDER = 1e-9
# Normals that differ by less are equal: the disc osculates.
_NO_TURN = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Stations:
    """Points of the medial axis, in the order of the boundary.

    Attributes
    ----------
    radius : (n,) array
        Of the maximal disc, mm.
    foot_distance : (n,) array
        Between the two footpoints, mm.
    tangent : (n, 2) array
        Unit tangent of the medial axis; NaN where there is none (convex vertices, arcs that touch as a whole).
    run : (n,) array
        Number of the run: consecutive stations with the same number lie on one branch.
    """

    radius: Floats
    foot_distance: Floats
    tangent: Floats
    run: Ints


def stations(axis: MedialAxis, per_edge: int) -> Stations:
    """Return the maximal discs at the middle of equal arc-length steps on every edge of every loop (reading 1).

    Parameters
    ----------
    axis : MedialAxis
    per_edge : int
        Number of steps on each edge: 100 is the paper's 0.01, 50 its 0.02 (reading 2).
    """
    element, t = _places(axis, per_edge)
    element, t = _with_vertex_branches(axis, element, t, per_edge)
    order = np.lexsort((t, element))
    element, t = element[order], t[order]
    contact, on_arc = contact_before(axis, element, t)
    radius, distance = np.zeros(len(t)), np.zeros(len(t))
    tangent = np.full((len(t), 2), np.nan)
    radius[on_arc], distance[on_arc] = _arc_values(axis, contact[on_arc])
    for number in np.unique(contact[~on_arc]):
        rows = np.flatnonzero((contact == number) & ~on_arc)
        piece, side = int(axis.contacts.piece[number]), int(axis.contacts.side[number])
        radius[rows], distance[rows], tangent[rows] = _piece_values(axis, piece, side, t[rows])
    branch = np.where(on_arc, -1, _branch_of_piece(axis)[axis.contacts.piece[contact]])
    order, run = _runs(axis, branch, element)
    corners = axis.discs.radius[axis.nodes.disc[axis.nodes.radius == 0.0]]
    return Stations(
        np.concatenate([radius[order], corners]),
        np.concatenate([distance[order], corners]),
        np.concatenate([tangent[order], np.full((len(corners), 2), np.nan)]),
        np.concatenate([run, -np.ones(len(corners), dtype=np.int64)]),
    )


def _places(axis: MedialAxis, per_edge: int) -> tuple[Ints, Floats]:
    """Places of the stations on edges."""
    tour = axis.tour
    elements: list[Ints] = []
    parameters: list[Floats] = []
    circles = {
        loop.edges[0]: index
        for index, loop in enumerate(axis.profile.loops)
        if len(loop.edges) == 1 and isinstance(loop.edges[0], Arc)
    }
    for number, edge in enumerate(axis.profile.edges):
        start = _largest_contact(axis, circles[edge]) if edge in circles else 0.0
        u = np.sort(_equal_steps(edge, per_edge, start))
        spans = np.flatnonzero((tour.edge == number) & (tour.degree > 0))
        e = spans[np.clip(np.searchsorted(tour.edge_from[spans], u, side="right") - 1, 0, len(spans) - 1)]
        fraction = (u - tour.edge_from[e]) / (tour.edge_to[e] - tour.edge_from[e])
        elements.append(e)
        parameters.append(_bezier_parameter(edge, fraction, tour.edge_to[e] - tour.edge_from[e]))
    element, t = np.concatenate(elements), np.concatenate(parameters)
    # The end of an element is the start of the next one, whatever rounding says.
    ended = t > 1.0 - _BORDER
    return np.where(ended, tour.after[element], element), np.where(ended, 0.0, t)


def _largest_contact(axis: MedialAxis, loop: int) -> float:
    """Edge parameter at which the largest node's disc touches a loop that is a full circle.

    Where a full circle starts is an accident of its file: readers put it in a fixed direction, whichever way the part
    is turned. So steps on it are counted from a place that belongs to the shape. A disc touches a circle only once.
    """
    contacts, tour = axis.contacts, axis.tour
    places = contacts.first[:, 0].astype(np.int64)
    mine = np.flatnonzero(
        (tour.loop[np.minimum(places, len(tour.loop) - 1)] == loop) & (axis.discs.degree[contacts.disc] != 2)
    )
    if not len(mine):
        return 0.0
    largest = mine[np.argmax(np.round(axis.discs.radius[contacts.disc[mine]] / axis.frame.size, 9))]
    return foot(tour, (int(places[largest]), float(contacts.first[largest, 1])))[1]


def _equal_steps(edge: Edge, count: int, start: float = 0.0) -> Floats:
    """Edge parameters at the middle of equal steps of arc length, counted from a parameter of a closed edge."""
    middles = (np.arange(count) + 0.5) / count
    if isinstance(edge, Line):
        return middles
    _, breaks = edge.spans()
    u = np.unique(np.concatenate([np.linspace(a, b, _TABLE + 1) for a, b in pairwise(breaks)]))
    # Simpson's rule on each interval of the table.
    speed = np.linalg.norm(edge.derivatives(np.sort(np.concatenate([u, (u[1:] + u[:-1]) / 2])))[:, 1], axis=1)
    steps = np.diff(u) * (speed[:-1:2] + 4 * speed[1::2] + speed[2::2]) / 6
    length = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    return np.interp(np.mod(middles + np.interp(start, u, length), 1.0), length, u)


def _bezier_parameter(edge: Edge, fraction: Floats, width: Floats) -> Floats:
    """Parameter of a span's Bezier form at a fraction of its edge parameter: only arcs differ, where u is the angle."""
    if not isinstance(edge, EllipseArc):
        return fraction
    quarter = edge.sweep * width / 4
    ratio = np.tan((2 * fraction - 1) * quarter) / np.tan(quarter)
    return (1 + ratio) / 2


def _with_vertex_branches(axis: MedialAxis, element: Ints, t: Floats, per_edge: int) -> tuple[Ints, Floats]:
    """Add stations on branches between two reflex vertices, which no station on an edge reaches (reading 10)."""
    pieces, tour = axis.pieces, axis.tour
    for branch in axis.branches:
        numbers = [piece for piece, _ in branch.pieces]
        if not all((tour.degree[pieces.element[number]] == 0).all() for number in numbers):
            continue
        widths = np.array([pieces.high[n, 0] - pieces.low[n, 0] for n in numbers])
        counts = np.maximum(1, np.rint(per_edge * widths / widths.sum())).astype(int)
        for number, count in zip(numbers, counts, strict=True):
            middles = (np.arange(count) + 0.5) / count
            element = np.append(element, np.full(count, pieces.element[number, 0]))
            t = np.append(t, pieces.low[number, 0] + middles * (pieces.high[number, 0] - pieces.low[number, 0]))
    return element, t


def _branch_of_piece(axis: MedialAxis) -> Ints:
    owner = np.full(len(axis.pieces.disc) + 1, -1, dtype=np.int64)  # the last one stands for no piece
    for number, branch in enumerate(axis.branches):
        owner[[piece for piece, _ in branch.pieces]] = number
    return owner


def _runs(axis: MedialAxis, branch: Ints, element: Ints) -> tuple[Ints, Ints]:
    """Order stations so that no run is cut by the seam of its loop, and number the runs.

    Returns
    -------
    order : (n,) array
        The stations loop by loop, each loop from the start of a run.
    run : (n,) array
        Of the stations in that order: consecutive ones on one branch and one loop; -1 on no branch.
    """
    loop = axis.tour.loop[element]
    order = []
    for number in np.unique(loop):
        mine = np.flatnonzero(loop == number)
        starts = np.flatnonzero(branch[mine] != np.roll(branch[mine], 1))
        order.append(np.roll(mine, -starts[0]) if len(starts) else mine)
    ordered = np.concatenate(order)
    changed = np.ones(len(ordered), dtype=bool)
    branch, loop = branch[ordered], loop[ordered]
    changed[1:] = (branch[1:] != branch[:-1]) | (loop[1:] != loop[:-1])
    return ordered, np.where(branch < 0, -1, np.cumsum(changed) - 1)


def _piece_values(axis: MedialAxis, piece: int, side: int, t: Floats) -> tuple[Floats, Floats, Floats]:
    """Radius, distance of footpoints and tangent at places of a piece."""
    pieces, tour, size = axis.pieces, axis.tour, axis.frame.size
    e, f = int(pieces.element[piece, side]), int(pieces.element[piece, 1 - side])
    t = np.clip(t, pieces.low[piece, side], pieces.high[piece, side])
    rows = discs_on_piece(axis, piece, t, side)
    here, there = _sites(tour, e, t), _sites(tour, f, rows[:, 3])
    tangent = _tangent(here[:, 2:], there[:, 2:])
    distance = np.hypot(*(here[:, :2] - there[:, :2]).T)
    return rows[:, 2] * size, distance * size, tangent


@compiled
def _sites(tour: Tour, e: int, t: Floats) -> Floats:
    """Points and inward normals at places of one element: (n, 4)."""
    rows = np.empty((len(t), 4))
    for k in range(len(t)):
        rows[k, 0], rows[k, 1], rows[k, 2], rows[k, 3], _, _ = site(tour, e, t[k])
    return rows


def _tangent(normal: Floats, other: Floats) -> Floats:
    """Return the axis' unit tangent: the bisector of the boundary tangents at the two feet (reading 11).

    Along the boundary T = (t1 - t2) / |t1 - t2|. Where the tangents agree, at an osculating end, it is the normal.
    At a reflex vertex the tangent is perpendicular to the spoke, which is the normal of the disc there.
    """
    difference = normal - other
    turned = np.column_stack([difference[:, 1], -difference[:, 0]])
    length = np.hypot(turned[:, 0], turned[:, 1])
    ended = length < _NO_TURN
    turned[ended], length[ended] = normal[ended], 1.0
    return turned / length[:, None]


def _arc_values(axis: MedialAxis, contact: Ints) -> tuple[Floats, Floats]:
    """Radius, and largest distance between two contacts, of discs that touch along an arc (reading 8)."""
    radius = axis.discs.radius[axis.contacts.disc[contact]]
    spread = {int(c): _spread(axis, int(axis.contacts.disc[c])) for c in np.unique(contact)}
    return radius, np.array([spread[int(c)] for c in contact])


def _spread(axis: MedialAxis, disc: int) -> float:
    """Largest distance between two points at which a disc touches the boundary, arcs included."""
    if not axis.branches:
        return float(2 * axis.discs.radius[disc])  # the domain is one disc
    mine = np.flatnonzero(axis.contacts.disc == disc)
    centre = (axis.discs.centre[disc] - axis.frame.middle) / axis.frame.size
    start, turn = np.array([_arc(axis, int(c), centre) for c in mine]).T
    # Somewhere on one arc lies the antipode of a point of another, or of the same one.
    opposite = np.mod(start[None, :] - start[:, None] - np.pi, 2 * np.pi)
    if np.any((opposite <= turn[:, None]) | (2 * np.pi - opposite <= turn[None, :])):
        return float(2 * axis.discs.radius[disc])
    ends = np.concatenate([start, start + turn])
    return float(np.abs(np.exp(1j * ends)[:, None] - np.exp(1j * ends)[None, :]).max() * axis.discs.radius[disc])


def _arc(axis: MedialAxis, contact: int, centre: Floats) -> tuple[float, float]:
    """Direction, seen from a disc's centre, in which a contact starts, and the angle over which it goes on, radians."""
    (e, t), (f, s) = axis.contacts.first[contact], axis.contacts.last[contact]
    (ax, ay), (bx, by) = site(axis.tour, int(e), t)[:2], site(axis.tour, int(f), s)[:2]
    start = float(np.arctan2(ay - centre[1], ax - centre[0]))
    turn = float(np.mod(np.arctan2(by - centre[1], bx - centre[0]) - start, 2 * np.pi))
    return start, turn if (e, t) != (f, s) else 0.0
