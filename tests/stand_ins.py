"""Hand-made sidecars, and what stands in for the real derivation in worker processes: by the file's name, it fails."""

import os
import signal
import time
from pathlib import Path

from mashape_cad.errors import KernelUnavailableError
from mashape_cad.evaluation.trial import Seconds, Trial
from mashape_cad.findings import Finding, Severity
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
    Source,
    Thumbnail,
    UnitRecord,
)
from mashape_cad.library.sidecar import sidecar_path, write_sidecar
from mashape_cad.options import PartOptions

SQUARE = Thumbnail((0.0, 0.0), 0.002, ((0, 0, 5000, 0, 5000, 5000, 0, 5000),), ((0, 0, 0, 2500, 2500, 2500),))
AXIS = AxisRecord(5.0, 4, 1, 4, 0, connected=True, max_disc_error=1e-15, max_foot_error=0.0, ok=True)
REFUSED = Refusal("profile-invalid", "the outline crosses itself; redraw it", (1.0, 2.0), "crossing")


def histogram(*filled: int) -> tuple[float, ...]:
    """64 bins, those named holding equal shares."""
    return tuple(filled.count(bin_) / len(filled) for bin_ in range(64))


def shape(*filled: int) -> tuple[int, ...]:
    """256 numbers, four for each bin: those named hold equal shares, the sum of squares is about 400 squared."""
    number = min(round(200 / len(filled) ** 0.5), 127)
    return tuple(number if entry // 4 in filled else 0 for entry in range(256))


def profile_record(*filled: int, refused: Refusal | None = None) -> ProfileRecord:
    """A square of 10 mm whose three histograms and default signature have the named bins filled."""
    return ProfileRecord(
        origin=OriginRecord("outline", ("1F", "20")),
        bounds=(0.0, 0.0, 10.0, 10.0),
        area=100.0,
        perimeter=40.0,
        edges=4,
        holes=0,
        thumbnail=SQUARE,
        axis=None if refused else AXIS,
        vectors=None if refused else {name: histogram(*filled) for name in ("df", "rf", "cf")},
        refused=refused,
        shape=None if refused else shape(*filled),
    )


def sidecar(source: Source, *profiles: ProfileRecord, options: PartOptions | None = None) -> Sidecar:
    """A sidecar of these profiles, with a finding."""
    return Sidecar(
        generator=GENERATOR,
        signature=CURRENT_SIGNATURE,
        source=source,
        options=options or PartOptions(),
        unit=UnitRecord("mm", 1.0, "insunits"),
        findings=(Finding("chain-open", Severity.LOST, "an end of Länge 3 is open", "2A", (1.5, -2.0)),),
        profiles=profiles,
        shape_signature=CURRENT_SHAPE,
    )


def face_record() -> ProfileRecord:
    """A refused face of a STEP file."""
    plane = PlaneRecord((0.0, 0.0, 5.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    record = profile_record(0, refused=REFUSED)
    return ProfileRecord(
        OriginRecord(face=3, plane=plane), record.bounds, 100.0, 40.0, 4, 1, record.thumbnail, refused=REFUSED
    )


def put_part(path: Path, *profiles: ProfileRecord, options: PartOptions | None = None) -> Path:
    """Write a part file and the sidecar that a scan would have given it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"content of " + os.fsencode(path.name))
    write_sidecar(sidecar_path(path), sidecar(source_of(path), *profiles, options=options))
    return path


def derive(path: Path, options: PartOptions) -> Sidecar:
    """Do what the file's name says."""
    word = path.stem.partition("-")[0]
    if word == "die":
        os._exit(7)
    if word == "segfault":
        os.kill(os.getpid(), signal.SIGSEGV)
    if word == "sleep":
        time.sleep(100)
    if word == "bug":
        raise ZeroDivisionError("division by zero")
    if word == "kernel":
        raise KernelUnavailableError("no kernel; install it")
    if word == "print":
        os.write(1, b"a library prints")
    if word == "unreadable":
        return Sidecar.failed(source_of(path), options, Failure("unreadable", "not a DXF file; export it again"))
    return sidecar(source_of(path), profile_record(3), options=options)


def warm_up() -> None:
    """Nothing to do."""


def slow_warm_up() -> None:
    """Longer than the time limits of the tests."""
    time.sleep(1.5)


def deadly_warm_up() -> None:
    """A machine on which workers cannot even start."""
    os._exit(9)


def tried(path: Path, blake2b: str, profile: int, options: PartOptions) -> Trial:
    """Stand in for a trial: times of round numbers, histograms by the length of the name."""
    if path.stem.startswith("bug"):
        raise ZeroDivisionError("division by zero")
    bin_ = len(path.stem)
    vectors = {name: histogram(bin_, bin_ + 1) for name in ("df", "rf", "cf")} | {"shape": shape(bin_, bin_ + 1)}
    return Trial(
        blake2b, profile, CURRENT_SIGNATURE, CURRENT_SHAPE, options, Seconds(4.0, 2.0, 1.0, 0.5, 0.25), vectors
    )
