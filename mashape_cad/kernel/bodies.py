"""Which faces of a shape are sides: `side_faces`.

Terminology
-----------
body
    A solid; a shell outside of solids; or a face outside of shells.
prism
    A body with a direction (that of extrusion) such that its planar faces across the direction, the *caps*, lie on two
    levels, and all its other faces run along the direction. A plate and a bar are prisms, a plate with chamfered
    edges or a pocket is not.
side
    A planar face along the direction of a prism.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.gp import gp_Pnt, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Face, TopoDS_Shape
from OCP.TopTools import TopTools_IndexedMapOfShape

from mashape_cad.geometry.edge import Floats
from mashape_cad.kernel.failures import ShapeError, kernel_failures_told
from mashape_cad.kernel.frames import coordinates

__all__ = ["side_faces"]

# Radians: walls written with a few digits still run along the direction, the smallest draft in use is ten times more.
_PARALLEL = 1e-4
# The cosine that goes with it.
_ACROSS = np.cos(_PARALLEL)
# Of the distance of the outermost levels: closer ones are one level.
_SAME_LEVEL = 1e-4
# Where the normal of a curved face is looked at, in both parameters.
_PLACES = (0.11, 0.5, 0.89)
# Relative: a box has three directions; one with larger caps is preferred only if they are larger beyond rounding.
_LARGER = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class _Body:
    """The faces of a body as far as they matter here.

    Attributes
    ----------
    numbers : (p,) array of int
        Of the planar faces.
    normals, points : (p, 3) arrays
        Their unit normals, and a point on each.
    areas : (p,) array
    curved : (c, 3) array
        Unit normals at some places of all other faces.
    """

    numbers: NDArray[np.int64]
    normals: Floats
    points: Floats
    areas: Floats
    curved: Floats


def side_faces(shape: TopoDS_Shape, faces: TopTools_IndexedMapOfShape) -> frozenset[int]:
    """Return the numbers of the faces that are sides of prisms.

    Parameters
    ----------
    shape : TopoDS_Shape
    faces : TopTools_IndexedMapOfShape
        All its faces; their indices are the numbers.
    """
    sides = set[int]()
    for body in _bodies(shape):
        with suppress(ShapeError), kernel_failures_told():  # a body that cannot be looked at has no sides
            sides.update(_sides(_measured(body, faces)))
    return frozenset(sides)


def _bodies(shape: TopoDS_Shape) -> Iterator[TopoDS_Shape]:
    for kind, outside in (
        (TopAbs_ShapeEnum.TopAbs_SOLID, TopAbs_ShapeEnum.TopAbs_SHAPE),
        (TopAbs_ShapeEnum.TopAbs_SHELL, TopAbs_ShapeEnum.TopAbs_SOLID),
    ):
        explorer = TopExp_Explorer(shape, kind, outside)
        while explorer.More():
            yield explorer.Current()
            explorer.Next()


def _measured(body: TopoDS_Shape, faces: TopTools_IndexedMapOfShape) -> _Body:
    own = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(body, TopAbs_ShapeEnum.TopAbs_FACE, own)
    planar, curved = [], [np.empty((0, 3))]
    for index in range(1, own.Extent() + 1):
        face = TopoDS.Face_s(own.FindKey(index))
        surface = BRepAdaptor_Surface(face, True)  # noqa: FBT003  (restricted to the face)
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Plane:
            plane = surface.Plane()
            normal, point = coordinates(plane.Axis().Direction()), coordinates(plane.Location())
            planar.append((faces.FindIndex(face), _area(face), *normal, *point))
        else:
            curved.append(_normals(surface))
    table = np.array(planar).reshape(-1, 8)
    return _Body(table[:, 0].astype(int), table[:, 2:5], table[:, 5:], table[:, 1], np.concatenate(curved))


def _area(face: TopoDS_Face) -> float:
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, properties)
    return float(properties.Mass())


def _normals(surface: BRepAdaptor_Surface) -> Floats:
    """Return unit normals at some places, zeros where the surface has none: (n, 3)."""
    low, high = surface.FirstUParameter(), surface.LastUParameter()
    bottom, top = surface.FirstVParameter(), surface.LastVParameter()
    point, along_u, along_v = gp_Pnt(), gp_Vec(), gp_Vec()
    found = []
    for u in _PLACES:
        for v in _PLACES:
            surface.D1(low + u * (high - low), bottom + v * (top - bottom), point, along_u, along_v)
            normal = coordinates(along_u.Crossed(along_v))
            found.append(normal / max(float(np.linalg.norm(normal)), np.finfo(float).tiny))
    return np.array(found)


def _sides(body: _Body) -> list[int]:
    """Return the sides of one body; none if it is no prism."""
    largest, sides = 0.0, list[int]()
    for direction in _directions(body.normals):
        cosines = np.abs(body.normals @ direction)
        is_cap, is_along = cosines >= _ACROSS, cosines <= _PARALLEL
        area = float(body.areas[is_cap].sum())
        if (
            area > largest * (1 + _LARGER)
            and np.all(is_cap | is_along)
            and np.all(np.abs(body.curved @ direction) <= _PARALLEL)
            and _has_two_levels(body.points[is_cap] @ direction)
        ):
            largest, sides = area, body.numbers[is_along].tolist()
    return sides


def _directions(normals: Floats) -> Floats:
    """Return the normals in their order, parallel ones mostly once: there may be thousands, with few directions."""
    largest = np.take_along_axis(normals, np.abs(np.round(normals, 3)).argmax(axis=1)[:, None], axis=1)
    _, first = np.unique(np.round(normals * np.sign(largest), 5) + 0.0, axis=0, return_index=True)
    return normals[np.sort(first)]


def _has_two_levels(levels: Floats) -> bool:
    steps = np.diff(np.sort(levels))
    spread = float(steps.sum())
    return bool(spread > 0 and np.count_nonzero(steps > _SAME_LEVEL * spread) == 1)
