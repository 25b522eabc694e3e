import numpy as np
import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakePolygon, BRepBuilderAPI_MakeVertex
from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pnt
from solids import L_SHAPE, placed, polygon_wire

from mashape_cad.kernel.failures import ShapeError
from mashape_cad.kernel.outlines import outline
from mashape_cad.kernel.shapes import together


def test_wires_in_one_plane_are_one_outline():
    """All their edges, whichever wire they came from."""
    hole = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(5, 5, 0), gp_Dir(0, 0, 1)), 2.0)).Edge()
    face = outline(together([polygon_wire(L_SHAPE), hole]))
    assert len(face.wires[0].edges) == 7
    assert face.plane.normal == (0, 0, 1)
    assert face.plane.x_axis == (1, 0, 0)
    assert face.plane.origin == (0, 0, 0)


@pytest.mark.parametrize("angle", [0.3, 1.0, 2.0, 3.0])
def test_any_plane_will_do(angle):
    """Edges keep their lengths and lie in the plane; it is seen from above."""
    face = outline(placed(polygon_wire(L_SHAPE), (100, 200, 300), angle))
    lengths = sorted(flat.edge.length() for flat in face.wires[0].edges)
    assert lengths == pytest.approx([10, 10, 20, 30, 30, 40], rel=1e-12)
    assert max(flat.height for flat in face.wires[0].edges) <= 1e-12 * 300
    assert face.plane.normal[2] > 0


def test_an_upright_plane_is_seen_from_a_fixed_side():
    """Normals point to the right or to the front, whatever the wire's sense."""
    for corners in (L_SHAPE, L_SHAPE[::-1]):
        polygon = BRepBuilderAPI_MakePolygon()
        for x, y in corners:
            polygon.Add(gp_Pnt(7.0, float(x), float(y)))
        polygon.Close()
        face = outline(polygon.Wire())
        assert face.plane.normal == pytest.approx((1, 0, 0), abs=1e-15)
        assert np.cross(face.plane.normal, face.plane.x_axis) == pytest.approx((0, 0, 1), abs=1e-15)


def test_edges_in_space_are_refused():
    """They bound no flat area."""
    polygon = BRepBuilderAPI_MakePolygon()
    for corner in [(0, 0, 0), (10, 0, 0), (10, 10, 0.1), (0, 10, 0)]:
        polygon.Add(gp_Pnt(*map(float, corner)))
    polygon.Close()
    with pytest.raises(ShapeError, match="one plane"):
        outline(polygon.Wire())


def test_a_vertex_has_no_outline():
    """It has no edges."""
    with pytest.raises(ShapeError, match="no edges"):
        outline(BRepBuilderAPI_MakeVertex(gp_Pnt()).Vertex())
