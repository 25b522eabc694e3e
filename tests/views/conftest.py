"""A small part as a sidecar keeps it."""

import pytest

from mashape_cad.library.record import AxisRecord, OriginRecord, ProfileRecord, Thumbnail

# A plate of 50 x 20 mm with a square hole near its right end, on a grid of 50 / 5000 mm that starts at (10, 5).
OUTER = (0, 0, 5000, 0, 5000, 2000, 0, 2000)
HOLE = (4000, 800, 4000, 1200, 4400, 1200, 4400, 800)
BRANCHES = (
    (0, 0, 0, 1000, 1000, 1000),
    (0, 2000, 0, 1000, 1000, 1000),
    (1000, 1000, 1000, 3200, 1000, 800),
)


@pytest.fixture
def plate():
    """A plate with a hole, a part of its axis, and histograms with one tall and some low bins."""
    vectors = {name: (0.7, *[0.3 / 63] * 63) for name in ("df", "rf", "cf")}
    return ProfileRecord(
        origin=OriginRecord(layer="0"),
        bounds=(10.0, 5.0, 60.0, 25.0),
        area=984.0,
        perimeter=156.0,
        edges=8,
        holes=1,
        thumbnail=Thumbnail((10.0, 5.0), 0.01, (OUTER, HOLE), BRANCHES),
        axis=AxisRecord(10.0, 3, 1, 2, 1, connected=True, max_disc_error=0.0, max_foot_error=0.0, ok=True),
        vectors=vectors,
    )
