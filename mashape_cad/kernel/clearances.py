"""The kernel's distance from many points to the nearest of the pieces of boundary that each of them may touch.

Meant for discs of which is known already that nothing else comes near (by bounds that never fail): then a call or two
of the kernel for each disc confirm its radius. Who knows nothing beforehand asks `queries.DistanceQuery`.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import sqrt

import numpy as np
from numpy.typing import NDArray
from OCP.Extrema import Extrema_ExtPC2d
from OCP.Geom2dAdaptor import Geom2dAdaptor_Curve
from OCP.Geom2dConvert import Geom2dConvert_BSplineCurveToBezierCurve
from OCP.gp import gp_Pnt2d

from mashape_cad.geometry.edge import Arc, BSpline, Edge, Floats, Line
from mashape_cad.kernel.curves import Twin, bezier

__all__ = ["clearances"]

# Of the kernel's parameter, its own default; a distance is off by about its square.
_TOLERANCE = 1e-10
_ROUNDING = 1e-15  # of coordinates

_Point = tuple[float, float]
# A search, the curve that it only points to, the curve's first and last parameter, and its end points.
_Piece = tuple[Extrema_ExtPC2d, Geom2dAdaptor_Curve, float, float, tuple[_Point, _Point]]


def clearances(
    edges: Sequence[tuple[Edge, Sequence[float]]], points: Floats, row: NDArray[np.int64], piece: NDArray[np.int64]
) -> Floats:
    """Return the kernel's distance of each point to the nearest of its pieces.

    Parameters
    ----------
    edges : sequence of (edge, breaks)
        All edges in order, each with the k + 1 parameters ``u`` at the ends of its k pieces. Pieces are numbered
        through.
    points : (m, 2) array
        mm.
    row, piece : (n,) arrays
        Pairs of a point and a piece.

    Returns
    -------
    (m,) array
        mm; infinite for a point without piece. The kernel may overlook the nearest point of a curve, and then an entry
        is too large; never too small.
    """
    pieces = [made for edge, breaks in edges for made in _pieces(edge, breaks)]
    ends = np.array([both for *_, both in pieces])[piece]
    found = np.hypot(*np.moveaxis(ends - points[row][:, None], 2, 0)).min(axis=1).tolist()
    nothing = _ROUNDING * float(np.abs(points).max(initial=0.0))
    place, at, coordinates = gp_Pnt2d(), -1, points.tolist()
    for pair, (number, index) in enumerate(zip(row.tolist(), piece.tolist(), strict=True)):
        if found[pair] <= nothing:
            continue  # The point is the piece's end, as at every convex vertex: none is nearer.
        if number != at:
            at = number
            place.SetCoord(*coordinates[at])
        extrema, _, low, high, _ = pieces[index]
        extrema.Perform(place)
        # At the centre of a circle all points are stationary, and the kernel reports that as a failure.
        if extrema.IsDone():
            for k in range(1, extrema.NbExt() + 1):
                apart = sqrt(extrema.SquareDistance(k))
                # The kernel takes lines and arcs for 1e-7 longer than they are.
                if apart < found[pair] and low <= extrema.Point(k).Parameter() <= high:
                    found[pair] = apart
    nearest = np.full(len(points), np.inf)
    np.minimum.at(nearest, row, found)
    return nearest


def _pieces(edge: Edge, breaks: Sequence[float]) -> list[_Piece]:
    """Make an edge's pieces as the kernel's curves with their end points."""
    # The kernel's search is better on Bezier curves: exact to rounding on those of a nearly round ellipse, and far less
    # apt to overlook something than on ranges of a B-spline.
    match edge:
        case Line() | Arc():
            twin = Twin.of(edge)
            return [_piece(twin.adaptor(low, high)) for low, high in pairwise(breaks)]
        case BSpline() if len(breaks) == 2:
            return [_piece(Geom2dAdaptor_Curve(bezier(edge.poles, edge.weights)))]
        case BSpline():
            convert = Geom2dConvert_BSplineCurveToBezierCurve(Twin.of(edge).curve)
            if convert.NbArcs() == len(breaks) - 1:
                return [_piece(Geom2dAdaptor_Curve(convert.Arc(k))) for k in range(1, len(breaks))]
    controls, _ = edge.spans()
    return [_piece(Geom2dAdaptor_Curve(bezier(c[:, :2] / c[:, 2:], c[:, 2]))) for c in controls]


def _piece(adaptor: Geom2dAdaptor_Curve) -> _Piece:
    first, last = adaptor.FirstParameter(), adaptor.LastParameter()
    extrema = Extrema_ExtPC2d()
    extrema.Initialize(adaptor, first, last, _TOLERANCE)
    start, end = adaptor.Value(first), adaptor.Value(last)
    return extrema, adaptor, first, last, ((start.X(), start.Y()), (end.X(), end.Y()))
