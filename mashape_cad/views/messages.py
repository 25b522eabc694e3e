"""JSON lines for other programs: one object a line, each with `message_type`, the summary last.

Fields are only ever added. Paths are as they were given, numbers in mm and mm2 where the name says no other.
"""

from pathlib import Path
from typing import Any

import msgspec

from mashape_cad.library.json_text import valid_text
from mashape_cad.library.match import Match
from mashape_cad.library.record import ProfileRecord
from mashape_cad.matching.portion import Portion
from mashape_cad.scanning import FileScanned, ScanSummary

__all__ = [
    "certificate_message",
    "certify_summary",
    "file_message",
    "match_message",
    "message",
    "readable",
    "scan_summary",
    "search_summary",
]


def readable(path: Path) -> str:
    """Return a path as valid text; a file name need not be valid UTF-8 on every system."""
    return valid_text(str(path))


def message(message_type: str, **fields: Any) -> str:
    """Return the line of a message of any kind."""
    return msgspec.json.encode({"message_type": message_type, **fields}).decode()


def file_message(event: FileScanned, **more: Any) -> str:
    """Return the line of one scanned file; here and below `more` are fields that only the caller knows."""
    sidecar = event.sidecar
    return message(
        "file",
        **more,
        path=readable(event.path),
        status=event.status,
        profiles=len(sidecar.profiles) if sidecar else 0,
        findings=sidecar.findings if sidecar else (),
        refused=sum(record.refused is not None for record in sidecar.profiles) if sidecar else 0,
        failure=event.failure,
    )


def scan_summary(summary: ScanSummary, **more: Any) -> str:
    """Return the last line of a scan."""
    return message("summary", **more, **msgspec.to_builtins(summary))


def match_message(match: Match, **more: Any) -> str:
    """Return the line of one match; `relation` is null unless the hit was compared with the query (mode same)."""
    return message(
        "match",
        **more,
        rank=match.rank,
        path=readable(match.path),
        profile=match.profile,
        distance=match.distance,
        score=match.score,
        size_mm=match.record.size,
        relation=match.relation and match.relation.kind,
        **(_comparison(match) if match.relation or match.unverified else {}),
        **({"portion": _portion(match.portion)} if match.portion else {}),
    )


def _portion(portion: Portion) -> dict[str, Any]:
    """Return how much of the query a hit contains (mode part), and how the query lies on the hit there."""
    (a, b), (c, d) = portion.placement.matrix.tolist()
    return {
        "share": portion.share,
        "scale": portion.placement.scale,
        "mirrored": portion.placement.mirrors,
        "placement": (a, b, c, d, *portion.placement.offset.tolist()),
    }


def _comparison(match: Match) -> dict[str, Any]:
    """Return the numbers that justify a relation; they are null if the hit could not be compared."""
    found = match.relation
    return {
        "scale": found and found.scale,
        "mirrored": found and found.is_mirrored,
        "hint": found and found.hint,
        "deviation_mm": found and found.deviation_mm,
        "area_difference": found and found.area_difference,
        "common": found and found.common,
        "tolerance_mm": found and found.tolerance_mm,
        "placement": found and found.placement,
        "unverified": match.unverified and valid_text(match.unverified),
    }


def search_summary(
    query: Path | None, profile: int | None, matches: int, parts: int, seconds: float, **more: Any
) -> str:
    """Return the last line of a search: which profile of the query it was, how many parts took part.

    `query` is null if it did not come from a file.
    """
    label = None if query is None else readable(query)
    counts = {"matches": matches, "parts": parts, "seconds": seconds}
    return message("summary", **more, query=label, profile=profile, **counts)


def certificate_message(path: Path, profile: int, record: ProfileRecord) -> str:
    """Return the line of one profile; `reason` says why it is not ok; without an axis the figures are null."""
    axis, refused = record.axis, record.refused
    return message(
        "certificate",
        path=readable(path),
        profile=profile,
        edges=record.edges,
        holes=record.holes,
        area_mm2=record.area,
        perimeter_mm=record.perimeter,
        max_radius_mm=axis and axis.max_radius,
        branches=axis and axis.branches,
        junctions=axis and axis.junctions,
        ends=axis and axis.ends,
        cycles=axis and axis.cycles,
        connected=axis is not None and axis.connected,
        max_disc_error=axis and axis.max_disc_error,
        max_foot_error=axis and axis.max_foot_error,
        ok=axis is not None and axis.ok,
        certified=axis is not None and axis.ok,
        euler_ok=axis and axis.euler_ok,
        counting_ok=axis and axis.counting_ok,
        area_error=axis and axis.area_error,
        completeness_error=axis and axis.completeness_error,
        reason=refused.text if refused else _doubt(record),
        refused=refused,
    )


def certify_summary(path: Path, profiles: int, ok: int, seconds: float) -> str:
    """Return the last line of a certification."""
    return message("summary", path=readable(path), profiles=profiles, ok=ok, seconds=seconds)


def _doubt(record: ProfileRecord) -> str | None:
    axis = record.axis
    if axis is None or axis.ok:
        return None
    if axis.reason:
        return axis.reason
    if not axis.connected:
        return "the axis is not connected"
    if axis.cycles != record.holes:
        return f"the axis has {axis.cycles} cycles around {record.holes} holes"
    return "the errors are too large, or junctions and ends do not agree in number"
