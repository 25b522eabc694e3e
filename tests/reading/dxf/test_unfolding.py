import math
import time

import numpy as np
import pytest
from drawings import codes, drawn, kinds, write_drawing

from mashape_cad.options import ReadOptions
from mashape_cad.reading.dxf import read_dxf


def block(space, name="B", base=(0, 0)):
    """A block with a circle of radius 1 at (2, 0)."""
    made = space.doc.blocks.new(name, base_point=base)
    made.add_circle((2, 0), 1)
    return made


def centres(part):
    """Centres of the circles that became profiles."""
    return {tuple(np.round(profile.outer.edges[0].centre, 9).tolist()) for profile in part.profiles}


def test_a_reference_is_scaled_turned_and_moved_from_its_base_point(tmp_path):
    """(2, 0) from base (1, 0): 1 to the right, times 3, turned by 90 degrees, moved to (10, 20)."""

    def draw(space):
        block(space, base=(1, 0))
        space.add_blockref("B", (10, 20), dxfattribs={"xscale": 3, "yscale": 3, "zscale": 3, "rotation": 90})

    part = drawn(tmp_path, draw)
    assert centres(part) == {(10, 23)}
    assert part.profiles[0].area == pytest.approx(9 * math.pi)
    assert kinds(part) == ["Arc"]


def test_rows_and_columns_follow_the_rotation(tmp_path):
    """Two columns, three rows, turned by 90 degrees: columns go up, rows go left."""

    def draw(space):
        block(space)
        grid = {"column_count": 2, "row_count": 3, "column_spacing": 10, "row_spacing": 5, "rotation": 90}
        space.add_blockref("B", (0, 0), dxfattribs=grid)

    assert centres(drawn(tmp_path, draw)) == {
        (-5.0 * row, 2.0 + 10 * column) for row in range(3) for column in range(2)
    }


def test_a_mirrored_reference_mirrors(tmp_path):
    """Negative x scale; a reference seen from below, which mirrors too."""

    def draw(space):
        block(space)
        space.add_blockref("B", (0, 0), dxfattribs={"xscale": -1})
        space.add_blockref("B", (-30, 0), dxfattribs={"extrusion": (0, 0, -1)})

    assert centres(drawn(tmp_path, draw)) == {(-2, 0), (28, 0)}


def test_uneven_scale_makes_ellipses(tmp_path):
    """A circle twice as high as wide."""

    def draw(space):
        block(space)
        space.add_blockref("B", (0, 0), dxfattribs={"yscale": 2})

    part = drawn(tmp_path, draw)
    assert kinds(part) == ["EllipseArc"]
    assert part.profiles[0].area == pytest.approx(2 * math.pi)


def test_nested_references_multiply_and_handles_tell_the_way(tmp_path):
    """A block in a block; the profile's handle is that of the reference, then that of the entity."""

    def draw(space):
        block(space, "INNER")
        outer = space.doc.blocks.new("OUTER")
        outer.add_blockref("INNER", (1, 0), dxfattribs={"rotation": 90})
        space.add_blockref("OUTER", (0, 0), dxfattribs={"xscale": 2, "yscale": 2, "zscale": 2})

    part = drawn(tmp_path, draw)
    assert centres(part) == {(2, 4)}
    assert part.profiles[0].area == pytest.approx(4 * math.pi)
    (handle,) = part.profiles[0].origin.handles
    assert handle.count("/") == 2


def test_an_array_of_arrays_of_a_thousand_million_lines_is_refused_at_once(tmp_path):
    """Counted before it is unfolded; what else is drawn is read."""

    def draw(space):
        block(space, "B0")
        for level in range(1, 10):
            made = space.doc.blocks.new(f"B{level}")
            for i in range(10):
                made.add_blockref(f"B{level - 1}", (i, 0))
        space.add_blockref("B9", (0, 0))
        space.add_circle((0, 0), 5)

    start = time.perf_counter()
    part = drawn(tmp_path, draw)
    assert time.perf_counter() - start < 5
    assert codes(part) == ["entity-limit"]
    assert len(part.profiles) == 1


def test_a_huge_array_of_one_reference_is_refused_at_once(tmp_path):
    """Rows and columns count too."""

    def draw(space):
        block(space)
        grid = {"column_count": 32000, "row_count": 32000, "column_spacing": 10, "row_spacing": 5}
        space.add_blockref("B", (0, 0), dxfattribs=grid)

    assert codes(drawn(tmp_path, draw)) == ["entity-limit"]


def test_a_block_that_contains_itself_is_refused(tmp_path):
    """Directly, or through another one."""

    def draw(space):
        block(space, "A").add_blockref("B", (0, 0))
        block(space, "B").add_blockref("A", (0, 0))
        space.add_blockref("A", (0, 0))
        space.add_circle((9, 9), 1)

    part = drawn(tmp_path, draw)
    assert codes(part) == ["entity-cycle"]
    assert len(part.profiles) == 1


def test_references_that_lead_nowhere_are_reported(tmp_path):
    """A block that is not there, an outside file, a scale of nothing, a tilt."""

    def draw(space):
        block(space)
        space.doc.add_xref_def("other.dxf", "X")
        space.add_blockref("NONE", (0, 0))
        space.add_blockref("X", (0, 0))
        space.add_blockref("B", (0, 0), dxfattribs={"xscale": 1e-10})
        space.add_blockref("B", (0, 0), dxfattribs={"extrusion": (0, 1, 1)})

    part = drawn(tmp_path, draw)
    assert codes(part) == ["entity-missing-block", "entity-xref", "entity-degenerate", "entity-tilted"]
    assert part.profiles == ()


@pytest.mark.parametrize("state", ["off", "freeze", "no-plot", "invisible", "defpoints"])
def test_what_is_hidden_is_left_out_and_reported(tmp_path, state):
    """Layers that are off, frozen or not plotted, and entities marked as invisible."""

    def draw(space):
        layer = space.doc.layers.add("HIDE")
        if state in {"off", "freeze"}:
            getattr(layer, state)()
        layer.dxf.plot = int(state != "no-plot")
        name = "Defpoints" if state == "defpoints" else "HIDE"
        space.add_circle((0, 0), 5, dxfattribs={"layer": name, "invisible": int(state == "invisible")})
        space.add_circle((0, 0), 3)

    part = drawn(tmp_path, draw)
    assert codes(part) == ["entity-hidden"]
    assert len(part.profiles) == 1


def test_layer_0_in_a_block_is_the_layer_of_the_reference(tmp_path):
    """Its circle is hidden with the reference's layer, and named after it."""

    def draw(space):
        space.doc.layers.add("CUT")
        space.doc.layers.add("OLD").off()
        block(space)
        space.add_blockref("B", (0, 0), dxfattribs={"layer": "CUT"})
        space.add_blockref("B", (50, 0), dxfattribs={"layer": "OLD"})

    part = drawn(tmp_path, draw)
    assert [profile.origin.layer for profile in part.profiles] == ["CUT"]
    assert codes(part) == ["entity-hidden"]


def test_what_bounds_nothing_is_counted_by_kind_with_the_first_handle_and_place(tmp_path):
    """Three texts are one finding; each kind has its own code and remedy."""

    def draw(space):
        for i in range(3):
            space.add_text("A", dxfattribs={"insert": (10 + i, 5)})
        space.add_point((1, 1))
        space.add_hatch().paths.add_polyline_path([(0, 0), (1, 0), (1, 1)])
        space.add_3dface([(0, 0, 0), (1, 0, 0), (1, 1, 1)])
        space.add_xline((0, 0), (1, 0))
        space.add_solid([(0, 0), (1, 0), (1, 1)])

    part = drawn(tmp_path, draw, units=1)
    found = {
        finding.text.split()[1].rstrip(":"): finding for finding in part.findings if finding.code != "unit-decided"
    }
    assert {kind: finding.code for kind, finding in found.items()} == {
        "TEXT": "entity-annotation",
        "POINT": "entity-point",
        "HATCH": "entity-filling",
        "3DFACE": "entity-3d",
        "XLINE": "entity-unbounded",
        "SOLID": "entity-filling",
    }
    assert found["TEXT"].count == 3
    assert found["TEXT"].place == pytest.approx((254, 127))
    assert found["TEXT"].entity


def test_heights_are_reported_only_where_they_differ(tmp_path):
    """A drawing that lies at height 5 is flat; one at two heights is projected."""

    def draw(space):
        space.add_circle((0, 0, 5), 3)
        space.add_circle((9, 0, 5), 3)

    assert codes(drawn(tmp_path, draw)) == []
    two = drawn(tmp_path, lambda space: (space.add_circle((0, 0, 5), 3), space.add_circle((9, 0, 6), 3)))
    assert codes(two) == ["entity-height"]


def test_a_kind_of_entity_that_nobody_knows_is_reported(tmp_path):
    """It has no attributes that could be asked for, not even a layer."""
    path = write_drawing(tmp_path / "p.dxf", lambda space: (space.add_circle((0, 0), 1), space.add_point((5, 5))))
    path.write_text(path.read_text().replace("\nPOINT\n", "\nNOVELTY\n"))
    part = read_dxf(path, ReadOptions())
    assert codes(part) == ["entity-unsupported"]
    assert len(part.profiles) == 1
