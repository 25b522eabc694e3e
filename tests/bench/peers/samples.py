"""The Voronoi diagram of boundary points (`scipy.spatial.Voronoi`, that is Qhull), pruned to the medial axis.

Of the ridges we keep those inside that do not part two neighbours on the boundary.
"""

import numpy as np
from cpu import timed
from found import Found
from polygons import Polygon
from scipy.spatial import Voronoi

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints

__all__ = ["medial_axis"]


def medial_axis(polygon: Polygon) -> Found:
    """Construct the diagram, then prune it; the two are timed apart."""
    diagram, construct = timed(lambda: Voronoi(polygon.points))
    (points, links), prune = timed(lambda: _pruned(diagram, polygon))
    found = Found.linked(points, links)
    return Found(found.points, found.degree, {"construct": construct, "prune": prune})


def _pruned(diagram: Voronoi, polygon: Polygon) -> tuple[Floats, Ints]:
    links, pairs = np.array(diagram.ridge_vertices), diagram.ridge_points
    a, b = pairs.T
    inward = _normals(polygon)
    kept = (links.min(axis=1) >= 0) & (polygon.following[a] != b) & (polygon.following[b] != a)
    for end in links.T:
        place = diagram.vertices[end]
        for point in (a, b):
            kept &= np.einsum("ij,ij->i", place - polygon.points[point], inward[point]) > 0
    links = links[kept]
    points = np.zeros((len(diagram.vertices), 3))
    points[:, :2] = diagram.vertices
    near = np.zeros(len(points), dtype=np.int64)
    near[links] = a[kept, None]
    points[:, 2] = np.linalg.norm(points[:, :2] - polygon.points[near], axis=1)
    return points, links


def _normals(polygon: Polygon) -> Floats:
    """Inward normals in the points, that of the chord from the point before to the one behind."""
    chord = polygon.points[polygon.following] - polygon.points[polygon.previous]
    return np.column_stack([-chord[:, 1], chord[:, 0]])
