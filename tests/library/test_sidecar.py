"""One sidecar on disk."""

import json
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
import stand_ins

from mashape_cad.errors import SidecarError
from mashape_cad.library import sidecar as module
from mashape_cad.library.record import Failure, Sidecar, Source
from mashape_cad.library.sidecar import (
    UnknownVersionError,
    decode,
    encode,
    read_sidecar,
    sidecar_path,
    write_sidecar,
)
from mashape_cad.options import PartOptions

SOURCE = Source("Träger [2].dxf", 1234, 1_700_000_000_123_456_789, "ab" * 32)
WHOLE = stand_ins.sidecar(SOURCE, stand_ins.profile_record(1, 2, 3), stand_ins.face_record())
FAILED = Sidecar.failed(SOURCE, PartOptions(), Failure("unreadable", "not a DXF file; export it again"))


def test_lies_beside_the_part_and_is_named_after_it():
    """part.dxf has part.dxf.mashape.json, whatever dots its name has."""
    assert sidecar_path(Path("a b/v1.2.part.dxf")) == Path("a b/v1.2.part.dxf.mashape.json")


@pytest.mark.parametrize("value", [WHOLE, FAILED])
def test_round_trip(tmp_path, value):
    """What is written is what is read."""
    write_sidecar(tmp_path / "x.mashape.json", value)
    assert read_sidecar(tmp_path / "x.mashape.json") == value


def test_same_value_same_bytes():
    """Reading and writing again changes no byte."""
    assert encode(decode(encode(WHOLE))) == encode(WHOLE)


def test_is_readable_json_in_utf8_with_unix_line_ends():
    """A list of numbers stands on one line, umlauts stand for themselves, the last line ends too."""
    text = encode(WHOLE).decode("utf-8")
    assert json.loads(text)["profiles"][0]["area"] == 100.0
    assert "Träger [2].dxf" in text
    assert "\r" not in text
    assert text.endswith("}\n")
    [line] = [each for each in text.splitlines() if '"df"' in each]
    assert len(json.loads("{" + line.strip().rstrip(",") + "}")["df"]) == 64


def test_a_change_is_a_small_diff():
    """Another number in one vector touches that vector's line only."""
    other = replace(WHOLE, profiles=(stand_ins.profile_record(1, 2, 4), *WHOLE.profiles[1:]))
    lines = zip(encode(WHOLE).splitlines(), encode(other).splitlines(), strict=True)
    assert sum(before != after for before, after in lines) == 4


def test_starts_with_format_and_version():
    """Whoever opens one sees first what it is."""
    assert list(json.loads(encode(WHOLE)))[:3] == ["format", "version", "generator"]


def test_other_version_is_refused_and_both_are_named():
    """A sidecar of the future is not guessed at."""
    future = encode(WHOLE).replace(b'"version": 1', b'"version": 7', 1)
    with pytest.raises(UnknownVersionError, match="version 7, this release knows version 1; install a newer") as caught:
        decode(future)
    assert caught.value.is_newer


def test_older_version_asks_for_a_scan():
    """A sidecar of the past is made anew."""
    with pytest.raises(UnknownVersionError, match="scan again") as caught:
        decode(encode(WHOLE).replace(b'"version": 1', b'"version": 0', 1))
    assert not caught.value.is_newer


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"[]",
        b"null",
        b'{"format": "other"}',
        encode(WHOLE)[:-500],
        b"\xff\xfe{}",
        encode(WHOLE).replace(b"100.0", b'"x"'),
    ],
)
def test_anything_else_is_refused_in_one_line(content):
    """Broken, empty, cut or foreign files are no sidecars, and the message says what to do."""
    with pytest.raises(SidecarError, match="delete it and scan again") as caught:
        decode(content, label="part.dxf.mashape.json")
    assert str(caught.value).startswith("part.dxf.mashape.json: ")
    assert "\n" not in str(caught.value)


def test_fields_that_are_not_known_are_passed_over():
    """A later release may add fields within the version."""
    assert decode(encode(WHOLE).replace(b'"generator"', b'"later": [1], "generator"', 1)) == WHOLE


def test_stray_bytes_in_a_text_become_question_marks():
    """A layer's name in another encoding does not cost the sidecar."""
    layer = replace(WHOLE.profiles[0].origin, layer="L\udce4nge")
    value = replace(WHOLE, profiles=(replace(WHOLE.profiles[0], origin=layer),))
    assert decode(encode(value)).profiles[0].origin.layer == "L\ufffdnge"


def test_missing_options_have_their_defaults():
    """An option that came later has its default in older sidecars, so that they stay fresh."""
    content = encode(WHOLE).replace(b',"gap_rel":0.0001', b"", 1)
    assert content != encode(WHOLE)
    assert decode(content).options == PartOptions()


def test_is_replaced_whole_or_not_at_all(tmp_path, monkeypatch):
    """When writing breaks off, the old one is still there and nothing else is."""
    path = tmp_path / "x.mashape.json"
    write_sidecar(path, WHOLE)

    def break_off(self, target):
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", break_off)
    with pytest.raises(KeyboardInterrupt):
        write_sidecar(path, FAILED)
    assert read_sidecar(path) == WHOLE
    assert list(tmp_path.iterdir()) == [path]


def test_a_name_as_long_as_a_folder_allows(tmp_path):
    """The temporary name does not make the longest possible name too long."""
    path = tmp_path / ("x" * (255 - len(module.SUFFIX)) + module.SUFFIX)
    write_sidecar(path, WHOLE)
    assert read_sidecar(path) == WHOLE


def test_folder_that_is_not_there_is_one_clear_line(tmp_path):
    """What cannot be written is said with path and remedy."""
    with pytest.raises(SidecarError, match=r"cannot write .*gone.*; make the folder writable and scan again"):
        write_sidecar(tmp_path / "gone" / "x.mashape.json", WHOLE)


def test_schema_in_the_package_is_up_to_date():
    """The schema that is shipped is the one that the values have: write `schema()` to it after a change."""
    shipped = Path(module.__file__).with_name("sidecar.schema.json").read_text(encoding="utf-8")
    assert json.loads(shipped) == json.loads(json.dumps(module.schema()))


def test_schema_knows_every_field():
    """Each field of a sidecar is in the schema, and no required one is missing from a sidecar."""
    described, written = module.schema(), msgspec.json.decode(encode(WHOLE))
    assert list(described["properties"]) == list(written)
    assert set(described["required"]) <= set(written)
    profile = described["$defs"]["ProfileRecord"]
    assert list(profile["properties"]) == list(written["profiles"][0])


def test_documentation_names_every_field():
    """docs/sidecar.md describes each field of the format."""
    page = (Path(__file__).parents[2] / "docs" / "sidecar.md").read_text(encoding="utf-8")
    definitions = [module.schema(), *module.schema()["$defs"].values()]
    fields = {name for each in definitions for name in each.get("properties", {})}
    assert [name for name in sorted(fields) if f"`{name}`" not in page] == []
