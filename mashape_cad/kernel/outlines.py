"""Wires and loose edges that lie in one plane, as if they were the outline of a face: `outline`."""

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp
from OCP.TopoDS import TopoDS, TopoDS_Shape
from OCP.TopTools import TopTools_IndexedMapOfShape

from mashape_cad.geometry.edge import Floats
from mashape_cad.kernel.faces import FlatWire, PlanarFace
from mashape_cad.kernel.failures import ShapeError, kernel_failures_told
from mashape_cad.kernel.flattening import flat_edge
from mashape_cad.kernel.frames import Frame, coordinates

__all__ = ["outline"]

# Of their extent: points this close to a plane lie in it.
_FLAT = 1e-6
# Components of a normal below this are rounding of a plane along the axes.
_ROUNDING = 1e-12
# Points taken on each edge to find the plane.
_POINTS = 9


def outline(shape: TopoDS_Shape) -> PlanarFace:
    """Return the edges of a shape without faces in the plane that they share, in no particular order.

    The plane is seen from above: its normal points up, or right if it stands upright, or to the front.

    Raises
    ------
    ShapeError
        If there is no edge, or the edges do not lie in one plane.
    """
    edges = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, TopAbs_ShapeEnum.TopAbs_EDGE, edges)
    found = [TopoDS.Edge_s(edges.FindKey(index)) for index in range(1, edges.Extent() + 1)]
    curves = [BRepAdaptor_Curve(edge) for edge in found if not BRep_Tool.Degenerated_s(edge)]
    if not curves:
        raise ShapeError("it has no edges")
    with kernel_failures_told():
        frame = _frame(np.concatenate([_points(curve) for curve in curves]))
        wire = FlatWire(tuple(flat_edge(curve, frame) for curve in curves), slits=0)
    return PlanarFace(1, frame.plane(), (wire,), is_side=False, is_flat_spline=False)


def _points(curve: BRepAdaptor_Curve) -> Floats:
    parameters = np.linspace(curve.FirstParameter(), curve.LastParameter(), _POINTS).tolist()
    return np.stack([coordinates(curve.Value(parameter)) for parameter in parameters])


def _frame(points: Floats) -> Frame:
    """Fit a plane, with its x axis along that of space as far as can be."""
    middle = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - middle, full_matrices=False)
    normal = np.where(np.abs(axes[2]) < _ROUNDING, 0.0, axes[2])
    normal /= np.copysign(np.linalg.norm(normal), normal[[2, 0, 1]][np.flatnonzero(normal[[2, 0, 1]])[0]])
    along = np.eye(3)[0] if abs(normal[0]) < 1 - _FLAT else np.eye(3)[1]
    x = along - (along @ normal) * normal
    x /= np.linalg.norm(x)
    foot = (middle @ normal) * normal  # the point of the plane next to the origin
    frame = Frame(foot, np.stack([x, np.cross(normal, x), normal]))
    if np.abs(frame.heights(points)).max() > _FLAT * np.ptp(points, axis=0).max():
        raise ShapeError("its edges do not lie in one plane")
    return frame.moved_near(points)
