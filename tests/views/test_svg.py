# ruff: noqa: S314  -- the XML is our own

import xml.etree.ElementTree as ET

import numpy as np

from mashape_cad.views.drawing import Area, Circle, Difference, Drawing, Label, Lines, rectangle
from mashape_cad.views.svg import svg

NAMES = {"svg": "http://www.w3.org/2000/svg"}


def tree(*shapes, title="a part"):
    """A drawing of these shapes, written and parsed again."""
    return ET.fromstring(svg(Drawing(100, 50, title, shapes)))


def test_each_shape_is_one_element_in_order():
    """Area, lines, circle and text, none lost, none swapped."""
    shapes = (
        Area((rectangle(0, 0, 10, 10),), "#ff0000"),
        Lines((np.array([(0.0, 0.0), (1.0, 2.0)]),), "#00ff00", 1.5),
        Circle(5, 5, 2, "none", "#0000ff", 1),
        Label(1, 2, "words", 10, "#000000", "end", bold=True),
    )
    kinds = [element.tag.split("}")[1] for element in tree(*shapes)]
    assert kinds == ["title", "path", "path", "circle", "text"]


def test_holes_are_left_out():
    """The rings of an area are filled by the even-odd rule."""
    (path,) = tree(Area((rectangle(0, 0, 9, 9), rectangle(2, 2, 3, 3)), "#abcdef")).findall("svg:path", NAMES)
    assert path.get("fill-rule") == "evenodd"
    assert path.get("d") == "M0 0L9 0L9 9L0 9ZM2 2L5 2L5 5L2 5Z"


def test_numbers_are_short_and_plain():
    """No exponents, no minus zero, hundredths at most."""
    text = svg(Drawing(100, 50, "t", (Lines((np.array([(-0.0001, 1e-9), (12.3456, 100.0)]),), "#000000", 1),)))
    assert 'd="M0 0L12.35 100"' in text


def test_names_cannot_break_out():
    """Markup in names is text, and what XML cannot hold is replaced."""
    name = 'Ä<b>&"x"\x01.dxf'
    root = tree(Label(0, 0, name, 10, "#000000"), title=name)
    shown = 'Ä<b>&"x"\ufffd.dxf'
    assert root.find("svg:text", NAMES).text == shown
    assert root.find("svg:title", NAMES).text == shown
    assert root.get("aria-label") == shown


def test_shapes_of_nothing_leave_no_trace():
    """An area without rings, lines without runs."""
    assert len(tree(Area((), "#000000"), Lines((), "#000000", 1))) == 1


def test_a_difference_is_one_path_by_the_even_odd_rule():
    """So that what both profiles cover stays free."""
    text = svg(Drawing(10, 10, "x", (Difference((rectangle(0, 0, 5, 5),), (rectangle(2, 0, 5, 5),), "#ff0000"),)))
    assert '<path d="M0 0L5 0L5 5L0 5ZM2 0L7 0L7 5L2 5Z" fill="#ff0000" fill-rule="evenodd"/>' in text
