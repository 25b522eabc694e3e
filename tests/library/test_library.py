"""Folders of sidecars, searchable."""

import os
import sys
from dataclasses import replace

import pytest
import stand_ins
from stand_ins import REFUSED, profile_record, put_part

from mashape_cad.errors import LibraryError, NoProfileError, QueryError, UnreadableFileError
from mashape_cad.library import library as module
from mashape_cad.library.freshness import source_of
from mashape_cad.library.library import Library
from mashape_cad.library.record import Failure, OriginRecord, Sidecar
from mashape_cad.library.sidecar import sidecar_path, write_sidecar
from mashape_cad.options import PartOptions, ReadOptions, SearchOptions


@pytest.fixture
def folder(tmp_path):
    """Parts a to d: b is nearest to a, then c, then d."""
    put_part(tmp_path / "a.dxf", profile_record(0, 1, 2, 3))
    put_part(tmp_path / "b.dxf", profile_record(0, 1, 2, 4))
    put_part(tmp_path / "sub" / "c.step", profile_record(0, 1, 5, 6))
    put_part(tmp_path / "d.dxf", profile_record(7, 8, 9, 10))
    return tmp_path


def _names(matches):
    return [match.path.name for match in matches]


def _fail(path, kind, text):
    path.write_text("0")
    write_sidecar(sidecar_path(path), Sidecar.failed(source_of(path), PartOptions(), Failure(kind, text)))
    return path


def test_ranks_by_distance_and_the_query_comes_first(folder):
    """Search with a part gives itself at rank 1 with distance 0, then the nearest."""
    matches = Library(folder).search(folder / "a.dxf")
    assert _names(matches) == ["a.dxf", "b.dxf", "c.step", "d.dxf"]
    assert [match.rank for match in matches] == [1, 2, 3, 4]
    assert matches[0].distance == 0.0
    assert sorted(match.distance for match in matches) == [match.distance for match in matches]
    assert matches[1].record == profile_record(0, 1, 2, 4)


def test_gives_at_most_k(folder):
    """The number counts the query's own file as well."""
    assert _names(Library(folder).search(folder / "a.dxf", k=2)) == ["a.dxf", "b.dxf"]
    with pytest.raises(ValueError, match="k must be at least 1"):
        Library(folder).search(folder / "a.dxf", k=0)


def test_equal_distances_put_the_query_first_then_names(folder):
    """Copies of a part are at distance 0 too; the one that was asked with still comes first."""
    for name in ("0.dxf", "z.dxf", "m.dxf"):
        put_part(folder / name, profile_record(0, 1, 2, 3))
    assert _names(Library(folder).search(str(folder / "m.dxf"), k=4)) == ["m.dxf", "0.dxf", "a.dxf", "z.dxf"]


def test_one_match_for_each_file_by_its_nearest_profile(folder):
    """A sheet with many parts does not fill the list."""
    put_part(folder / "many.dxf", profile_record(20), profile_record(0, 1, 2, 3), profile_record(0, 1, 2, 4))
    matches = Library(folder).search(folder / "b.dxf")
    assert sorted(_names(matches)) == ["a.dxf", "b.dxf", "c.step", "d.dxf", "many.dxf"]
    assert next(match.profile for match in matches if match.path.name == "many.dxf") == 2


def _as_faces(*records):
    return [replace(record, origin=OriginRecord(face=number)) for number, record in enumerate(records, start=1)]


def test_a_solid_is_compared_by_its_first_face(folder):
    """Its sides resemble those of all other plates."""
    put_part(folder / "plate.step", *_as_faces(profile_record(20), profile_record(0, 1, 2, 3)))
    put_part(folder / "other.step", *_as_faces(profile_record(refused=REFUSED), profile_record(0, 1, 2, 3)))
    found = {match.path.name: match for match in Library(folder).search(folder / "a.dxf")}
    assert (found["other.step"].profile, found["other.step"].distance) == (1, 0.0)
    assert found["plate.step"].profile == 0
    assert found["plate.step"].distance > 1


def test_any_face_of_a_solid_can_be_the_query(folder):
    """It finds its own file by that face."""
    plate = put_part(folder / "plate.step", *_as_faces(profile_record(20), profile_record(0, 1, 2, 9)))
    [first, second, *_] = Library(folder).search(plate, profile=1)
    assert (first.path, first.profile, first.distance) == (plate, 1, 0.0)
    assert second.path.name == "a.dxf"


def test_faces_that_take_no_part_do_not_shape_the_distances(folder):
    """The medians are over the profiles that are compared."""
    before = Library(folder).search(folder / "a.dxf")[1].distance
    part = folder / "sub" / "c.step"
    put_part(part, *_as_faces(profile_record(0, 1, 5, 6), *[profile_record(0)] * 20))
    assert Library(folder).search(folder / "a.dxf")[1].distance == before


def test_the_queries_own_profile_stands_for_its_file(folder):
    """Two equal faces of one part: the one that was asked with is the match."""
    part = put_part(folder / "two.step", profile_record(20), profile_record(1, 2), profile_record(1, 2))
    [first, *_] = Library(folder).search(part, profile=2)
    assert (first.path, first.profile, first.distance) == (part, 2, 0.0)


def test_a_query_without_sidecar_in_the_library(folder, tmp_path_factory):
    """A scanned file elsewhere is compared by its own sidecar."""
    elsewhere = put_part(tmp_path_factory.mktemp("elsewhere") / "q.dxf", profile_record(0, 1, 2, 4))
    matches = Library(folder).search(elsewhere)
    assert _names(matches)[0] == "b.dxf"
    assert len(matches) == 4


def test_a_query_that_is_not_scanned_is_derived_with_the_librarys_options(folder, monkeypatch):
    """Its signature comes from the file, made as those that it is compared with."""
    (folder / "q.dxf").write_text("new")
    asked = []

    def derive(self, path):
        asked.append((path, self.options))
        return stand_ins.sidecar(source_of(path), profile_record(0, 1, 2, 3))

    monkeypatch.setattr(Library, "_derived", derive)
    library = Library(folder)
    assert _names(library.search(folder / "q.dxf"))[:2] == ["a.dxf", "b.dxf"]
    assert asked == [(folder / "q.dxf", PartOptions())]
    assert library.unscanned == (folder / "q.dxf",)


def test_a_query_may_be_a_record(folder):
    """What one search gave can be the next one's query."""
    library = Library(folder)
    match = library.search(folder / "a.dxf")[1]
    assert _names(library.search(match.record))[0] == "b.dxf"


@pytest.mark.parametrize(("profile", "text"), [(3, "no profile 3; it has 2, numbered from 0"), (-1, "no profile -1")])
def test_a_profile_that_is_not_there(folder, profile, text):
    """The message says which there are."""
    put_part(folder / "q.dxf", profile_record(1), profile_record(2))
    with pytest.raises(QueryError, match=text):
        Library(folder).search(folder / "q.dxf", profile=profile)


def test_a_refused_profile_cannot_be_the_query(folder):
    """It has no signature; the reason is said. Unless it is asked for, the next one is taken."""
    put_part(folder / "q.dxf", profile_record(refused=REFUSED), profile_record(0, 1, 2, 3))
    library = Library(folder)
    with pytest.raises(QueryError, match="profile 0 cannot be compared: the outline crosses itself"):
        library.search(folder / "q.dxf", profile=0)
    assert library.query(folder / "q.dxf").profile == 1


@pytest.mark.parametrize(
    ("kind", "error"), [("no-profile", NoProfileError), ("unreadable", UnreadableFileError), ("timeout", QueryError)]
)
def test_a_failed_file_cannot_be_the_query(folder, kind, error):
    """The reason on record is the message."""
    with pytest.raises(error, match=r"q\.dxf: there is text only"):
        Library(folder).search(_fail(folder / "q.dxf", kind, "there is text only"))


def test_refused_profiles_and_failed_files_take_no_part(folder):
    """They have no signature."""
    put_part(folder / "refused.dxf", profile_record(refused=REFUSED))
    _fail(folder / "failed.dxf", "no-profile", "text only")
    assert len(Library(folder).search(folder / "a.dxf")) == 4


def test_removed_parts_take_no_part(folder):
    """A sidecar alone is not a part."""
    (folder / "b.dxf").unlink()
    assert _names(Library(folder).search(folder / "a.dxf")) == ["a.dxf", "c.step", "d.dxf"]


def test_changed_parts_are_named(folder):
    """Their sidecar is compared, and whoever asks learns that it is out of date."""
    os.utime(folder / "b.dxf", (1, 1))
    assert Library(folder).outdated == (folder / "b.dxf",)


def test_broken_sidecars_count_as_not_scanned(folder):
    """One bad sidecar does not end a search."""
    sidecar_path(folder / "b.dxf").write_text("{")
    library = Library(folder)
    assert library.unscanned == (folder / "b.dxf",)
    assert len(library.search(folder / "a.dxf")) == 3


def test_several_folders(folder, tmp_path_factory):
    """Folders are one library; a part in two of them counts once."""
    other = tmp_path_factory.mktemp("other")
    put_part(other / "e.dxf", profile_record(0, 1, 2, 3))
    library = Library(folder, other, folder / "sub")
    assert len(library.parts) == 5
    assert sorted(_names(library.search(folder / "a.dxf"))) == ["a.dxf", "b.dxf", "c.step", "d.dxf", "e.dxf"]


def test_folder_that_was_not_scanned(tmp_path):
    """The message is the command to run."""
    folder = tmp_path / "my parts"
    folder.mkdir()
    (folder / "a.dxf").write_text("0")
    with pytest.raises(LibraryError, match=r"not scanned yet; run: mashape-cad scan '.*my parts'"):
        Library(folder)


def test_folder_without_parts(tmp_path):
    """Nothing to search in."""
    with pytest.raises(LibraryError, match="no part files in it"):
        Library(tmp_path)


def test_folder_without_comparable_profiles(tmp_path):
    """Scanned, but nothing came of it."""
    _fail(tmp_path / "a.dxf", "no-profile", "text only")
    with pytest.raises(LibraryError, match="no profile that can be compared; to see why, run: mashape-cad scan"):
        Library(tmp_path)


def test_folder_that_does_not_exist(tmp_path):
    """No such folder."""
    with pytest.raises(LibraryError, match="no such folder"):
        Library(tmp_path / "gone")


def test_sidecars_made_differently_are_not_compared(folder):
    """Rather than rank apples with pears, it asks for a scan."""
    put_part(folder / "e.dxf", profile_record(1), options=PartOptions(ReadOptions(unit="in")))
    with pytest.raises(LibraryError, match=r"other signatures or options.*run: mashape-cad scan"):
        Library(folder)


def test_sidecars_of_another_format_are_refused(folder):
    """Both versions are named."""
    path = sidecar_path(folder / "b.dxf")
    path.write_bytes(path.read_bytes().replace(b'"version": 1', b'"version": 2', 1))
    with pytest.raises(LibraryError, match="format version 2, this release knows version 1"):
        Library(folder)


def test_module_does_not_load_the_kernel():
    """The library's own module names no floor that does."""
    heavy = ("OCP", "ezdxf", "numba", "matplotlib")
    assert not set(heavy) & set(vars(module))
    assert module.__name__ in sys.modules


def _sized(area, holes):
    return replace(profile_record(0, 1, 2, 4), area=area, holes=holes)


def test_parts_of_another_size_can_be_left_out(folder):
    """By the square root of the area: 100 and 110 mm2 differ by 4.9 % in size, 121 by 10 %."""
    put_part(folder / "x110.dxf", _sized(110.0, 0))
    put_part(folder / "x121.dxf", _sized(121.0, 0))
    library = Library(folder)
    names = set(_names(library.search(folder / "a.dxf", options=SearchOptions(same_size=0.05))))
    assert ("x110.dxf" in names, "x121.dxf" in names) == (True, False)
    names = set(_names(library.search(folder / "a.dxf", options=SearchOptions(same_size=0.11))))
    assert {"x110.dxf", "x121.dxf"} <= names


def test_parts_with_another_number_of_holes_can_be_left_out(folder):
    """Even the query itself."""
    put_part(folder / "two.dxf", _sized(100.0, 2))
    matches = Library(folder).search(folder / "a.dxf", options=SearchOptions(holes=2))
    assert [(match.rank, match.path.name) for match in matches] == [(1, "two.dxf")]


def test_a_part_stands_by_the_nearest_profile_that_passes(folder):
    """A filter is about profiles: another one of the same drawing may pass."""
    put_part(folder / "sheet.dxf", profile_record(0, 1, 2, 3), replace(profile_record(9, 10, 11, 12), holes=3))
    (match,) = Library(folder).search(folder / "a.dxf", options=SearchOptions(holes=3))
    assert (match.path.name, match.profile) == ("sheet.dxf", 1)
