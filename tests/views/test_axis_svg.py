# ruff: noqa: S314  -- the XML is our own

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, profile_of
from traces import moved, traced

from mashape_cad.geometry.profile import Origin, Plane
from mashape_cad.views.axis_svg import axes_svg
from mashape_cad.views.colours import PAPER

NAMES = {"svg": "http://www.w3.org/2000/svg"}


def _tree(*profiles, name="part.dxf", **options):
    return ET.fromstring(axes_svg(traced(*profiles, **options), Path(name)))


def _scale(tree):
    """Millimetres to a unit of the view box, in both directions."""
    box = [float(each) for each in tree.get("viewBox").split()]
    sides = [float(tree.get(side).removesuffix("mm")) for side in ("width", "height")]
    return sides[0] / box[2], sides[1] / box[3]


def _points(path):
    return np.array([[float(each) for each in pair.split()] for pair in re.findall(r"[\d.-]+ [\d.-]+", path.get("d"))])


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_it_is_drawn_in_true_size(name):
    """Width and height are in mm, and the outline's box is as large as the profile's."""
    tree, profile = _tree(name), profile_of(name)
    across, down = _scale(tree)
    assert across == pytest.approx(down, rel=1e-6)
    drawn = np.ptp(_points(tree.findall("svg:path", NAMES)[0]), axis=0) * across
    points = np.concatenate([loop.flattened(24) for loop in profile.loops])
    assert drawn == pytest.approx(np.ptp(points, axis=0), abs=3e-5 * profile.diagonal)


def test_branches_have_the_colour_of_their_clearance():
    """The middle branch of the rectangle is the lightest, the vertices are dark, the rest lies between."""
    paths = _tree("rectangle").findall("svg:path", NAMES)
    strokes = {path.get("stroke"): path for path in paths if path.get("fill") == "none"}
    assert next(iter(strokes)) == PAPER.axis[0]
    assert list(strokes)[-1] == PAPER.axis[-1]
    assert len(strokes) == len(PAPER.axis)
    middle = _points(strokes[PAPER.axis[-1]])
    assert np.ptp(middle[:, 0]) > 0.5 * np.ptp(_points(paths[0])[:, 0])


def test_the_legend_names_the_largest_clearance():
    """Of all profiles: colours compare."""
    texts = [text.text for text in _tree("rectangle", moved("ell", 20, 0)).findall("svg:text", NAMES)]
    assert texts == ["clearance radius", "0", "0.75", "1.5 mm"]


def test_profiles_of_a_drawing_lie_where_they_are():
    """The second one 20 mm to the right."""
    tree = _tree("rectangle", moved("rectangle", 20, 0))
    outline = _points(tree.findall("svg:path", NAMES)[0]) * _scale(tree)[0]
    assert np.ptp(outline[:, 0]) == pytest.approx(27.0, abs=1e-3)
    assert np.ptp(outline[:, 1]) == pytest.approx(3.0, abs=1e-3)


def test_faces_in_different_planes_are_drawn_below_one_another():
    """Each under its name, none over another."""
    faces = [
        replace(profile_of(name), origin=Origin(face=face, plane=Plane((0.0, 0.0, z), (1.0, 0, 0), (0, 0, 1.0))))
        for name, face, z in (("rectangle", 3, 0.0), ("ell", 7, 5.0))
    ]
    tree = _tree(*faces)
    assert [text.text for text in tree.findall("svg:text", NAMES)][:2] == ["profile 0 (face 3)", "profile 1 (face 7)"]
    d = tree.findall("svg:path", NAMES)[0].get("d")
    first, second = ([float(y) for y in re.findall(r" ([\d.]+)", part)] for part in d.split("Z")[:2])
    assert max(first) < min(second)


@pytest.mark.parametrize("name", ["disc", "eccentric ring", "wedged room"])
def test_special_axes_are_drawn(name):
    """A point, a branch without end, branches between vertices."""
    assert len(_tree(name)) > 5


def test_names_with_umlauts_and_markup():
    """Are escaped."""
    assert _tree("ell", name="Träger <1> & 2.dxf").findtext("svg:title", namespaces=NAMES) == (
        "medial axis of Träger <1> & 2.dxf"
    )


def test_a_pruned_axis_can_be_drawn():
    """Down to one point."""
    tree = _tree("square", min_thickness=1e6)
    assert len(tree.findall("svg:circle", NAMES)) == 1
