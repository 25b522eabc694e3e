import numpy as np
import pytest
from OCP.gp import gp_Ax3, gp_Dir, gp_Pln, gp_Pnt

from mashape_cad.kernel.frames import Frame

_PLANE = gp_Pln(gp_Ax3(gp_Pnt(1, 2, 3), gp_Dir(0, 1, 1), gp_Dir(1, 0, 0)))


def _space(frame, flat, height=0.0):
    return frame.origin + flat @ frame.axes[:2] + height * frame.axes[2]


@pytest.mark.parametrize("reverse", [False, True])
def test_a_frame_is_right_handed_and_gives_coordinates_back(reverse):
    """Points made from coordinates have these coordinates, and the height that they were given."""
    frame = Frame.of(_PLANE, reverse=reverse)
    assert np.linalg.det(frame.axes) == pytest.approx(1, rel=1e-15)
    flat = np.array([(4.0, -2.0), (0.0, 0.0)])
    points = _space(frame, flat, 0.5)
    assert frame.flat(points) == pytest.approx(flat, abs=1e-14)
    assert frame.heights(points) == pytest.approx([0.5, 0.5], abs=1e-14)


def test_reversed_it_looks_the_other_way():
    """The normal turns round, the x axis stays."""
    front, back = Frame.of(_PLANE, reverse=False), Frame.of(_PLANE, reverse=True)
    assert back.axes[2] == pytest.approx(-front.axes[2])
    assert np.array_equal(back.axes[0], front.axes[0])


def test_a_left_handed_plane_faces_where_its_axes_say():
    """The kernel's normal is x cross y, not the axis that the plane names."""
    plane = gp_Pln(gp_Ax3(gp_Pnt(), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)))
    plane.VReverse()
    assert Frame.of(plane, reverse=False).plane().normal == (0.0, 0.0, -1.0)


def test_the_origin_stays_beside_what_is_drawn_around_it():
    """A sketch around or beside its origin keeps its numbers."""
    frame = Frame.of(_PLANE, reverse=False)
    for corner in ((-3.0, -4.0), (0.0, 0.0)):
        points = _space(frame, np.array([corner, np.add(corner, (6, 8))]))
        assert np.array_equal(frame.moved_near(points).origin, frame.origin)


def test_the_origin_moves_to_what_lies_far_off():
    """By steps of a power of two, so that numbers which are round stay round."""
    frame = Frame.of(_PLANE, reverse=False)
    points = _space(frame, np.array([(1e6, 5.0), (1e6 + 10, 9.0)]))
    near = frame.moved_near(points)
    assert np.abs(near.flat(points)).max() <= 16
    assert frame.flat(near.origin)[0] % 16 == pytest.approx(0, abs=1e-9)
    assert near.heights(points) == pytest.approx([0, 0], abs=1e-9)


def test_its_plane_has_no_negative_zeros():
    """They would only make two records of one plane look different."""
    plane = Frame.of(gp_Pln(gp_Ax3(gp_Pnt(), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0))), reverse=True).plane()
    assert "-0.0" not in repr(plane)
