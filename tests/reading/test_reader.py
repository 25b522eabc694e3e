import os

import pytest
from drawings import write_drawing

from mashape_cad.errors import UnreadableFileError
from mashape_cad.options import ReadOptions
from mashape_cad.reading.reader import read


def square(space):
    """Draw a square of 2 units."""
    space.add_lwpolyline([(0, 0), (2, 0), (2, 2), (0, 2)], close=True)


@pytest.mark.parametrize("name", ["plate.dxf", "PLATE.DXF", "plate mit Löchern [2].dxf"])
def test_any_name_is_read_as_text_or_path(tmp_path, name):
    """The suffix decides, in any case; blanks, umlauts and brackets do not matter."""
    path = write_drawing(tmp_path / name, square)
    for source in (path, str(path)):
        part = read(source)
        assert (part.path, part.format, part.profiles[0].area) == (path, "dxf", pytest.approx(4))


def test_options_reach_the_reader(tmp_path):
    """A square of 2 inches."""
    path = write_drawing(tmp_path / "plate.dxf", square)
    assert read(path, ReadOptions(unit="in")).profiles[0].area == pytest.approx(4 * 25.4**2)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("empty.dxf", b"", "empty"),
        ("blank.step", b" \n\n", "empty"),
        ("note.txt", b"text", "unknown kind of file '.txt'; known are .dxf"),
        ("none", b"text", "unknown kind of file ''"),
        ("picture.dxf", b"\x89PNG\r\n\x1a\n", "is really a PNG picture"),
        ("page.step", b"<!DOCTYPE html><html>", "is really an HTML or XML page"),
        ("drawing.dxf", b"AC1027\0\0", "is really a DWG drawing"),
        ("model.dxf", b"ISO-10303-21;\nHEADER;", "is really a STEP file"),
        ("prose.dxf", b"Dear all,\nplease cut.\n", "not a DXF file"),
        ("cut.dxf", b"0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n", "cut off"),
    ],
)
def test_what_cannot_be_read_is_one_line_with_the_path_and_a_remedy(tmp_path, name, content, message):
    """The message begins with the path and says what to do."""
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(UnreadableFileError) as refused:
        read(path)
    text = str(refused.value)
    assert text.startswith(f"{path}: ")
    assert message in text
    assert ";" in text
    assert "\n" not in text


def test_what_is_not_there_or_a_folder_is_refused(tmp_path):
    """Neither is a traceback."""
    with pytest.raises(UnreadableFileError, match="no such file"):
        read(tmp_path / "missing.dxf")
    with pytest.raises(UnreadableFileError, match="is a folder"):
        read(tmp_path)


@pytest.mark.skipif(os.name == "nt" or not hasattr(os, "geteuid") or os.geteuid() == 0, reason="nothing is forbidden")
def test_what_may_not_be_read_is_refused(tmp_path):
    """No permission."""
    path = write_drawing(tmp_path / "plate.dxf", square)
    path.chmod(0)
    with pytest.raises(UnreadableFileError, match=r"Permission denied.*permissions"):
        read(path)


def test_an_error_of_the_system_becomes_one_line(tmp_path, monkeypatch):
    """Whatever the system says, e.g. of a network share that has gone."""
    path = write_drawing(tmp_path / "plate.dxf", square)

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr("pathlib.Path.open", refuse)
    with pytest.raises(UnreadableFileError, match=r"Permission denied.*check the path and its permissions"):
        read(path)
