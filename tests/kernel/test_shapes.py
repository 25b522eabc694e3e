import os
from pathlib import Path

import pytest
from OCP.BinTools import BinTools
from OCP.BRepTools import BRepTools
from OCP.Message import Message
from OCP.TopoDS import TopoDS_Shape
from solids import box, polygon_wire

from mashape_cad.kernel.failures import ShapeError
from mashape_cad.kernel.shapes import has_faces, is_shape, read_brep, read_step, together


def _brep(path: Path) -> Path:
    BRepTools.Write_s(box(1, 2, 3), str(path))
    return path


def test_a_shape_is_told_from_other_things():
    """A null shape holds nothing, so it is none."""
    assert is_shape(box(1, 1, 1))
    assert not is_shape(TopoDS_Shape())
    assert not is_shape("box")


def test_faces_are_told_from_wires():
    """Also where they are held together."""
    assert has_faces(together([polygon_wire([(0, 0), (1, 0), (0, 1)]), box(1, 1, 1)]))
    assert not has_faces(polygon_wire([(0, 0), (1, 0), (0, 1)]))


def test_text_and_binary_files_are_both_read(tmp_path):
    """The kernel writes its format in two ways."""
    binary = tmp_path / "binary.brep"
    BinTools.Write_s(box(1, 2, 3), str(binary))
    assert has_faces(read_brep(_brep(tmp_path / "text.brep")))
    assert has_faces(read_brep(binary))


def test_a_truncated_file_says_nothing_on_its_own(tmp_path, capfd):
    """The kernel's own words do not reach the terminal; the error does."""
    whole = _brep(tmp_path / "whole.brep").read_bytes()
    for share in (0.05, 0.3, 0.5, 0.8):
        cut = tmp_path / f"cut-{share}.brep"
        cut.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(ShapeError):
            read_brep(cut)
    assert capfd.readouterr() == ("", "")


def test_a_broken_step_file_says_nothing_on_its_own(tmp_path, capfd):
    """Neither colours nor stars of the kernel's messenger."""
    broken = tmp_path / "broken.step"
    broken.write_text("ISO-10303-21;\nHEADER;\nnonsense\nEND-ISO-10303-21;\n")
    with pytest.raises(ShapeError, match="breaks the rules"):
        read_step(broken)
    assert capfd.readouterr() == ("", "")


def test_the_messenger_speaks_again_afterwards(tmp_path):
    """A program that uses the kernel too keeps its messages."""
    before = Message.DefaultMessenger_s().Printers().Size()
    read_brep(_brep(tmp_path / "whole.brep"))
    assert Message.DefaultMessenger_s().Printers().Size() == before


def test_reading_leaves_standard_output_alone(tmp_path, capfd):
    """What is written before and after arrives."""
    path = _brep(tmp_path / "whole.brep")
    os.write(1, b"before ")
    read_brep(path)
    os.write(1, b"after")
    assert capfd.readouterr().out == "before after"
