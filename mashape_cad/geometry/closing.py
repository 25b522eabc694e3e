"""Loops whose edges meet: after the ends of edges were joined across gaps, the edges themselves are moved to fit.

Each joint gets one place, and both edges end there. A line is simply drawn to it. A curve is carried onto its new ends
by a similarity, so that an arc stays an arc. A curve whose own ends are close together is *stiff*: that map would
magnify the gap, so such a curve only ever keeps its place, and its neighbours come to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mashape_cad.geometry.edge import BSpline, Edge, EllipseArc, Floats, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop

__all__ = ["Closed", "closed_loop"]

# Chord over length: below it a curve is stiff. Carrying a curve magnifies a gap by about the inverse.
_STIFF = 0.3
# Ends this close, beside the coordinates themselves, meet already: moving them would only add rounding.
_ROUNDING = 4 * np.finfo(float).eps


@dataclass(frozen=True, slots=True, eq=False)
class Closed:
    """A loop and the gaps that were closed in it.

    Attributes
    ----------
    loop : Loop
    gaps : (n,) array
        Distance of the ends that met at the start of each edge before, mm.
    """

    loop: Loop
    gaps: Floats


def closed_loop(edges: Sequence[Edge]) -> Closed:
    """Make a loop of edges in order, each of which starts near the end of the one before.

    Parameters
    ----------
    edges : sequence of Edge
        At least one. A single one must be closed but for a gap.
    """
    starts = np.stack([edge.start for edge in edges])
    ends = np.stack([edge.end for edge in edges])
    before = np.roll(ends, 1, axis=0)
    gaps = np.linalg.norm(starts - before, axis=1)
    if len(edges) == 1:
        return Closed(Loop((_closed_edge(edges[0], gaps[0]),)), gaps)
    weight = np.array([_stiffness(edge, chord) for edge, chord in zip(edges, ends - starts, strict=True)])
    joints = _places(starts, before, weight, np.roll(weight, 1))
    fitted = (
        _fitted(edge, (start, end), (joints[i], joints[(i + 1) % len(edges)]))
        for i, (edge, start, end) in enumerate(zip(edges, starts, ends, strict=True))
    )
    return Closed(Loop(tuple(fitted)), gaps)


def _stiffness(edge: Edge, chord: Floats) -> int:
    """Rank what is better left as it is: 0 lines, 1 curves, 2 curves with their ends close together."""
    if isinstance(edge, Line):
        return 0
    return 2 if np.hypot(*chord) < _STIFF * edge.length() else 1


def _places(starts: Floats, before: Floats, weight: Floats, weight_before: Floats) -> Floats:
    """Choose the place of each joint: at the stiffer edge's end, or halfway."""
    share = (np.sign(weight - weight_before)[:, None] + 1) / 2
    return np.where(share == 1, starts, np.where(share == 0, before, (starts + before) / 2))


def _fitted(edge: Edge, old: tuple[Floats, Floats], new: tuple[Floats, Floats]) -> Edge:
    if isinstance(edge, Line):
        return Line.of(*new)
    moved = max(np.abs(new[0] - old[0]).max(), np.abs(new[1] - old[1]).max())
    rounding = _ROUNDING * max(np.abs(old[0]).max(), np.abs(old[1]).max())
    if moved <= rounding or moved > _STIFF * np.hypot(*(old[1] - old[0])):
        # Moved that far, it would be another curve; left open, the medial axis refuses the loop.
        return edge
    return edge.transformed(Similarity.carrying(old, new))


def _closed_edge(edge: Edge, gap: float) -> Edge:
    """Close a curve in itself."""
    if gap <= _ROUNDING * np.abs(edge.start).max():
        return edge
    if isinstance(edge, EllipseArc):
        return replace(edge, sweep=float(np.copysign(2 * np.pi, edge.sweep)))
    if isinstance(edge, BSpline):
        return _closed_spline(edge)
    raise TypeError(f"a {type(edge).__name__} does not close in itself")


def _closed_spline(spline: BSpline) -> BSpline:
    """Spread the gap evenly: a straight motion by u, which poles at the Greville abscissae follow exactly.

    On a rational spline the motion is only nearly straight; the ends meet all the same.
    """
    inner = np.lib.stride_tricks.sliding_window_view(spline.knots[1:-1], spline.degree).mean(axis=1)
    u = (inner - inner[0]) / (inner[-1] - inner[0])
    gap = spline.end - spline.start
    return replace(spline, poles=frozen(spline.poles + (0.5 - u)[:, None] * gap))
