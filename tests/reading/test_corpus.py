"""Real drawings of other projects: nothing raises, nothing hangs, counts and areas agree with a reference."""

import csv
import math
import time
from pathlib import Path

import pytest

from mashape_cad.errors import UnreadableFileError
from mashape_cad.reading.part import Part
from mashape_cad.reading.reader import read

pytestmark = pytest.mark.slow

# Areas of the reference are those of polylines, and hold to a few times 1e-5.
_AREA = 5e-5
# Drawn with decimal commas, of which the reference kept only the digits before: 4 instead of 6.
_WRONG_REFERENCE = "nothing-decimal-comma-separated"


def drawings(folder: Path) -> list[Path]:
    """All drawings below a folder."""
    return sorted(path for path in folder.rglob("*") if path.suffix.lower() == ".dxf")


def rows(corpus: Path) -> list[dict[str, str]]:
    """The reference's rows of drawings."""
    with (corpus / "truth.csv").open(encoding="utf-8", newline="") as file:
        return [row for row in csv.DictReader(file) if row["kind"] == "dxf"]


def agrees(part: Part, row: dict[str, str]) -> bool:
    """Whether counts and area are those of the reference."""
    area = sum(profile.area for profile in part.profiles) / part.unit.millimetres**2
    holes = sum(len(profile.holes) for profile in part.profiles)
    counts = (len(part.profiles), holes) == (int(row["profiles_or_planar_faces"]), int(row["holes"]))
    return counts and math.isclose(area, float(row["area"]), rel_tol=_AREA)


def _profile_or_reason(path: Path) -> bool:
    """Whether a drawing gives a profile, or a finding of what was lost, or an error of one line."""
    try:
        part = read(path)
    except UnreadableFileError as error:
        return "\n" not in str(error)
    return bool(part.profiles) or any(finding.severity == "lost" for finding in part.findings)


def test_every_drawing_gives_a_part_or_one_clear_line_within_seconds(corpus, capfd):
    """Sound and hostile ones; a part without profile has a finding that says why."""
    for path in drawings(corpus):
        start = time.perf_counter()
        assert _profile_or_reason(path), path
        assert time.perf_counter() - start < 20, path
    assert capfd.readouterr() == ("", "")


def test_profiles_holes_and_areas_agree_with_the_reference(corpus):
    """All rows but the one whose reference is wrong."""
    disagree = [row["path"] for row in rows(corpus) if not agrees(read(corpus / row["path"]), row)]
    assert [path for path in disagree if _WRONG_REFERENCE not in path] == []


def test_each_labelled_shape_is_one_profile(retrieval):
    """Outlines, letters, and planted changes: also with gaps, as one spline, split, and as a polyline of 500 edges."""
    wrong = [path for path in drawings(retrieval) if len(read(path).profiles) != 1]
    assert wrong == []


def test_planted_changes_that_keep_the_part_keep_its_area_and_holes(retrieval):
    """Whatever the way of drawing it."""
    kept = ("one_spline", "edges_split", "start_moved", "loop_reversed", "moved_rotated", "mirrored", "gaps_0_05")
    for base in sorted(retrieval.glob("planted/*/base.dxf")):
        (expected,) = read(base).profiles
        for name in kept:
            (profile,) = read(base.with_name(f"{name}.dxf")).profiles
            assert len(profile.holes) == len(expected.holes), (base, name)
            tolerance = 0.05 * expected.perimeter if name == "gaps_0_05" else 1e-5 * expected.area
            assert abs(profile.area - expected.area) <= tolerance, (base, name)
