"""What takes no part in a drawing's profiles, counted by kind: one finding each, with the first handle and place."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from ezdxf.entities.dxfentity import DXFEntity

from mashape_cad.findings import Finding, Severity

__all__ = ["Tally", "why_ignored"]

_ANNOTATION = frozenset(
    (
        *("ACAD_TABLE", "ATTDEF", "ATTRIB", "LEADER", "MLEADER", "MTEXT", "MULTILEADER", "RTEXT", "TEXT", "TOLERANCE"),
        *("ARC_DIMENSION", "DIMENSION", "LARGE_RADIAL_DIMENSION"),
        *("ARCALIGNEDTEXT", "IMAGE", "OLE2FRAME", "OLEFRAME", "PDFUNDERLAY", "DWFUNDERLAY", "DGNUNDERLAY", "WIPEOUT"),
        *("ACAD_PROXY_ENTITY", "LIGHT", "SECTION", "VIEWPORT"),
    )
)
_FILLING = frozenset(("HATCH", "MPOLYGON", "SOLID", "TRACE"))
_SPATIAL = frozenset(
    (
        *("3DFACE", "3DSOLID", "BODY", "HELIX", "MESH", "REGION", "SURFACE"),
        *("EXTRUDEDSURFACE", "LOFTEDSURFACE", "PLANESURFACE", "REVOLVEDSURFACE", "SWEPTSURFACE"),
    )
)
_WHY = (
    (_ANNOTATION, "entity-annotation", "no outline"),
    (
        _FILLING,
        "entity-filling",
        "fills an area; only drawn curves are read, so explode it to its outline if that is missing",
    ),
    (_SPATIAL, "entity-3d", "a body in space; save it as STEP, or project it to a flat drawing"),
    (frozenset(("RAY", "XLINE")), "entity-unbounded", "a construction line without end"),
    (frozenset(("POINT",)), "entity-point", "a point bounds nothing"),
)

# Attributes that say where an entity is, by preference.
_PLACES = ("insert", "center", "start", "location", "defpoint", "vtx0")


def why_ignored(kind: str) -> tuple[str, str]:
    """Return code and reason for a kind of entity that bounds no profile."""
    for kinds, code, reason in _WHY:
        if kind in kinds:
            return code, reason
    return "entity-unsupported", "not a kind of curve that is read; explode it in a CAD program"


@dataclass(slots=True)
class _Row:
    severity: Severity
    entity: str
    place: tuple[float, ...] | None
    count: int = 0


@dataclass(slots=True)
class Tally:
    """Counts of entities by code, kind and reason.

    Parameters
    ----------
    scale : float
        Millimetres of one drawing unit.
    """

    scale: float
    rows: dict[tuple[str, str, str], _Row] = field(default_factory=dict)

    def add(
        self,
        entity: DXFEntity,
        code: str,
        reason: str,
        *,
        handle: str | None = None,
        severity: Severity = Severity.LOST,
        count: int = 1,
    ) -> None:
        """Count an entity."""
        key = code, entity.dxftype(), reason
        if key not in self.rows:
            self.rows[key] = _Row(severity, handle or str(entity.dxf.handle), self._place(entity))
        self.rows[key].count += count

    def findings(self) -> list[Finding]:
        """Return one finding for each kind and reason, in the order in which they were met."""
        return [
            Finding(code, row.severity, f"{row.count} {kind}: {reason}", row.entity, row.place, row.count)
            for (code, kind, reason), row in self.rows.items()
        ]

    def _place(self, entity: Any) -> tuple[float, ...] | None:
        for name in _PLACES:
            if entity.dxf.is_supported(name) and entity.dxf.hasattr(name):
                place = np.array(entity.dxf.get(name), float)[:2] * self.scale
                return tuple(place.tolist()) if np.all(np.isfinite(place)) else None
        return None
