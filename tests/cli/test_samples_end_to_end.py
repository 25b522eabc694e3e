"""The whole way on the sample parts: scan, search with each, and with moved, turned, scaled and mirrored copies."""

import json
import math
import os
import shutil
import subprocess
import sys

import ezdxf
import pytest
from ezdxf.math import Matrix44

from mashape_cad import Library, read
from mashape_cad.cli.main import main
from mashape_cad.reading.part import Part

pytestmark = pytest.mark.slow

VARIANTS = {
    "moved": Matrix44.translate(1234.5, -987.6, 0),
    "turned": Matrix44.z_rotate(math.radians(37)),
    "scaled": Matrix44.scale(25.4),
    "mirrored": Matrix44.scale(-1, 1, 1),
}


def _scan(folder, repository):
    command = [sys.executable, "-m", "mashape_cad", "scan", str(folder), "--json", "--jobs", "2"]
    environment = os.environ | {"PYTHONPATH": str(repository)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


@pytest.fixture(scope="module")
def scans(tmp_path_factory, samples, repository):
    """The samples, scanned twice: folder and the messages of both scans."""
    folder = tmp_path_factory.mktemp("samples")
    for path in samples.rglob("*"):
        if path.suffix in {".dxf", ".step"}:
            shutil.copy2(path, folder)
    return folder, _scan(folder, repository), _scan(folder, repository)


@pytest.fixture(scope="module")
def library(scans):
    """The scanned samples."""
    return Library(scans[0])


def _drawings(samples):
    return sorted(path.stem for path in samples.rglob("*.dxf"))


def pytest_generate_tests(metafunc):
    """A test for each sample drawing."""
    if "name" in metafunc.fixturenames:
        folder = metafunc.config.rootpath / "samples"
        metafunc.parametrize("name", _drawings(folder))


def test_all_samples_are_new_then_unchanged_in_a_tenth_of_the_time(scans):
    """Nothing fails, every profile has its axis, and the second scan reads nothing."""
    _, (*first, summary), (*second, again) = scans
    assert {each["status"] for each in first} == {"new"}
    assert sum(each["refused"] for each in first) == 0
    assert {each["status"] for each in second} == {"unchanged"}
    assert again["seconds"] < summary["seconds"] / 10


def test_each_sample_finds_itself(library):
    """At rank 1 with distance 0, solids too."""
    for path, _ in library.parts:
        [first, *_] = library.search(path)
        assert (first.rank, first.path, first.distance) == (1, path, 0.0)


def test_variants_find_the_sample(name, scans, library, tmp_path):
    """Whatever was done to it, it is at rank 1, at less than a tenth of the distance to the next other part."""
    for variant, matrix in VARIANTS.items():
        drawing = ezdxf.readfile(scans[0] / f"{name}.dxf")
        for entity in drawing.modelspace():
            entity.transform(matrix)
        path = tmp_path / f"{variant} {name}.dxf"
        drawing.saveas(path)
        first, *others = library.search(path)
        assert first.path.stem == name, variant
        nearest_other = next(match for match in others if match.path.stem != name)
        assert first.distance < nearest_other.distance / 10, (variant, first.distance, nearest_other.distance)


def test_certify_is_ok(name, freeform80, capsys):
    """Every axis of a sample drawing is proven: exact to 1e-7, connected, as many cycles as holes."""
    assert main(["certify", str(freeform80 / f"{name}.dxf"), "--json"]) == 0
    *certificates, summary = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    for each in certificates:
        assert each["ok"]
        assert each["connected"]
        assert each["cycles"] == each["holes"]
        assert max(each["max_disc_error"], each["max_foot_error"]) <= 1e-7
        assert each["certified"]
        assert each["euler_ok"]
        assert each["counting_ok"]
        assert max(each["area_error"], each["completeness_error"]) <= 1e-7
        assert each["reason"] is None
    assert summary["ok"] == summary["profiles"] == len(certificates) > 0


def test_a_query_may_be_a_profile(scans, library):
    """As read from a file, without one."""
    part = read(scans[0] / "gear-1.dxf")
    assert isinstance(part, Part)
    [first, *_] = library.search(part.profiles[0])
    assert (first.path.name, first.distance) == ("gear-1.dxf", 0.0)


def test_show_reads_what_is_not_scanned(freeform80, tmp_path, capsys):
    """Both formats of pictures."""
    shutil.copy(freeform80 / "bird-1.dxf", tmp_path / "a bird.dxf")
    for suffix in ("svg", "png"):
        assert main(["show", str(tmp_path / "a bird.dxf"), "-o", str(tmp_path / f"bird.{suffix}")]) == 0
        assert (tmp_path / f"bird.{suffix}").stat().st_size > 5000
    assert capsys.readouterr().err == ""
