"""``mashape-cad axis`` as people run it: files in, files out, what is left out and how it ends."""

import json
import xml.etree.ElementTree as ET

import ezdxf
import numpy as np
import pytest
from drawings import write_drawing

from mashape_cad.cli import main as program
from mashape_cad.cli.axis import axis
from mashape_cad.options import AxisOptions


@pytest.fixture
def run(capsys):
    """Run the program in this process: exit code, lines on stdout, lines on stderr."""

    def run(*arguments):
        code = program.main(["axis", *(str(each) for each in arguments)])
        captured = capsys.readouterr()
        return code, captured.out.splitlines(), captured.err.splitlines()

    return run


def _rectangle(space, x=0.0, y=0.0):
    space.add_lwpolyline([(x, y), (x + 7, y), (x + 7, y + 3), (x, y + 3)], close=True)


def _bowtie(space, x=0.0):
    space.add_lwpolyline([(x, 0), (x + 4, 4), (x + 4, 0), (x, 3)], close=True)


@pytest.fixture
def drawing(tmp_path):
    """Two rectangles in inches, under a name that needs care."""
    folder = tmp_path / "Zeichnungen (alt)"
    folder.mkdir()

    def draw(space):
        _rectangle(space)
        _rectangle(space, x=10.0, y=2.0)

    return write_drawing(folder / "Träger 1 [neu].dxf", draw, units=1)


@pytest.mark.parametrize("suffix", ["json", "svg", "dxf", "JSON", "DXF"])
def test_all_profiles_are_written(drawing, run, suffix):
    """Beside the drawing, in mm; nothing else is left in the folder."""
    out = drawing.with_name(f"Achse ä.{suffix}")
    assert run(drawing, "-o", out) == (0, ["2 of 2 profiles, 10 branches"], [])
    assert sorted(path.name for path in out.parent.iterdir()) == sorted([drawing.name, out.name])
    if suffix.lower() == "json":
        profiles = json.loads(out.read_bytes())["profiles"]
        assert [each["profile"] for each in profiles] == [0, 1]
        assert max(node["r"] for node in profiles[0]["nodes"]) == pytest.approx(1.5 * 25.4)
        assert max(node["x"] for node in profiles[1]["nodes"]) == pytest.approx(17 * 25.4)
    elif suffix.lower() == "dxf":
        assert ezdxf.readfile(out).header["$INSUNITS"] == 4
    else:
        root = ET.fromstring(out.read_bytes())  # noqa: S314  (our own)
        assert float(root.get("width").removesuffix("mm")) > 17 * 25.4


def test_one_profile(drawing, run, tmp_path):
    """By its number, which it keeps."""
    out = tmp_path / "a.json"
    assert run(drawing, "--profile", "1", "-o", out, "-q") == (0, [], [])
    assert [each["profile"] for each in json.loads(out.read_bytes())["profiles"]] == [1]
    code, _, err = run(drawing, "--profile", "2", "-o", tmp_path / "b.json")
    assert (code, len(err)) == (1, 1)
    assert "no profile 2; it has 2, numbered from 0" in err[0]
    assert not (tmp_path / "b.json").exists()


@pytest.mark.parametrize("step", [0.5, 40.0])
def test_the_step(drawing, run, tmp_path, step):
    """In mm, whatever the drawing's unit."""
    out = tmp_path / "a.json"
    run(drawing, "--step", step, "-o", out)
    for profile in json.loads(out.read_bytes())["profiles"]:
        for branch in profile["branches"]:
            chords = np.hypot(np.diff(branch["x"]), np.diff(branch["y"]))
            assert step / 3 < chords.max() <= step * (1 + 1e-9)


@pytest.mark.parametrize("switches", [("--min-angle", "46"), ("--min-thickness", "16")])
def test_end_branches_can_be_left_out(drawing, run, tmp_path, switches):
    """Those into the corners have 45 degrees and stick out by 0.62 inches, 15.8 mm."""
    out = tmp_path / "a.json"
    assert run(drawing, *switches, "-o", out)[1] == ["2 of 2 profiles, 2 branches"]
    assert [len(each["branches"]) for each in json.loads(out.read_bytes())["profiles"]] == [1, 1]


@pytest.mark.parametrize("suffix", ["json", "svg", "dxf"])
def test_a_refused_profile_is_named_and_left_out(tmp_path, run, suffix):
    """Exit code 3; the others are written, and JSON has the reason too."""

    def draw(space):
        _rectangle(space)
        _bowtie(space, x=20.0)

    path, out = write_drawing(tmp_path / "a b.dxf", draw), tmp_path / f"out.{suffix}"
    code, lines, err = run(path, "-o", out)
    assert (code, lines) == (3, ["1 of 2 profiles, 5 branches"])
    (line,) = err
    assert line.startswith(f"left out: {path}: profile ")
    assert "cross" in line
    assert out.exists()
    if suffix == "json":
        document = json.loads(out.read_bytes())
        (refused,) = document["refused"]
        assert {refused["profile"], *(each["profile"] for each in document["profiles"])} == {0, 1}
        assert refused["kind"] == "crossing"


def test_only_refused_profiles(tmp_path, run):
    """Exit code 1, and no file: an old one stays as it was."""
    path, out = write_drawing(tmp_path / "a.dxf", _bowtie), tmp_path / "out.json"
    out.write_text("old")
    code, lines, err = run(path, "-o", out)
    assert (code, lines, len(err)) == (1, [], 1)
    assert out.read_text() == "old"


def test_files_that_cannot_be_used(tmp_path, run):
    """One line each: no such file, no outline in it, no folder to write to."""
    path = write_drawing(tmp_path / "a.dxf", _rectangle)
    empty = write_drawing(tmp_path / "empty.dxf", lambda space: space.add_line((0, 0), (1, 1)))
    for arguments, text in (
        ([tmp_path / "gone.dxf", "-o", tmp_path / "o.svg"], "gone.dxf"),
        ([empty, "-o", tmp_path / "o.svg"], "no closed outline"),
        ([path, "-o", tmp_path / "gone" / "o.svg"], "choose a folder that exists"),
    ):
        code, out, err = run(*arguments)
        assert (code, out, len(err)) == (1, [], 1)
        assert text in err[0]


def test_the_drawing_itself_is_not_overwritten_by_mistake(tmp_path, run):
    """OUT may not be FILE."""
    path = write_drawing(tmp_path / "a.dxf", _rectangle)
    before = path.read_bytes()
    code, _, err = run(path, "-o", tmp_path / "." / "a.dxf")
    assert code == 2
    assert "is the file that is read" in err[-1]
    assert path.read_bytes() == before


def test_defaults_stand_in_one_place():
    """The switches are the declared options with their defaults."""
    defaults = {each.name: each.default for each in axis.params}
    options = AxisOptions()
    for name in ("step", "min_angle", "min_thickness"):
        assert defaults[name] == getattr(options, name)


@pytest.mark.parametrize("values", [{"step": 0.0}, {"min_angle": 90.1}, {"min_thickness": -1.0}])
def test_values_outside_their_range(values):
    """Are refused from Python too."""
    with pytest.raises(ValueError, match=next(iter(values))):
        AxisOptions(**values)
