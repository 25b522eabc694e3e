"""Real parts and what was done to them, beside what `related` says they are."""

import csv

import pytest

from mashape_cad.matching.outline import Outline
from mashape_cad.matching.relating import related
from mashape_cad.matching.relation import Kind
from mashape_cad.options import SearchOptions
from mashape_cad.reading.reader import read

BASES = (
    "Heart-08", "ampersand-spectral", "angle_L-1", "cam-6", "camel-18", "crown-07", "device2-11",
    "digit_4-montserrat-alternates", "flange6-8", "gasket_square-7", "gear-7", "guitar-19", "gusset", "hook", "jar-04",
    "link_arm-7", "lower_e-germania-one", "lower_g-chewy", "plate_slotted-1", "pocket-02", "tslot30-3", "upper_A-prata",
    "upper_R-arvo", "upper_S-space-mono", "wrench-1",
)  # fmt: skip
# Bases that are their own mirror image: turned over, they are the same.
SYMMETRIC = {"flange6-8", "gasket_square-7", "gear-7", "link_arm-7", "plate_slotted-1", "wrench-1"}
EXACT = ("moved_rotated", "one_spline", "edges_split", "start_moved", "loop_reversed")
EXPECTED = {
    "mirrored": Kind.MIRRORED,
    "scaled_25_4": Kind.SCALED,
    "scaled_1_37": Kind.SCALED,
    "hole_moved_0_2": Kind.MODIFIED,
    "extra_hole": Kind.MODIFIED,
}


@pytest.mark.slow
@pytest.mark.parametrize("base", BASES)
def test_every_planted_relation(retrieval, base):
    """All variants of a base are told right, with the numbers that were planted."""
    folder = retrieval / "planted" / base
    with (retrieval / "planted" / "planted.csv").open(encoding="utf-8") as stream:
        rows = [row for row in csv.DictReader(stream) if row["base"] == base]
    query = Outline(read(folder / "base.dxf").profiles[0])
    assert len(rows) >= 12
    for row in rows:
        found = related(query, Outline(read(folder / row["file"]).profiles[0]), SearchOptions().tolerance)
        expected = EXPECTED.get(row["relation"], Kind.IDENTICAL)
        if row["relation"] == "mirrored" and base in SYMMETRIC:
            expected = Kind.IDENTICAL
        assert found.kind is expected, row["relation"]
        if row["relation"] in EXACT:
            assert found.deviation_mm < 3e-6
        if expected is Kind.SCALED:
            assert found.scale == pytest.approx(float(row["parameter"]), rel=1e-6)
        if row["relation"] == "hole_moved_0_2":
            assert found.deviation_mm == pytest.approx(0.2, rel=0.02)


@pytest.mark.slow
def test_different_parts_are_never_identical(retrieval):
    """Each base beside the next ones in the alphabet: none is called a copy, in whatever size."""
    outlines = {base: Outline(read(retrieval / "planted" / base / "base.dxf").profiles[0]) for base in BASES}
    for number, base in enumerate(BASES):
        for other in BASES[number + 1 : number + 5]:
            found = related(outlines[base], outlines[other], SearchOptions().tolerance)
            assert found.kind is Kind.SIMILAR, (base, other)
