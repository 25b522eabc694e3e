"""The domain cut by discs: contacts, gaps, faces."""

import numpy as np
import pytest
from catalogue import box, circle, polygon, profile_of
from laid_out import (
    all_faces,
    contact_of,
    faces_of_ends,
    faces_of_ends_and_links,
    gaps_of,
    settle,
    stretch_of,
    walked,
)

from mashape_cad.errors import AxisError
from mashape_cad.geometry.edge import BSpline
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial import cutting
from mashape_cad.medial.cutting import cut
from mashape_cad.medial.ends import ends
from mashape_cad.medial.faces import (
    CONTACTS,
    DISCS,
    JUNCTION,
    LAID_OUT,
    LOOSE_LOOP,
    STATION,
    WRONG_COUNT,
    SettledDisc,
    add_contact,
    add_disc,
    attach,
    blank_faces,
    corner,
    cycle,
    distinct_faces,
    gap_at,
    insert,
    is_laid_out,
    lay_out,
    on_contact,
    settled_discs,
)
from mashape_cad.medial.links import links
from mashape_cad.medial.tour import tour

_FEET = {0: (0, 0.25), 1: (1, 0.6), 2: (2, 2 / 3)}  # of the triangle's incircle, by the gap
_HOLED = ["plate with holes", "hole grid", "blob with holes", "bracket"]


def _triangle():
    laid_out, frame = tour(Profile.of(polygon([(0, 0), (4, 0), (0, 3)])))
    return laid_out, faces_of_ends(laid_out)[0], frame


def _incircle(faces, frame, kind=JUNCTION):
    x, y = (np.array([1.0, 1.0]) - frame.middle) / frame.size
    return add_disc(faces, float(x), float(y), 1 / frame.size, kind, 1e-11)


def _insert(faces, number, gaps):
    feet = [_FEET[gap] for gap in gaps]
    return insert(faces, number, np.array(gaps), np.array([e for e, _ in feet]), np.array([t for _, t in feet]))


def _between_holes(laid_out):
    """A disc between two holes that touches no other loop."""
    left, right = (int(np.flatnonzero(laid_out.loop == loop)[0]) for loop in (1, 2))
    return SettledDisc(0.0, 0.0, 0.05, (((left, 0.5),) * 2, ((right, 0.5),) * 2), "station")


def test_corners_alone_leave_one_face():
    """With a gap for each side."""
    laid_out, faces, _ = _triangle()
    (face,) = all_faces(faces)
    assert len(face) == 3
    assert [stretch_of(laid_out, faces, gap) for gap in sorted(face)] == [(0, 0.0, 1.0), (1, 0.0, 1.0), (2, 0.0, 1.0)]


def test_the_incircle_cuts_a_triangle_into_three():
    """Each part is bounded by two gaps, between the circle and one corner."""
    laid_out, faces, frame = _triangle()
    (face,) = all_faces(faces)
    new = _insert(faces, _incircle(faces, frame), face)
    parts = [walked(faces, gap) for gap in new.tolist()]
    assert [len(part) for part in parts] == [2, 2, 2]
    assert {frozenset(face) for face in all_faces(faces)} == {frozenset(part) for part in parts}
    discs = settled_discs(faces)
    for part in parts:
        assert {discs[corner(faces, gap)].kind for gap in part} == {"corner", "junction"}
        assert all(is_laid_out(laid_out, faces, gap) for gap in part)
    assert len(discs[-1].contacts) == 3


def test_a_face_may_be_cut_in_any_order():
    """First a disc with two contacts, then a third contact of it: the same as all three at once."""
    _, faces, frame = _triangle()
    (face,) = all_faces(faces)
    first, second, third = face
    number = _incircle(faces, frame, STATION)
    parts = [walked(faces, gap) for gap in _insert(faces, number, (first, second)).tolist()]
    assert sorted(len(part) for part in parts) == [2, 3]
    rest = next(part for part in parts if third in part)
    before = next(gap for gap in rest if corner(faces, gap) == number)
    new = attach(faces, before, third, *_FEET[third])
    assert [len(walked(faces, gap)) for gap in (new, third)] == [2, 2]
    assert walked(faces, new) != walked(faces, third)
    assert sorted(len(part) for part in all_faces(faces)) == [2, 2, 2]
    assert settled_discs(faces)[number].kind == "junction"
    assert len(settled_discs(faces)[number].contacts) == 3


@pytest.mark.parametrize("name", ["triangle", *_HOLED])
def test_a_cycle_is_the_walk_round_a_face(name):
    """From whichever of its gaps it starts, and one gap of each face stands for it."""
    laid_out, _ = tour(Profile.of(polygon([(0, 0), (4, 0), (0, 3)])) if name == "triangle" else profile_of(name))
    faces, _ = faces_of_ends_and_links(laid_out)
    assert all(tuple(cycle(faces, gap).tolist()) == walked(faces, gap) for gap in gaps_of(faces))
    for _ in range(2):  # marks of the first time do not confuse the second
        kept = distinct_faces(faces, np.array(gaps_of(faces))).tolist()
        assert sorted(min(walked(faces, gap)) for gap in kept) == [face[0] for face in all_faces(faces)]


def test_gaps_are_found_by_place():
    """Strictly inside; a contact belongs to no gap."""
    laid_out, faces, _ = _triangle()
    assert gap_at(laid_out, faces, 0, 0.4) == 0
    assert gap_at(laid_out, faces, 2, 0.999) == 2
    assert gap_at(laid_out, faces, 1, 0.0) < 0


@pytest.mark.parametrize("name", ["ell", "ellipse", "stadium", "keyhole", *_HOLED])
def test_every_place_is_on_a_contact_or_in_the_gap_behind_the_last_one(name):
    """As a plain sort of all contacts of the loop tells; also before the first contact, where the gap runs over the
    loop's start.
    """
    laid_out, _ = tour(profile_of(name))
    faces, _ = faces_of_ends_and_links(laid_out)
    for e in range(len(laid_out.degree)):
        mine = [gap for gap in gaps_of(faces) if laid_out.loop[faces.contact[gap]["first_e"]] == laid_out.loop[e]]
        ordered = sorted(mine, key=lambda gap: contact_of(faces, gap)[0])
        for t in (0.0, 1e-3, 0.3, 0.5, 0.77, 1 - 1e-9):
            before = [gap for gap in ordered if contact_of(faces, gap)[0] <= (e, t)]
            last = (before or ordered)[-1]
            expected = -1 if on_contact(faces, last, e, t) else last
            assert gap_at(laid_out, faces, e, t) == expected


def test_a_stretch_lies_on_one_element():
    """A gap that runs over a border is not a stretch yet; one up to the border is."""
    laid_out, _ = tour(Profile.of(polygon([(0, 0), (2, 0), (4, 0), (4, 3), (0, 3)])))
    faces, _ = faces_of_ends(laid_out)
    (face,) = all_faces(faces)
    assert [stretch_of(laid_out, faces, gap) for gap in face].count(None) == 1
    assert gap_at(laid_out, faces, 1, 0.0) == 0


def _teardrop():
    """A loop of a single element: one cubic that comes back to its start."""
    laid_out, _ = tour(Profile.of(Loop((BSpline.of(3, [0] * 4 + [1] * 4, [(0, 0), (2, 3), (-2, 3), (0, 0)]),))))
    assert laid_out.degree.tolist() == [3]
    return laid_out


@pytest.mark.parametrize(
    ("places", "expected"),
    [
        ([0.0], [(0, 0.0, 1.0)]),
        ([0.4], [None]),
        ([0.0, 0.4], [(0, 0.0, 0.4), (0, 0.4, 1.0)]),
        ([0.2, 0.4], [(0, 0.2, 0.4), None]),
        ([0.0, 0.2, 0.4], [(0, 0.0, 0.2), (0, 0.2, 0.4), (0, 0.4, 1.0)]),
    ],
)
def test_stretches_of_a_loop_of_a_single_element(places, expected):
    """A gap up to the seam is one, one over the seam is none."""
    laid_out = _teardrop()
    faces = blank_faces(laid_out)
    for t in places:
        add_contact(faces, add_disc(faces, 0.0, 0.0, 0.1, STATION, 1e-11), 0, t, 0, t)
    lay_out(laid_out, faces)
    assert [stretch_of(laid_out, faces, gap) for gap in range(len(places))] == expected


def test_a_teardrop_is_laid_out_by_its_ends():
    """Its corner and its tip: two gaps on the one element that there is."""
    laid_out = _teardrop()
    faces, told = faces_of_ends(laid_out)
    assert told == (LAID_OUT, 1)
    assert sorted(stretch_of(laid_out, faces, gap) for gap in gaps_of(faces)) == [
        (0, 0.0, pytest.approx(0.5)),
        (0, pytest.approx(0.5), 1.0),
    ]
    assert is_laid_out(laid_out, faces, 0)


def test_one_gap_alone_is_no_piece():
    """Nor are three, nor two of which one spans several elements."""
    laid_out, faces, frame = _triangle()
    assert not is_laid_out(laid_out, faces, 0)
    number = _incircle(faces, frame, STATION)
    new = _insert(faces, number, all_faces(faces)[0][:2])
    assert sorted(is_laid_out(laid_out, faces, gap) for gap in new.tolist()) == [False, True]
    drop = _teardrop()
    alone = blank_faces(drop)
    add_contact(alone, add_disc(alone, 0.0, 0.0, 0.1, STATION, 1e-11), 0, 0.0, 0, 0.0)
    lay_out(drop, alone)
    assert not is_laid_out(drop, alone, 0)
    rounded, _ = tour(profile_of("plate with a slot"))
    first, _ = faces_of_ends_and_links(rounded)
    assert not any(is_laid_out(rounded, first, gap) for gap in gaps_of(first))


def test_places_on_an_arc_that_is_touched_belong_to_no_gap():
    """Also across the seam of the loop."""
    profile = profile_of("stadium")
    for start in range(4):
        edges = profile.outer.edges[start:] + profile.outer.edges[:start]
        laid_out, _ = tour(Profile.of(type(profile.outer)(edges)))
        faces, _ = faces_of_ends(laid_out)
        for e in range(len(laid_out.degree)):
            assert (gap_at(laid_out, faces, e, 0.5) < 0) == (laid_out.degree[e] == 2)


def test_an_arc_over_the_seam_of_its_loop_holds_its_places():
    """Between its first and its last place, ends included; no other place."""
    faces = blank_faces(tour(profile_of("rectangle"))[0])
    over = add_contact(faces, add_disc(faces, 0.0, 0.0, 0.1, STATION, 1e-11), 3, 0.5, 1, 0.25)
    plain = add_contact(faces, 0, 1, 0.5, 2, 0.25)
    inside = [(3, 0.5), (3, 0.9), (0, 0.0), (0, 0.7), (1, 0.0), (1, 0.25)]
    outside = [(1, 0.26), (1, 0.9), (2, 0.5), (3, 0.0), (3, 0.49)]
    assert [on_contact(faces, over, *place) for place in inside + outside] == [True] * 6 + [False] * 5
    inside, outside = [(1, 0.5), (1, 0.9), (2, 0.25)], [(1, 0.49), (2, 0.26), (0, 0.9), (3, 0.1)]
    assert [on_contact(faces, plain, *place) for place in inside + outside] == [True] * 3 + [False] * 4


def test_a_loop_that_no_disc_touches_is_an_error(monkeypatch):
    """Its place is told."""
    laid_out, _ = tour(Profile.of(box(0, 0, 4, 4), [circle(2, 2, 1)]))
    assert faces_of_ends(laid_out)[1] == (LOOSE_LOOP, 1)
    monkeypatch.setattr(cutting, "settle_links", lambda tour, faces: None)
    with pytest.raises(AxisError, match="no disc touches loop 1") as caught:
        cut(laid_out)
    assert caught.value.place == pytest.approx((0.25, 0.0))


@pytest.mark.parametrize("name", _HOLED)
def test_links_make_every_face_simply_connected(name):
    """As many faces as the sum over discs says."""
    laid_out, _ = tour(profile_of(name))
    faces, (outcome, count) = faces_of_ends_and_links(laid_out)
    holes = int(laid_out.loop.max())
    assert outcome == LAID_OUT
    assert len(all_faces(faces)) == 1 - holes + sum(len(disc.contacts) - 1 for disc in settled_discs(faces)) == count


@pytest.mark.parametrize("name", _HOLED)
def test_discs_settled_twice_are_one(name):
    """Together ends and links give their discs, those that are both only once."""
    laid_out, _ = tour(profile_of(name))
    together = settled_discs(faces_of_ends_and_links(laid_out)[0])
    apart = [*ends(laid_out), *links(laid_out)]
    centres = np.array([(disc.x, disc.y, disc.r) for disc in apart])
    distinct = [k for k, row in enumerate(centres) if not np.any(np.abs(centres[:k] - row).max(axis=1) <= 1e-9)]
    assert len(together) == len(distinct)
    for k, disc in zip(distinct, together, strict=True):
        assert (disc.x, disc.y, disc.r) == pytest.approx(centres[k], abs=1e-9)


def test_discs_that_do_not_link_all_loops_are_noticed(monkeypatch):
    """Two holes tied to one another and not to the outline."""
    laid_out, _ = tour(Profile.of(box(-5, -3, 10, 6), [circle(-1, 0, 0.5), circle(1, 0, 0.5)]))
    assert faces_of_ends(laid_out, [_between_holes(laid_out)])[1][0] == WRONG_COUNT
    monkeypatch.setattr(cutting, "settle_links", lambda tour, faces: settle(faces, _between_holes(tour)))
    with pytest.raises(AxisError, match="faces"):
        cut(laid_out)


def test_discs_are_read_as_they_were_settled():
    """Centre, radius, kind, tolerance, and all contacts of each."""
    laid_out, _ = tour(profile_of("rectangle"))
    faces = blank_faces(laid_out)
    discs = [
        SettledDisc(0.1, 0.2, 0.3, (((0, 0.5), (0, 0.5)), ((2, 0.25), (3, 0.5))), "cluster", 1e-9),
        SettledDisc(-0.1, 0.0, 0.0, (((1, 0.0), (1, 0.0)),), "corner", 1e-11),
    ]
    assert [settle(faces, disc) for disc in discs] == [0, 1]
    assert settled_discs(faces) == discs
    assert (faces.used[CONTACTS], faces.used[DISCS]) == (3, 2)
