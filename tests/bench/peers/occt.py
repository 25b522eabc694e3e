"""The kernel's own bisecting locus (`BRepMAT2d`): an oracle on lines and arcs, and wrong without a word on splines.

It is asked in a process of its own, since it may crash or never return. Its nodes of degree 3 are more than junctions:
the borders between a reflex vertex and its edges count as branches there. Nodes on the boundary are left out: most of
them are places where curves join smoothly.
"""

from collections import Counter

import numpy as np
from cpu import median_ms, timed
from found import Found
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.BRepMAT2d import BRepMAT2d_BisectingLocus, BRepMAT2d_Explorer
from OCP.GeomAbs import GeomAbs_JoinType
from OCP.GeomAPI import GeomAPI
from OCP.gp import gp_Dir, gp_Pln, gp_Pnt
from OCP.MAT import MAT_Side
from OCP.TopoDS import TopoDS, TopoDS_Edge, TopoDS_Face, TopoDS_Wire

from mashape_cad.geometry.edge import Edge
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.kernel.curves import Twin

__all__ = ["medial_axis"]

# A node with a smaller radius (mm) lies on the boundary.
_ON_BOUNDARY = 1e-9
_PLANE = gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))


def medial_axis(profile: Profile, repeats: int = 1) -> Found:
    """Compute the locus inside the outer loop."""
    face = _face(profile)
    locus = _locus(face)
    parts = median_ms(lambda: {"all": timed(lambda: _locus(face))[1]}, repeats)
    degree, place = Counter[int](), {}
    for arc in map(locus.Graph().Arc, range(1, locus.Graph().NumberOfArcs() + 1)):
        for node in (arc.FirstNode(), arc.SecondNode()):
            if not node.Infinite():
                point = locus.GeomElt(node)
                degree[node.Index()] += 1
                place[node.Index()] = (point.X(), point.Y(), node.Distance())
    points, degrees = np.array(list(place.values())).reshape(-1, 3), np.array(list(degree.values()))
    inside = points[:, 2] > _ON_BOUNDARY
    return Found(points[inside], degrees[inside], parts)


def _locus(face: TopoDS_Face) -> BRepMAT2d_BisectingLocus:
    locus = BRepMAT2d_BisectingLocus()
    locus.Compute(BRepMAT2d_Explorer(face), 1, MAT_Side.MAT_Left, GeomAbs_JoinType.GeomAbs_Arc, False)
    return locus


def _face(profile: Profile) -> TopoDS_Face:
    maker = BRepBuilderAPI_MakeFace(_PLANE, _wire(profile.outer), True)
    for hole in profile.holes:
        maker.Add(_wire(hole))
    return maker.Face()


def _wire(loop: Loop) -> TopoDS_Wire:
    maker = BRepBuilderAPI_MakeWire()
    for edge in loop.edges:
        maker.Add(_edge(edge))
    return maker.Wire()


def _edge(edge: Edge) -> TopoDS_Edge:
    twin = Twin.of(edge)
    low, high = sorted((twin.first, twin.first + twin.rate))
    made = BRepBuilderAPI_MakeEdge(GeomAPI.To3d_s(twin.curve, _PLANE), low, high).Edge()
    return TopoDS.Edge_s(made.Reversed()) if twin.rate < 0 else made
