"""Edges from splines as files hold them: cut where they are not smooth, lines and arcs where that is what they are.

Terminology
-----------
kink
    An inner knot at which the direction of a spline changes; such a place is a corner and belongs to an edge's end.
jump
    An inner knot that occurs more than `degree` times: the spline may be interrupted there.
joint
    An inner knot that occurs `degree` times: two curves were put together there, with or without a kink.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from mashape_cad.geometry.edge import Arc, BSpline, Edge, Floats, Line, frozen

__all__ = ["pieces_without_kinks", "simplest", "spline_edges"]

# Radians. The medial axis takes a smaller turn at a joint for a rounded coordinate, not for a corner, so a cut there
# would gain nothing; a kink overlooked would be a corner inside an edge.
_KINK = 1e-6
# Of the curve's size: what stays closer to a line or a circle is one. Ends that are this close count as the same point
# too, and nine written digits do not tell more.
_SAME_CURVE = 1e-9
# Radius over size. A flatter piece stays a spline: its centre would lie so far away that rounding it moves the arc by
# more than the piece deviates from one.
_FLATTEST_ARC = 1e5
# Of the knot range: knots that differ by less were meant to be equal (a file's digits rounded them apart).
_SAME_KNOT = 1e-10


def spline_edges(degree: int, knots: ArrayLike, poles: ArrayLike, weights: ArrayLike | None = None) -> tuple[Edge, ...]:
    """Make edges from a spline of any kind: clamped or not, with kinks and jumps, straight pieces and arcs.

    Parameters
    ----------
    degree : int
    knots : (n + degree + 1,) array_like
        Non-decreasing up to rounding.
    poles : (n, 2) array_like
    weights : (n,) array_like, optional
        Positive.

    Returns
    -------
    tuple of Edge
        In the spline's order; empty if all poles coincide. At a jump one edge does not start where the last one ends.

    Raises
    ------
    ValueError
        If the numbers do not make a spline, see `BSpline.of`.
    """
    whole = BSpline.of(degree, _settled(knots), poles, weights)
    pieces = [piece for part in _parts_between_jumps(whole) for piece in pieces_without_kinks(part)]
    return tuple(edge for piece in pieces for edge in simplest(piece))


def pieces_without_kinks(spline: BSpline) -> tuple[BSpline, ...]:
    """Cut a spline at its kinks; stretches without length are left out.

    Parameters
    ----------
    spline : BSpline
        Without jumps.
    """
    control, breaks = spline.spans()
    points = control[..., :2] / control[..., 2:]
    legs = np.diff(points, axis=1)
    lengths = np.linalg.norm(legs, axis=2)
    size = float(np.ptp(points, axis=(0, 1)).max()) if len(points) else 0.0
    stands = lengths > 1e-12 * size  # legs that have a direction
    moves = stands.any(axis=1)
    if size == 0.0 or not moves.any():
        return ()
    cuts = [0.0]
    cuts += [
        float(breaks[i])
        for i in range(1, len(points))
        if not (moves[i - 1] and moves[i]) or _turn(legs[i - 1], stands[i - 1], legs[i], stands[i]) > _KINK
    ]
    cuts.append(1.0)
    middles = (breaks[1:] + breaks[:-1]) / 2
    kept = [bool(moves[(middles > low) & (middles < high)].any()) for low, high in pairwise(cuts)]
    return tuple(piece for piece, keep in zip(_cut(spline, cuts[1:-1]), kept, strict=True) if keep)


def simplest(spline: BSpline) -> tuple[Edge, ...]:
    """Cut out of a smooth spline the lines and arcs that were put together to make it.

    Parameters
    ----------
    spline : BSpline
        Without kinks.

    Returns
    -------
    tuple of Edge
        Lines and arcs that the spline follows to within 1e-9 of their size between joints, and the splines between.
    """
    joints = [0.0, *_joints(spline), 1.0]
    last = len(joints) - 1
    cuts, first = set(), 0
    while first < last:
        end = _end_of_simple(spline, joints, first)
        if end > first:
            cuts |= {joints[first], joints[end]}
        first = max(end, first + 1)
    pieces = _cut(spline, sorted(cuts - {0.0, 1.0}))
    return tuple(_as_line(piece) or _as_arc(piece) or piece for piece in pieces)


def _end_of_simple(spline: BSpline, joints: list[float], first: int) -> int:
    """Return the last joint to which the curve from joint `first` on is one line or arc; `first` if it is none."""
    last = len(joints) - 1
    if _is_simple(_between(spline, joints[first], joints[last])):
        return last
    end = first
    while end + 1 < last and _is_simple(_between(spline, joints[first], joints[end + 1])):
        end += 1
    return end


def _is_simple(piece: BSpline) -> bool:
    return _as_line(piece) is not None or _as_arc(piece) is not None


def _joints(spline: BSpline) -> list[float]:
    """Return the parameters u of the joints."""
    low, high = spline.knots[0], spline.knots[-1]
    values, counts = np.unique(spline.knots[spline.degree + 1 : -spline.degree - 1], return_counts=True)
    return ((values[counts >= spline.degree] - low) / (high - low)).tolist()


def _between(spline: BSpline, low: float, high: float) -> BSpline:
    return _cut(spline, [u for u in (low, high) if 0 < u < 1])[1 if low > 0 else 0]


def _settled(knots: ArrayLike) -> Floats:
    """Make knots equal that were meant to be, and let no later one fall below an earlier one by rounding."""
    values = np.array(knots, float)
    if len(values) == 0 or not np.all(np.isfinite(values)):
        return values
    near = _SAME_KNOT * (values.max() - values.min())
    for i in range(1, len(values)):
        if abs(values[i] - values[i - 1]) <= near:
            values[i] = values[i - 1]
    return values


def _parts_between_jumps(spline: BSpline) -> list[BSpline]:
    degree, knots = spline.degree, spline.knots
    values, counts = np.unique(knots[degree + 1 : -degree - 1], return_counts=True)
    parts, rest = [], spline
    for value, count in zip(values, counts, strict=True):
        if count <= degree:
            continue
        at = int(np.searchsorted(rest.knots, value))
        after = at + int(count) - degree - 1
        if count == degree + 1 and np.allclose(rest.poles[at - 1], rest.poles[at], rtol=0, atol=1e-12 * _size(spline)):
            rest = _without_double_pole(rest, at)
            continue
        left = replace(rest, knots=rest.knots[: at + degree + 1], poles=rest.poles[:at], weights=rest.weights[:at])
        rest = replace(rest, knots=rest.knots[after:], poles=rest.poles[after:], weights=rest.weights[after:])
        parts.append(left)
    return [*parts, rest]


def _without_double_pole(spline: BSpline, at: int) -> BSpline:
    """Join both sides of a jump that only repeats a point."""
    return replace(
        spline,
        knots=frozen(np.delete(spline.knots, at)),
        poles=frozen(np.delete(spline.poles, at, axis=0)),
        weights=frozen(np.delete(spline.weights, at)),
    )


def _turn(before: Floats, before_stands: Floats, after: Floats, after_stands: Floats) -> float:
    """Angle between the last leg with a direction of one span and the first of the next, radians."""
    (ax, ay), (bx, by) = before[before_stands][-1], after[after_stands][0]
    return float(abs(np.arctan2(ax * by - ay * bx, ax * bx + ay * by)))


def _cut(spline: BSpline, cuts: list[float]) -> list[BSpline]:
    pieces, rest, done = [], spline, 0.0
    for cut in cuts:
        piece, rest = rest.split((cut - done) / (1.0 - done))
        pieces.append(piece)
        done = cut
    return [*pieces, rest]


def _as_line(spline: BSpline) -> Line | None:
    chord = spline.poles[-1] - spline.poles[0]
    length = float(np.hypot(*chord))
    if length <= 0.5 * _size(spline):
        return None
    legs = spline.poles - spline.poles[0]
    across = (legs @ np.array([-chord[1], chord[0]])) / length
    along = legs @ chord
    if np.abs(across).max() > _SAME_CURVE * length or np.any(np.diff(along) < 0):
        return None
    return Line.of(spline.poles[0], spline.poles[-1])


def _as_arc(spline: BSpline) -> Arc | None:
    points = spline.flattened(8)
    first, second, third = (complex(*points[i]) for i in (0, len(points) // 3, 2 * len(points) // 3))
    centre = _circle_centre(first, second, third)
    if centre is None:
        return None
    spokes = points[:, 0] + 1j * points[:, 1] - centre
    radius = abs(spokes[0])
    if radius > _FLATTEST_ARC * _size(spline):
        return None
    if np.abs(np.abs(spokes) - radius).max() > _SAME_CURVE * min(radius, _size(spline)):
        return None
    turns = np.angle(spokes[1:] / spokes[:-1])
    sweep = float(turns.sum())
    if np.any(turns * sweep <= 0) or abs(sweep) > 2 * np.pi * (1 + _SAME_CURVE):
        return None
    if abs(abs(sweep) - 2 * np.pi) <= _SAME_CURVE:
        sweep = float(np.copysign(2 * np.pi, sweep))
    return Arc.of([centre.real, centre.imag], radius, float(np.angle(spokes[0])), sweep)


def _circle_centre(first: complex, second: complex, third: complex) -> complex | None:
    a, b = second - first, third - first
    cross = (a.conjugate() * b).imag
    if cross == 0.0:
        return None
    return first + 1j * (a * abs(b) ** 2 - b * abs(a) ** 2) / (2 * cross)


def _size(spline: BSpline) -> float:
    return float(np.ptp(spline.poles, axis=0).max())
