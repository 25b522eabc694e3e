import warnings

import numpy as np
import pytest
from OCP.TopoDS import TopoDS_Shape
from solids import L_SHAPE, box, polygon_wire, prism

from mashape_cad.errors import QueryError
from mashape_cad.options import ReadOptions
from mashape_cad.reading.objects import read_object


def _imported(name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the packages that they import
        return pytest.importorskip(name)


@pytest.fixture(scope="module")
def cq():
    """CadQuery."""
    return _imported("cadquery")


@pytest.fixture(scope="module")
def bd():
    """build123d, where it is installed."""
    return _imported("build123d")


def _first(thing):
    part = read_object(thing)
    assert part.format == "object"
    assert part.path is None
    return part.profiles[0]


def test_a_kernel_shape_is_read_as_it_is():
    """A solid gives its planar faces, the section of a bar first."""
    part = read_object(prism(L_SHAPE, 1000))
    assert len(part.profiles) == 8
    assert part.profiles[0].area == pytest.approx(600, rel=1e-12)


def test_a_wire_becomes_a_face():
    """Of the kernel, without any wrapper."""
    assert _first(polygon_wire(L_SHAPE)).area == pytest.approx(600, rel=1e-12)


def test_lists_of_shapes_are_taken_together():
    """Wires in a list may be outline and hole."""
    hole = polygon_wire([(2, 2), (4, 2), (4, 4), (2, 4)])
    assert _first([polygon_wire(L_SHAPE), [hole]]).area == pytest.approx(596, rel=1e-12)


def test_lengths_are_millimetres_unless_an_option_says_otherwise():
    """A script may work in inches."""
    part = read_object(box(1, 2, 3), ReadOptions(unit="in"))
    assert part.unit.decided_by == "option"
    assert part.profiles[0].area == pytest.approx(6 * 25.4**2, rel=1e-12)


def test_an_open_wire_gives_no_profile_but_a_finding(cq):
    """Nobody guesses how it was meant to close."""
    part = read_object(cq.Workplane().moveTo(0, 0).lineTo(5, 0).lineTo(5, 5))
    assert part.profiles == ()
    assert "chain-open" in [finding.code for finding in part.findings]


def _things_of_cadquery(cq):
    sketch = cq.Sketch().rect(10, 20).circle(3, mode="s")
    part = cq.Workplane().rect(10, 20).circle(3).extrude(5)
    return {
        "sketch": sketch,
        "sketch on a workplane": cq.Workplane("XZ").placeSketch(sketch),
        "wires on a workplane": cq.Workplane().rect(10, 20).circle(3),
        "part": part,
        "selected face": part.faces(">Z"),
        "wires of a face": part.faces(">Z").wires(),
        "face": part.faces(">Z").val(),
        "solid": part.val(),
        "assembly": cq.Assembly().add(part, loc=cq.Location((5, 6, 7))),
        "list": [part.faces(">Z").val()],
    }


@pytest.mark.parametrize(
    "name",
    [
        "sketch",
        "sketch on a workplane",
        "wires on a workplane",
        "part",
        "selected face",
        "wires of a face",
        "face",
        "solid",
        "assembly",
        "list",
    ],
)
def test_things_of_cadquery(cq, name):
    """A plate of 10 x 20 with a bore of radius 3, wrapped in many ways."""
    profile = _first(_things_of_cadquery(cq)[name])
    assert profile.area == pytest.approx(200 - 9 * np.pi, rel=1e-12)
    assert len(profile.holes) == 1


def test_edges_that_wait_on_a_workplane(cq):
    """Drawn and closed, not yet extruded."""
    drawn = cq.Workplane("YZ").polyline([(0, 0), (3, 0), (3, 1)]).close()
    profile = _first(drawn)
    assert profile.area == pytest.approx(1.5, rel=1e-12)
    assert profile.origin.plane.normal == pytest.approx((1, 0, 0))


def test_a_periodic_spline_stays_one(cq):
    """One edge, closed in itself."""
    profile = _first(cq.Workplane().spline([(0, 0), (5, 1), (6, 7), (1, 5)], periodic=True))
    (edge,) = profile.edges
    assert type(edge).__name__ == "BSpline"
    assert edge.is_closed


def _things_of_build123d(bd):
    with bd.BuildSketch() as sketch:
        bd.Rectangle(10, 20)
        bd.Circle(3, mode=bd.Mode.SUBTRACT)
    with bd.BuildPart() as part:
        bd.extrude(sketch.sketch, amount=5)
    algebra = bd.Rectangle(10, 20) - bd.Circle(3)
    return {
        "sketch builder": sketch,
        "sketch": sketch.sketch,
        "algebra": algebra,
        "part builder": part,
        "part": part.part,
        "face": part.faces().sort_by(bd.Axis.Z)[-1],
        "faces": part.faces().sort_by(bd.Axis.Z)[-1:],
        "moved": bd.Pos(7, 8, 9) * algebra,
    }


@pytest.mark.parametrize(
    "name", ["sketch builder", "sketch", "algebra", "part builder", "part", "face", "faces", "moved"]
)
def test_things_of_build123d(bd, name):
    """The same plate."""
    profile = _first(_things_of_build123d(bd)[name])
    assert profile.area == pytest.approx(200 - 9 * np.pi, rel=1e-12)
    assert len(profile.holes) == 1


def test_lines_of_build123d(bd):
    """A wire, and what a line builder holds."""
    with bd.BuildLine() as line:
        bd.Polyline((0, 0), (3, 0), (3, 2), close=True)
    assert _first(line).area == pytest.approx(3, rel=1e-12)
    assert _first(bd.Wire.make_circle(3)).area == pytest.approx(9 * np.pi, rel=1e-12)


def test_an_empty_sketch_of_build123d_is_refused(bd):
    """Some of its properties fail where they should be absent."""
    with pytest.raises(QueryError, match="build123d Sketch"):
        read_object(bd.Sketch())


@pytest.mark.parametrize("thing", ["part.step", 7, None, {}, np.zeros((3, 3)), TopoDS_Shape(), [[[[[[]]]]]]])
def test_other_things_are_refused_by_name(thing):
    """With what would be welcome."""
    with pytest.raises(QueryError, match="give a face, wire, sketch or solid"):
        read_object(thing)


def test_what_contains_itself_is_refused():
    """A list in itself does not hang."""
    endless = []
    endless.append(endless)
    with pytest.raises(QueryError):
        read_object(endless)


def test_a_wire_in_space_is_refused(cq):
    """It has no plane, so it bounds no face."""
    crooked = cq.Workplane().polyline([(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 0)]).close()
    with pytest.raises(QueryError, match="one plane"):
        read_object(crooked)
