import pytest
from stand_ins import REFUSED, profile_record, put_part

from mashape_cad.errors import LibraryError
from mashape_cad.evaluation.labelled import labelled_set


def test_shapes_come_by_class_and_number(folder):
    """Ten after two."""
    labelled = labelled_set(folder)
    assert [shape.path.stem for shape in labelled.shapes] == [
        "bolt-1",
        "bolt-2",
        "bolt-10",
        "nut-1",
        "nut-2",
        "nut-3",
        "washer",
    ]
    assert labelled.labels == ("bolt",) * 3 + ("nut",) * 3 + ("washer",)
    assert labelled.left_out == ()


def test_the_first_profile_with_a_signature_stands_for_the_part(folder):
    """As in a search; a part without one is left out, and named."""
    put_part(folder / "nut-4.dxf", profile_record(1, refused=REFUSED), profile_record(20, 30, 43))
    put_part(folder / "nut-5.dxf", profile_record(1, refused=REFUSED))
    labelled = labelled_set(folder)
    [nut] = [shape for shape in labelled.shapes if shape.path.stem == "nut-4"]
    assert (nut.profile, nut.record.vectors["df"][43]) == (1, pytest.approx(1 / 3))
    assert labelled.left_out == (folder / "nut-5.dxf",)


def test_a_folder_without_classes_is_refused(tmp_path):
    """With the remedy."""
    for name in ("a", "b"):
        put_part(tmp_path / f"{name}.dxf", profile_record(1))
    with pytest.raises(LibraryError, match="sub-folder, or name files"):
        labelled_set(tmp_path)
