"""What is known of one part file, as plain values: `Sidecar` and what it is made of.

These values are what `docs/sidecar.md` describes, field by field; `mashape_cad.library.sidecar` keeps them on disk.
They hold no arrays and need neither kernel nor numpy, so that a scanned library is listed and drawn at once.
Lengths are millimetres, areas square millimetres; a profile's coordinates are those of its own plane.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from mashape_cad.findings import Finding
from mashape_cad.options import PartOptions
from mashape_cad.version import __version__

__all__ = [
    "CURRENT_SHAPE",
    "CURRENT_SIGNATURE",
    "GENERATOR",
    "AxisRecord",
    "Failure",
    "OriginRecord",
    "PlaneRecord",
    "ProfileRecord",
    "Refusal",
    "Sidecar",
    "SignatureName",
    "Source",
    "Thumbnail",
    "UnitRecord",
]

Vector3 = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Source:
    """The part file that a sidecar was made from.

    Attributes
    ----------
    name : str
        File name without folder, so that part and sidecar move together.
    size : int
        Bytes.
    mtime_ns : int
        Time of the last change, nanoseconds since 1970.
    blake2b : str or None
        Hash of the content, 64 hexadecimal digits; None if the file could not be opened.
    """

    name: str
    size: int
    mtime_ns: int
    blake2b: str | None


@dataclass(frozen=True, slots=True)
class UnitRecord:
    """The unit of the file's numbers.

    Attributes
    ----------
    name : str
        Such as ``mm`` or ``in``.
    millimetres : float
        What one unit is worth.
    decided_by : str
        ``option``, ``insunits``, ``measurement``, ``file`` or ``default``.
    """

    name: str
    millimetres: float
    decided_by: str


@dataclass(frozen=True, slots=True)
class SignatureName:
    """Kind and version of the signatures; only equal ones can be compared."""

    name: str
    version: int


GENERATOR = f"mashape-cad {__version__}"
# Stated here and not asked of the signatures themselves, because that loads numpy: a test holds them together.
CURRENT_SIGNATURE = SignatureName("paper", 1)
CURRENT_SHAPE = SignatureName("default", 1)


@dataclass(frozen=True, slots=True)
class PlaneRecord:
    """Where a planar face lies in its part: a right-handed frame."""

    origin: Vector3
    x_axis: Vector3
    normal: Vector3


@dataclass(frozen=True, slots=True)
class OriginRecord:
    """Where in its file a profile comes from: layer and handles (DXF), or face number and plane (STEP, BREP)."""

    layer: str | None = None
    handles: tuple[str, ...] = ()
    face: int | None = None
    plane: PlaneRecord | None = None


@dataclass(frozen=True, slots=True)
class AxisRecord:
    """Counts and certificate of a medial axis, as `mashape_cad.medial.certificate.Certificate` describes them.

    The last five are None where they were not found out: all of them in sidecars of earlier releases,
    `completeness_error` also by `scan`, and `reason` where nothing stands against the axis.
    """

    max_radius: float
    branches: int
    junctions: int
    ends: int
    cycles: int
    connected: bool
    max_disc_error: float
    max_foot_error: float
    ok: bool
    euler_ok: bool | None = None
    counting_ok: bool | None = None
    area_error: float | None = None
    completeness_error: float | None = None
    reason: str | None = None


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a profile has no medial axis.

    Attributes
    ----------
    code : str
        ``profile-invalid`` or ``axis-refused``, as the finding that says so.
    text : str
        One sentence.
    place : tuple of float or None
        Where, in the profile's coordinates, mm.
    kind : str or None
        What is wrong with an invalid profile: see `mashape_cad.errors.InvalidProfileError`.
    """

    code: str
    text: str
    place: tuple[float, float] | None = None
    kind: str | None = None


@dataclass(frozen=True, slots=True)
class Thumbnail:
    """Light picture of a profile and its medial axis: integers on a grid of 1/5000 of the larger side.

    A grid point (i, j) lies at ``corner + pitch * (i, j)``, a radius k is ``pitch * k``, all in mm.

    Attributes
    ----------
    corner : tuple of float
        Lower left corner of the bounding box, mm.
    pitch : float
        One step of the grid, mm.
    loops : tuple of tuple of int
        Outer loop first, then the holes; each x, y, x, y, ..., closed, the first point not repeated.
    branches : tuple of tuple of int
        From node to node, each x, y, r, x, y, r, ...; a disc's axis is one point. Empty if the axis was refused.
    """

    corner: tuple[float, float]
    pitch: float
    loops: tuple[tuple[int, ...], ...]
    branches: tuple[tuple[int, ...], ...] = ()


@dataclass(frozen=True, slots=True)
class ProfileRecord:
    """All that is kept of one profile.

    Attributes
    ----------
    origin : OriginRecord
    bounds : tuple of float
        xmin, ymin, xmax, ymax, mm.
    area, perimeter : float
        mm2 and mm, holes considered.
    edges, holes : int
    thumbnail : Thumbnail
    axis : AxisRecord or None
        None if the axis was refused.
    vectors : mapping of str to tuple of float, or None
        Paper mode's vectors by name; None if the axis was refused.
    refused : Refusal or None
    shape : tuple of int or None
        The default signature, 256 whole numbers from -127 to 127; None if the axis was refused.
    """

    origin: OriginRecord
    bounds: tuple[float, float, float, float]
    area: float
    perimeter: float
    edges: int
    holes: int
    thumbnail: Thumbnail
    axis: AxisRecord | None = None
    vectors: Mapping[str, tuple[float, ...]] | None = None
    refused: Refusal | None = None
    shape: tuple[int, ...] | None = None

    @property
    def compared(self) -> Mapping[str, tuple[float, ...]]:
        """All that it is compared by: paper mode's vectors, and ``shape``; nothing if the axis was refused."""
        return {**(self.vectors or {}), **({"shape": self.shape} if self.shape else {})}

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the bounding box, mm."""
        xmin, ymin, xmax, ymax = self.bounds
        return xmax - xmin, ymax - ymin


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a file gave nothing.

    Attributes
    ----------
    kind : str
        ``unreadable``, ``no-profile``, ``timeout``, ``crash`` (its worker died) or ``internal`` (a fault of ours).
    text : str
        One line with the remedy.
    """

    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class Sidecar:
    """All that is known of one part file.

    Attributes
    ----------
    generator : str
        Program and version that made it; on record only, it does not decide freshness.
    signature : SignatureName
        Of paper mode.
    source : Source
    options : PartOptions
        What shaped the result.
    unit : UnitRecord or None
        None if the file could not be read.
    findings : tuple of Finding
    failure : Failure or None
    profiles : tuple of ProfileRecord
        In the order of the file's reader: the one that `search` uses by default comes first.
    shape_signature : SignatureName or None
        Of the default signature; None in sidecars of before there was one.
    """

    generator: str
    signature: SignatureName
    source: Source
    options: PartOptions
    unit: UnitRecord | None = None
    findings: tuple[Finding, ...] = ()
    failure: Failure | None = None
    profiles: tuple[ProfileRecord, ...] = ()
    shape_signature: SignatureName | None = None

    @classmethod
    def failed(cls, source: Source, options: PartOptions, failure: Failure) -> "Sidecar":
        """Return the sidecar of a file that gave nothing at all."""
        return cls(GENERATOR, CURRENT_SIGNATURE, source, options, failure=failure, shape_signature=CURRENT_SHAPE)
