"""What a part file holds once it is read: `Part`, and the `Unit` that its coordinates were in."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from mashape_cad.findings import Finding
from mashape_cad.geometry.profile import Profile

__all__ = ["Part", "Unit"]

# What the unit names of `ReadOptions` are worth.
_MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8, "um": 1e-3}

Decider = Literal["option", "insunits", "measurement", "file", "default"]


@dataclass(frozen=True, slots=True)
class Unit:
    """The length unit of a file's coordinates, and who decided it.

    Attributes
    ----------
    name : str
        Short name: ``mm``, ``in``, ``m``...
    millimetres : float
        Length of one unit, mm.
    decided_by : str
        ``option`` (the user said so), ``insunits`` or ``measurement`` (variables of a DXF header), ``file`` (the file
        states its unit beyond doubt), ``default`` (nobody said anything).
    """

    name: str
    millimetres: float
    decided_by: Decider

    @classmethod
    def named(cls, name: str, decided_by: Decider) -> "Unit":
        """Return a unit by one of the names that `ReadOptions.unit` allows."""
        return cls(name, _MILLIMETRES[name], decided_by)


@dataclass(frozen=True, slots=True)
class Part:
    """Everything that was read from one part file or kernel object.

    Attributes
    ----------
    path : Path or None
        The file; None for an object.
    format : str
        ``dxf``, ``step``, ``brep`` or ``object``.
    unit : Unit
        The unit that was converted to mm.
    profiles : tuple of Profile
        In mm, the most telling one first; may be empty, then `findings` say why.
    findings : tuple of Finding
        What took no part in any profile, was repaired or was decided.
    """

    path: Path | None
    format: Literal["dxf", "step", "brep", "object"]
    unit: Unit
    profiles: tuple[Profile, ...]
    findings: tuple[Finding, ...]
