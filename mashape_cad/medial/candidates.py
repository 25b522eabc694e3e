"""Whether every place where the axis can end is accounted for.

An axis ends in convex vertices, and in discs that osculate the boundary at a local maximum of its curvature, possibly
along a whole arc (Choi, Choi, Moon 1997). All such places are listed from the boundary alone. Of each, either its disc
is one of the axis that touches there: an end, or with contacts elsewhere too; or a boundary point lies strictly inside
its disc: the witness that rejects it. A vertex at which a rounded arc meets its neighbour at a kink that is rounding
belongs to the disc that fills the arc: with its tolerance, that disc touches there. Together with the counting identity
this shows that no end is missing, and so no junction: an end that was forgotten along with its junction cancels in the
sum, but not here.

Conversely every end of the axis must be one of these places.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.assembly import foot
from mashape_cad.medial.bezier import evaluate
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.contact import TOUCH
from mashape_cad.medial.emptiness import EMPTY, NO_SKIP, distance_minima
from mashape_cad.medial.ends import curvature_candidates
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.objection import Objection
from mashape_cad.medial.tour import Tour, site

__all__ = ["Candidate", "candidate_objections", "candidates", "touched_arcs", "turns"]

Place = tuple[int, float]

# The disc of a candidate and that of the axis differ by no more (sizes): arcs on one circle are averaged, and two
# maxima that a border separates are one. Looser could mistake a neighbouring disc for the one that is missing.
_SAME_DISC = 3e-8
# Contacts of an osculating disc are known to some root of the distance's rounding: a candidate this near (radii) to a
# contact of its disc is that contact.
_SAME_CONTACT = 0.02
# A disc that fills an arc is rejected by what lies this deep inside (sizes): radii and centres of arcs are rounded.
_ARC = 1e-8
# A border whose tangents turn left by more (radians) is a convex vertex whatever the tour says; it decides about less.
_VERTEX = 1e-6
_SAME_CIRCLE = 1e-8  # neighbouring arcs whose centres and radii agree this well (sizes) are one arc
_STRAIGHT = 1e-9  # a curvature below this (one over sizes) has no maximum that matters


@dataclass(frozen=True, slots=True)
class Candidate:
    """A place where the axis may end, in the tour's scale.

    Attributes
    ----------
    kind : str
        ``convex vertex``, ``curvature maximum`` or ``arc``.
    place : (int, float)
        Element and parameter; of an arc, where it starts.
    x, y, r : float
        The disc of curvature; radius 0 at a vertex.
    """

    kind: str
    place: Place
    x: float
    y: float
    r: float


def candidates(tour: Tour, touched: NDArray[np.bool_]) -> Iterator[Candidate]:
    """Yield all places where the axis can end.

    Parameters
    ----------
    tour : Tour
    touched : (n,) bool array
        Elements that a disc touches as a whole: circular, so that the maxima of their curvature are rounding.
    """
    for e in np.flatnonzero(tour.convex | (turns(tour) > _VERTEX)).tolist():
        x, y, *_ = site(tour, e, 0.0)
        yield Candidate("convex vertex", (e, 0.0), x, y, 0.0)
    for run in _arcs(tour):
        (x, y), r = tour.round_centre[run].mean(axis=0).tolist(), float(tour.round_radius[run].mean())
        yield Candidate("arc", (run[0], 0.0), x, y, r)
    for e, t in zip(*(array.tolist() for array in curvature_candidates(tour, touched)), strict=True):
        x, y, nx, ny, curvature, _ = site(tour, e, t)
        if t == 0.0:
            left = site(tour, int(tour.before[e]), 1.0)
            if left[4] > curvature:
                x, y, nx, ny, curvature, _ = left
        if curvature > _STRAIGHT:
            yield Candidate("curvature maximum", (e, t), x + nx / curvature, y + ny / curvature, 1 / curvature)


def touched_arcs(axis: MedialAxis) -> NDArray[np.bool_]:
    """Tell of each element of the tour whether it is an arc that a disc of the axis touches as a whole."""
    touched = np.zeros(len(axis.tour.degree), dtype=bool)
    contacts = axis.contacts
    for first, last in zip(contacts.first.tolist(), contacts.last.tolist(), strict=True):
        e = int(first[0])
        # A contact that begins inside an element is that of an osculating disc which reaches a border.
        while first != last and first[1] == 0.0 and e != int(last[0]) and not touched[e]:
            touched[e] = True
            e = int(axis.tour.after[e])
    return touched


def _arcs(tour: Tour) -> Iterator[list[int]]:
    """Yield the longest runs of neighbouring spans on one inward circle; one all round a loop has any start."""
    joined = [_is_joined(tour, int(tour.before[e]), e) for e in range(len(tour.element))]
    seen: set[int] = set()
    for first in sorted(np.flatnonzero(~np.isnan(tour.round_radius)).tolist(), key=lambda e: joined[e]):
        if first not in seen:
            run = [first]
            while joined[after := int(tour.after[run[-1]])] and after not in {first, *seen}:
                run.append(after)
            seen.update(run)
            yield run


def _is_joined(tour: Tour, before: int, e: int) -> bool:
    """Whether a span goes on with the circle of the one before it."""
    if tour.convex[e] or np.isnan(tour.round_radius[[before, e]]).any():
        return False
    off = np.append(
        tour.round_centre[before] - tour.round_centre[e],
        tour.round_radius[before] - tour.round_radius[e],
    )
    return bool(np.abs(off).max() <= _SAME_CIRCLE)


def candidate_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Yield candidates that are neither in the axis nor rejected by a witness, and ends that are no candidates."""
    found = list(candidates(axis.tour, touched_arcs(axis)))
    circles = np.array([(c.x, c.y, c.r) for c in found]).reshape(-1, 3)
    accepted = _accepting_discs(axis, found, circles)
    for candidate, discs in zip(found, accepted, strict=True):
        if not discs and not _has_witness(axis.tour, candidate):
            yield _forgotten(axis, candidate)
    ends = np.flatnonzero(axis.nodes.degree == 1)
    known = [disc for discs in accepted for disc in discs]
    for node in ends[~np.isin(axis.nodes.disc[ends], known)]:
        text = f"end {node} is no convex vertex, and osculates the boundary at no maximum of its curvature"
        yield Objection.at("candidate", text, axis.nodes.centre[node])


def _forgotten(axis: MedialAxis, candidate: Candidate) -> Objection:
    edge, u = foot(axis.tour, candidate.place)
    name = f"the {candidate.kind} on edge {edge} at u = {u:.6g}"
    text = f"{name} ends no branch, and no boundary point lies inside its disc of radius"
    radius = candidate.r * axis.frame.size
    place = site(axis.tour, *candidate.place)[:2]
    return Objection.in_frame("candidate", f"{text} {radius:.6g}", axis, place)


def _accepting_discs(axis: MedialAxis, found: list[Candidate], circles: Floats) -> list[list[int]]:
    """Return the discs of the axis that each candidate's is, and that touch at its place."""
    discs, size = axis.discs, axis.frame.size
    known = np.column_stack([(discs.centre - axis.frame.middle) / size, discs.radius / size])
    tol = _SAME_DISC + discs.tolerance / size
    contacts_of = _contacts_of(axis)
    accepted: list[list[int]] = []
    order = np.argsort(known[:, 0], kind="stable")
    for k, candidate in enumerate(found):
        low, high = np.searchsorted(known[order, 0], [candidate.x - tol.max(), candidate.x + tol.max()])
        near = order[low:high]
        same = near[np.abs(known[near] - circles[k]).max(axis=1) <= tol[near]]
        discs_there = [disc for disc in same.tolist() if _ends_at(axis, contacts_of[disc], candidate)]
        if not discs_there and candidate.kind == "convex vertex":
            discs_there = axis.contacts.disc[_arcs_to(axis, candidate.place)].tolist()
        accepted.append(discs_there)
    return accepted


def _arcs_to(axis: MedialAxis, place: Place) -> NDArray[np.bool_]:
    """Tell of each contact whether it is an arc that starts or ends at a place, on a disc that fills it."""
    first, last = axis.contacts.first, axis.contacts.last
    is_arc = (first[:, 0] != last[:, 0]) & (first[:, 1] == 0.0) & (last[:, 1] == 0.0)
    return is_arc & ((first == place).all(axis=1) | (last == place).all(axis=1))


def _ends_at(axis: MedialAxis, contacts: list[int], candidate: Candidate) -> bool:
    """Whether a disc touches at a candidate's place.

    One with two contacts that are both there has passed the candidate by: its branch goes on where it should end.
    """
    touching = [_touches(axis, contact, candidate) for contact in contacts]
    return sum(touching) == 1 or (any(touching) and len(touching) > 2)


def _contacts_of(axis: MedialAxis) -> list[list[int]]:
    numbers: list[list[int]] = [[] for _ in axis.discs.radius]
    for contact, disc in enumerate(axis.contacts.disc.tolist()):
        numbers[disc].append(contact)
    return numbers


def _touches(axis: MedialAxis, contact: int, candidate: Candidate) -> bool:
    """Whether a contact is at a candidate's place."""
    contacts, tour = axis.contacts, axis.tour
    (e, t), (f, s) = contacts.first[contact].tolist(), contacts.last[contact].tolist()
    same_loop = tour.loop[int(e)] == tour.loop[candidate.place[0]]
    if same_loop and (e, t) != (f, s) and _within(candidate.place, (int(e), t), (int(f), s)):
        return True
    x, y, *_ = site(tour, *candidate.place)
    near = _SAME_CONTACT * candidate.r + _SAME_DISC
    feet = [site(tour, int(element), at) for element, at in ((e, t), (f, s)) if element < len(tour.element)]
    return any(np.hypot(x - foot[0], y - foot[1]) <= near for foot in feet)


def _within(place: Place, first: Place, last: Place) -> bool:
    """Whether a place lies on an arc that may pass over the start of its loop."""
    if first < last:
        return first <= place <= last
    return place >= first or place <= last


def _has_witness(tour: Tour, candidate: Candidate) -> bool:
    """Whether a boundary point lies strictly inside a candidate's disc."""
    depth, skip = (_ARC, candidate.place[0]) if candidate.kind == "arc" else (EMPTY, int(NO_SKIP))
    return bool(_deepest(tour, candidate.x, candidate.y, candidate.r, skip, depth) < -depth)


@compiled
def turns(tour: Tour) -> Floats:
    """Angle by which the tangent turns at the start of each element, radians; 0 at cones, which have turned already."""
    turns = np.zeros(len(tour.element))
    for e in range(len(turns)):
        left = tour.element[e].before
        if tour.element[e].degree > 0 and tour.element[left].degree > 0:
            _, _, ux, uy, _, _ = evaluate(tour.control[left], tour.element[left].degree, 1.0)
            _, _, vx, vy, _, _ = evaluate(tour.control[e], tour.element[e].degree, 0.0)
            turns[e] = np.arctan2(ux * vy - uy * vx, ux * vx + uy * vy)
    return turns


@compiled
def _deepest(tour: Tour, x: float, y: float, r: float, skip: int, floor: float) -> float:
    """Smallest ``|q - c| - r`` over the boundary, where that is at most the width of a touch; or one below -`floor`."""
    found, _, _, depth = distance_minima(tour, x, y, r, TOUCH, skip, floor)
    deepest = np.inf
    for k in range(found):
        deepest = min(deepest, depth[k])
    return deepest
