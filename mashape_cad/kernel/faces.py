"""The planar faces of a shape, each with exact edges in its own plane: `planar_faces`.

Faces are numbered from 1 in the kernel's order over the whole shape (as modelling programs do: "Face3"), curved ones
included. A face that occurs in several places, as parts of an assembly do, counts once for each place.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepTools import BRepTools_WireExplorer
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.GeomLib import GeomLib_IsPlanarSurface
from OCP.gp import gp_Pln, gp_Pnt, gp_Vec
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face, TopoDS_Shape, TopoDS_Wire
from OCP.TopTools import TopTools_IndexedMapOfShape

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Plane
from mashape_cad.kernel.bodies import side_faces
from mashape_cad.kernel.failures import kernel_failures_told
from mashape_cad.kernel.flattening import FlatEdge, flat_edge
from mashape_cad.kernel.frames import Frame, coordinates

__all__ = ["BrokenFace", "FlatWire", "PlanarFace", "PlanarFaces", "planar_faces"]

# mm: a surface of another kind whose points stay this close to a plane is one.
_FLAT = 1e-7
# Surfaces that are never flat; asking would cost time.
_ROUND = {
    GeomAbs_SurfaceType.GeomAbs_Cylinder,
    GeomAbs_SurfaceType.GeomAbs_Cone,
    GeomAbs_SurfaceType.GeomAbs_Sphere,
    GeomAbs_SurfaceType.GeomAbs_Torus,
}


@dataclass(frozen=True, slots=True, eq=False)
class FlatWire:
    """A closed chain of edges of a face, in the face's plane.

    Attributes
    ----------
    edges : tuple of FlatEdge
        In order, with the face's material on the left, as far as the kernel knows an order.
    slits : int
        How many edges were left out because they bound nothing: run through both ways, or inside the material.
    """

    edges: tuple[FlatEdge, ...]
    slits: int


@dataclass(frozen=True, slots=True, eq=False)
class PlanarFace:
    """A planar face, seen from outside the material.

    Attributes
    ----------
    number : int
    plane : Plane
    wires : tuple of FlatWire
    is_side : bool
        Whether the face runs along the direction in which its solid was extruded, see `bodies`.
    is_flat_spline : bool
        Whether its surface is flat, but not stored as a plane.
    """

    number: int
    plane: Plane
    wires: tuple[FlatWire, ...]
    is_side: bool
    is_flat_spline: bool


@dataclass(frozen=True, slots=True)
class BrokenFace:
    """A planar face that the kernel, or the numbers in the file, failed."""

    number: int
    reason: str


@dataclass(frozen=True, slots=True)
class PlanarFaces:
    """What a shape has of planar faces.

    Attributes
    ----------
    faces : tuple of PlanarFace
        By number.
    broken : tuple of BrokenFace
    curved : tuple of int
        Numbers of the faces that are not flat.
    loose_edges : int
        Edges that belong to no face.
    """

    faces: tuple[PlanarFace, ...]
    broken: tuple[BrokenFace, ...]
    curved: tuple[int, ...]
    loose_edges: int


def planar_faces(shape: TopoDS_Shape) -> PlanarFaces:
    """Return the planar faces of a shape.

    Parameters
    ----------
    shape : TopoDS_Shape
        Not null; coordinates in mm.
    """
    faces = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, TopAbs_ShapeEnum.TopAbs_FACE, faces)
    sides = side_faces(shape, faces)
    found, broken, curved = [], [], []
    for number in range(1, faces.Extent() + 1):
        try:
            with kernel_failures_told():
                face = _planar_face(TopoDS.Face_s(faces.FindKey(number)), number)
        except (ValueError, ArithmeticError) as error:
            broken.append(BrokenFace(number, str(error)))
            continue
        if face is None:
            curved.append(number)
        else:
            found.append(replace(face, is_side=number in sides))
    return PlanarFaces(tuple(found), tuple(broken), tuple(curved), _loose_edges(shape))


def _planar_face(face: TopoDS_Face, number: int) -> PlanarFace | None:
    """Return a face in its own plane; None if it is curved."""
    surface = BRepAdaptor_Surface(face, True)  # noqa: FBT003  (restricted to the face)
    plane = _plane(face, surface)
    if plane is None:
        return None
    reverse = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
    frame = Frame.of(plane, reverse=reverse)
    frame = frame.moved_near(_corners(face))
    # The kernel orders the edges of a wire for the face as it lies on its surface, whichever side is outside.
    forward = TopoDS.Face_s(face.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    wires = tuple(_flat_wire(wire, forward, frame, reverse=reverse) for wire in _wires(forward))
    is_flat_spline = surface.GetType() != GeomAbs_SurfaceType.GeomAbs_Plane
    return PlanarFace(number, frame.plane(), wires, is_side=False, is_flat_spline=is_flat_spline)


def _plane(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> gp_Pln | None:
    kind = surface.GetType()
    if kind == GeomAbs_SurfaceType.GeomAbs_Plane:
        return surface.Plane()
    if kind in _ROUND:
        return None
    flat = GeomLib_IsPlanarSurface(BRep_Tool.Surface_s(face), _FLAT)
    return _facing_like(surface, flat.Plan()) if flat.IsPlanar() else None


def _facing_like(surface: BRepAdaptor_Surface, plane: gp_Pln) -> gp_Pln:
    """Turn a plane round if it faces against the surface that it stands for."""
    point, along_u, along_v = gp_Pnt(), gp_Vec(), gp_Vec()
    middle_u = (surface.FirstUParameter() + surface.LastUParameter()) / 2
    middle_v = (surface.FirstVParameter() + surface.LastVParameter()) / 2
    surface.D1(middle_u, middle_v, point, along_u, along_v)
    normal = np.cross(coordinates(along_u), coordinates(along_v))
    if normal @ Frame.of(plane, reverse=False).axes[2] < 0:
        plane.VReverse()
    return plane


def _corners(face: TopoDS_Face) -> Floats:
    """Return some points of each edge of a face: (n, 3)."""
    points = []
    for edge in _explored(face, TopAbs_ShapeEnum.TopAbs_EDGE):
        if BRep_Tool.Degenerated_s(TopoDS.Edge_s(edge)):
            continue
        curve = BRepAdaptor_Curve(TopoDS.Edge_s(edge))
        parameters = np.linspace(curve.FirstParameter(), curve.LastParameter(), 5).tolist()
        points += [coordinates(curve.Value(parameter)) for parameter in parameters]
    if not points:
        raise ValueError("the face has no edges")
    return np.stack(points)


def _explored(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> Iterator[TopoDS_Shape]:
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def _wires(face: TopoDS_Face) -> Iterator[TopoDS_Wire]:
    return map(TopoDS.Wire_s, _explored(face, TopAbs_ShapeEnum.TopAbs_WIRE))


def _flat_wire(wire: TopoDS_Wire, face: TopoDS_Face, frame: Frame, *, reverse: bool) -> FlatWire:
    bounding, slits = _bounding_edges(wire)
    ordered = _in_order(wire, face)
    # The explorer stops where it finds no successor; then any order is as good.
    edges = ordered if len(ordered) == len(bounding) + slits and slits == 0 else bounding
    flat = [_directed(edge, frame) for edge in edges if not BRep_Tool.Degenerated_s(edge)]
    if reverse:
        flat = [replace(each, edge=each.edge.reversed()) for each in reversed(flat)]
    return FlatWire(tuple(flat), slits)


def _bounding_edges(wire: TopoDS_Wire) -> tuple[list[TopoDS_Edge], int]:
    """Return the edges that have material on one side only, and the number of the others."""
    edges = [TopoDS.Edge_s(edge) for edge in _explored(wire, TopAbs_ShapeEnum.TopAbs_EDGE)]
    directed = (TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED)
    bounding = [
        edge
        for edge in edges
        if edge.Orientation() in directed and not any(edge.IsSame(other) and not edge.IsEqual(other) for other in edges)
    ]
    return bounding, len(edges) - len(bounding)


def _in_order(wire: TopoDS_Wire, face: TopoDS_Face) -> list[TopoDS_Edge]:
    explorer = BRepTools_WireExplorer(wire, face)
    edges = []
    while explorer.More():
        edges.append(explorer.Current())
        explorer.Next()
    return edges


def _directed(edge: TopoDS_Edge, frame: Frame) -> FlatEdge:
    """Return an edge in the direction in which its wire runs through it."""
    flat = flat_edge(BRepAdaptor_Curve(edge), frame)
    if edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
        return replace(flat, edge=flat.edge.reversed())
    return flat


def _loose_edges(shape: TopoDS_Shape) -> int:
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_EDGE, TopAbs_ShapeEnum.TopAbs_FACE)
    count = 0
    while explorer.More():
        count += 1
        explorer.Next()
    return count
