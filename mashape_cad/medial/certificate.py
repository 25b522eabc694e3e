"""What is proven of a medial axis: `Certificate`.

Found from the finished axis and the profile, independently of how the axis was traced. For a domain with h holes the
axis is connected, has h independent cycles, and fulfils ``sum over junctions of (degree - 2) = ends + 2 h - 2``. The
checks, each in its own module:

* every settled disc by the kernel's distance, and by all of its contacts (`confirmation`);
* every place where the axis can end, accepted or rejected by a witness (`candidates`);
* every stretch of the boundary paired with its twin, and the pieces as faces of one decomposition (`pairing`);
* one disc inside every piece (`inner_disc`), and the area that all discs cover (`coverage`);
* where asked for, the discs at other places against those that the definition gives (`completeness`).

References
----------
H. I. Choi, S. W. Choi, H. P. Moon, Mathematical theory of medial axis transform, Pacific J. Math. 181 (1997).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mashape_cad.medial.candidates import candidate_objections
from mashape_cad.medial.completeness import Completeness, completeness
from mashape_cad.medial.confirmation import Confirmation, confirmation
from mashape_cad.medial.coverage import Coverage, coverage
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.inner_disc import inner_disc_objections
from mashape_cad.medial.objection import Objection
from mashape_cad.medial.pairing import pairing_objections, reference_objections

__all__ = ["STATIONS", "Certificate", "certificate"]

# Stations on each span at which `certify` holds an axis against the definition. More find smaller faults, and cost in
# proportion; what hides between three of them is left to the other checks.
STATIONS = 3


@dataclass(frozen=True, slots=True)
class Certificate:
    """Figures of one profile's medial axis; errors are relative to the bounding box's diagonal.

    Attributes
    ----------
    edges, holes : int
    area_mm2, perimeter_mm, max_radius_mm : float
    branches, junctions, ends, cycles : int
    connected : bool
    max_disc_error : float
        Largest difference between a disc's radius and the kernel's distance from its centre to the boundary.
    max_foot_error : float
        Largest difference between a disc's radius and the distance from its centre to a contact or footpoint.
    ok, certified : bool
        Whether nothing stands against the axis. One and the same under two names.
    euler_ok : bool
        Connected, with as many independent cycles as holes.
    counting_ok : bool
        The counting identity holds, and every candidate for an end is accepted or rejected by a witness.
    area_error : float
        Difference between the area that all discs cover and that of the profile, relative to the latter.
    completeness_error : float or None
        Largest distance of a disc of the axis from the one that the definition gives at the same place; None if that
        was not asked for.
    reason : str
        The first thing that stands against it, with its place; empty if nothing does.
    """

    edges: int
    holes: int
    area_mm2: float
    perimeter_mm: float
    max_radius_mm: float
    branches: int
    junctions: int
    ends: int
    cycles: int
    connected: bool
    max_disc_error: float
    max_foot_error: float
    ok: bool
    certified: bool
    euler_ok: bool
    counting_ok: bool
    area_error: float
    completeness_error: float | None
    reason: str


@dataclass(frozen=True, slots=True, eq=False)
class _Findings:
    """What the checks found; those that could not be made are None."""

    discs: Confirmation | None
    covered: Coverage | None
    defined: Completeness | None
    candidates: tuple[Objection, ...]
    count: tuple[Objection, ...]
    euler: tuple[Objection, ...]
    pairing: tuple[Objection, ...]
    inner: tuple[Objection, ...]

    def first(self) -> Objection | None:
        """Return the objection that tells most: what names a place comes before what only counts."""
        measured = [found.objections for found in (self.covered, self.defined) if found is not None]
        discs = self.discs.objections if self.discs is not None else ()
        every = (discs, self.candidates, self.pairing, self.euler, self.count, self.inner, *measured)
        return next((objection for objections in every for objection in objections), None)


def certificate(axis: MedialAxis, stations: int = 0) -> Certificate:
    """Return what can be proven of a medial axis.

    Parameters
    ----------
    axis : MedialAxis
    stations : int
        On how many places of each span of the boundary the maximal disc is found anew by its definition, for
        `Certificate.completeness_error`; 0 leaves that out. It costs about as much as all other checks.
    """
    profile, nodes = axis.profile, axis.nodes
    area, diagonal = profile.area, profile.diagonal
    found = _findings(axis, area, diagonal, stations)
    objection = found.first()
    return Certificate(
        edges=len(profile.edges),
        holes=len(profile.holes),
        area_mm2=area,
        perimeter_mm=profile.perimeter,
        max_radius_mm=float(axis.discs.radius.max()),
        branches=len(axis.branches),
        junctions=sum(kind == "junction" for kind in nodes.kind),
        ends=sum(kind == "end" for kind in nodes.kind),
        cycles=axis.cycles,
        connected=axis.components == 1,
        max_disc_error=math.inf if found.discs is None else float(found.discs.disc.max() / diagonal),
        max_foot_error=math.inf if found.discs is None else float(found.discs.foot.max() / diagonal),
        ok=objection is None,
        certified=objection is None,
        euler_ok=not found.euler,
        counting_ok=not (found.count or found.candidates),
        area_error=math.inf if found.covered is None else abs(found.covered.area / area - 1.0),
        completeness_error=None if found.defined is None else float(found.defined.error.max() / diagonal),
        reason="" if objection is None else str(objection),
    )


def _findings(axis: MedialAxis, area: float, diagonal: float, stations: int) -> _Findings:
    euler, count = tuple(_euler_objections(axis)), tuple(_count_objections(axis))
    broken = tuple(reference_objections(axis))
    if broken:
        return _Findings(None, None, None, (), count, euler, broken, ())
    pairing = tuple(pairing_objections(axis))
    return _Findings(
        confirmation(axis, diagonal),
        coverage(axis, area),
        completeness(axis, diagonal, stations) if stations and not pairing else None,
        tuple(candidate_objections(axis)),
        count,
        euler,
        pairing,
        tuple(inner_disc_objections(axis)),
    )


def _euler_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Yield how the graph is not connected, or has not one independent cycle for each hole (V - E = 1 - holes)."""
    holes, parts = len(axis.profile.holes), axis.components
    if parts != 1:
        yield Objection.at("graph", f"the axis falls into {parts} parts", axis.discs.centre[_apart(axis)])
    if axis.cycles != holes:
        yield Objection("graph", f"the axis has {axis.cycles} cycles around {holes} holes")


def _count_objections(axis: MedialAxis) -> Iterator[Objection]:
    """Yield how the counting identity of the module's text fails; a disc has neither ends nor junctions."""
    holes, degree = len(axis.profile.holes), axis.nodes.degree
    if axis.nodes.kind == ("disc",):
        if holes:
            yield Objection("count", f"one disc can have no holes, the profile has {holes}")
        return
    ends, junctions = int(np.sum(degree == 1)), int((degree[degree > 2] - 2).sum())
    if junctions != ends + 2 * holes - 2:
        text = f"junctions add up to {junctions}, and {ends} ends with {holes} holes ask for {ends + 2 * holes - 2}"
        yield Objection("count", text)


def _apart(axis: MedialAxis) -> int:
    """Return a disc that no branch joins to the first node; any at all if there are no nodes."""
    reached = {0}
    for _ in axis.branches:
        reached |= {n for b in axis.branches if reached & {b.start, b.end} for n in (b.start, b.end)}
    lost = next((n for n in range(len(axis.nodes.disc)) if n not in reached), None)
    return 0 if lost is None else int(axis.nodes.disc[lost])
