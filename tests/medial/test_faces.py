"""The domain cut by discs: contacts, gaps, faces."""

import numpy as np
import pytest
from catalogue import box, circle, polygon, profile_of

from mashape_cad.errors import AxisError
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.ends import SettledDisc, ends
from mashape_cad.medial.faces import Faces
from mashape_cad.medial.links import links
from mashape_cad.medial.tour import tour


def _triangle():
    laid_out, frame = tour(Profile.of(polygon([(0, 0), (4, 0), (0, 3)])))
    return Faces(laid_out, ends(laid_out)), frame


def _incircle(frame):
    x, y = (np.array([1.0, 1.0]) - frame.middle) / frame.size
    return SettledDisc(float(x), float(y), 1 / frame.size, (), "junction")


def test_corners_alone_leave_one_face():
    """With a gap for each side."""
    faces, _ = _triangle()
    (face,) = faces.faces
    assert len(face) == 3
    assert [faces.stretch(gap) for gap in sorted(face)] == [(0, 0.0, 1.0), (1, 0.0, 1.0), (2, 0.0, 1.0)]


def test_the_incircle_cuts_a_triangle_into_three():
    """Each part is bounded by two gaps, between the circle and one corner."""
    faces, frame = _triangle()
    (face,) = faces.faces
    feet = {0: (0, 0.25), 1: (1, 0.6), 2: (2, 2 / 3)}
    parts = faces.insert(_incircle(frame), face, [(face.index(gap), feet[gap]) for gap in face])
    assert [len(part) for part in parts] == [2, 2, 2]
    assert set(faces.faces) == set(parts)
    for part in parts:
        assert {faces.discs[faces.corner(part, k)].kind for k in range(2)} == {"corner", "junction"}
        assert all(faces.face_of(gap) == part for gap in part)
    assert len(faces.discs[-1].contacts) == 3


def test_a_face_may_be_cut_in_any_order():
    """First a disc with two contacts, then a third contact of it: the same as all three at once."""
    faces, frame = _triangle()
    (face,) = faces.faces
    feet = {0: (0, 0.25), 1: (1, 0.6), 2: (2, 2 / 3)}
    first, second, third = face
    parts = faces.insert(_incircle(frame), face, [(0, feet[first]), (1, feet[second])])
    assert sorted(len(part) for part in parts) == [2, 3]
    rest = next(part for part in parts if third in part)
    number = len(faces.discs) - 1
    corner = next(k for k in range(len(rest)) if faces.corner(rest, k) == number)
    parts = faces.attach(number, rest, corner, rest.index(third), feet[third])
    assert [len(part) for part in parts] == [2, 2]
    assert sorted(len(part) for part in faces.faces) == [2, 2, 2]
    assert len(faces.discs[number].contacts) == 3


def test_gaps_are_found_by_place():
    """Strictly inside; a contact belongs to no gap."""
    faces, _ = _triangle()
    assert faces.gap_at((0, 0.4)) == 0
    assert faces.gap_at((2, 0.999)) == 2
    assert faces.gap_at((1, 0.0)) is None


def test_a_stretch_lies_on_one_element():
    """A gap that runs over a border is not a stretch yet; one up to the border is."""
    laid_out, _ = tour(Profile.of(polygon([(0, 0), (2, 0), (4, 0), (4, 3), (0, 3)])))
    faces = Faces(laid_out, ends(laid_out))
    (face,) = faces.faces
    assert sorted(str(faces.stretch(gap)) for gap in face).count("None") == 1
    assert faces.gap_at((1, 0.0)) == 0


def test_places_on_an_arc_that_is_touched_belong_to_no_gap():
    """Also across the seam of the loop."""
    profile = profile_of("stadium")
    for start in range(4):
        edges = profile.outer.edges[start:] + profile.outer.edges[:start]
        laid_out, _ = tour(Profile.of(type(profile.outer)(edges)))
        faces = Faces(laid_out, ends(laid_out))
        for e in range(len(laid_out.degree)):
            assert (faces.gap_at((e, 0.5)) is None) == (laid_out.degree[e] == 2)


def test_a_loop_that_no_disc_touches_is_an_error():
    """Its place is told."""
    laid_out, _ = tour(Profile.of(box(0, 0, 4, 4), [circle(2, 2, 1)]))
    with pytest.raises(AxisError, match="no disc touches loop 1") as caught:
        Faces(laid_out, ends(laid_out))
    assert caught.value.place is not None


@pytest.mark.parametrize("name", ["plate with holes", "hole grid", "blob with holes", "bracket"])
def test_links_make_every_face_simply_connected(name):
    """As many faces as the sum over discs says."""
    laid_out, _ = tour(profile_of(name))
    first = ends(laid_out) + links(laid_out)
    faces = Faces(laid_out, first)
    holes = int(laid_out.loop.max())
    assert len(faces.faces) == 1 - holes + sum(len(disc.contacts) - 1 for disc in first)


def test_discs_that_do_not_link_all_loops_are_noticed():
    """Two holes tied to one another and not to the outline."""
    laid_out, _ = tour(Profile.of(box(-5, -3, 10, 6), [circle(-1, 0, 0.5), circle(1, 0, 0.5)]))
    left = np.flatnonzero(laid_out.loop == 1)
    right = np.flatnonzero(laid_out.loop == 2)
    between = SettledDisc(0.0, 0.0, 0.05, (((int(left[0]), 0.5),) * 2, ((int(right[0]), 0.5),) * 2), "station")
    with pytest.raises(AxisError, match="faces"):
        Faces(laid_out, [*ends(laid_out), between])
