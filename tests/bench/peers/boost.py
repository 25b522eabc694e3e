"""Boost.Polygon's Voronoi diagram of segments, through pyvoronoi, pruned to the medial axis.

Coordinates are 32 bit integers there. Of the diagram's edges we keep those inside that part two boundary elements which
are not neighbours at a smooth place: the bisector of two neighbouring chords of one curve is no branch.
"""

from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np
from cpu import timed
from found import Found
from polygons import Polygon

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.tour import Ints

if TYPE_CHECKING:
    from pyvoronoi import Pyvoronoi  # of the extra `bench`

__all__ = ["is_at_hand", "medial_axis"]

# Largest coordinate handed over: Boost takes 32 bit integers.
_LARGEST = 1 << 30
# Which end of its segment a point cell belongs to, in Boost's words.
_SEGMENT_END = 2


def is_at_hand() -> bool:
    """Whether pyvoronoi is installed."""
    return find_spec("pyvoronoi") is not None


def medial_axis(polygon: Polygon) -> Found:
    """Construct the diagram, then prune it; the two are timed apart."""
    middle = (polygon.points.min(axis=0) + polygon.points.max(axis=0)) / 2
    scale = int(_LARGEST / np.abs(polygon.points - middle).max())
    ends = np.stack([polygon.points - middle, polygon.points[polygon.following] - middle], axis=1)
    diagram, construct = timed(lambda: _constructed(ends, scale))
    (points, links), prune = timed(lambda: _pruned(diagram, polygon, ends))
    points[:, :2] += middle
    found = Found.linked(points, links)
    return Found(found.points, found.degree, {"construct": construct, "prune": prune})


def _constructed(ends: Floats, scale: int) -> "Pyvoronoi":
    from pyvoronoi import Pyvoronoi

    diagram = Pyvoronoi(scale)
    for segment in ends.tolist():
        diagram.AddSegment(segment)
    diagram.Construct()
    return diagram


def _pruned(diagram: "Pyvoronoi", polygon: Polygon, ends: Floats) -> tuple[Floats, Ints]:
    vertices = np.array([(vertex.X, vertex.Y) for vertex in diagram.GetVertices()])
    cells = np.array([(cell.site, cell.contains_point, cell.source_category) for cell in diagram.GetCells()])
    edges = [
        (edge.start, edge.end, edge.cell, diagram_twin.cell)
        for edge, diagram_twin in _pairs(diagram)
        if edge.is_primary and edge.start >= 0 and edge.end >= 0
    ]
    start, end, cell, other = np.array(edges).T
    is_point, site = cells[:, 1].astype(bool), cells[:, 0]
    vertex = np.where(cells[:, 2] == _SEGMENT_END, polygon.following[site], site)
    kept = _inside((vertices[start] + vertices[end]) / 2, ends, polygon, is_point, site, vertex, cell)
    kept &= ~_are_smooth_neighbours(polygon, is_point, site, cell, other)
    links = np.column_stack([start, end])[kept]
    points = np.zeros((len(vertices), 3))
    points[:, :2] = vertices
    cell_of = np.zeros(len(vertices), dtype=np.int64)
    cell_of[links] = cell[kept, None]
    used = np.unique(links)
    points[used, 2] = _distance(vertices[used], ends, polygon, is_point, site, vertex, cell_of[used])
    return points, links


def _pairs(diagram: "Pyvoronoi"):
    edges = diagram.GetEdges()
    return ((edge, edges[edge.twin]) for k, edge in enumerate(edges) if k < edge.twin)


def _inside(
    place: Floats, ends: Floats, polygon: Polygon, is_point: Ints, site: Ints, vertex: Ints, cell: Ints
) -> Ints:
    """Tell which places lie inside: left of the nearest segment, or nearest to a reflex vertex."""
    first, last = ends[site[cell], 0], ends[site[cell], 1]
    left = _cross(last - first, place - first) > 0
    before, here, after = ends[polygon.previous, 0], ends[:, 0], ends[:, 1]
    reflex = _cross(here - before, after - here) < 0
    return np.where(is_point[cell], reflex[vertex[cell]], left)


def _are_smooth_neighbours(polygon: Polygon, is_point: Ints, site: Ints, cell: Ints, other: Ints) -> Ints:
    a, b = site[cell], site[other]
    meet = np.where(polygon.following[a] == b, b, np.where(polygon.following[b] == a, a, -1))
    return (meet >= 0) & polygon.smooth[meet] & ~is_point[cell] & ~is_point[other]


def _distance(
    place: Floats, ends: Floats, polygon: Polygon, is_point: Ints, site: Ints, vertex: Ints, cell: Ints
) -> Floats:
    first, last = ends[site[cell], 0], ends[site[cell], 1]
    to_line = np.abs(_cross(last - first, place - first)) / np.linalg.norm(last - first, axis=1)
    return np.where(is_point[cell], np.linalg.norm(place - ends[vertex[cell], 0], axis=1), to_line)


def _cross(a: Floats, b: Floats) -> Floats:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
