"""A small labelled folder whose sidecars are written by hand."""

import pytest
from stand_ins import profile_record, put_part


@pytest.fixture
def folder(tmp_path):
    """Two classes of three, one of one: histograms of a class have neighbouring bins filled."""
    for name, *bins in (
        ("bolt-1", 0, 1, 2),
        ("bolt-2", 0, 1, 3),
        ("bolt-10", 0, 1, 20),
        ("nut-1", 20, 30, 40),
        ("nut-2", 20, 30, 41),
        ("nut-3", 20, 31, 42),
        ("washer", 50, 51, 52),
    ):
        put_part(tmp_path / f"{name}.dxf", profile_record(*bins))
    return tmp_path
