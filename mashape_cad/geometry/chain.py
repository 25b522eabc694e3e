"""Loose edges to closed loops: what is drawn twice dropped, gaps bridged, what does not close set aside and reported.

Terminology
-----------
chain
    Edges that meet, each at most two at a point; a closed chain is a loop.
branch
    A point where more than two edges meet.
gap tolerance
    The longest distance of two ends that are still joined, a fraction of the drawing's diagonal.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mashape_cad.findings import Finding
from mashape_cad.geometry import chain_findings as report
from mashape_cad.geometry.closing import Closed, closed_loop
from mashape_cad.geometry.cycles import Cycles, Step, find_cycles
from mashape_cad.geometry.drawing import Drawing, Strand
from mashape_cad.geometry.duplicates import repeated_edges, repeated_loops
from mashape_cad.geometry.joining import Nodes, bridged_ends, coincident_ends
from mashape_cad.geometry.profile import Loop

__all__ = ["Chained", "ChainedLoop", "chain"]

# Of the drawing's diagonal: copies of an edge that were rounded differently are one edge.
_SAME_EDGE = 1e-6
# A gap may be this much wider than the tolerance if it closes a loop...
_WIDER = 20.0
# ...of whose area over length it is no more than this share: lines that run side by side are not meant to be joined.
_SHARE_OF_WIDTH = 0.1
# Chord over length of a curve that can be closed in itself.
_BENT = 0.5
# Of a loop's size: less width could not be told from a line. A strip of 1 mm to a kilometre has 1e-6.
_NO_WIDTH = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class ChainedLoop:
    """A loop with the entities that it is made of.

    Attributes
    ----------
    loop : Loop
    handles, layers : tuple of str
        In the order of the edges, each once.
    gap : float
        The widest that was bridged in it, mm.
    """

    loop: Loop
    handles: tuple[str, ...]
    layers: tuple[str, ...]
    gap: float = 0.0


@dataclass(frozen=True, slots=True)
class Chained:
    """What `chain` made of loose edges."""

    loops: tuple[ChainedLoop, ...]
    findings: tuple[Finding, ...]


def chain(strands: Sequence[Strand], gap_rel: float) -> Chained:
    """Join loose edges to loops.

    Parameters
    ----------
    strands : sequence of Strand
        In any order and direction; strands of one entity follow one another.
    gap_rel : float
        Gap tolerance, as a fraction of the diagonal of all strands.

    Returns
    -------
    Chained
        Loops whose edges meet, and a finding for all that was changed or left out.
    """
    if not strands:
        return Chained((), ())
    whole = Drawing.of(strands)
    sizable = np.flatnonzero(whole.lengths > whole.noise).tolist()
    own, loose = _closed_entities(whole, sizable)
    loose, copies = _without_copies(whole, loose)
    graph = whole.pick(loose)
    nodes = _joined(graph, gap_rel)
    cycles = _untangled(graph, nodes)
    closed = [_closed(whole, steps) for steps in own] + [_closed(graph, steps) for steps in cycles.cycles]
    wide, flat = _without_flat([loop for loop, _ in closed])
    kept, repeated = _without_repeated(wide, _SAME_EDGE * whole.diagonal)
    findings = (
        *report.zero_length(whole, whole.lengths <= whole.noise),
        *report.copied_edges(whole, copies),
        *report.gaps([fit for _, fit in closed], whole),
        *report.flat_loops([(one.loop, one.handles) for one in flat]),
        *report.copied_loops([(one.loop, one.handles) for one in repeated]),
        *report.open_chains(graph, nodes, cycles.dangling),
        *report.branches(graph, nodes, cycles.tangles),
    )
    return Chained(tuple(kept), findings)


def _closed_entities(drawing: Drawing, numbers: list[int]) -> tuple[list[list[Step]], list[int]]:
    """Take out entities that are closed in themselves: where others touch them does not matter."""
    entities = defaultdict(list)
    for number in numbers:
        entities[drawing.strands[number].entity].append(number)
    own: list[list[Step]] = []
    loose = []
    for members in entities.values():
        starts, before = drawing.ends[members, 0], np.roll(drawing.ends[members, 1], 1, axis=0)
        if np.linalg.norm(starts - before, axis=1).max() <= drawing.noise:
            own.append([(number, False) for number in members])
        else:
            loose += members
    return own, loose


def _without_copies(drawing: Drawing, numbers: list[int]) -> tuple[list[int], list[int]]:
    """Split into edges and repeated edges."""
    picked = drawing.pick(numbers)
    copies = repeated_edges([strand.edge for strand in picked.strands], picked.lengths, _SAME_EDGE * drawing.diagonal)
    repeats = {numbers[copy] for copy in copies}
    return [number for number in numbers if number not in repeats], sorted(repeats)


def _joined(graph: Drawing, gap_rel: float) -> Nodes:
    """Join ends across gaps, and across wider ones where that closes a loop."""
    tolerance = max(gap_rel * graph.diagonal, graph.noise)
    same = coincident_ends(graph.ends, graph.noise)
    near = bridged_ends(same, graph.ends, graph.lengths, graph.noise, tolerance)
    far = bridged_ends(near, graph.ends, graph.lengths, tolerance, _WIDER * tolerance)
    joined = near.copy()
    for steps in _cycles(graph, far).cycles:
        members = [edge for edge, _ in steps]
        fit = _closed(graph, steps)[1]
        if fit.gaps.max() > tolerance and _is_short_beside_loop(fit):
            joined[members] = far[members] + near.max() + 1  # nodes of their own: a cycle shares none
    return joined


def _is_short_beside_loop(fit: Closed) -> bool:
    mean_width = abs(fit.loop.signed_area) / fit.loop.length
    return bool(fit.gaps.max() <= _SHARE_OF_WIDTH * mean_width)


def _untangled(graph: Drawing, nodes: Nodes) -> Cycles:
    """Find cycles; where several share edges, look at each layer alone."""
    whole = _cycles(graph, nodes)
    cycles, dangling, tangles = list(whole.cycles), list(whole.dangling), []
    for tangle in whole.tangles:
        layers = defaultdict(list)
        for edge in tangle:
            layers[graph.strands[edge].layer].append(edge)
        parts = [_cycles(graph, nodes, edges) for edges in layers.values()]
        if any(part.cycles for part in parts):
            cycles += [cycle for part in parts for cycle in part.cycles]
            dangling += [group for part in parts for group in part.dangling]
            tangles += [rest for part in parts for rest in part.tangles]
        else:
            tangles.append(tangle)
    return Cycles(tuple(cycles), tuple(dangling), tuple(tangles))


def _cycles(graph: Drawing, nodes: Nodes, edges: list[int] | None = None) -> Cycles:
    """Find cycles; an edge hardly longer than rounding, with both ends at one node, is none."""
    found = find_cycles(nodes, edges)
    chords = np.linalg.norm(graph.ends[:, 1] - graph.ends[:, 0], axis=1)
    bent = chords <= _BENT * graph.lengths
    sound = tuple(steps for steps in found.cycles if len(steps) > 1 or bent[steps[0][0]])
    points = tuple((steps[0][0],) for steps in found.cycles if len(steps) == 1 and not bent[steps[0][0]])
    return Cycles(sound, (*found.dangling, *points), found.tangles)


def _closed(drawing: Drawing, steps: Sequence[Step]) -> tuple[ChainedLoop, Closed]:
    strands = [drawing.strands[number] for number, _ in steps]
    fit = closed_loop(
        [
            strand.edge.reversed() if backwards else strand.edge
            for strand, (_, backwards) in zip(strands, steps, strict=True)
        ]
    )
    handles = tuple(dict.fromkeys(strand.handle for strand in strands))
    layers = tuple(dict.fromkeys(strand.layer for strand in strands))
    return ChainedLoop(fit.loop, handles, layers, float(fit.gaps.max())), fit


def _without_flat(loops: list[ChainedLoop]) -> tuple[list[ChainedLoop], list[ChainedLoop]]:
    """Split into loops with and without width."""
    flat = [_width(one.loop) <= _NO_WIDTH for one in loops]
    pairs = list(zip(loops, flat, strict=True))
    return [one for one, is_flat in pairs if not is_flat], [one for one, is_flat in pairs if is_flat]


def _width(loop: Loop) -> float:
    """Width over length of the box that lies along a loop."""
    points = loop.flattened(4)
    long, short = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return float(short / long) if long > 0 else 0.0


def _without_repeated(loops: list[ChainedLoop], tolerance: float) -> tuple[list[ChainedLoop], list[ChainedLoop]]:
    """Split into loops and repeated loops."""
    repeats = repeated_loops([one.loop for one in loops], tolerance)
    return [one for i, one in enumerate(loops) if i not in repeats], [loops[i] for i in repeats]
