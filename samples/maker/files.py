"""Sample parts as files: DXF R2010 with the curves as they are, STEP of the extruded profile.

Both are written so that the same drawing gives the same bytes: no date of today, no running numbers.
"""

import re
from math import degrees
from pathlib import Path

import ezdxf
import numpy as np
from ezdxf.layouts import Modelspace
from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.Geom import Geom_BSplineCurve
from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pnt, gp_Vec
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.Message import Message, Message_PrinterOStream
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
from OCP.TColgp import TColgp_Array1OfPnt
from OCP.TCollection import TCollection_HAsciiString
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal
from OCP.TopoDS import TopoDS_Edge, TopoDS_Wire

from mashape_cad.geometry.edge import Arc, BSpline, Edge, Floats, Line
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["write_dxf", "write_step"]

THICKNESS = 5.0  # of the extruded parts, mm
WRITTEN = "2024-01-01T00:00:00"
LAYER = "OUTLINE"


def write_dxf(path: Path, profile: Profile) -> None:
    """Write the profile's edges as LINE, ARC, CIRCLE and SPLINE entities on one layer."""
    ezdxf.options.write_fixed_meta_data_for_testing = True
    document = ezdxf.new("R2010", units=ezdxf.units.MM)
    document.layers.add(LAYER)
    space = document.modelspace()
    for edge in profile.edges:
        _add_entity(space, edge)
    low, high = profile.bounds
    document.header["$EXTMIN"], document.header["$EXTMAX"] = (*low, 0.0), (*high, 0.0)
    # ezdxf would list the object types in the order of a set, which differs from run to run.
    for name in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(name)
    document.saveas(path)


def _add_entity(space: Modelspace, edge: Edge) -> None:
    attributes = {"layer": LAYER}
    match edge:
        case Line():
            space.add_line(edge.first, edge.last, attributes)
        case Arc() if edge.is_closed:
            space.add_circle(edge.centre, edge.radius, attributes)
        case Arc():
            first, last = (edge.start, edge.end) if edge.is_counter_clockwise else (edge.end, edge.start)
            space.add_arc(edge.centre, edge.radius, _angle(edge, first), _angle(edge, last), dxfattribs=attributes)
        case BSpline():
            spline = space.add_spline(degree=edge.degree, dxfattribs=attributes)
            spline.control_points = [(x, y, 0.0) for x, y in edge.poles]
            spline.knots = list(edge.knots)
        case _:
            raise TypeError(f"no entity for {type(edge).__name__}")


def _angle(arc: Arc, point: Floats) -> float:
    x, y = point - arc.centre
    return degrees(float(np.arctan2(y, x)))


def write_step(path: Path, profile: Profile) -> None:
    """Write the profile as a plate, `THICKNESS` high."""
    face = BRepBuilderAPI_MakeFace(_wire(profile.outer), OnlyPlane=True)
    for hole in profile.holes:
        face.Add(_wire(hole))
    Message.DefaultMessenger_s().RemovePrinters(Message_PrinterOStream.get_type_descriptor_s())  # a chatty writer
    solid = BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0.0, 0.0, THICKNESS)).Shape()
    writer = STEPControl_Writer()
    Interface_Static.SetCVal_s("write.step.product.name", path.stem)
    Interface_Static.SetIVal_s("write.surfacecurve.mode", 0)  # planes and extrusions need no curves on surfaces
    writer.Transfer(solid, STEPControl_StepModelType.STEPControl_AsIs)
    header = APIHeaderSection_MakeHeader(writer.Model())
    header.SetName(TCollection_HAsciiString(path.name))
    header.SetTimeStamp(TCollection_HAsciiString(WRITTEN))
    if writer.Write(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OSError(f"cannot write {path}")
    _drop_accidents(path)


def _drop_accidents(path: Path) -> None:
    """Take out what differs from run to run, or with the last digits of a float.

    OCCT gives the product's name a number, which counts the files of one run; and it calls knots uniform or not, as
    their rounded differences happen to be.
    """
    text = re.sub(rf"'{path.stem} \d+'", f"'{path.stem}'", path.read_text(encoding="ascii"))
    text = re.sub(r"\.(QUASI_)?UNIFORM_KNOTS\.", ".UNSPECIFIED.", text)
    path.write_text(text, encoding="ascii", newline="\n")


def _wire(loop: Loop) -> TopoDS_Wire:
    wire = BRepBuilderAPI_MakeWire()
    for edge in loop.edges:
        wire.Add(_kernel_edge(edge))
    return wire.Wire()


def _kernel_edge(edge: Edge) -> TopoDS_Edge:
    match edge:
        case Line():
            return BRepBuilderAPI_MakeEdge(_point(edge.first), _point(edge.last)).Edge()
        case Arc():
            up = gp_Dir(0.0, 0.0, 1.0 if edge.is_counter_clockwise else -1.0)
            circle = gp_Circ(gp_Ax2(_point(edge.centre), up), edge.radius)
            if edge.is_closed:
                return BRepBuilderAPI_MakeEdge(circle).Edge()
            return BRepBuilderAPI_MakeEdge(circle, _point(edge.start), _point(edge.end)).Edge()
        case BSpline():
            return BRepBuilderAPI_MakeEdge(_kernel_spline(edge)).Edge()
        case _:
            raise TypeError(f"no kernel curve for {type(edge).__name__}")


def _kernel_spline(edge: BSpline) -> Geom_BSplineCurve:
    distinct, counts = np.unique(edge.knots, return_counts=True)
    poles = TColgp_Array1OfPnt(1, len(edge.poles))
    knots = TColStd_Array1OfReal(1, len(distinct))
    multiplicities = TColStd_Array1OfInteger(1, len(distinct))
    for i, pole in enumerate(edge.poles, 1):
        poles.SetValue(i, _point(pole))
    for i, (knot, count) in enumerate(zip(distinct, counts, strict=True), 1):
        knots.SetValue(i, float(knot))
        multiplicities.SetValue(i, int(count))
    return Geom_BSplineCurve(poles, knots, multiplicities, edge.degree)


def _point(point: Floats) -> gp_Pnt:
    return gp_Pnt(float(point[0]), float(point[1]), 0.0)
