import numpy as np
import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder, BRepPrimAPI_MakeSphere
from OCP.Geom import Geom_Plane, Geom_RectangularTrimmedSurface
from OCP.GeomConvert import GeomConvert
from OCP.gp import gp_Ax2, gp_Ax3, gp_Circ, gp_Dir, gp_Pnt
from OCP.TopoDS import TopoDS_Compound, TopoDS_Wire
from solids import L_SHAPE, TRIANGLE, box, drilled, mirrored, placed, polygon_wire, prism

from mashape_cad.geometry.profile import Loop
from mashape_cad.kernel import faces
from mashape_cad.kernel.faces import planar_faces


def _loops(face):
    return [Loop(tuple(flat.edge for flat in wire.edges)) for wire in face.wires]


def _area(face):
    return sum(loop.signed_area for loop in _loops(face))


def _compound(*shapes):
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    for shape in shapes:
        builder.Add(compound, shape)
    return compound


@pytest.mark.parametrize("turn", [lambda shape: shape, mirrored, lambda shape: placed(shape, (40, -7, 1e3), 2.0)])
def test_faces_of_a_box_are_seen_from_outside(turn):
    """Normals lead away from the middle, and each outline runs counter-clockwise around its area."""
    shape = turn(box(2, 3, 5))
    found = planar_faces(shape).faces
    middle = np.mean([face.plane.origin for face in found], axis=0)
    assert sorted(_area(face) for face in found) == pytest.approx([6, 6, 10, 10, 15, 15], rel=1e-12)
    for face in found:
        corners = np.array([flat.edge.start for flat in face.wires[0].edges])
        x, normal = np.array(face.plane.x_axis), np.array(face.plane.normal)
        centre = np.array(face.plane.origin) + corners.mean(axis=0) @ np.stack([x, np.cross(normal, x)])
        assert normal @ (centre - middle) > 0


def _turns_of(face):
    """Lengths of the sides on the way round, from the longest on."""
    lengths = [flat.edge.length() for flat in face.wires[0].edges]
    longest = int(np.argmax(lengths))
    return [round(length, 9) for length in lengths[longest:] + lengths[:longest]]


def test_top_and_bottom_of_a_plate_are_mirror_images():
    """Each is seen from its own outside, so the same outline runs the other way round."""
    tops = {face.plane.normal: face for face in planar_faces(prism(TRIANGLE, 0.1)).faces}
    longest = round(13**0.5, 9)
    assert _turns_of(tops[0, 0, 1]) == [longest, 2, 3]
    assert _turns_of(tops[0, 0, -1]) == [longest, 3, 2]


def test_a_mirrored_plate_shows_the_mirrored_outline():
    """The top of the mirrored plate looks as the bottom of the plate."""
    tops = {face.plane.normal: face for face in planar_faces(mirrored(prism(TRIANGLE, 0.1))).faces}
    assert _turns_of(tops[0, 0, 1]) == [round(13**0.5, 9), 3, 2]


def test_holes_run_the_other_way_than_outlines():
    """Material is on the left of every wire, seen from either side."""
    plate = drilled(drilled(box(20, 10, 2), 5, 5, 1), 12, 5, 2)
    whole = [face for face in planar_faces(plate).faces if len(face.wires) == 3]
    assert len(whole) == 2
    for face in whole:
        areas = sorted(loop.signed_area for loop in _loops(face))
        assert areas == pytest.approx([-4 * np.pi, -np.pi, 200], rel=1e-12)


def test_faces_are_numbered_as_the_kernel_counts_them():
    """Curved ones count too: the two caps of a cylinder are not faces 1 and 2."""
    found = planar_faces(BRepPrimAPI_MakeCylinder(2.0, 5.0).Shape())
    assert [face.number for face in found.faces] == [2, 3]
    assert found.curved == (1,)


def test_a_sphere_has_no_planar_face():
    """Its only face is curved."""
    found = planar_faces(BRepPrimAPI_MakeSphere(3.0).Shape())
    assert found.faces == ()
    assert found.curved == (1,)


def test_each_place_of_a_part_counts():
    """One solid in three places has three times the faces, each in its place."""
    part = prism(TRIANGLE, 1)
    found = planar_faces(_compound(part, placed(part, (10, 0, 0)), placed(part, (20, 0, 0), 1.0)))
    assert len(found.faces) == 15
    assert len({face.plane for face in found.faces}) == 15


def test_edges_outside_of_faces_are_counted():
    """A loose wire beside a face."""
    found = planar_faces(_compound(box(1, 1, 1), polygon_wire(TRIANGLE)))
    assert found.loose_edges == 3
    assert len(found.faces) == 6


@pytest.mark.parametrize("upside_down", [False, True])
def test_a_flat_spline_surface_is_a_planar_face_and_says_so(upside_down):
    """Its outside is where the surface's own normal points, turned if the face is reversed."""
    plane = Geom_RectangularTrimmedSurface(Geom_Plane(gp_Ax3()), 0.0, 4.0, 0.0, 3.0)
    face = BRepBuilderAPI_MakeFace(GeomConvert.SurfaceToBSplineSurface_s(plane), 1e-7).Face()
    found = planar_faces(face.Reversed() if upside_down else face)
    (flat,) = found.faces
    assert flat.is_flat_spline
    assert flat.plane.normal == ((0, 0, -1) if upside_down else (0, 0, 1))
    assert _area(flat) == pytest.approx(12, rel=1e-12)


def test_planes_are_no_flat_splines():
    """So that both can be counted apart."""
    assert not any(face.is_flat_spline for face in planar_faces(box(1, 2, 3)).faces)


def test_an_edge_run_through_both_ways_is_left_out():
    """A keyhole's bridge between outline and hole bounds nothing."""
    hole = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(5, 5, 0), gp_Dir(0, 0, 1)), 2.0)).Edge()
    bridge = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(7, 5, 0)).Edge()
    wire, builder = TopoDS_Wire(), BRep_Builder()
    builder.MakeWire(wire)
    for start, end in [((0, 0), (10, 0)), ((10, 0), (10, 10)), ((10, 10), (0, 10)), ((0, 10), (0, 0))]:
        builder.Add(wire, BRepBuilderAPI_MakeEdge(gp_Pnt(*start, 0), gp_Pnt(*end, 0)).Edge())
    for edge in (bridge, hole.Reversed(), bridge.Reversed()):
        builder.Add(wire, edge)
    face = BRepBuilderAPI_MakeFace(Geom_Plane(gp_Ax3()), wire, False).Face()
    (found,) = planar_faces(face).faces
    assert found.wires[0].slits == 2
    assert len(found.wires[0].edges) == 5


def test_a_face_without_edges_is_broken_and_does_not_stop_the_others():
    """The kernel can hold one; its number and a reason are kept."""
    bare = BRepBuilderAPI_MakeFace(Geom_Plane(gp_Ax3()), 1e-7).Face()
    found = planar_faces(_compound(bare, box(1, 1, 1)))
    assert [each.number for each in found.broken] == [1]
    assert found.broken[0].reason
    assert len(found.faces) == 6


def test_coordinates_are_small_where_the_part_is_far_away():
    """A plate 1e7 mm off has its profile beside the origin of its plane."""
    for face in planar_faces(placed(prism(L_SHAPE, 5), (1e7, -1e7, 3e6))).faces:
        corners = np.array([flat.edge.start for flat in face.wires[0].edges])
        assert np.abs(corners).max() <= 64


def test_sides_of_a_plate_are_told():
    """The walls of a drilled L are sides, its caps are not."""
    walls = planar_faces(drilled(prism(L_SHAPE, 5), 5, 5, 2)).faces
    assert [abs(face.plane.normal[2]) for face in walls if face.is_side] == pytest.approx([0] * 6, abs=1e-12)
    assert [abs(face.plane.normal[2]) for face in walls if not face.is_side] == [1, 1]


def test_a_failure_of_the_kernel_costs_one_face(monkeypatch):
    """Its exceptions share no base class; all the same they become one line, and the other faces are read."""
    fail_at = iter([False, True, False, False, False, False])

    def failing(face, surface, asked=faces._plane):
        if next(fail_at):
            gp_Dir(0, 0, 0)
        return asked(face, surface)

    monkeypatch.setattr(faces, "_plane", failing)
    found = planar_faces(box(1, 2, 3))
    assert [face.number for face in found.faces] == [1, 3, 4, 5, 6]
    assert [each.number for each in found.broken] == [2]
    assert "Standard_ConstructionError" in found.broken[0].reason


def test_a_fault_of_this_program_is_not_hidden(monkeypatch):
    """Only the kernel's failures and numbers that make no curve are a face's fault."""
    monkeypatch.setattr(faces, "_plane", lambda face, surface: face.no_such_name)
    with pytest.raises(AttributeError):
        planar_faces(box(1, 2, 3))
