"""The unit of a drawing: what the user says, else what the header says, else millimetres."""

from ezdxf.document import Drawing

from mashape_cad.findings import Finding, Severity
from mashape_cad.reading.part import Unit

__all__ = ["drawing_unit", "unit_finding"]

# $INSUNITS of the DXF reference; 0 means that nothing is said. The astronomical ones (18 to 20) are left out.
_INSUNITS = {
    1: ("in", 25.4),
    2: ("ft", 304.8),
    3: ("mi", 1609344.0),
    4: ("mm", 1.0),
    5: ("cm", 10.0),
    6: ("m", 1000.0),
    7: ("km", 1e6),
    8: ("uin", 25.4e-6),
    9: ("mil", 25.4e-3),
    10: ("yd", 914.4),
    11: ("angstrom", 1e-7),
    12: ("nm", 1e-6),
    13: ("um", 1e-3),
    14: ("dm", 100.0),
    15: ("dam", 1e4),
    16: ("hm", 1e5),
    17: ("Gm", 1e12),
    21: ("US survey ft", 1200e3 / 3937),
    22: ("US survey in", 100e3 / 3937),
    23: ("US survey yd", 3600e3 / 3937),
    24: ("US survey mi", 6336e6 / 3937),
}
# $MEASUREMENT: 0 English, 1 metric.
_MEASUREMENT = {0: "in", 1: "mm"}

_REASON = {
    "option": "as the option says",
    "insunits": "as the header's $INSUNITS says",
    "measurement": "guessed from the header's $MEASUREMENT; the option for the unit overrules it",
    "default": "assumed, as the file does not say; the option for the unit overrules it",
}


def drawing_unit(document: Drawing, name: str | None) -> Unit:
    """Decide the unit of a drawing.

    Parameters
    ----------
    document : ezdxf.document.Drawing
    name : str or None
        What the user says.
    """
    if name is not None:
        return Unit.named(name, "option")
    # Asked of the variables as they were read: `document.header` knows defaults for those that are not there.
    header = document.header.hdrvars
    insunits = _INSUNITS.get(header["$INSUNITS"].value) if "$INSUNITS" in header else None
    if insunits is not None:
        return Unit(*insunits, "insunits")
    measurement = _MEASUREMENT.get(header["$MEASUREMENT"].value) if "$MEASUREMENT" in header else None
    if measurement is not None:
        return Unit.named(measurement, "measurement")
    return Unit.named("mm", "default")


def unit_finding(unit: Unit) -> Finding:
    """Put on record what was decided."""
    return Finding("unit-decided", Severity.INFO, f"1 drawing unit = 1 {unit.name}, {_REASON[unit.decided_by]}")
