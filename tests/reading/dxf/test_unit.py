import pytest
from drawings import drawn, write_drawing

from mashape_cad.options import ReadOptions
from mashape_cad.reading.dxf import read_dxf


def square(space):
    """Draw a square of 2 units."""
    space.add_lwpolyline([(0, 0), (2, 0), (2, 2), (0, 2)], close=True)


def without(path, *variables):
    """Take variables, each of one value, out of the header of a DXF file."""
    lines = path.read_text().splitlines()
    for variable in variables:
        while variable in lines:
            at = lines.index(variable)
            del lines[at - 1 : at + 3]
    path.write_text("\n".join(lines) + "\n")
    return path


def decided(part):
    """Say what was decided of the unit, and how loud."""
    (finding,) = [finding for finding in part.findings if finding.code == "unit-decided"]
    return part.unit.name, part.unit.millimetres, part.unit.decided_by, finding.severity


@pytest.mark.parametrize(
    ("code", "name", "millimetres"), [(1, "in", 25.4), (4, "mm", 1.0), (5, "cm", 10.0), (6, "m", 1e3)]
)
def test_the_header_says_the_unit_and_coordinates_become_mm(tmp_path, code, name, millimetres):
    """$INSUNITS; a square of 2 units."""
    part = drawn(tmp_path, square, units=code)
    assert decided(part) == (name, millimetres, "insunits", "info")
    assert part.profiles[0].area == pytest.approx(4 * millimetres**2)


def test_the_option_overrules_the_header(tmp_path):
    """The file says metres, the user says inches."""
    part = drawn(tmp_path, square, ReadOptions(unit="in"), units=6)
    assert decided(part) == ("in", 25.4, "option", "info")
    assert part.profiles[0].area == pytest.approx(4 * 25.4**2)


@pytest.mark.parametrize(("measurement", "name"), [(0, "in"), (1, "mm")])
def test_without_a_unit_the_system_of_measurement_decides(tmp_path, measurement, name):
    """$INSUNITS 0 says nothing."""

    def draw(space):
        square(space)
        space.doc.header["$MEASUREMENT"] = measurement

    assert decided(drawn(tmp_path, draw, units=0))[::2] == (name, "measurement")


def test_with_nothing_in_the_header_it_is_mm_and_the_record_says_assumed(tmp_path):
    """Ezdxf has defaults for variables that are not there; they are no statement of the file."""
    path = without(write_drawing(tmp_path / "square.dxf", square), "$INSUNITS", "$MEASUREMENT")
    part = read_dxf(path, ReadOptions())
    assert decided(part) == ("mm", 1.0, "default", "info")
    assert "assumed" in part.findings[0].text


def test_a_unit_that_no_part_has_counts_as_none(tmp_path):
    """Light years fall through to $MEASUREMENT."""

    def draw(space):
        square(space)
        space.doc.header["$MEASUREMENT"] = 1

    assert drawn(tmp_path, draw, units=19).unit.decided_by == "measurement"
