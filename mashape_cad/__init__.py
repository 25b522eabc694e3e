"""Finds parts of similar shape, from the exact medial axes of their profiles.

Names are loaded on first use, so that a program that only looks into sidecars never loads the geometry kernel.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from mashape_cad.version import __version__

if TYPE_CHECKING:
    from mashape_cad.errors import (
        AxisError,
        InvalidProfileError,
        KernelUnavailableError,
        LibraryError,
        MashapeError,
        NoProfileError,
        QueryError,
        SidecarError,
        UnreadableFileError,
    )
    from mashape_cad.findings import Finding, Severity
    from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Line, Similarity
    from mashape_cad.geometry.profile import Loop, Origin, Plane, Profile
    from mashape_cad.library.library import Library
    from mashape_cad.library.match import Match
    from mashape_cad.library.record import ProfileRecord, Sidecar
    from mashape_cad.library.sidecar import read_sidecar, sidecar_path
    from mashape_cad.matching.relation import Relation
    from mashape_cad.medial.axis import MedialAxis, medial_axis
    from mashape_cad.medial.branch_curve import BranchDiscs, discs_on_branch
    from mashape_cad.medial.certificate import Certificate, certificate
    from mashape_cad.medial.pruning import PrunedAxis, simplify
    from mashape_cad.options import PartOptions, ReadOptions, ScanOptions, SearchOptions, SignatureOptions
    from mashape_cad.reading.part import Part, Unit
    from mashape_cad.reading.reader import read
    from mashape_cad.scanning import scan
    from mashape_cad.signatures.paper import signature
    from mashape_cad.signatures.shape import shape_signature
    from mashape_cad.signatures.vectors import Signature

__all__ = [
    "Arc",
    "AxisError",
    "BSpline",
    "BranchDiscs",
    "Certificate",
    "Edge",
    "EllipseArc",
    "Finding",
    "InvalidProfileError",
    "KernelUnavailableError",
    "Library",
    "LibraryError",
    "Line",
    "Loop",
    "MashapeError",
    "Match",
    "MedialAxis",
    "NoProfileError",
    "Origin",
    "Part",
    "PartOptions",
    "Plane",
    "Profile",
    "ProfileRecord",
    "PrunedAxis",
    "QueryError",
    "ReadOptions",
    "Relation",
    "ScanOptions",
    "SearchOptions",
    "Severity",
    "Sidecar",
    "SidecarError",
    "Signature",
    "SignatureOptions",
    "Similarity",
    "Unit",
    "UnreadableFileError",
    "__version__",
    "certificate",
    "discs_on_branch",
    "medial_axis",
    "read",
    "read_sidecar",
    "scan",
    "shape_signature",
    "sidecar_path",
    "signature",
    "simplify",
]

# Where each name is found at run time; the imports above say the same to type checkers.
_PLACES = {
    "errors": (
        "AxisError",
        "InvalidProfileError",
        "KernelUnavailableError",
        "LibraryError",
        "MashapeError",
        "NoProfileError",
        "QueryError",
        "SidecarError",
        "UnreadableFileError",
    ),
    "findings": ("Finding", "Severity"),
    "geometry.edge": ("Arc", "BSpline", "Edge", "EllipseArc", "Line", "Similarity"),
    "geometry.profile": ("Loop", "Origin", "Plane", "Profile"),
    "library.library": ("Library",),
    "library.match": ("Match",),
    "library.record": ("ProfileRecord", "Sidecar"),
    "library.sidecar": ("read_sidecar", "sidecar_path"),
    "medial.axis": ("MedialAxis", "medial_axis"),
    "medial.branch_curve": ("BranchDiscs", "discs_on_branch"),
    "medial.certificate": ("Certificate", "certificate"),
    "medial.pruning": ("PrunedAxis", "simplify"),
    "matching.relation": ("Relation",),
    "options": ("PartOptions", "ReadOptions", "ScanOptions", "SearchOptions", "SignatureOptions"),
    "reading.part": ("Part", "Unit"),
    "reading.reader": ("read",),
    "scanning": ("scan",),
    "signatures.paper": ("signature",),
    "signatures.shape": ("shape_signature",),
    "signatures.vectors": ("Signature",),
}
_PLACE_OF = {name: place for place, names in _PLACES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _PLACE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_PLACE_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
