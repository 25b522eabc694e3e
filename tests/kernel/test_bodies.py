import numpy as np
import pytest
from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepFilletAPI import BRepFilletAPI_MakeChamfer
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Compound
from OCP.TopTools import TopTools_IndexedMapOfShape
from solids import L_SHAPE, box, drilled, placed, prism

from mashape_cad.kernel.bodies import side_faces
from mashape_cad.kernel.faces import planar_faces


def _sides(shape):
    faces = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, TopAbs_ShapeEnum.TopAbs_FACE, faces)
    return side_faces(shape, faces)


def _normals_of_sides(shape):
    return [face.plane.normal for face in planar_faces(shape).faces if face.is_side]


def test_a_long_bar_shows_its_section():
    """The caps of an L of 1 m are its small ends, not the large walls."""
    assert len(_sides(prism(L_SHAPE, 1000))) == 6


def test_a_turned_bar_too():
    """The direction does not have to be an axis."""
    assert len(_sides(placed(prism(L_SHAPE, 1000), (5, 6, 7), 1.1))) == 6


def test_the_caps_of_a_box_are_its_largest_faces():
    """It could have been extruded three ways; the four smaller faces count as sides."""
    assert np.abs(_normals_of_sides(box(10, 20, 3)))[:, 2].max() == 0
    assert np.abs(_normals_of_sides(box(3, 20, 10)))[:, 0].max() == 0


def test_a_cube_has_four_sides():
    """One pair of faces is taken, always the same one."""
    assert _sides(box(1, 1, 1)) == _sides(box(1, 1, 1))
    assert len(_sides(box(1, 1, 1))) == 4


def test_a_drilled_plate_has_sides_and_a_cylinder_none():
    """Round walls run along the direction, but are not planar."""
    assert len(_sides(drilled(box(10, 20, 3), 5, 5, 1))) == 4
    assert _sides(BRepPrimAPI_MakeCylinder(1.0, 2.0).Shape()) == frozenset()


def test_a_plate_with_a_pocket_is_no_prism():
    """Three levels: the largest face tells most."""
    pocket = placed(box(4, 4, 4), (2, 2, 2))
    assert _sides(BRepAlgoAPI_Cut(box(10, 20, 3), pocket).Shape()) == frozenset()


def test_a_chamfered_box_is_no_prism():
    """A slanted face is neither across nor along; with a chamfer along one edge only, it is the bar's section."""
    solid = box(10, 20, 3)
    edges = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_EDGE)
    chamfer = BRepFilletAPI_MakeChamfer(solid)
    chamfer.Add(0.5, TopoDS.Edge_s(edges.Current()))
    assert len(_sides(chamfer.Shape())) == 5
    all_edges = BRepFilletAPI_MakeChamfer(solid)
    while edges.More():
        all_edges.Add(0.5, TopoDS.Edge_s(edges.Current()))
        edges.Next()
    assert _sides(all_edges.Shape()) == frozenset()


def test_a_cross_hole_makes_a_bar_no_prism():
    """Its wall does not run along the direction."""
    assert _sides(drilled(placed(prism(L_SHAPE, 100), (0, 0, 0), np.pi), 0, 0, 1)) != frozenset({1, 2, 3, 4, 5, 6})


def test_solids_are_looked_at_one_by_one():
    """A plate beside a bar: each has its own direction."""
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    builder.Add(compound, box(100, 200, 3))
    builder.Add(compound, placed(prism(L_SHAPE, 1000), (0, 0, 50), 0.8))
    assert len(_sides(compound)) == 4 + 6


@pytest.mark.parametrize("height", [5, 50])
def test_two_levels_may_have_several_faces_each(height):
    """Two blocks joined by a thinner one along the direction share two levels."""
    blocks = BRepAlgoAPI_Fuse(box(10, 10, height), placed(box(10, 10, height), (10, 5, 0))).Shape()
    normals = np.abs(_normals_of_sides(blocks))
    assert len(normals) >= 8
    assert normals[:, 2].max() == pytest.approx(0, abs=1e-12)
