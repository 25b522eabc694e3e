"""How chaining tells what it changed and what it left out: the wording and the places of its findings."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from mashape_cad.findings import Finding, Severity
from mashape_cad.geometry.closing import Closed
from mashape_cad.geometry.drawing import Drawing
from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.joining import Nodes
from mashape_cad.geometry.profile import Loop

__all__ = ["branches", "copied_edges", "copied_loops", "flat_loops", "gaps", "open_chains", "zero_length"]

# Of the drawing's diagonal: gaps up to here come from rounding and are on record, wider ones count as repaired.
_ROUNDED_GAP = 1e-6
# Open chains and branches are reported one by one up to here, the rest as a sum.
_ONE_BY_ONE = 20

Numbered = Sequence[tuple[int, ...]]
LoopWithHandles = tuple[Loop, tuple[str, ...]]


def zero_length(drawing: Drawing, are_points: NDArray[np.bool_]) -> list[Finding]:
    """Report edges that are points."""
    points = np.flatnonzero(are_points).tolist()
    return _edges(drawing, points, "chain-zero-length", Severity.INFO, "without length, left out")


def copied_edges(drawing: Drawing, copies: list[int]) -> list[Finding]:
    """Report edges that repeat another one."""
    return _edges(drawing, copies, "chain-duplicate", Severity.REPAIRED, "drawn on top of another one, left out")


def copied_loops(loops: Sequence[LoopWithHandles]) -> list[Finding]:
    """Report loops that repeat another one."""
    return _loops(loops, "loop-duplicate", Severity.REPAIRED, "drawn on top of another one, left out")


def flat_loops(loops: Sequence[LoopWithHandles]) -> list[Finding]:
    """Report loops that bound nothing."""
    return _loops(loops, "loop-flat", Severity.LOST, "without any width, left out")


def gaps(closed: Sequence[Closed], drawing: Drawing) -> list[Finding]:
    """Report the gaps that were bridged, in one sum."""
    starts = [(gap, edge.start) for fit in closed for gap, edge in zip(fit.gaps, fit.loop.edges, strict=True)]
    bridged = [(gap, place) for gap, place in starts if gap > drawing.noise]
    if not bridged:
        return []
    widest, place = max(bridged, key=lambda pair: pair[0])
    rounding = widest <= _ROUNDED_GAP * drawing.diagonal
    text = f"{_counted(len(bridged), 'gap')} between ends bridged, the widest {widest:.3g} mm"
    severity = Severity.INFO if rounding else Severity.REPAIRED
    return [Finding("chain-gap", severity, text, place=_place(place), count=len(bridged))]


def open_chains(graph: Drawing, nodes: Nodes, groups: Numbered) -> list[Finding]:
    """Report what does not close, one by one, and how far the next loose end is."""
    if not groups:
        return []
    is_loose = np.bincount(nodes.ravel())[nodes] == 1
    loose = cKDTree(graph.ends[is_loose]) if is_loose.any() else None
    findings = []
    for group in groups[:_ONE_BY_ONE]:
        ends = graph.ends[list(group)][is_loose[list(group)]]
        place = ends[0] if len(ends) else graph.ends[group[0], 0]
        text = _closes_no_loop("", len(group)) + _next_end(ends, loose)
        findings.append(_lost("chain-open", graph, group, text, place))
    rest = groups[_ONE_BY_ONE:]
    if rest:
        text = _closes_no_loop("more ", sum(map(len, rest))) + f", in {_counted(len(rest), 'chain')}"
        findings.append(_lost("chain-open", graph, rest[0], text, graph.ends[rest[0][0], 0], len(rest)))
    return findings


def _closes_no_loop(more: str, count: int) -> str:
    return f"{count} {more}edge closes no loop" if count == 1 else f"{count} {more}edges close no loop"


def _next_end(ends: Floats, loose: cKDTree | None) -> str:
    if loose is None or len(ends) == 0 or loose.n < 2:
        return ""
    gap = float(loose.query(ends, k=2)[0][:, 1].min())
    return f"; the next loose end is {gap:.3g} mm away"


def branches(graph: Drawing, nodes: Nodes, tangles: Numbered) -> list[Finding]:
    """Report edges that meet in more than one way."""
    findings = []
    for tangle in tangles:
        members = list(tangle)
        degree = np.bincount(nodes[members].ravel())
        place = graph.ends[members][degree[nodes[members]] > 2][0]
        text = (
            f"{len(tangle)} edges close more than one loop, as more than two of them meet at a point; "
            "put what is not outline on a layer of its own"
        )
        findings.append(_lost("chain-branch", graph, tangle, text, place))
    return findings


def _lost(code: str, graph: Drawing, members: Sequence[int], text: str, place: Floats, count: int = 1) -> Finding:
    return Finding(code, Severity.LOST, text, graph.strands[members[0]].handle, _place(place), count)


def _edges(drawing: Drawing, numbers: list[int], code: str, severity: Severity, text: str) -> list[Finding]:
    if not numbers:
        return []
    first = numbers[0]
    handle, place = drawing.strands[first].handle, _place(drawing.ends[first, 0])
    return [Finding(code, severity, f"{_counted(len(numbers), 'edge')} {text}", handle, place, len(numbers))]


def _loops(loops: Sequence[LoopWithHandles], code: str, severity: Severity, text: str) -> list[Finding]:
    if not loops:
        return []
    loop, handles = loops[0]
    place = _place(loop.edges[0].start)
    return [Finding(code, severity, f"{_counted(len(loops), 'loop')} {text}", handles[0], place, len(loops))]


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def _place(point: Floats) -> tuple[float, ...]:
    return tuple(float(value) for value in point)
