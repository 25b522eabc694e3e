"""The parts that a newcomer sees first."""

import re
import subprocess
import sys
from collections import Counter

import ezdxf
import pytest

CLASSES = ("airplane", "bird", "bracket", "chassis", "ell", "gear", "map", "rect")


@pytest.fixture(scope="module")
def drawings(samples):
    """All DXF samples as ezdxf documents, by name."""
    return {path.stem: ezdxf.readfile(path) for path in sorted(samples.glob("*.dxf"))}


def test_there_are_enough_parts_in_each_class(samples, drawings):
    """Eight classes of at least three, and at least six of the parts as solids too."""
    sizes = Counter(name.rsplit("-", 1)[0] for name in drawings)
    assert set(sizes) == set(CLASSES)
    assert min(sizes.values()) >= 3
    solids = {path.stem for path in samples.glob("*.step")}
    assert len(solids) >= 6
    assert solids <= set(drawings)


def test_drawings_are_sound_and_in_millimetres(drawings):
    """The audit of ezdxf has nothing to say, and each drawing states its unit."""
    for name, drawing in drawings.items():
        audit = drawing.audit()
        assert (name, len(audit.errors), len(audit.fixes)) == (name, 0, 0)
        assert drawing.units == ezdxf.units.MM


def test_drawings_hold_real_splines(drawings):
    """Each has cubic B-splines with control points, none a polyline."""
    for name, drawing in drawings.items():
        kinds = Counter(entity.dxftype() for entity in drawing.modelspace())
        assert kinds["SPLINE"] >= 1, name
        assert set(kinds) <= {"SPLINE", "LINE", "ARC", "CIRCLE"}, name
        for spline in drawing.modelspace().query("SPLINE"):
            assert spline.dxf.degree == 3
            assert len(spline.control_points) >= 4


def test_drawings_are_small(samples):
    """A newcomer's clone does not carry much: each file stays under 250 kB."""
    assert all(path.stat().st_size < 250_000 for path in samples.iterdir() if path.suffix in {".dxf", ".step"})


def test_brackets_and_gears_have_holes_and_some_birds_do(samples):
    """The traits that the paper lists in its section 4.2."""
    from mashape_cad import read

    holes = {path.stem: len(read(path).profiles[0].holes) for path in sorted(samples.glob("*.dxf"))}
    assert all(count >= 1 for name, count in holes.items() if name.startswith(("bracket", "gear", "chassis")))
    birds = [count for name, count in holes.items() if name.startswith("bird")]
    assert min(birds) == 0 < max(birds)


def test_every_sample_is_one_profile_without_findings_but_its_unit(samples):
    """Nothing has to be repaired or left out."""
    from mashape_cad import read

    for path in sorted(samples.glob("*.dxf")):
        part = read(path)
        assert (path.name, len(part.profiles)) == (path.name, 1)
        assert [finding for finding in part.findings if finding.severity != "info"] == []


def test_a_solid_has_the_outline_of_its_drawing(samples):
    """The first profile of a STEP part has the area, holes and edges of the DXF of the same name."""
    from mashape_cad import read

    for path in sorted(samples.glob("*.step")):
        solid, drawing = read(path).profiles[0], read(path.with_suffix(".dxf")).profiles[0]
        assert solid.area == pytest.approx(drawing.area, rel=1e-9), path.name
        assert len(solid.holes) == len(drawing.holes)
        assert len(solid.edges) == len(drawing.edges)


@pytest.mark.slow
def test_the_script_makes_the_same_files_again(samples, repository, tmp_path):
    """So that a change of a drawing shows as one; last digits of a float differ from processor to processor."""
    script = repository / "samples" / "make_samples.py"
    subprocess.run([sys.executable, script, tmp_path], check=True, cwd=repository, env={"PYTHONPATH": str(repository)})
    made = {path.name: words_and_numbers(path) for path in tmp_path.iterdir()}
    shipped = {path.name: words_and_numbers(path) for path in samples.iterdir() if path.suffix in {".dxf", ".step"}}
    assert sorted(made) == sorted(shipped)
    for name, (words, numbers) in made.items():
        assert words == shipped[name][0], name
        assert numbers == pytest.approx(shipped[name][1], rel=0, abs=1e-11), name


def words_and_numbers(path):
    """Split a text file into what stands between decimal fractions, and these."""
    parts = re.split(r"(-?\d+\.\d*(?:[Ee][-+]?\d+)?)", path.read_text(encoding="utf-8"))
    return parts[::2], [float(part) for part in parts[1::2]]
