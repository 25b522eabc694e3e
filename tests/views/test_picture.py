# ruff: noqa: RUF001, S314  -- the sign of multiplication is meant; the XML is our own

import subprocess
import sys
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from mashape_cad.errors import MashapeError
from mashape_cad.geometry.edge import Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.library.record import Refusal, Thumbnail
from mashape_cad.views.picture import write_record, write_show

SVG = "{http://www.w3.org/2000/svg}"


def texts(path):
    """All texts of an SVG file, in order."""
    return [element.text for element in ET.parse(path).iter(f"{SVG}text")]


def test_a_picture_says_what_it_shows(plate, tmp_path):
    """Name, size, counts, the three functions, the scale and the largest radius."""
    out = tmp_path / "plate.svg"
    write_record(out, plate, "plate.dxf")
    said = texts(out)
    assert said[0] == "plate.dxf"
    assert "50.0 × 20.0 mm · 8 edges · 1 hole · 3 branches" in said
    assert {"DF", "RF", "CF", "10 mm", "clearance radius"} <= set(said)


def test_both_kinds_of_file_are_written(plate, tmp_path):
    """The suffix decides, in small letters or capitals."""
    for name, start in (("a.svg", b"<svg "), ("b.SVG", b"<svg "), ("c.png", b"\x89PNG"), ("d.PNG", b"\x89PNG")):
        write_record(tmp_path / name, plate, "plate.dxf")
        assert (tmp_path / name).read_bytes().startswith(start)


def test_the_same_record_gives_the_same_bytes(plate, tmp_path):
    """Pictures can be kept under version control."""
    for name in ("a.svg", "b.svg", "a.png", "b.png"):
        write_record(tmp_path / name, plate, "plate.dxf")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_another_suffix_is_refused_by_naming_the_known_ones(plate, tmp_path):
    """And nothing is written."""
    with pytest.raises(MashapeError, match=r"plate\.pdf.*\.svg or \.png"):
        write_record(tmp_path / "plate.pdf", plate, "plate.dxf")
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_one_line_with_the_remedy(plate, tmp_path):
    """Not a traceback of the system's error."""
    with pytest.raises(MashapeError, match="No such file or directory; choose a folder"):
        write_record(tmp_path / "nowhere" / "plate.svg", plate, "plate.dxf")


def test_a_refused_profile_is_drawn_with_reason_and_place(plate, tmp_path):
    """The outline stays, the charts give way to the reason, a ring marks the place."""
    refusal = Refusal("profile-invalid", "the outline crosses itself; mend it in the drawing", (35.0, 15.0), "crossing")
    light = replace(plate.thumbnail, branches=())
    out = tmp_path / "plate.svg"
    write_record(out, replace(plate, axis=None, vectors=None, thumbnail=light, refused=refusal), "plate.dxf")
    said = texts(out)
    assert "no medial axis" in said
    assert "the outline crosses itself; mend it in" in " ".join(said)
    assert not {"DF", "clearance radius"} & set(said)
    (ring,) = ET.parse(out).iter(f"{SVG}circle")
    panel = next(ET.parse(out).iter(f"{SVG}path")).get("d")
    xs = [float(pair.split()[0]) for pair in panel.strip("MZ").split("Z")[0].split("L")]
    assert float(ring.get("cx")) == pytest.approx((min(xs) + max(xs)) / 2, abs=0.02)


def test_a_profile_without_extent_is_drawn_as_nothing(plate, tmp_path):
    """The record of a profile whose numbers cannot be kept."""
    empty = replace(
        plate,
        bounds=(0.0, 0.0, 0.0, 0.0),
        thumbnail=Thumbnail((0.0, 0.0), 1.0, ()),
        axis=None,
        vectors=None,
        refused=Refusal("profile-invalid", "the profile has no extent"),
    )
    for name in ("empty.svg", "empty.png"):
        write_record(tmp_path / name, empty, "empty.dxf")
        assert (tmp_path / name).stat().st_size > 0


def test_drawing_a_record_as_svg_loads_nothing_heavy(tmp_path):
    """No kernel, no reader, no medial axis, no scipy, no matplotlib."""
    heavy = (
        "OCP",
        "ezdxf",
        "numba",
        "scipy",
        "matplotlib",
        "mashape_cad.medial",
        "mashape_cad.kernel",
        "mashape_cad.reading",
    )
    modules = "mashape_cad.views.picture, mashape_cad.views.page"
    code = f"import sys, {modules}; print([m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_exact_values_are_drawn_like_a_record(tmp_path):
    """Profile, axis and signature, with a radius in the colour bar and as many branches as there are."""
    from mashape_cad import medial_axis, signature

    corners = np.array([(0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (0.0, 10.0)])
    sides = (Line.of(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True))
    axis = medial_axis(Profile.of(Loop(tuple(sides))))
    write_show(tmp_path / "plate.svg", axis.profile, axis, signature(axis), "plate.dxf")
    said = texts(tmp_path / "plate.svg")
    assert "30.0 × 10.0 mm · 4 edges · no holes · 5 branches" in said
    assert "5 mm" in said
    assert {"DF", "RF", "CF"} <= set(said)
