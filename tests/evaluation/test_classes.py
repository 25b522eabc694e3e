from pathlib import Path

import pytest

from mashape_cad.evaluation.classes import class_of

FOLDER = Path("parts")


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        ("bird/robin.dxf", "bird"),
        ("bird/young/robin-3.dxf", "bird"),
        ("bird-10.dxf", "bird"),
        ("bird10.dxf", "bird"),
        ("bird 3.step", "bird"),
        ("bird_robin.dxf", "bird"),
        ("sea-bird-2.dxf", "sea-bird"),
        ("sea-bird-gull.dxf", "sea-bird"),
        ("bird.dxf", "bird"),
        ("2012.dxf", "2012"),
        ("M8-7.dxf", "M8"),
    ],
)
def test_the_class_is_the_sub_folder_or_else_the_prefix(file, expected):
    """However files are numbered."""
    assert class_of(FOLDER / file, FOLDER) == expected
