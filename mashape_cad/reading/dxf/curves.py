"""Exact edges from DXF entities, in the xy plane and in drawing units.

Most entities lie in a plane of their own, the object coordinate system. Only two such planes matter to a flat drawing:
the xy plane seen from above and, with extrusion (0, 0, -1), seen from below, where x is mirrored.

References
----------
AutoCAD DXF Reference, ENTITIES section; arbitrary axis algorithm under "Object Coordinate Systems".
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.lldxf.const import DXFError
from ezdxf.math import fit_points_to_cad_cv
from numpy.typing import ArrayLike
from scipy.interpolate import make_interp_spline

from mashape_cad.geometry.affine import affine_image, ellipse_arc
from mashape_cad.geometry.edge import Arc, Edge, Floats, Line
from mashape_cad.geometry.spline import spline_edges

__all__ = ["Drawn", "UnusableEntityError", "bulge_edge", "draws_curve", "entity_edges"]

# Direction cosines: a plane tilted by less changes lengths by its square, far below any digit.
_TILT = 1e-6
# Beyond, neighbouring floats are more than a tenth of a unit apart: no outline is meant there.
_FARTHEST = 1e15
# Bulge (tangent of a quarter of the arc's angle) b of a chord c: the arc bows by b c / 2, but its radius of c / (4 b)
# rounds its ends off by 1e-16 of itself. A smaller bulge than this is better served by a line.
_STRAIGHT_BULGE = 1e-8
# Flag of a VERTEX.
_SPLINE_FRAME = 16


class UnusableEntityError(Exception):
    """An entity that bounds nothing; `code` names the finding."""

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """What an entity draws.

    Attributes
    ----------
    edges : tuple of Edge
        One after the other, drawing units; seen from above.
    low, high : float
        Range of its heights (z), drawing units.
    """

    edges: tuple[Edge, ...]
    low: float
    high: float


def draws_curve(entity: DXFEntity) -> bool:
    """Whether an entity is of a kind that `entity_edges` understands."""
    return entity.dxftype() in _READERS


def entity_edges(entity: DXFEntity) -> Drawn:
    """Return the exact edges of an entity.

    Raises
    ------
    UnusableEntityError
        If it is tilted, has no extent, or its numbers make no curve.
    """
    try:
        with np.errstate(divide="raise", invalid="raise", over="raise"):
            return _READERS[entity.dxftype()](entity)
    except (DXFError, ValueError, TypeError, ArithmeticError) as error:
        raise UnusableEntityError("entity-invalid", f"its numbers make no curve ({error})") from error


def bulge_edge(first: ArrayLike, last: ArrayLike, bulge: float) -> Line | Arc:
    """Return the segment of a polyline: a line, or the arc whose quarter angle has the tangent `bulge`."""
    if abs(bulge) <= _STRAIGHT_BULGE:
        return Line.of(first, last)
    start, end = (complex(*np.asarray(point, float)) for point in (first, last))
    centre = (start + end) / 2 + 1j * (end - start) * (1 - bulge**2) / (4 * bulge)
    spoke = start - centre
    return Arc.of([centre.real, centre.imag], abs(spoke), float(np.angle(spoke)), float(4 * np.arctan(bulge)))


def _numbers(values: Any) -> Floats:
    array = np.array(values, float)
    if not np.all(np.isfinite(array)) or np.any(np.abs(array) > _FARTHEST):
        raise UnusableEntityError("entity-invalid", "a coordinate is not a number or beyond all measure")
    return array


def _side(entity: DXFEntity) -> float:
    """Return 1.0 for a plane seen from above, -1.0 from below."""
    normal = _numbers(entity.dxf.extrusion)
    normal = normal / np.linalg.norm(normal)
    if np.abs(normal[:2]).max() > _TILT:
        raise UnusableEntityError("entity-tilted", "it does not lie flat in the xy plane")
    return float(np.sign(normal[2]))


def _in_plane(entity: DXFEntity, edges: Iterable[Edge], heights: ArrayLike) -> Drawn:
    """Bring edges from the entity's own plane into the xy plane."""
    side = _side(entity)
    if side < 0:
        mirror = np.diag([-1.0, 1.0])
        edges = [affine_image(edge, mirror, np.zeros(2)) for edge in edges]
    return _drawn(edges, side * np.asarray(heights, float))


def _drawn(edges: Iterable[Edge], heights: ArrayLike) -> Drawn:
    return Drawn(tuple(edges), float(np.min(heights)), float(np.max(heights)))


def _line(entity: Any) -> Drawn:
    first, last = _numbers([entity.dxf.start, entity.dxf.end])
    return _drawn([Line.of(first[:2], last[:2])], [first[2], last[2]])


def _circle(entity: Any) -> Drawn:
    return _arc_of(entity, 0.0, 2 * np.pi)


def _arc(entity: Any) -> Drawn:
    start, end = _numbers([entity.dxf.start_angle, entity.dxf.end_angle])
    return _arc_of(entity, float(np.radians(start)), _turn(np.radians(end - start)))


def _arc_of(entity: Any, start: float, sweep: float) -> Drawn:
    centre, radius = _numbers(entity.dxf.center), float(_numbers(entity.dxf.radius))
    if radius <= 0:
        raise UnusableEntityError("entity-degenerate", "its radius is not positive")
    return _in_plane(entity, [Arc.of(centre[:2], radius, start, sweep)], centre[2])


def _turn(angle: float) -> float:
    """Bring an angle into (0, 2 pi]; none at all means all the way round, up to rounding of the file's degrees."""
    turn = float(angle % (2 * np.pi))
    return 2 * np.pi if min(turn, 2 * np.pi - turn) <= 1e-9 else turn  # noqa: PLR2004


def _ellipse(entity: Any) -> Drawn:
    centre, major = _numbers([entity.dxf.center, entity.dxf.major_axis])
    ratio, start, end = _numbers([entity.dxf.ratio, entity.dxf.start_param, entity.dxf.end_param])
    side = _side(entity)
    if np.hypot(*major[:2]) == 0 or ratio == 0:
        raise UnusableEntityError("entity-degenerate", "an axis has no length")
    minor = side * ratio * np.array([-major[1], major[0]])
    edge = ellipse_arc(centre[:2], major[:2], minor, start, _turn(end - start))
    return _drawn([edge], centre[2] + np.array([-1, 1]) * abs(major[2]))


def _lwpolyline(entity: Any) -> Drawn:
    points = _numbers(entity.get_points("xyb")).reshape(-1, 3)
    edges = _segments(points[:, :2], points[:, 2], closed=entity.closed)
    return _in_plane(entity, edges, float(_numbers(entity.dxf.elevation)))


def _polyline(entity: Any) -> Drawn:
    if not (entity.is_2d_polyline or entity.is_3d_polyline):
        raise UnusableEntityError("entity-3d", "it is a mesh")
    # Vertices of the frame of a spline-fit polyline are shown, if at all, beside the curve.
    vertices = [vertex for vertex in entity.vertices if not vertex.dxf.flags & _SPLINE_FRAME]
    if not vertices:
        raise UnusableEntityError("entity-degenerate", "it has no vertices")
    points = _numbers([vertex.dxf.location for vertex in vertices])
    if entity.is_3d_polyline:
        return _drawn(_segments(points[:, :2], np.zeros(len(points)), closed=entity.is_closed), points[:, 2])
    bulges = _numbers([vertex.dxf.bulge for vertex in vertices])
    elevation = _numbers(entity.dxf.elevation)[2] if entity.dxf.hasattr("elevation") else points[0, 2]
    return _in_plane(entity, _segments(points[:, :2], bulges, closed=entity.is_closed), elevation)


def _segments(points: Floats, bulges: Floats, *, closed: bool) -> list[Edge]:
    """Return the edges of a polyline; one without length stays, as a line, so that chaining can count it."""
    if len(points) < 2:
        raise UnusableEntityError("entity-degenerate", "it has fewer than two vertices")
    following = np.roll(points, -1, axis=0)
    count = len(points) if closed else len(points) - 1
    return [
        Line.of(points[i], following[i])
        if np.array_equal(points[i], following[i])
        else bulge_edge(points[i], following[i], float(bulges[i]))
        for i in range(count)
    ]


def _spline(entity: Any) -> Drawn:
    if entity.control_point_count():
        return _control_spline(entity)
    if entity.fit_point_count() > 1:
        return _fit_spline(entity)
    raise UnusableEntityError("entity-degenerate", "it has neither control points nor fit points")


def _control_spline(entity: Any) -> Drawn:
    degree = int(entity.dxf.degree)
    poles, knots = _numbers(entity.control_points), _numbers(entity.knots)
    weights = _numbers(entity.weights) if len(entity.weights) else np.ones(len(poles))
    if len(knots) == 0:
        knots = _uniform_knots(len(poles), degree)
    elif entity.closed and len(knots) == len(poles) + 2 * degree + 1:
        # Some writers leave out the poles that a periodic spline repeats.
        poles, weights = np.concatenate([poles, poles[:degree]]), np.concatenate([weights, weights[:degree]])
    else:
        degree = len(knots) - len(poles) - 1  # the counts are the truth; a stated degree may be missing
    return _drawn(spline_edges(degree, knots, poles[:, :2], weights), poles[:, 2])


def _uniform_knots(count: int, degree: int) -> Floats:
    inner = np.arange(count - degree + 1, dtype=float)
    return np.concatenate([np.repeat(inner[0], degree), inner, np.repeat(inner[-1], degree)])


def _fit_spline(entity: Any) -> Drawn:
    points = _without_repeats(_numbers(entity.fit_points))
    if entity.closed and not np.array_equal(points[0], points[-1]):
        points = np.concatenate([points, points[:1]])
    if entity.closed and len(points) > 3:
        return _drawn(_periodic_fit(points[:, :2]), points[:, 2])
    has_tangents = entity.dxf.hasattr("start_tangent") and entity.dxf.hasattr("end_tangent")
    tangents = [entity.dxf.start_tangent, entity.dxf.end_tangent] if has_tangents else None
    tool = fit_points_to_cad_cv(points, tangents=tangents)
    poles = _numbers(list(tool.control_points))
    return _drawn(spline_edges(tool.degree, tool.knots(), poles[:, :2]), poles[:, 2])


def _periodic_fit(points: Floats) -> tuple[Edge, ...]:
    """Interpolate a closed run of points with continuous curvature, by chord length as CAD systems do."""
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    curve = make_interp_spline(np.append(0.0, np.cumsum(chords)), points, k=3, bc_type="periodic")
    return spline_edges(3, curve.t, curve.c)


def _without_repeats(points: Floats) -> Floats:
    moves = np.any(np.diff(points, axis=0) != 0, axis=1)
    kept = points[np.append(True, moves)]
    if len(kept) < 2:
        raise UnusableEntityError("entity-degenerate", "all its points coincide")
    return kept


_READERS: dict[str, Callable[[Any], Drawn]] = {
    "ARC": _arc,
    "CIRCLE": _circle,
    "ELLIPSE": _ellipse,
    "LINE": _line,
    "LWPOLYLINE": _lwpolyline,
    "POLYLINE": _polyline,
    "SPLINE": _spline,
}
