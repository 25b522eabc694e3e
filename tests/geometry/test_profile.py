"""Loops and profiles: orientation, area, perimeter, numbering of edges."""

import numpy as np
import pytest

from mashape_cad.geometry.edge import Arc, Line, Similarity
from mashape_cad.geometry.profile import Loop, Profile

_CORNERS = [(0, 0), (6, 0), (6, 4), (0, 4)]
_BOX = Loop(tuple(Line.of(a, b) for a, b in zip(_CORNERS, _CORNERS[1:] + _CORNERS[:1], strict=True)))
_HOLE = Loop((Arc.of((3, 2), 1),))


def test_a_profile_has_its_interior_on_the_left():
    """However its loops came."""
    for outer in (_BOX, _BOX.reversed()):
        for hole in (_HOLE, _HOLE.reversed()):
            profile = Profile.of(outer, [hole])
            assert profile.outer.signed_area > 0 > profile.holes[0].signed_area


def test_area_and_perimeter_take_holes_into_account():
    """Area less, perimeter more."""
    profile = Profile.of(_BOX, [_HOLE])
    assert profile.area == pytest.approx(24 - np.pi, rel=1e-13)
    assert profile.perimeter == pytest.approx(20 + 2 * np.pi, rel=1e-13)
    assert profile.diagonal == pytest.approx(np.hypot(6, 4))


def test_a_mirrored_profile_still_has_its_interior_on_the_left():
    """The sense of rotation is put right again."""
    image = Profile.of(_BOX, [_HOLE]).transformed(Similarity.of(2, 0.4, (9, 9), mirror=True))
    assert image.outer.signed_area == pytest.approx(4 * 24)
    assert image.holes[0].signed_area == pytest.approx(-4 * np.pi)


def test_edges_are_numbered_loop_by_loop():
    """Outer loop first."""
    profile = Profile.of(_BOX, [_HOLE])
    assert profile.edges[:4] == profile.outer.edges
    assert profile.edges[4:] == profile.holes[0].edges
    assert list(profile) == [profile.outer, *profile.holes]
