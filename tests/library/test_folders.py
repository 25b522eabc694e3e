"""Which part files lie below a folder."""

from pathlib import Path

import pytest

from mashape_cad.errors import LibraryError, UnreadableFileError
from mashape_cad.library.folders import check_file, check_folder, part_files


def _make(folder, *names):
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("0")


def _listed(folder):
    return [path.relative_to(folder).as_posix() for path in part_files(folder, lambda *_: pytest.fail("refused"))]


def test_all_formats_in_all_subfolders_by_name(tmp_path):
    """Suffixes in capitals count, other files do not."""
    _make(tmp_path, "b.dxf", "a.STEP", "sub/c.stp", "sub/deep/d.brep", "sub/e.BRP", "f.txt", "dxf", "g.dxf.bak")
    assert _listed(tmp_path) == ["a.STEP", "b.dxf", "sub/c.stp", "sub/deep/d.brep", "sub/e.BRP"]


def test_hidden_files_and_sidecars_are_left_out(tmp_path):
    """Version control, editors and this program keep files of their own."""
    _make(tmp_path, ".git/a.dxf", ".b.dxf", "c.dxf.mashape.json", "c.dxf")
    assert _listed(tmp_path) == ["c.dxf"]


def test_strange_names(tmp_path):
    """Spaces, umlauts, brackets and line breaks are letters like others."""
    names = sorted(["a b.dxf", "Träger [1].dxf", "{x}*?.dxf", "line\nbreak.dxf"])
    _make(tmp_path, *names)
    assert _listed(tmp_path) == names


def test_links_in_a_circle_end(tmp_path):
    """A link back up is followed once at most."""
    _make(tmp_path, "sub/a.dxf")
    (tmp_path / "sub" / "up").symlink_to(tmp_path, target_is_directory=True)
    (tmp_path / "self").symlink_to(tmp_path / "self")
    assert _listed(tmp_path) == ["sub/a.dxf"]


def test_linked_folder_is_followed(tmp_path):
    """Parts elsewhere can be linked into a library."""
    _make(tmp_path, "elsewhere/a.dxf")
    library = tmp_path / "library"
    library.mkdir()
    (library / "linked").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
    assert _listed(library) == ["linked/a.dxf"]


def test_link_to_nowhere_is_a_part(tmp_path):
    """It is not dropped in silence: reading it will fail and say so."""
    (tmp_path / "a.dxf").symlink_to(tmp_path / "gone.dxf")
    assert _listed(tmp_path) == ["a.dxf"]


def test_folder_that_cannot_be_listed_is_told(tmp_path):
    """The others are listed all the same."""
    refused = []
    found = list(part_files(tmp_path / "gone", lambda folder, error: refused.append((folder, error))))
    assert found == []
    assert refused[0][0] == tmp_path / "gone"


def test_check_folder(tmp_path):
    """A folder is a folder."""
    check_folder(tmp_path)
    _make(tmp_path, "a.dxf")
    with pytest.raises(LibraryError, match="is a file, not a folder"):
        check_folder(tmp_path / "a.dxf")
    with pytest.raises(LibraryError, match="no such folder"):
        check_folder(tmp_path / "gone")


def test_check_file(tmp_path):
    """A file is a file."""
    _make(tmp_path, "a.dxf")
    check_file(tmp_path / "a.dxf")
    with pytest.raises(UnreadableFileError, match="is a folder"):
        check_file(tmp_path)
    with pytest.raises(UnreadableFileError, match="no such file"):
        check_file(Path("gone.dxf"))
