"""From a part file to what is known of it: read, medial axis, certificate, signature, record.

Importing this module loads the kernel; whoever works from sidecars imports it only for a part that has none.
"""

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from mashape_cad.errors import (
    AxisError,
    InvalidProfileError,
    KernelUnavailableError,
    NoProfileError,
    UnreadableFileError,
)
from mashape_cad.findings import Finding, Severity
from mashape_cad.geometry.edge import Arc, BSpline, Floats, Line
from mashape_cad.geometry.profile import Loop, Origin, Profile
from mashape_cad.library.freshness import source_of
from mashape_cad.library.record import (
    CURRENT_SHAPE,
    CURRENT_SIGNATURE,
    GENERATOR,
    AxisRecord,
    Failure,
    OriginRecord,
    PlaneRecord,
    ProfileRecord,
    Refusal,
    Sidecar,
    Thumbnail,
    UnitRecord,
)
from mashape_cad.library.thumbnail import exact_bounds, thumbnail
from mashape_cad.medial.axis import MedialAxis, medial_axis
from mashape_cad.medial.branch import sampled_branches
from mashape_cad.medial.certificate import certificate
from mashape_cad.options import PartOptions, ReadOptions, SignatureOptions
from mashape_cad.reading.part import Part
from mashape_cad.reading.reader import read
from mashape_cad.signatures import paper
from mashape_cad.signatures.shape import shape_signature

__all__ = ["derive", "profile_record", "profile_records", "read_part", "records_of", "refusal", "warm_up"]

# Spacing of the axis' points before they are thinned for the thumbnail, as a fraction of the larger side: on a branch
# that bends with a twentieth of the size as radius, the chord is off by 1/4000.
_THUMBNAIL_STEP = 0.01


def derive(path: Path, options: PartOptions | None = None) -> Sidecar:
    """Return all that can be known of one part file.

    A profile whose axis is refused stays in the list with the reason; a file that cannot be read, or has no profile,
    gives a sidecar with a `failure`.

    Parameters
    ----------
    path : Path
    options : PartOptions, optional

    Raises
    ------
    KernelUnavailableError
        If the geometry kernel cannot be imported: no fault of this file.
    UnreadableFileError
        If there is no such file.
    """
    options = options or PartOptions()
    source = source_of(path)
    try:
        part = read(path, options.read)
    except UnreadableFileError as error:
        return Sidecar.failed(source, options, Failure("unreadable", _without_folder(str(error), path)))
    records = tuple(profile_records(part, options.signature))
    return Sidecar(
        generator=GENERATOR,
        signature=CURRENT_SIGNATURE,
        source=source,
        options=options,
        unit=UnitRecord(part.unit.name, part.unit.millimetres, part.unit.decided_by),
        findings=part.findings + tuple(_refusals(records)),
        failure=None if records else _no_profile(part),
        profiles=records,
        shape_signature=CURRENT_SHAPE,
    )


def read_part(path: Path, options: ReadOptions) -> Part:
    """Read a part file that has at least one profile.

    Raises
    ------
    UnreadableFileError
        If it cannot be read.
    NoProfileError
        If it has none; the message counts what was met instead.
    """
    part = read(path, options)
    if not part.profiles:
        raise NoProfileError(f"{path}: {_no_profile(part).text}")
    return part


def records_of(thing: Any, options: PartOptions) -> tuple[ProfileRecord, ...]:
    """Return what is known of a `Profile`, or of the profiles of a kernel object or one that wraps such.

    Raises
    ------
    UnreadableFileError
        If it is nothing of the kind.
    """
    profiles = (thing,) if isinstance(thing, Profile) else read(thing, options.read).profiles
    return tuple(profile_record(profile, options.signature) for profile in profiles)


def profile_records(part: Part, options: SignatureOptions, stations: int = 0) -> Iterator[ProfileRecord]:
    """Yield what is known of each profile of a part, in order, as soon as it is computed; see `profile_record`."""
    return (profile_record(profile, options, stations) for profile in part.profiles)


def profile_record(profile: Profile, options: SignatureOptions, stations: int = 0) -> ProfileRecord:
    """Return what is known of one profile; if its axis is refused, the record says why.

    Parameters
    ----------
    profile : Profile
    options : SignatureOptions
    stations : int
        Places of each span at which the axis is held against its definition; 0 leaves out `completeness_error`.

    Raises
    ------
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    try:
        bounds = _sound(exact_bounds(profile.outer), profile)
    except (InvalidProfileError, FloatingPointError) as error:
        return _without_extent(profile, error)
    try:
        axis = medial_axis(profile)
        certified, vectors, numbers = _certified(axis, stations), _vectors(axis, options), _numbers(axis)
        branches = _branches(axis, float((bounds[1] - bounds[0]).max()))
    except KernelUnavailableError:
        raise
    except Exception as error:  # noqa: BLE001  (a fault of ours in one profile must not cost the others)
        return _record(profile, bounds, thumbnail(profile, bounds), refused=refusal(error))
    picture = thumbnail(profile, bounds, branches)
    return _record(profile, bounds, picture, axis=certified, vectors=vectors, shape=numbers)


def refusal(error: Exception) -> Refusal:
    """Return what is put on record of an error that ended one profile."""
    text = " ".join(str(error).split())
    if isinstance(error, InvalidProfileError):
        return Refusal("profile-invalid", text, error.place, error.kind)
    if isinstance(error, AxisError):
        return Refusal("axis-refused", text, error.place)
    return Refusal("axis-refused", f"a fault of this program ({type(error).__name__}: {text})", kind="internal")


def warm_up() -> None:
    """Load what is heavy and compute one small axis, so that the first file does not pay for it.

    It has a line, an arc, a spline, a reflex vertex and a hole: all that makes compiled code differ.
    """
    corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (1.0, 1.0)]
    lines = [Line.of(start, end) for start, end in pairwise(corners)]
    side = BSpline.of(3, [0.0] * 4 + [1.0] * 4, [corners[-1], (0.4, 1.2), (-0.2, 0.5), corners[0]])
    hole = Loop((Arc.of((1.8, 0.6), 0.2),))
    profile_record(Profile.of(Loop((*lines, side)), [hole]), SignatureOptions())


def _sound(bounds: Floats, profile: Profile) -> Floats:
    """Return the bounds of a profile whose numbers can be kept.

    Raises
    ------
    InvalidProfileError
        If it is too large for numbers to hold, or has no extent.
    """
    extent = float((bounds[1] - bounds[0]).max())
    if not (math.isfinite(extent) and math.isfinite(profile.area) and math.isfinite(profile.perimeter)):
        raise InvalidProfileError("degenerate", "the profile is larger than numbers can hold; check the file's unit")
    if extent <= 0:
        raise InvalidProfileError("degenerate", "the profile has no extent; delete it in the drawing")
    return bounds


def _record(profile: Profile, bounds: Floats, thumbnail: Thumbnail, **more: Any) -> ProfileRecord:
    (xmin, ymin), (xmax, ymax) = bounds.tolist()
    return ProfileRecord(
        origin=_origin(profile.origin),
        bounds=(xmin, ymin, xmax, ymax),
        area=float(profile.area),
        perimeter=float(profile.perimeter),
        edges=len(profile.edges),
        holes=len(profile.holes),
        thumbnail=thumbnail,
        **more,
    )


def _without_extent(profile: Profile, error: Exception) -> ProfileRecord:
    """Return a record that says no more than that there is a profile, and why it is not known."""
    return ProfileRecord(
        origin=_origin(profile.origin),
        bounds=(0.0, 0.0, 0.0, 0.0),
        area=0.0,
        perimeter=0.0,
        edges=len(profile.edges),
        holes=len(profile.holes),
        thumbnail=Thumbnail((0.0, 0.0), 1.0, ()),
        refused=refusal(error),
    )


def _origin(origin: Origin) -> OriginRecord:
    plane = origin.plane
    kept = PlaneRecord(plane.origin, plane.x_axis, plane.normal) if plane else None
    return OriginRecord(origin.layer, origin.handles, origin.face, kept)


def _certified(axis: MedialAxis, stations: int) -> AxisRecord:
    found = certificate(axis, stations)
    return AxisRecord(
        max_radius=float(found.max_radius_mm),
        branches=int(found.branches),
        junctions=int(found.junctions),
        ends=int(found.ends),
        cycles=int(found.cycles),
        connected=bool(found.connected),
        max_disc_error=float(found.max_disc_error),
        max_foot_error=float(found.max_foot_error),
        ok=bool(found.ok),
        euler_ok=bool(found.euler_ok),
        counting_ok=bool(found.counting_ok),
        area_error=_finite(found.area_error),
        completeness_error=_finite(found.completeness_error),
        reason=found.reason or None,
    )


def _finite(error: float | None) -> float | None:
    """Leave out what no number was found for: sidecars hold finite numbers only."""
    return float(error) if error is not None and math.isfinite(error) else None


def _vectors(axis: MedialAxis, options: SignatureOptions) -> Mapping[str, tuple[float, ...]]:
    vectors = paper.signature(axis, per_edge=options.per_edge).vectors
    return {name: tuple(vector.tolist()) for name, vector in vectors.items()}


def _numbers(axis: MedialAxis) -> tuple[int, ...]:
    return tuple(int(number) for number in shape_signature(axis).vectors["shape"])


def _branches(axis: MedialAxis, size: float) -> list[Floats]:
    if not axis.branches:  # a disc: its axis is one point
        return [np.column_stack([axis.nodes.centre, axis.nodes.radius])]
    samples = sampled_branches(axis, size * _THUMBNAIL_STEP)
    return [np.column_stack([each.centre, each.radius]) for each in samples]


def _refusals(records: tuple[ProfileRecord, ...]) -> Iterator[Finding]:
    for number, record in enumerate(records):
        if record.refused is not None:
            entity = None if record.origin.face is None else f"face {record.origin.face}"
            text = f"profile {number} has no medial axis: {record.refused.text}"
            place = _in_file(record.refused.place, record.origin.plane)
            yield Finding(record.refused.code, Severity.LOST, text, entity, place)


def _in_file(place: tuple[float, float] | None, plane: PlaneRecord | None) -> tuple[float, ...] | None:
    """Return a place of a profile in the frame of its file."""
    if place is None or plane is None:
        return place
    (ax, ay, az), (nx, ny, nz) = plane.x_axis, plane.normal
    y_axis = (ny * az - nz * ay, nz * ax - nx * az, nx * ay - ny * ax)
    frame = zip(plane.origin, plane.x_axis, y_axis, strict=True)
    return tuple(origin + place[0] * along + place[1] * across for origin, along, across in frame)


def _without_folder(text: str, path: Path) -> str:
    """Leave out where the file lies: a sidecar's bytes do not depend on it, and whoever shows it names the file."""
    return text.replace(str(path), path.name).removeprefix(f"{path.name}: ")


def _no_profile(part: Part) -> Failure:
    counts = Counter[str]()
    for finding in part.findings:
        if finding.severity is Severity.LOST:
            counts[finding.code] += finding.count
    met = ", ".join(f"{code} {count}" for code, count in sorted(counts.items())) or "nothing at all"
    if part.format == "dxf":
        return Failure("no-profile", f"no closed outline in it (met: {met}); close it in the drawing and save again")
    return Failure("no-profile", f"no planar face in it (met: {met}); only planar faces can be compared")
