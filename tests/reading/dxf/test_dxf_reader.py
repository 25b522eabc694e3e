import math

import pytest
from drawings import codes, drawn

from mashape_cad.findings import Severity


def rectangle(space, x, y, width, height, **attributes):
    """Draw a closed polyline."""
    corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
    space.add_lwpolyline(corners, close=True, dxfattribs=attributes)


def test_profiles_come_largest_first_with_their_holes_layer_and_handles(tmp_path):
    """Outline, hole, island in the hole; another plate. The interior is on the left of every loop."""

    def draw(space):
        space.add_circle((5, 5), 1, dxfattribs={"layer": "ISLAND"})
        rectangle(space, 0, 0, 20, 10, layer="CUT")
        space.add_circle((5, 5), 3, dxfattribs={"layer": "HOLES"})
        rectangle(space, 30, 0, 30, 10, layer="CUT")

    part = drawn(tmp_path, draw)
    assert [profile.area for profile in part.profiles] == pytest.approx([300, 200 - 9 * math.pi, math.pi])
    assert [len(profile.holes) for profile in part.profiles] == [0, 1, 0]
    assert [profile.origin.layer for profile in part.profiles] == ["CUT", "CUT", "ISLAND"]
    assert [len(profile.origin.handles) for profile in part.profiles] == [1, 2, 1]
    assert part.profiles[1].holes[0].signed_area < 0
    assert codes(part) == []


def test_only_model_space_is_read(tmp_path):
    """Paper space is counted, and an empty model space is said to be so."""

    def draw(space):
        space.doc.layout("Layout1").add_circle((0, 0), 3)

    part = drawn(tmp_path, draw)
    assert part.profiles == ()
    assert {"entity-paper-space", "file-empty"} <= set(codes(part))


def test_a_drawing_of_texts_has_no_profile_and_the_findings_say_why(tmp_path):
    """No exception: the part is readable."""
    part = drawn(tmp_path, lambda space: space.add_text("Title"))
    assert part.profiles == ()
    assert [finding.severity for finding in part.findings if finding.code == "entity-annotation"] == [Severity.LOST]


def test_a_sheet_frame_is_pointed_out_and_kept(tmp_path):
    """Even-odd stays: the parts are holes, but the record says that they may not be meant so."""

    def draw(space):
        rectangle(space, 0, 0, 100, 50, layer="FRAME")
        for x in (5, 35, 65):
            rectangle(space, x, 5, 25, 40)
            space.add_circle((x + 10, 20), 5)

    part = drawn(tmp_path, draw)
    assert len(part.profiles) == 4
    assert codes(part) == ["profile-frame"]


def test_findings_lie_where_the_profiles_do(tmp_path):
    """In mm, also if the drawing is in inches."""
    part = drawn(tmp_path, lambda space: space.add_line((1, 2), (3, 4)), units=1)
    (finding,) = [finding for finding in part.findings if finding.code == "chain-open"]
    assert finding.place == pytest.approx((25.4, 50.8))
