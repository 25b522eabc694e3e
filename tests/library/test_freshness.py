"""Whether what a sidecar says still holds."""

import os
from dataclasses import replace
from pathlib import Path

import pytest
import stand_ins

from mashape_cad.errors import UnreadableFileError
from mashape_cad.library.freshness import Status, freshness, source_of
from mashape_cad.library.record import Failure, Sidecar, SignatureName
from mashape_cad.library.sidecar import UnknownVersionError, encode, read_sidecar, sidecar_path, write_sidecar
from mashape_cad.options import PartOptions, ReadOptions, SignatureOptions


@pytest.fixture
def part(tmp_path):
    """A part with a fresh sidecar."""
    return stand_ins.put_part(tmp_path / "part.dxf", stand_ins.profile_record(1))


def _rewrite(part, **changes):
    path = sidecar_path(part)
    write_sidecar(path, replace(read_sidecar(path), **changes))


def _touch(part, seconds=10):
    status = part.stat()
    os.utime(part, ns=(status.st_atime_ns, status.st_mtime_ns + seconds * 10**9))


def test_without_sidecar_it_is_new(tmp_path):
    """A part that was never scanned."""
    (tmp_path / "part.dxf").write_text("0")
    assert freshness(tmp_path / "part.dxf", PartOptions()).status is Status.NEW


def test_scanned_it_is_unchanged_and_known(part):
    """Nothing has happened since the scan."""
    fresh = freshness(part, PartOptions())
    assert (fresh.status, fresh.is_moved) == (Status.UNCHANGED, False)
    assert fresh.sidecar == read_sidecar(sidecar_path(part))


def test_unchanged_is_not_even_opened(part, monkeypatch):
    """Same size and time: the content is not read, which is what makes a second scan fast."""

    def refuse(*_):
        pytest.fail("the part was opened")

    monkeypatch.setattr("mashape_cad.library.freshness._hash", refuse)
    assert freshness(part, PartOptions()).status is Status.UNCHANGED


def test_touched_only_it_is_unchanged(part):
    """Another time, the same content: a copy or a checkout. What is on record can be brought up to date."""
    _touch(part)
    fresh = freshness(part, PartOptions())
    assert (fresh.status, fresh.is_moved) == (Status.UNCHANGED, True)
    assert fresh.sidecar.source == source_of(part)


def test_renamed_with_its_sidecar_it_is_unchanged(part):
    """A part that moved together with its sidecar is not computed again."""
    sidecar_path(part).rename(part.parent / "other.dxf.mashape.json")
    other = part.rename(part.parent / "other.dxf")
    fresh = freshness(other, PartOptions())
    assert (fresh.status, fresh.is_moved) == (Status.UNCHANGED, True)
    assert fresh.sidecar.source.name == "other.dxf"


@pytest.mark.parametrize("content", ["another length", "CONTENT OF PART.DXF"])
def test_other_content_is_changed(part, content):
    """Other bytes, also if there are as many as before."""
    part.write_text(content)
    _touch(part)
    assert freshness(part, PartOptions()).status is Status.CHANGED


@pytest.mark.parametrize(
    "options",
    [
        PartOptions(ReadOptions(unit="in")),
        PartOptions(ReadOptions(gap_rel=1e-5)),
        PartOptions(signature=SignatureOptions(per_edge=50)),
    ],
)
def test_other_options_are_changed(part, options):
    """What shaped the sidecar is not what is asked for now."""
    assert freshness(part, options).status is Status.CHANGED


@pytest.mark.parametrize("signature", [SignatureName("paper", 2), SignatureName("other", 1)])
def test_other_signature_is_changed(part, signature):
    """Numbers of another signature cannot be compared."""
    _rewrite(part, signature=signature)
    assert freshness(part, PartOptions()).status is Status.CHANGED


def test_other_release_is_unchanged(part):
    """The program's version alone does not make anything old: signature and format have versions of their own."""
    _rewrite(part, generator="mashape-cad 99.0")
    assert freshness(part, PartOptions()).status is Status.UNCHANGED


def test_failed_it_is_unchanged(part):
    """A file that failed is not tried at every scan."""
    write_sidecar(sidecar_path(part), Sidecar.failed(source_of(part), PartOptions(), Failure("timeout", "too long")))
    fresh = freshness(part, PartOptions())
    assert fresh.status is Status.UNCHANGED
    assert fresh.sidecar.failure.kind == "timeout"


def test_failed_for_permission_it_is_tried_when_it_can_be_opened(part):
    """A changed permission changes neither size nor time."""
    source = replace(source_of(part), blake2b=None)
    write_sidecar(sidecar_path(part), Sidecar.failed(source, PartOptions(), Failure("unreadable", "not allowed")))
    assert freshness(part, PartOptions()).status is Status.CHANGED


def test_failed_for_permission_it_is_unchanged_while_it_cannot(part, monkeypatch):
    """As long as it still cannot be opened, nothing is new."""
    monkeypatch.setattr("mashape_cad.library.freshness._hash", lambda _: None)
    write_sidecar(
        sidecar_path(part), Sidecar.failed(source_of(part), PartOptions(), Failure("unreadable", "not allowed"))
    )
    assert freshness(part, PartOptions()).status is Status.UNCHANGED


@pytest.mark.parametrize("content", [b"", b"{}", b"not json"])
def test_broken_sidecar_is_changed(part, content):
    """It is made anew."""
    sidecar_path(part).write_bytes(content)
    assert freshness(part, PartOptions()).status is Status.CHANGED


def test_sidecar_of_an_older_format_is_changed(part):
    """It is made anew in this release's format."""
    path = sidecar_path(part)
    path.write_bytes(path.read_bytes().replace(b'"version": 1', b'"version": 0', 1))
    assert freshness(part, PartOptions()).status is Status.CHANGED


def test_sidecar_of_a_newer_format_is_not_ours(part):
    """Two releases that share a folder must not overwrite each other for ever."""
    path = sidecar_path(part)
    path.write_bytes(path.read_bytes().replace(b'"version": 1', b'"version": 2', 1))
    with pytest.raises(UnknownVersionError, match="version 2, this release knows version 1"):
        freshness(part, PartOptions())


def test_part_that_is_gone(part):
    """A sidecar without its part says nothing."""
    part.unlink()
    with pytest.raises(UnreadableFileError, match="No such file"):
        freshness(part, PartOptions())


def test_source_has_size_and_hash(tmp_path):
    """The hash is of the content alone."""
    for name in ("a.dxf", "b.dxf"):
        Path(tmp_path / name).write_bytes(b"same")
    first, second = source_of(tmp_path / "a.dxf"), source_of(tmp_path / "b.dxf")
    assert first.blake2b == second.blake2b
    assert (first.name, first.size, len(first.blake2b)) == ("a.dxf", 4, 64)
    assert encode(stand_ins.sidecar(first))
