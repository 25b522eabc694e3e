import csv
import re

import numpy as np
import pytest
from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.GProp import GProp_GProps
from OCP.Interface import Interface_Static
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
from solids import L_SHAPE, box, drilled, placed, prism

from mashape_cad.errors import UnreadableFileError
from mashape_cad.findings import Severity
from mashape_cad.geometry.edge import EllipseArc
from mashape_cad.kernel.shapes import read_step as read_shape
from mashape_cad.kernel.shapes import together
from mashape_cad.options import ReadOptions
from mashape_cad.reading.step import read_brep, read_step


def _write_step(path, shape, unit="MM"):
    writer = STEPControl_Writer()
    Interface_Static.SetCVal_s("write.step.unit", unit)
    writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(path))
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    return path


def _write_brep(path, shape):
    BRepTools.Write_s(shape, str(path))
    return path


def _read(path, **options):
    return (read_brep if path.suffix == ".brep" else read_step)(path, ReadOptions(**options))


@pytest.fixture
def plate(tmp_path):
    """A drilled L, 5 mm thick, as STEP."""
    return _write_step(tmp_path / "plate.step", drilled(prism(L_SHAPE, 5), 5, 5, 2))


def test_a_plate_shows_its_outline_first(plate):
    """Top and bottom, then the walls from the largest on."""
    part = _read(plate)
    areas = [profile.area for profile in part.profiles]
    assert part.format == "step"
    assert part.path == plate
    assert areas == pytest.approx([600 - 4 * np.pi] * 2 + [200, 150, 150, 100, 50, 50], rel=1e-9)
    assert len(part.profiles[0].holes) == 1
    assert {finding.severity for finding in part.findings} == {Severity.INFO}


def test_a_long_bar_shows_its_section_first(tmp_path):
    """Its walls are much larger."""
    part = _read(_write_step(tmp_path / "bar.step", placed(prism(L_SHAPE, 1000), (3, 4, 5), 0.7)))
    assert [profile.area for profile in part.profiles[:3]] == pytest.approx([600, 600, 40_000], rel=1e-9)


@pytest.mark.parametrize(("unit", "name", "factor"), [("MM", "mm", 1), ("INCH", "in", 25.4), ("M", "m", 1000)])
def test_the_unit_of_the_file_is_read(tmp_path, unit, name, factor):
    """A box of 2 x 3 x 5 mm is that in any unit; which one it was is on record."""
    part = _read(_write_step(tmp_path / "box.step", box(2, 3, 5), unit))
    assert (part.unit.name, part.unit.millimetres, part.unit.decided_by) == (name, pytest.approx(factor), "file")
    assert part.profiles[0].area == pytest.approx(15, rel=1e-9)
    assert "unit-decided" in [finding.code for finding in part.findings]


def test_an_option_overrules_the_unit_of_the_file(tmp_path):
    """If the file's unit is wrong, its numbers are taken for what the user says."""
    path = _write_step(tmp_path / "box.step", box(2, 3, 5))
    part = _read(path, unit="in")
    assert part.unit.decided_by == "option"
    assert part.profiles[0].area == pytest.approx(15 * 25.4**2, rel=1e-9)
    assert any("the file states mm" in finding.text for finding in part.findings)
    same = _read(_write_step(path, box(2, 3, 5), "INCH"), unit="in")
    assert same.profiles[0].area == pytest.approx(15, rel=1e-9)


def test_numbers_of_a_brep_file_are_millimetres_unless_an_option_says_otherwise(tmp_path):
    """The format states no unit."""
    path = _write_brep(tmp_path / "box.brep", box(2, 3, 5))
    assert _read(path).unit.decided_by == "default"
    assert _read(path).profiles[0].area == pytest.approx(15, rel=1e-12)
    assert _read(path, unit="cm").profiles[0].area == pytest.approx(1500, rel=1e-12)


def test_every_place_of_a_part_in_an_assembly_counts(tmp_path):
    """Two instances, one of them turned."""
    part = drilled(prism(L_SHAPE, 5), 5, 5, 2)
    path = _write_step(tmp_path / "assembly.step", together([part, placed(part, (100, 0, 0), 1.0)]))
    profiles = _read(path).profiles
    assert len(profiles) == 16
    assert [len(profile.holes) for profile in profiles[:5]] == [1, 1, 1, 1, 0]


def test_a_file_name_may_have_any_letters(tmp_path):
    """Spaces, umlauts and brackets."""
    assert _read(_write_step(tmp_path / "Gehäuse (neu) [3].step", box(1, 2, 3))).profiles


def test_a_file_that_only_points_at_others_says_so(tmp_path, plate):
    """Its product structure holds no shape; the files it names do."""
    lines = plate.read_text().splitlines()
    start = lines.index("DATA;")
    path = tmp_path / "structure.step"
    reference = "#1 = DOCUMENT_FILE('wheel.stp','','',#2,'',$);\n#2 = DOCUMENT_TYPE('geometry');"
    path.write_text("\n".join([*lines[: start + 1], reference, "ENDSEC;", "END-ISO-10303-21;"]))
    part = _read(path)
    assert part.profiles == ()
    (finding,) = [finding for finding in part.findings if finding.severity is Severity.LOST]
    assert finding.code == "file-no-shape"
    assert "wheel.stp" in finding.text


def _spoiled(plate, how):
    text = plate.read_text()
    if how == "cut":
        return text[: len(text) // 2]
    if how == "cut, end mark kept":
        return text[: len(text) // 2] + "\nENDSEC;\nEND-ISO-10303-21;\n"
    if how == "dangling reference":
        lines = [line for line in text.splitlines() if "EDGE_LOOP" not in line]
        return "\n".join(lines)
    if how == "other text":
        return "<html>404</html>" * 1000
    return "\n \n"


@pytest.mark.parametrize(
    ("how", "told"),
    [
        ("cut", "cut off"),
        ("cut, end mark kept", "not a sound STEP file"),
        ("dangling reference", "missing"),
        ("other text", "not a STEP file"),
        ("nothing", "empty"),
    ],
)
def test_a_spoiled_step_file_is_told_in_one_line(plate, capfd, how, told):
    """With the cause and what to do; the kernel itself stays silent."""
    plate.write_text(_spoiled(plate, how))
    with pytest.raises(UnreadableFileError, match=told) as caught:
        _read(plate)
    assert "\n" not in str(caught.value)
    assert ";" in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_stray_entities_do_not_matter(plate):
    """Some programs write entities without parameters that nobody refers to."""
    text = plate.read_text()
    head, _, tail = text.rpartition("ENDSEC;")
    plate.write_text(f"{head}#999998=BOUNDED_CURVE();\n#999999=B_SPLINE_CURVE();\nENDSEC;{tail}")
    assert len(_read(plate).profiles) == 8


def test_a_number_that_is_none_is_told(plate):
    """The kernel would leave the faces out that need it."""
    damaged = re.sub(r"CARTESIAN_POINT\('',\(30\.", "CARTESIAN_POINT('',(3x.", plate.read_text(), count=1)
    plate.write_text(damaged)
    with pytest.raises(UnreadableFileError, match="not a sound STEP file"):
        _read(plate)


@pytest.mark.parametrize("content", ["", "prose named .brep\n" * 50, "half"])
def test_a_spoiled_brep_file_is_told_in_one_line(tmp_path, capfd, content):
    """Empty, other text, or cut off."""
    path = _write_brep(tmp_path / "box.brep", box(1, 2, 3))
    whole = path.read_text()
    path.write_text(whole[: len(whole) // 2] if content == "half" else content)
    with pytest.raises(UnreadableFileError) as caught:
        _read(path)
    assert "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_a_file_that_is_not_there_is_the_systems_error(tmp_path):
    """Whoever calls knows how to tell it."""
    with pytest.raises(FileNotFoundError):
        _read(tmp_path / "none.step")
    with pytest.raises(FileNotFoundError):
        _read(tmp_path / "none.brep")


def _truth(corpus):
    with (corpus / "truth.csv").open(newline="") as file:
        return [row for row in csv.DictReader(file) if row["kind"] in {"step", "brep"}]


def _agrees(part, row):
    """Whether planar faces, and holes and area of the largest one, are what the table says."""
    flat_splines = sum(finding.code == "entity-flat-spline" for finding in part.findings)
    if len(part.profiles) - flat_splines != int(row["profiles_or_planar_faces"]):
        return False
    if not part.profiles:
        return row["area"] == ""
    largest = max(part.profiles, key=lambda profile: profile.area)
    return len(largest.holes) == int(row["holes"]) and abs(largest.area / float(row["area"]) - 1) <= 2e-5


@pytest.mark.slow
def test_real_files_agree_with_the_table(corpus):
    """Planar faces, holes and area of all 91 STEP and BREP files in it."""
    rows = _truth(corpus)
    wrong = [row["path"] for row in rows if not _agrees(_read(corpus / row["path"]), row)]
    assert len(rows) > 80
    assert wrong == []


def _rounding(loop):
    """What the largest number in a loop leaves of the fifteenth digit."""
    centres = [np.abs(edge.centre).max() for edge in loop.edges if isinstance(edge, EllipseArc)]
    return 1e-14 * max(np.abs(loop.bounds).max(), *centres, 0)


@pytest.mark.slow
def test_edges_of_real_files_meet_and_lie_on_the_left(corpus):
    """Every loop is closed to rounding, which is that of the centre for flat arcs; outlines run left, holes right."""
    for path in sorted([*corpus.glob("step/*"), *corpus.glob("brep/*")]):
        for profile in _read(path).profiles:
            assert profile.outer.signed_area > 0
            assert all(hole.signed_area < 0 for hole in profile.holes)
            for loop in profile:
                ends = zip([loop.edges[-1], *loop.edges], loop.edges, strict=False)
                assert max(np.hypot(*(edge.start - before.end)) for before, edge in ends) <= _rounding(loop), path


@pytest.mark.slow
def test_hostile_files_are_read_or_refused(corpus, capfd):
    """Nothing but the one error, and nothing on the terminal."""
    profiles = {
        "assembly_two_instances.step": 12,
        "box_offset_1e7.step": 6,
        "micro_box.step": 6,
        "sphere_no_planar_face.step": 0,
    }
    for path in sorted([*corpus.glob("hostile/*.step"), *corpus.glob("hostile/*.brep")]):
        if path.name in profiles:
            assert len(_read(path).profiles) == profiles[path.name]
        else:
            with pytest.raises(UnreadableFileError):
                _read(path)
    assert capfd.readouterr() == ("", "")


def _surface(path):
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(read_shape(path).shape, properties, 1e-7)
    return properties.Mass()


@pytest.mark.slow
def test_first_profile_of_extruded_parts_is_the_one_that_was_extruded(retrieval):
    """Two caps and the wall around them make up the whole surface, which the kernel knows to a part in 500."""
    paths = sorted(retrieval.glob("parts/*/*.step"))
    assert paths
    for path in paths:
        part = _read(path)
        first, second = part.profiles[:2]
        normal = np.array(first.origin.plane.normal)
        height = abs(normal @ (np.array(first.origin.plane.origin) - second.origin.plane.origin))
        assert 2 * first.area + first.perimeter * height == pytest.approx(_surface(path), rel=5e-3), path
