"""Discs that tie every hole to another loop, so that cutting along them leaves simply connected faces.

At the highest point of a hole, in any fixed direction, the maximal disc lies above the hole; so it touches another
loop, whose own highest point is higher still. One such disc for each hole links all loops without a cycle.
"""

import math

from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.contact import TOUCH, one_contact
from mashape_cad.medial.disc import maximal_disc
from mashape_cad.medial.faces import (
    CONTACTS,
    DISCS,
    STATION,
    Faces,
    SettledDisc,
    add_contact,
    add_disc,
    blank_faces,
    disc_at,
    on_contact,
    settled_discs,
)
from mashape_cad.medial.tour import Tour, loop_count, site

__all__ = ["links", "settle_links"]

# Any direction (radians) serves; crooked ones seldom meet the symmetries of drawings, where discs have more than two
# contacts. The next one is taken where a disc happens to touch a vertex that turns by next to nothing: there it has two
# contacts so near to one another that they cannot be told apart.
_DIRECTIONS = (1.1, 2.6, 4.3, 5.7)
# Two discs with centre and radius this close are one (sizes of the shape).
_SAME_DISC = 1e-9
# Height (sizes) by which a cone wins over the ends of its neighbours: only its normals include the direction.
_CONE_WINS = 1e-12
# Samples among which the highest point of a span is looked for.
_STEPS = 32


def links(tour: Tour) -> list[SettledDisc]:
    """Return one disc for each hole, touching it and another loop."""
    faces = blank_faces(tour)
    settle_links(tour, faces)
    return settled_discs(faces)


@compiled
def settle_links(tour: Tour, faces: Faces) -> None:
    """Add one disc for each hole; one that is settled already gets the contacts that it lacks."""
    contacts, discs = faces.used[CONTACTS], faces.used[DISCS]
    for direction in _DIRECTIONS:
        faces.used[CONTACTS], faces.used[DISCS] = contacts, discs
        clear = True
        for loop in range(1, loop_count(tour)):
            clear = clear and _settle_link(tour, faces, loop, math.cos(direction), math.sin(direction))
        if clear:
            break


@compiled
def _settle_link(tour: Tour, faces: Faces, loop: int, up_x: float, up_y: float) -> bool:
    """Add the disc at the highest point of one loop; return whether no contact is a convex vertex."""
    e, t = _highest(tour, loop, up_x, up_y)
    x, y, r, ok, count, element, place_t = maximal_disc(tour, e, t)
    if not ok or count == 0:
        return False
    number = disc_at(faces, x, y, r, _SAME_DISC)
    known = faces.used[CONTACTS]
    if number < 0:
        number, known = add_disc(faces, x, y, r, STATION, TOUCH), 0
    _add_lacking(tour, faces, number, known, e, t)
    clear = not (t == 0.0 and tour.element[e].convex)
    for k in range(count):
        _add_lacking(tour, faces, number, known, element[k], place_t[k])
        clear = clear and not (place_t[k] == 0.0 and tour.element[element[k]].convex)
    return clear


@compiled
def _add_lacking(tour: Tour, faces: Faces, number: int, known: int, e: int, t: float) -> None:
    """Add a contact to a disc unless it is one of the first `known` contacts."""
    x, y, r = faces.settled[number].x, faces.settled[number].y, faces.settled[number].r
    for c in range(known):
        if faces.contact[c].disc == number and (
            on_contact(faces, c, e, t)
            or one_contact(tour, e, t, faces.contact[c].first_e, faces.contact[c].first_t, x, y, r)
            or one_contact(tour, e, t, faces.contact[c].last_e, faces.contact[c].last_t, x, y, r)
        ):
            return
    add_contact(faces, number, e, t, e, t)


@compiled
def _highest(tour: Tour, loop: int, up_x: float, up_y: float) -> tuple[int, float]:
    """Place of a hole that is highest in a direction, with its normal in that direction."""
    best, best_e, best_t = -math.inf, -1, 0.0
    for e in range(len(tour.element)):
        if tour.element[e].loop != loop:
            continue
        is_cone = tour.element[e].degree == 0
        t = _highest_on_cone(tour, e, up_x, up_y) if is_cone else _highest_on_span(tour, e, up_x, up_y)
        if not 0.0 <= t < 1.0:
            continue
        x, y, _, _, _, _ = site(tour, e, t)
        height = up_x * x + up_y * y + (_CONE_WINS if is_cone else 0.0)
        if height > best:
            best, best_e, best_t = height, e, t
    return best_e, best_t


@compiled
def _highest_on_cone(tour: Tour, e: int, up_x: float, up_y: float) -> float:
    """Parameter at which a cone's normal points up; outside (0, 1) if none does."""
    middle = tour.element[e].cone_turn / 2
    turned = math.atan2(up_y, up_x) - tour.element[e].cone_angle - middle
    turned -= 2 * math.pi * math.floor(turned / (2 * math.pi) + 0.5)
    t = (turned + middle) / tour.element[e].cone_turn
    return t if 0.0 < t < 1.0 else -1.0


@compiled
def _highest_on_span(tour: Tour, e: int, up_x: float, up_y: float) -> float:
    """Parameter of a span's highest point; 1 if that is its end, which belongs to the next element."""
    most, k = -math.inf, 0
    for i in range(_STEPS + 1):
        x, y, _, _, _, _ = site(tour, e, i / _STEPS)
        if up_x * x + up_y * y > most:
            most, k = up_x * x + up_y * y, i
    if k == _STEPS:
        return 1.0
    low, high = max(k - 1, 0) / _STEPS, (k + 1) / _STEPS
    if _climb(tour, e, low, up_x, up_y) <= 0.0 or _climb(tour, e, high, up_x, up_y) >= 0.0:
        return k / _STEPS
    for _ in range(60):
        middle = (low + high) / 2
        if _climb(tour, e, middle, up_x, up_y) > 0.0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


@compiled
def _climb(tour: Tour, e: int, t: float, up_x: float, up_y: float) -> float:
    """How much the boundary rises along its tangent."""
    _, _, nx, ny, _, _ = site(tour, e, t)
    return ny * up_x - nx * up_y
