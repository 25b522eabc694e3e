"""Small pictures of outlines, looked at through the decoder that matplotlib brings."""

import io

import numpy as np
import pytest
from stand_ins import profile_record

from mashape_cad.library.record import ProfileRecord, Thumbnail
from mashape_cad.views.tile import tile_png


def _dots(record: ProfileRecord, side: int = 100) -> np.ndarray:
    from matplotlib.image import imread

    return imread(io.BytesIO(tile_png(record, side)), format="png")


def _record(*loops: tuple[int, ...]) -> ProfileRecord:
    plain = profile_record(0)
    values = {name: getattr(plain, name) for name in plain.__slots__}
    return ProfileRecord(**values | {"thumbnail": Thumbnail((-7.0, 3.0), 0.01, loops)})


OUTER = (0, 0, 5000, 0, 5000, 2500, 0, 2500)
HOLE = (1000, 500, 1000, 2000, 2000, 2000, 2000, 500)


def test_covers_what_the_profile_covers():
    """The share of opaque dots is the area of the part, its hole left out, within the anti-aliased rim."""
    opacity = _dots(_record(OUTER, HOLE))[..., 3]
    pixel = 5000 / 90  # 5 of 100 dots are left free at each side
    assert opacity.sum() == pytest.approx((5000 * 2500 - 1000 * 1500) / pixel**2, rel=0.01)


def test_up_is_up():
    """A hole near the lower left corner of the part is near the lower left corner of the picture."""
    opacity = _dots(_record(OUTER, (500, 250, 500, 1000, 1500, 1000, 1500, 250)))[..., 3]
    assert opacity[65, 22] == 0
    assert opacity[35, 22] == 1


def test_has_a_dark_line_along_the_outline():
    """The outline shows on a light list and the material on a dark one."""
    red = _dots(_record(OUTER))[..., 0]
    assert red[50, 5] < 0.3
    assert red[50, 50] > 0.4


def test_is_transparent_around_the_part():
    """It fits any list."""
    assert _dots(_record(OUTER))[2, 2, 3] == 0


def test_a_profile_without_outline_is_an_empty_picture():
    """A refused profile may have none; a picture is still a picture."""
    assert _dots(_record())[..., 3].max() == 0


@pytest.mark.parametrize("side", [15, 1025])
def test_refuses_sizes_that_make_no_sense(side):
    """A million dots would be a mistake of the plug-in's."""
    with pytest.raises(ValueError, match="dots wide"):
        tile_png(profile_record(0), side)
