import pytest

from mashape_cad.library.replacing import replace_file


def test_a_file_is_replaced(tmp_path):
    """Its content is the new one, and nothing else is left in the folder."""
    path = tmp_path / "Träger 1.dxf"
    path.write_bytes(b"old")
    replace_file(path, b"new")
    assert path.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [path]


def test_what_fails_leaves_the_old_file(tmp_path, monkeypatch):
    """Interrupted while writing: the old content is there, and no remains."""
    path = tmp_path / "a.json"
    path.write_bytes(b"old")
    monkeypatch.setattr(type(path), "replace", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        replace_file(path, b"new")
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_is_not_there(tmp_path):
    """The system's own error."""
    with pytest.raises(OSError, match="No such file"):
        replace_file(tmp_path / "gone" / "a.json", b"")
