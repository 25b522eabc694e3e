import ezdxf
import pytest
from drawings import codes, write_drawing
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mashape_cad.errors import UnreadableFileError
from mashape_cad.options import ReadOptions
from mashape_cad.reading.dxf import read_dxf

POLYGON = [(0, 0), (9.5, 0), (9.5, 5), (0, 5)]


def polygon(space):
    """Draw a rectangle with a side of 9.5 as four lines."""
    for first, last in zip(POLYGON, POLYGON[1:] + POLYGON[:1], strict=True):
        space.add_line(first, last)


def spoilt(path, change):
    """Write a drawing of four lines and a spline-free circle, then change its text."""
    write_drawing(path, lambda space: (polygon(space), space.add_circle((4, 2), 1)))
    path.write_bytes(change(path.read_bytes()))
    return read_dxf(path, ReadOptions())


@pytest.mark.parametrize("version", ["R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018"])
@pytest.mark.parametrize("binary", [False, True])
def test_all_versions_are_read_text_and_binary(tmp_path, version, binary):
    """The same area from each."""
    document = ezdxf.new(version)
    polygon(document.modelspace())
    document.saveas(tmp_path / "p.dxf", fmt="bin" if binary else "asc")
    assert read_dxf(tmp_path / "p.dxf", ReadOptions(unit="mm")).profiles[0].area == pytest.approx(47.5)


def test_decimal_commas_are_read_as_points(tmp_path):
    """A recovering reader would keep the 9 of 9,5; what was changed is on record."""
    part = spoilt(tmp_path / "p.dxf", lambda data: data.replace(b"\n9.5\n", b"\n9,5\n"))
    assert part.profiles[0].area == pytest.approx(47.5 - 3.14159265)
    assert {"file-recovered", "file-decimal-comma"} <= set(codes(part))


def test_missing_subclass_markers_are_added(tmp_path):
    """Also to blocks and layers; hidden layers stay hidden."""

    def draw(space):
        space.doc.layers.add("OLD").off()
        space.doc.blocks.new("B").add_circle((0, 0), 1)
        space.add_blockref("B", (4, 2))
        space.add_lwpolyline(POLYGON, close=True)
        space.add_circle((0, 0), 50, dxfattribs={"layer": "OLD"})

    path = write_drawing(tmp_path / "p.dxf", draw)
    lines = path.read_text().splitlines()
    kept = [pair for pair in zip(lines[::2], lines[1::2], strict=True) if pair[0].strip() != "100"]
    path.write_text("\n".join(line for pair in kept for line in pair) + "\n")
    part = read_dxf(path, ReadOptions(unit="mm"))
    assert part.profiles[0].area == pytest.approx(47.5 - 3.14159265)
    assert "file-subclass-markers" in codes(part)
    assert "entity-hidden" in codes(part)


def test_a_damaged_structure_is_recovered_and_said_so(tmp_path):
    """The geometry is whole, the record says that the file was not."""
    part = spoilt(tmp_path / "p.dxf", lambda data: data.replace(b"ENDSEC\n", b"ENDSEC\n  0\nENDSEC\n", 1))
    assert len(part.profiles) == 1
    assert "file-recovered" in codes(part)


def test_a_byte_order_mark_does_not_matter(tmp_path):
    """Editors add it."""
    assert len(spoilt(tmp_path / "p.dxf", lambda data: b"\xef\xbb\xbf" + data).profiles) == 1


@pytest.mark.parametrize("share", [0.3, 0.9, 0.999])
def test_a_file_that_is_cut_off_is_refused(tmp_path, share):
    """Half a part is worse than none: the message says what is missing and what to do."""
    with pytest.raises(UnreadableFileError, match=r"cut off.*EOF.*again"):
        spoilt(tmp_path / "p.dxf", lambda data: data[: int(len(data) * share)])


def test_other_text_is_refused(tmp_path):
    """Prose named .dxf."""
    with pytest.raises(UnreadableFileError, match="not a DXF file"):
        spoilt(tmp_path / "p.dxf", lambda _: b"Please cut this plate twice.\nRegards\n")


def test_beyond_repair_is_one_line(tmp_path):
    """Nothing but structure, all of it wrong."""
    with pytest.raises(UnreadableFileError) as refused:
        spoilt(tmp_path / "p.dxf", lambda _: b"0\nSECTION\n2\nHEADER\nno group code\nvalue\n0\nEOF\n")
    assert "\n" not in str(refused.value)
    assert "not a sound DXF file" in str(refused.value)


def test_nothing_reaches_the_terminal(tmp_path, capfd):
    """What ezdxf has to say about a file becomes a finding."""

    def with_handle_twice(data):
        handles = [line for i, line in enumerate(data.split(b"\n")) if data.split(b"\n")[i - 1] == b"  5"]
        return data.replace(b"  5\n" + handles[-1] + b"\n", b"  5\n" + handles[-2] + b"\n")

    part = spoilt(tmp_path / "p.dxf", with_handle_twice)
    assert capfd.readouterr() == ("", "")
    assert "file-warning" in codes(part)


def everything(space):
    """Draw one of each kind that is read, and a nested reference."""
    polygon(space)
    space.add_circle((4, 2), 1)
    space.add_arc((20, 0), 2, 0, 180)
    space.add_ellipse((30, 0), (3, 1), 0.5)
    space.add_lwpolyline([(40, 0, 0.5), (44, 0, 0), (44, 3, -1)], format="xyb", close=True)
    space.add_polyline2d([(50, 0), (54, 0), (54, 3)], close=True)
    space.add_open_spline([(60, 0), (61, 3), (64, 2), (66, 0)])
    space.add_spline([(70, 0), (71, 3), (74, 2), (76, 0)])
    space.doc.blocks.new("IN").add_circle((0, 0), 1)
    space.doc.blocks.new("OUT").add_blockref("IN", (1, 1), dxfattribs={"xscale": 2})
    space.add_blockref("OUT", (80, 0), dxfattribs={"row_count": 2, "row_spacing": 5})
    space.add_text("A")


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(
        st.tuples(
            st.floats(0, 1), st.sampled_from(["drop", "drop pair", "double", "0", "-5", "nan", "1e400", "abc", ""])
        ),
        min_size=1,
        max_size=5,
    )
)
def test_damage_of_any_kind_gives_a_part_or_one_clear_line(tmp_path, damages):
    """Lines of the file's geometry lost, doubled, or replaced by nonsense: never a traceback."""
    path = tmp_path / "damaged.dxf"
    if not (tmp_path / "sound.dxf").exists():
        write_drawing(tmp_path / "sound.dxf", everything, version="R2000")
    lines = (tmp_path / "sound.dxf").read_text().splitlines()
    first = lines.index("BLOCKS")
    for place, damage in damages:
        at = first + int(place * (lines.index("OBJECTS") - first - 1)) if "OBJECTS" in lines else first
        replacement = {"drop": [], "drop pair": [], "double": lines[at : at + 1] * 2}.get(damage, [damage])
        lines[at : at + 1 + (damage == "drop pair")] = replacement
    path.write_text("\n".join(lines) + "\n")
    try:
        read_dxf(path, ReadOptions())
    except UnreadableFileError as error:
        assert "\n" not in str(error)  # noqa: PT017
