"""The parts that a newcomer sees first."""

import re
import subprocess
import sys
from collections import Counter

import ezdxf
import numpy as np
import pytest

CLASSES = ("airplane", "bird", "bracket", "chassis", "ell", "gear", "map", "rect")


@pytest.fixture(scope="module")
def drawings(freeform80):
    """All DXF samples as ezdxf documents, by name."""
    return {path.stem: ezdxf.readfile(path) for path in sorted(freeform80.glob("*.dxf"))}


@pytest.fixture(scope="module")
def profiles(freeform80):
    """The one profile of each DXF sample, by name."""
    from mashape_cad import read

    return {path.stem: read(path).profiles[0] for path in sorted(freeform80.glob("*.dxf"))}


def test_there_are_ten_drawings_in_each_of_the_papers_classes(samples, drawings):
    """Eight classes, and at least six of the parts as solids too."""
    sizes = Counter(name.rsplit("-", 1)[0] for name in drawings)
    assert sizes == dict.fromkeys(CLASSES, 10)
    solids = {path.stem for path in samples.glob("*.step")}
    assert len(solids) >= 6
    assert solids <= set(drawings)


def test_drawings_are_sound_and_in_millimetres(drawings):
    """The audit of ezdxf has nothing to say, and each drawing states its unit."""
    for name, drawing in drawings.items():
        audit = drawing.audit()
        assert (name, len(audit.errors), len(audit.fixes)) == (name, 0, 0)
        assert drawing.units == ezdxf.units.MM


def test_drawings_hold_real_splines(drawings):
    """Each has cubic B-splines with control points, none a polyline."""
    for name, drawing in drawings.items():
        kinds = Counter(entity.dxftype() for entity in drawing.modelspace())
        assert kinds["SPLINE"] >= 1, name
        assert set(kinds) <= {"SPLINE", "LINE", "ARC", "CIRCLE"}, name
        for spline in drawing.modelspace().query("SPLINE"):
            assert spline.dxf.degree == 3
            assert len(spline.control_points) >= 4


def test_drawings_are_small(samples):
    """A newcomer's clone does not carry much: each file stays under 250 kB."""
    assert all(path.stat().st_size < 250_000 for path in samples.rglob("*") if path.suffix in {".dxf", ".step"})


# The traits that the paper lists in its section 4.2


def test_every_bracket_has_one_hole(profiles):
    """As the paper says: "The class 'Bracket' has a hole (inner loop) in all the shapes"."""
    assert {len(profile.holes) for name, profile in profiles.items() if name.startswith("bracket")} == {1}


def test_some_birds_have_holes(profiles):
    """As the paper says: "Within a class, shapes have holes as well as no-hole ones (see for example 'bird')"."""
    assert {len(profile.holes) for name, profile in profiles.items() if name.startswith("bird")} == {0, 1}


def test_holes_of_gears_vary_in_shape_and_size(profiles):
    """Every gear has one, and no two gears have the same kind of edges and the same share of area in their holes."""
    kinds = set()
    for name, profile in profiles.items():
        if name.startswith("gear"):
            assert profile.holes
            edges = tuple(sorted(len(hole.edges) for hole in profile.holes))
            kinds.add((edges, round(-sum(hole.signed_area for hole in profile.holes) / profile.outer.signed_area, 2)))
    assert len(kinds) == 10
    assert len({edges for edges, _ in kinds}) >= 6


def test_ells_are_scaled_unlike_along_and_across(profiles):
    """Numbers 5 to 10 become number 1 again when each is scaled to its box; no two have the same proportions."""

    def fitted(profile):
        low, high = profile.bounds
        return np.concatenate([(edge.poles - low) / (high - low) for edge in profile.outer.edges])

    proportions = []
    for number in range(5, 11):
        profile = profiles[f"ell-{number}"]
        np.testing.assert_allclose(fitted(profile), fitted(profiles["ell-1"]), atol=1e-9)
        proportions.append(np.divide(*np.subtract(*profile.bounds[::-1])))
    assert np.diff(np.sort(proportions)).min() > 0.01
    assert max(proportions) / min(proportions) > 2


@pytest.mark.slow
def test_rects_differ_but_their_axes_are_built_alike(profiles):
    """As the paper says: "the same structural arrangement of MA", which has two junctions and four ends."""
    from mashape_cad import medial_axis

    for name, profile in profiles.items():
        if name.startswith("rect"):
            nodes = medial_axis(profile).nodes
            assert (name, sorted(nodes.degree)) == (name, [1, 1, 1, 1, 3, 3])


@pytest.mark.slow
def test_axes_of_one_class_have_unlike_numbers_of_segments(profiles):
    """Fig. 11: "for similar shapes; number of MA segments is quite different from each other"."""
    from mashape_cad import medial_axis

    for class_ in ("airplane", "bird", "bracket", "gear", "map"):
        counts = [len(medial_axis(profiles[f"{class_}-{number}"]).branches) for number in range(1, 11)]
        assert max(counts) >= 2 * min(counts), class_


@pytest.mark.parametrize(("one", "other"), [("bird-1", "bird-10"), ("chassis-1", "chassis-5")])
def test_some_shapes_are_only_partially_similar(profiles, one, other):
    """Fig. 12: they share a good part of their outline, edge for edge, and differ in the rest."""

    def edges(profile):
        return {tuple(np.round(edge.point(np.linspace(0, 1, 5)), 6).ravel()): edge.length() for edge in profile.edges}

    first, second = edges(profiles[one]), edges(profiles[other])
    shared = sum(length for places, length in first.items() if places in second)
    assert 0.3 < shared / sum(first.values()) < 0.8


def test_every_sample_is_one_profile_without_findings_but_its_unit(freeform80):
    """Nothing has to be repaired or left out."""
    from mashape_cad import read

    for path in sorted(freeform80.glob("*.dxf")):
        part = read(path)
        assert (path.name, len(part.profiles)) == (path.name, 1)
        assert [finding for finding in part.findings if finding.severity != "info"] == []


def test_a_solid_has_the_outline_of_its_drawing(samples, profiles):
    """The first profile of a STEP part has the area, holes and edges of the DXF of the same name."""
    from mashape_cad import read

    for path in sorted(samples.glob("*.step")):
        solid, drawing = read(path).profiles[0], profiles[path.stem]
        assert solid.area == pytest.approx(drawing.area, rel=1e-9), path.name
        assert len(solid.holes) == len(drawing.holes)
        assert len(solid.edges) == len(drawing.edges)


@pytest.mark.slow
def test_the_script_makes_the_same_files_again(samples, repository, tmp_path):
    """So that a change of a drawing shows as one; last digits of a float differ from processor to processor."""
    script = repository / "samples" / "make_samples.py"
    subprocess.run([sys.executable, script, tmp_path], check=True, cwd=repository, env={"PYTHONPATH": str(repository)})
    made = {path.name: words_and_numbers(path) for path in tmp_path.rglob("*.*")}
    shipped = {path.name: words_and_numbers(path) for path in samples.rglob("*") if path.suffix in {".dxf", ".step"}}
    assert sorted(made) == sorted(shipped)
    for name, (words, numbers) in made.items():
        assert words == shipped[name][0], name
        # STEP files have eleven decimals here, the last of which may be rounded either way.
        assert numbers == pytest.approx(shipped[name][1], rel=0, abs=1.5e-11), name


def words_and_numbers(path):
    """Split a text file into what stands between decimal fractions, and these."""
    parts = re.split(r"(-?\d+\.\d*(?:[Ee][-+]?\d+)?)", path.read_text(encoding="utf-8"))
    return parts[::2], [float(part) for part in parts[1::2]]
