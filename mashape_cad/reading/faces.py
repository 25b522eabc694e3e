"""Planar faces of a kernel shape to profiles, with a finding for all that did not become one.

The profile that comes first is the one that tells most of a part: the largest face, but not a *side*, that is, one of
the walls between the two caps of an extruded solid. A plate has two such faces, top and bottom; both are kept, in the
order of their numbers.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mashape_cad.findings import Finding, Severity
from mashape_cad.geometry.chain import chain
from mashape_cad.geometry.closing import closed_loop
from mashape_cad.geometry.drawing import Strand
from mashape_cad.geometry.edge import BSpline, Edge, Floats, Similarity
from mashape_cad.geometry.nesting import nest
from mashape_cad.geometry.profile import Loop, Origin, Plane, Profile
from mashape_cad.geometry.spline import spline_edges
from mashape_cad.kernel.faces import FlatWire, PlanarFace, PlanarFaces

__all__ = ["FaceProfiles", "face_profiles"]

# Of a face's diagonal: edges shorter than this are points; gaps up to the second come from rounding; curves that leave
# the plane, or that are met by an approximation, by more than the third are worth a look.
_POINT = 1e-9
_ROUNDED_GAP = 1e-6
_WORTH_A_LOOK = 1e-4
# Of a face's diagonal: errors of an edge up to here are no approximation.
_EXACT = 1e-8
# Of the bounding rectangle: loops with less area bound nothing.
_NO_AREA = 1e-12


@dataclass(frozen=True, slots=True)
class FaceProfiles:
    """Profiles, the most telling one first, and findings."""

    profiles: tuple[Profile, ...]
    findings: tuple[Finding, ...]

    def scaled(self, scale: float) -> "FaceProfiles":
        """Return the same of a shape that is `scale` times as large."""
        if scale == 1.0:
            return self
        profiles = tuple(
            replace(profile.transformed(Similarity.of(scale)), origin=_scaled_origin(profile.origin, scale))
            for profile in self.profiles
        )
        findings = tuple(
            finding if finding.place is None else replace(finding, place=tuple(scale * x for x in finding.place))
            for finding in self.findings
        )
        return FaceProfiles(profiles, findings)


@dataclass(frozen=True, slots=True, eq=False)
class _Joined:
    """What became of one wire; gaps in mm, findings in the face's plane."""

    loops: tuple[Loop, ...]
    gaps: tuple[float, ...]
    findings: tuple[Finding, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Reading:
    """What became of one face; gaps as fractions of its diagonal."""

    face: PlanarFace
    profiles: tuple[Profile, ...]
    findings: tuple[Finding, ...]
    gaps: tuple[float, ...]


def face_profiles(found: PlanarFaces, gap_rel: float) -> FaceProfiles:
    """Make profiles of the planar faces of a shape.

    Parameters
    ----------
    found : PlanarFaces
    gap_rel : float
        Gap tolerance, as a fraction of a face's diagonal.
    """
    readings = [_reading(face, gap_rel) for face in found.faces]
    findings = [finding for reading in readings for finding in reading.findings]
    findings += _gap_findings(readings) + _findings_of_shape(found)
    if not any(reading.profiles for reading in readings):
        text = "no planar face with a closed outline; only flat faces become profiles"
        findings.append(Finding("file-no-planar-face", Severity.LOST, text))
    return FaceProfiles(_ordered(readings), tuple(findings))


def _ordered(readings: Iterable[_Reading]) -> tuple[Profile, ...]:
    """Sort: sides last, then the largest first, then by number; areas that differ by rounding count as equal."""
    keyed = [
        ((reading.face.is_side, -float(f"{profile.area:.8e}"), reading.face.number), profile)
        for reading in readings
        for profile in reading.profiles
    ]
    return tuple(profile for _, profile in sorted(keyed, key=lambda pair: pair[0]))


def _reading(face: PlanarFace, gap_rel: float) -> _Reading:
    diagonal = _diagonal(face)
    joined = [_joined(wire, diagonal, gap_rel) for wire in face.wires]
    loops = [loop for each in joined for loop in each.loops]
    findings = _face_findings(face, diagonal)
    findings += [_in_space(finding, face) for each in joined for finding in each.findings]
    areas = np.array([loop.signed_area for loop in loops])
    wide = np.flatnonzero(np.abs(areas) > _NO_AREA * diagonal**2).tolist()
    if len(wide) < len(loops):
        findings.append(_finding("loop-flat", Severity.LOST, f"{len(loops) - len(wide)} loops bound nothing", face))
    gaps = [gap for each in joined for gap in each.gaps]
    nested = _nested([loops[i] for i in wide], areas[wide], Origin(face=face.number, plane=face.plane))
    profiles = tuple(replace(profile, gap=max(gaps, default=0.0)) for profile in nested)
    if not profiles:
        text = "the outline of a planar face does not close"
        findings.append(_finding("entity-face-open", Severity.LOST, text, face))
    return _Reading(face, profiles, tuple(findings), tuple(gap / diagonal for gap in gaps))


def _joined(wire: FlatWire, diagonal: float, gap_rel: float) -> _Joined:
    """Close a wire in the kernel's order; where that leaves a gap, the edges find their own order."""
    edges = [part for flat in wire.edges for part in _parts(flat.edge) if _extent(part) > _POINT * diagonal]
    if not edges:
        return _Joined((), (), ())
    if _is_chain(edges, gap_rel * diagonal):
        closed = closed_loop(edges)
        return _Joined((closed.loop,), tuple(closed.gaps.tolist()), ())
    chained = chain([Strand(edge, i, "", "") for i, edge in enumerate(edges)], gap_rel)
    return _Joined(tuple(each.loop for each in chained.loops), (), chained.findings)


def _is_chain(edges: Sequence[Edge], tolerance: float) -> bool:
    """Whether each edge starts where the one before ends, and none of several is closed in itself."""
    gaps = [np.hypot(*(edge.start - before.end)) for before, edge in zip([edges[-1], *edges], edges, strict=False)]
    return max(gaps) <= tolerance and (len(edges) == 1 or not any(edge.is_closed for edge in edges))


def _nested(loops: Sequence[Loop], areas: Floats, origin: Origin) -> tuple[Profile, ...]:
    """Make profiles of a face's loops: mostly one, as the largest loop runs left around the others, which run right."""
    if not loops:
        return ()
    outer = int(np.argmax(np.abs(areas)))
    holes = [loop for i, loop in enumerate(loops) if i != outer]
    if areas[outer] > 0 and np.count_nonzero(areas > 0) == 1:
        return (Profile(loops[outer], tuple(holes), origin),)
    return tuple(Profile.of(loops[one.outer], [loops[i] for i in one.holes], origin) for one in nest(loops))


def _parts(edge: Edge) -> Sequence[Edge]:
    """Cut a spline at its kinks, and make what is straight or round a line or arc, as readers of drawings do."""
    if isinstance(edge, BSpline):
        return spline_edges(edge.degree, edge.knots, edge.poles, edge.weights)
    return (edge,)


def _extent(edge: Edge) -> float:
    return float(np.ptp(edge.bounds(), axis=0).max())


def _diagonal(face: PlanarFace) -> float:
    boxes = [flat.edge.bounds() for wire in face.wires for flat in wire.edges]
    if not boxes:
        return 0.0
    low, high = np.min([box[0] for box in boxes], axis=0), np.max([box[1] for box in boxes], axis=0)
    return float(np.hypot(*(high - low)))


def _face_findings(face: PlanarFace, diagonal: float) -> list[Finding]:
    findings = []
    edges = [flat for wire in face.wires for flat in wire.edges]
    if face.is_flat_spline:
        text = "a flat face that is not stored as a plane"
        findings.append(_finding("entity-flat-spline", Severity.INFO, text, face))
    slits = sum(wire.slits for wire in face.wires)
    if slits:
        text = f"{slits} edges with the face on both sides left out"
        findings.append(_finding("entity-slit", Severity.REPAIRED, text, face, slits))
    bent = [flat for flat in edges if flat.is_approximation or flat.error > _EXACT * diagonal]
    if bent:
        text = f"{len(bent)} curves without exact form approximated to {max(flat.error for flat in bent):.1g} mm"
        findings.append(_finding("entity-approximated", Severity.REPAIRED, text, face, len(bent)))
    height = max((flat.height for flat in edges), default=0.0)
    if height > _WORTH_A_LOOK * diagonal:
        text = f"edges leave the face's plane by up to {height:.2g} mm and were projected onto it"
        findings.append(_finding("entity-not-flat", Severity.REPAIRED, text, face))
    return findings


def _gap_findings(readings: Sequence[_Reading]) -> list[Finding]:
    """Report in one sum the gaps that are wider than rounding."""
    gaps = [(gap, reading.face) for reading in readings for gap in reading.gaps if gap > _ROUNDED_GAP]
    if not gaps:
        return []
    widest, face = max(gaps, key=lambda pair: pair[0])
    text = f"{len(gaps)} gaps between edges bridged, the widest {widest:.1e} of its face's diagonal"
    return [_finding("chain-gap", Severity.REPAIRED, text, face, len(gaps))]


def _findings_of_shape(found: PlanarFaces) -> list[Finding]:
    findings = [
        Finding("entity-face-broken", Severity.LOST, f"a face cannot be read: {each.reason}", f"face {each.number}")
        for each in found.broken
    ]
    if found.curved:
        text, entity = f"{len(found.curved)} curved faces have no profile", f"face {found.curved[0]}"
        findings.append(Finding("entity-curved-face", Severity.INFO, text, entity, count=len(found.curved)))
    if found.loose_edges:
        text = f"{found.loose_edges} edges belong to no face"
        findings.append(Finding("entity-loose-edge", Severity.LOST, text, count=found.loose_edges))
    return findings


def _name(face: PlanarFace) -> str:
    return f"face {face.number}"


def _finding(code: str, severity: Severity, text: str, face: PlanarFace, count: int = 1) -> Finding:
    return Finding(code, severity, text, _name(face), face.plane.origin, count)


def _in_space(finding: Finding, face: PlanarFace) -> Finding:
    """Carry a finding on a face's loops from its plane into the file's frame."""
    if finding.place is None:
        return replace(finding, entity=_name(face))
    return replace(finding, entity=_name(face), place=tuple(_space_point(face.plane, finding.place).tolist()))


def _space_point(plane: Plane, place: Sequence[float]) -> Floats:
    x_axis, normal = np.array(plane.x_axis), np.array(plane.normal)
    return np.array(plane.origin) + place[0] * x_axis + place[1] * np.cross(normal, x_axis)


def _scaled_origin(origin: Origin, scale: float) -> Origin:
    if origin.plane is None:
        return origin
    x, y, z = origin.plane.origin
    return replace(origin, plane=replace(origin.plane, origin=(scale * x, scale * y, scale * z)))
