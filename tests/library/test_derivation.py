"""From a part file to what is known of it."""

import shutil
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from mashape_cad.errors import (
    AxisError,
    InvalidProfileError,
    KernelUnavailableError,
    NoProfileError,
    UnreadableFileError,
)
from mashape_cad.findings import Finding, Severity
from mashape_cad.geometry.edge import Arc, Line
from mashape_cad.geometry.profile import Loop, Origin, Plane, Profile
from mashape_cad.library import derivation
from mashape_cad.library.derivation import derive, profile_record, read_part, records_of, warm_up
from mashape_cad.library.record import CURRENT_SIGNATURE
from mashape_cad.library.sidecar import decode, encode
from mashape_cad.medial.axis import medial_axis
from mashape_cad.options import PartOptions, ReadOptions, SignatureOptions
from mashape_cad.reading.part import Part, Unit
from mashape_cad.signatures.paper import signature


def _rectangle(width, height, x=0.0, y=0.0, origin=None):
    corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
    lines = tuple(Line.of(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True))
    return Profile.of(Loop(lines), origin=origin)


def _drawing(path, *polylines, texts=0, unit=4):
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = unit
    for points in polylines:
        document.modelspace().add_lwpolyline(points, close=True)
    for _ in range(texts):
        document.modelspace().add_text("hello")
    document.saveas(path)
    return path


RECTANGLE = [(0, 0), (40, 0), (40, 20), (0, 20)]
BOWTIE = [(100, 0), (110, 10), (110, 0), (100, 10)]


@pytest.fixture
def stand_in(monkeypatch):
    """Let the reader give these profiles, and one finding."""

    def stand_in(*profiles):
        finding = Finding("entity-text", Severity.LOST, "a text is no outline", count=3)
        part = Part(Path("x.step"), "step", Unit("mm", 1.0, "file"), profiles, (finding,))
        monkeypatch.setattr(derivation, "read", lambda *_: part)

    return stand_in


def test_a_drawing(tmp_path):
    """All that the format promises is there."""
    sidecar = derive(_drawing(tmp_path / "plate.dxf", RECTANGLE))
    assert (sidecar.source.name, sidecar.failure, sidecar.signature) == ("plate.dxf", None, CURRENT_SIGNATURE)
    assert (sidecar.unit.name, sidecar.unit.decided_by) == ("mm", "insunits")
    [record] = sidecar.profiles
    assert record.bounds == (0.0, 0.0, 40.0, 20.0)
    assert (record.edges, record.holes, record.refused) == (4, 0, None)
    assert (record.area, record.perimeter) == pytest.approx((800.0, 120.0))
    assert (record.axis.branches, record.axis.junctions, record.axis.ends, record.axis.ok) == (5, 2, 4, True)
    assert record.axis.max_radius == pytest.approx(10.0)
    assert {name: len(vector) for name, vector in record.vectors.items()} == {"df": 64, "rf": 64, "cf": 64}
    assert record.thumbnail.loops == ((0, 0, 5000, 0, 5000, 2500, 0, 2500),)
    assert len(record.thumbnail.branches) == 5


def test_survives_the_disk(tmp_path):
    """No number is lost or changed by writing it down."""
    sidecar = derive(_drawing(tmp_path / "plate.dxf", RECTANGLE))
    assert decode(encode(sidecar)) == sidecar


def test_same_file_same_bytes_wherever_it_lies(tmp_path):
    """Neither folder nor time of the scan leave a trace; that goes for failures too."""
    (tmp_path / "copy").mkdir()
    (tmp_path / "prose.dxf").write_text("this is not a drawing", encoding="utf-8")
    _drawing(tmp_path / "plate.dxf", RECTANGLE)
    for name in ("plate.dxf", "prose.dxf"):
        shutil.copy2(tmp_path / name, tmp_path / "copy" / name)
        assert encode(derive(tmp_path / name)) == encode(derive(tmp_path / "copy" / name))


def test_options_arrive(tmp_path):
    """The unit shapes the profile, the stations the histograms; both are on record."""
    options = PartOptions(ReadOptions(unit="in"), SignatureOptions(per_edge=10))
    path = _drawing(tmp_path / "plate.dxf", RECTANGLE)
    sidecar = derive(path, options)
    assert sidecar.options == options
    assert sidecar.profiles[0].bounds == pytest.approx((0.0, 0.0, 1016.0, 508.0))
    assert sidecar.profiles[0].vectors != derive(path).profiles[0].vectors


def test_a_refused_profile_does_not_cost_the_others(tmp_path):
    """It stays in the list with the reason, and a finding says so."""
    sidecar = derive(_drawing(tmp_path / "two.dxf", RECTANGLE, BOWTIE))
    refused = [record for record in sidecar.profiles if record.refused]
    if refused:  # a reader may set it aside already
        assert (refused[0].axis, refused[0].vectors) == (None, None)
        assert refused[0].refused.code == "profile-invalid"
        assert "profile-invalid" in {finding.code for finding in sidecar.findings}
    assert any(record.vectors for record in sidecar.profiles)
    assert sidecar.failure is None


def test_refusals_say_where(stand_in, monkeypatch, tmp_path):
    """In the profile's coordinates on the profile, in the file's on the finding."""

    def refuse(_):
        raise InvalidProfileError("crossing", "it crosses\nitself", (1.0, 2.0))

    plane = Plane((10.0, 20.0, 30.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    stand_in(_rectangle(4, 4, origin=Origin(face=7, plane=plane)))
    monkeypatch.setattr(derivation, "medial_axis", refuse)
    (tmp_path / "x.step").write_text("x")
    sidecar = derive(tmp_path / "x.step")
    refused = sidecar.profiles[0].refused
    assert (refused.code, refused.kind, refused.text) == ("profile-invalid", "crossing", "it crosses itself")
    assert refused.place == (1.0, 2.0)
    finding = sidecar.findings[-1]
    assert (finding.code, finding.severity, finding.entity) == ("profile-invalid", Severity.LOST, "face 7")
    assert finding.place == (8.0, 21.0, 30.0)


@pytest.mark.parametrize(
    ("error", "code", "kind"),
    [
        (AxisError("no junction found; please report it", (0.0, 0.0)), "axis-refused", None),
        (ZeroDivisionError("by zero"), "axis-refused", "internal"),
        (np.linalg.LinAlgError("singular"), "axis-refused", "internal"),
    ],
)
def test_a_fault_in_one_profile_does_not_cost_the_others(stand_in, monkeypatch, tmp_path, error, code, kind):
    """Whatever goes wrong in one axis, the next profile is computed."""
    wide, high = _rectangle(40, 20), _rectangle(4, 20)

    def axis(profile):
        if profile is wide:
            raise error
        return medial_axis(profile)

    stand_in(wide, high)
    monkeypatch.setattr(derivation, "medial_axis", axis)
    (tmp_path / "x.step").write_text("x")
    first, second = derive(tmp_path / "x.step").profiles
    assert (first.refused.code, first.refused.kind) == (code, kind)
    assert first.thumbnail.loops
    assert second.axis.ok


def test_a_missing_kernel_is_no_refusal(stand_in, monkeypatch, tmp_path):
    """It would be on record as the file's fault."""

    def axis(_):
        raise KernelUnavailableError("no kernel")

    stand_in(_rectangle(4, 4))
    monkeypatch.setattr(derivation, "medial_axis", axis)
    (tmp_path / "x.step").write_text("x")
    with pytest.raises(KernelUnavailableError):
        derive(tmp_path / "x.step")


@pytest.mark.parametrize("size", [1e308, 0.0])
def test_numbers_that_cannot_be_kept(size):
    """A profile beyond all numbers, or without any extent, is refused, and what is kept is finite."""
    with np.errstate(all="ignore"):
        record = profile_record(_rectangle(size, size), SignatureOptions())
    assert record.refused.kind == "degenerate"
    assert np.isfinite([*record.bounds, record.area, record.perimeter]).all()


def test_no_profile_counts_what_was_met_instead(stand_in, tmp_path):
    """The file failed, its findings are kept, and the message says what was in it."""
    stand_in()
    (tmp_path / "x.step").write_text("x")
    sidecar = derive(tmp_path / "x.step")
    assert sidecar.failure.kind == "no-profile"
    assert "(met: entity-text 3)" in sidecar.failure.text
    assert sidecar.findings[0].code == "entity-text"
    with pytest.raises(NoProfileError, match=r"x\.step: no planar face in it.*entity-text 3"):
        read_part(tmp_path / "x.step", ReadOptions())


def test_text_only(tmp_path):
    """A drawing with nothing to cut."""
    failure = derive(_drawing(tmp_path / "text.dxf", texts=2)).failure
    assert failure.kind == "no-profile"
    assert failure.text.startswith("no closed outline in it (met: ")


@pytest.mark.parametrize(
    ("name", "content"), [("prose.dxf", b"hello"), ("empty.dxf", b""), ("cut.step", b"ISO-10303-21;")]
)
def test_unreadable(tmp_path, name, content):
    """One line that does not repeat the file's name, and no folder in it."""
    (tmp_path / name).write_bytes(content)
    failure = derive(tmp_path / name).failure
    assert failure.kind == "unreadable"
    assert str(tmp_path) not in failure.text
    assert not failure.text.startswith(name)
    assert "\n" not in failure.text


def test_missing_file(tmp_path):
    """There is nothing to put a sidecar beside."""
    with pytest.raises(UnreadableFileError, match="No such file"):
        derive(tmp_path / "gone.dxf")


def test_a_disc_is_drawn_with_its_one_point():
    """Its axis has no branches."""
    record = profile_record(Profile.of(Loop((Arc.of([5, 5], 5.0),))), SignatureOptions())
    assert record.thumbnail.branches == ((2500, 2500, 2500),)
    assert record.axis.ok


def test_records_of_a_profile():
    """A profile needs no file."""
    profile = _rectangle(40, 20)
    assert records_of(profile, PartOptions()) == (profile_record(profile, SignatureOptions()),)


def test_signature_on_record_is_the_one_that_is_computed():
    """Name and version are stated twice, so that a fresh library is told without loading numpy."""
    computed = signature(medial_axis(_rectangle(4, 2)))
    assert (computed.name, computed.version) == (CURRENT_SIGNATURE.name, CURRENT_SIGNATURE.version)


def test_warming_up_works():
    """It computes an axis; an error in it would be passed over in silence."""
    warm_up()


def test_record_does_not_depend_on_where_the_profile_came_from():
    """The origin is on record and changes nothing else."""
    plain, named = (profile_record(_rectangle(4, 2, origin=each), SignatureOptions()) for each in (None, Origin("cut")))
    assert named.origin.layer == "cut"
    assert replace(named, origin=plain.origin) == plain
