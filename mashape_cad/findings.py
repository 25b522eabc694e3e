"""What a reader met on its way: `Finding` and its codes.

A finding never stops a part. Codes are grouped by the first letter of their subject and only ever added:
``file-*`` the file as a whole, ``unit-*`` its unit, ``entity-*`` one entity or face, ``chain-*`` joining edges into
loops, ``loop-*`` closed loops, ``profile-*`` what became (or did not become) a profile, ``axis-*`` its medial axis.
"""

from dataclasses import dataclass
from enum import StrEnum

__all__ = ["Finding", "Severity"]


class Severity(StrEnum):
    """How much a finding matters to somebody who trusts the result."""

    INFO = "info"  # on record, nothing lost: the unit that was assumed
    REPAIRED = "repaired"  # geometry was changed within a stated tolerance: a gap bridged
    LOST = "lost"  # geometry that takes no part in any profile: an open chain, a text


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that a reader met.

    Attributes
    ----------
    code : str
        Stable, kebab-case, e.g. ``chain-open``.
    severity : Severity
        See `Severity`.
    text : str
        One sentence for a person, with the remedy where there is one.
    entity : str or None
        DXF handle, or ``face N`` (1-based) of a STEP or BREP file.
    place : tuple of float or None
        Coordinates in the file's frame, mm.
    count : int
        How many like it the finding stands for.
    """

    code: str
    severity: Severity
    text: str
    entity: str | None = None
    place: tuple[float, ...] | None = None
    count: int = 1
