"""Profiles as they come from files: our samples, and real outlines, glyphs and parts."""

import numpy as np
import pytest
from invariants import check_axis

from mashape_cad import read
from mashape_cad.errors import AxisError, InvalidProfileError
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import certificate

# Files whose axes the certificate refused once: kinks of 1e-5 at the ends of fillets, a wedge between bent spans, a
# foot that is known to 1e-8, rounding beside a reflex vertex.
_REFUSED_ONCE = (
    "planted/gusset/one_spline.dxf",
    "planted/lower_e-germania-one/moved_rotated.dxf",
    "outlines30/elephant/elephant-09.dxf",
    "outlines30/fork/fork-13.dxf",
    "dxf/lumberjack-keyboard__lumberjack-frogmini.dxf",
    "dxf/lumberjack-keyboard__lumberjack-polaris.dxf",
    "step/crkbd__left.step",
)
_SMALLEST, _DRAWN = 200, 150


def _verdict(profile):
    """What became of a profile: ok, or the reason in a word."""
    try:
        axis = medial_axis(profile)
    except (AxisError, InvalidProfileError) as error:
        return str(error).split(" near ")[0]
    return "ok" if certificate(axis).ok else "not certified"


@pytest.mark.slow
def test_every_sample_has_a_certified_axis(freeform80):
    """Freeform outlines with and without holes, each accurate to a thousandth of what is promised."""
    for path in sorted(freeform80.glob("*.dxf")):
        for profile in read(path).profiles:
            axis = medial_axis(profile)
            found = certificate(axis)
            assert found.ok, path.name
            assert max(found.max_disc_error, found.max_foot_error) <= 1e-10, path.name
            check_axis(profile, axis, accuracy=1e-8)


def _files(folder):
    return sorted((*folder.rglob("*.dxf"), *folder.rglob("*.step")))


def _refused(paths):
    """What is not certified of the profiles of some files: files and reasons. Invalid ones may be refused as such."""
    verdicts = ((path.name, _verdict(profile)) for path in paths for profile in read(path).profiles)
    return [(name, verdict) for name, verdict in verdicts if verdict != "ok"]


@pytest.mark.slow
def test_small_real_profiles_are_certified(retrieval):
    """All files of next to no size."""
    small = sorted(_files(retrieval), key=lambda path: path.stat().st_size)[:_SMALLEST]
    assert not _refused(small)


@pytest.mark.slow
def test_some_real_profiles_are_certified(retrieval):
    """Files drawn with a printed seed: polylines of 500 segments, outlines from images, glyphs, parts."""
    seed = np.random.SeedSequence().entropy
    print(f"seed {seed}")  # noqa: T201 - to repeat a failure
    files = _files(retrieval)
    drawn = np.random.default_rng(seed).choice(len(files), _DRAWN, replace=False)
    assert not _refused([files[k] for k in drawn])


@pytest.mark.slow
@pytest.mark.parametrize("name", _REFUSED_ONCE)
def test_axes_that_were_refused_once(name, retrieval, corpus):
    """Profiles that do not cross themselves are certified."""
    path = next(folder / name for folder in (retrieval, corpus) if (folder / name).exists())
    assert not [verdict for _, verdict in _refused([path]) if "crosses" not in verdict]
