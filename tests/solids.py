"""Kernel shapes for tests: plates and other solids made with the kernel alone."""

from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon, BRepBuilderAPI_Transform
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder, BRepPrimAPI_MakePrism
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec

L_SHAPE = [(0, 0), (30, 0), (30, 10), (10, 10), (10, 40), (0, 40)]
TRIANGLE = [(0, 0), (3, 0), (0, 2)]


def box(x, y, z):
    """A box with one corner at the origin."""
    return BRepPrimAPI_MakeBox(float(x), float(y), float(z)).Shape()


def polygon_wire(corners, z=0.0):
    """A closed wire of lines in a plane z."""
    polygon = BRepBuilderAPI_MakePolygon()
    for x, y in corners:
        polygon.Add(gp_Pnt(float(x), float(y), float(z)))
    polygon.Close()
    return polygon.Wire()


def prism(corners, height):
    """A polygon extruded upwards."""
    face = BRepBuilderAPI_MakeFace(polygon_wire(corners)).Face()
    return BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, float(height))).Shape()


def drilled(solid, x, y, radius, height=1e3):
    """A solid with a hole from below z = 0 upwards."""
    axis = gp_Ax2(gp_Pnt(float(x), float(y), -1.0), gp_Dir(0, 0, 1))
    return BRepAlgoAPI_Cut(solid, BRepPrimAPI_MakeCylinder(axis, float(radius), float(height)).Shape()).Shape()


def placed(shape, offset=(0, 0, 0), angle=0.0):
    """A copy turned about the axis (1, 2, 3) through the origin, then moved."""
    turn, move = gp_Trsf(), gp_Trsf()
    turn.SetRotation(gp_Ax1(gp_Pnt(), gp_Dir(1, 2, 3)), angle)
    move.SetTranslation(gp_Vec(*map(float, offset)))
    return BRepBuilderAPI_Transform(shape, move.Multiplied(turn), True).Shape()  # True: a copy


def mirrored(shape):
    """A copy mirrored in the plane x = 0."""
    mirror = gp_Trsf()
    mirror.SetMirror(gp_Ax2(gp_Pnt(), gp_Dir(1, 0, 0)))
    return BRepBuilderAPI_Transform(shape, mirror, True).Shape()  # True: a copy
