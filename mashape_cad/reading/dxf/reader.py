"""One DXF drawing to profiles: load, unfold, chain, nest."""

from collections.abc import Sequence
from pathlib import Path

from ezdxf.document import Drawing

from mashape_cad.findings import Finding, Severity
from mashape_cad.geometry.chain import ChainedLoop, chain
from mashape_cad.geometry.nesting import Nested, looks_like_frame, nest
from mashape_cad.geometry.profile import Origin, Profile
from mashape_cad.options import ReadOptions
from mashape_cad.reading.dxf.document import listening, load_document, message_findings
from mashape_cad.reading.dxf.unfolding import unfold
from mashape_cad.reading.dxf.unit import drawing_unit, unit_finding
from mashape_cad.reading.part import Part

__all__ = ["read_dxf"]


def read_dxf(path: Path, options: ReadOptions) -> Part:
    """Read a DXF drawing.

    Raises
    ------
    UnreadableFileError
        If it is no DXF file, is cut off, or its structure is beyond repair.
    OSError
        If it cannot be opened.
    """
    with listening() as messages:
        document = load_document(path)
        unit = drawing_unit(document.drawing, options.unit)
        unfolded = unfold(document.drawing, unit.millimetres)
        chained = chain(unfolded.strands, options.gap_rel)
        profiles, frame_findings = _profiles(chained.loops)
    findings = (
        *document.findings,
        unit_finding(unit),
        *unfolded.findings,
        *_layout_findings(document.drawing),
        *chained.findings,
        *frame_findings,
        *message_findings(messages),
    )
    return Part(path, "dxf", unit, tuple(profiles), findings)


def _profiles(chained: Sequence[ChainedLoop]) -> tuple[list[Profile], list[Finding]]:
    loops = [one.loop for one in chained]
    nested = nest(loops)
    profiles = [
        Profile.of(loops[one.outer], [loops[hole] for hole in one.holes], _origin(chained, one), _gap(chained, one))
        for one in nested
    ]
    return sorted(profiles, key=lambda profile: -profile.area), _frame_findings(
        chained, looks_like_frame(loops, nested)
    )


def _origin(chained: Sequence[ChainedLoop], nested: Nested) -> Origin:
    members = [chained[number] for number in (nested.outer, *nested.holes)]
    handles = dict.fromkeys(handle for member in members for handle in member.handles)
    return Origin(layer=chained[nested.outer].layers[0], handles=tuple(handles))


def _gap(chained: Sequence[ChainedLoop], nested: Nested) -> float:
    return max(chained[number].gap for number in (nested.outer, *nested.holes))


def _frame_findings(chained: Sequence[ChainedLoop], frame: Nested | None) -> list[Finding]:
    if frame is None:
        return []
    outer = chained[frame.outer]
    text = (
        f"a rectangle lies around nearly everything: if it is the frame of a sheet, its {len(frame.holes)} holes are "
        "parts and their holes are not; hide its layer"
    )
    place = tuple(outer.loop.edges[0].start.tolist())
    return [Finding("profile-frame", Severity.INFO, text, outer.handles[0], place)]


def _layout_findings(drawing: Drawing) -> list[Finding]:
    """Report what lies outside model space, and a model space without anything."""
    findings = []
    count = sum(len(layout) for layout in drawing.layouts if layout.name != "Model")
    if count:
        text = f"{count} entities of paper space are not read; only model space is"
        findings.append(Finding("entity-paper-space", Severity.INFO, text, count=count))
    if len(drawing.modelspace()) == 0:
        findings.append(Finding("file-empty", Severity.LOST, "nothing is drawn in model space"))
    return findings
