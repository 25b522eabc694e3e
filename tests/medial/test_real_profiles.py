"""Profiles as they come from files: our samples, and real outlines, glyphs and parts."""

from collections import Counter

import pytest
from invariants import check_axis

from mashape_cad import read
from mashape_cad.errors import AxisError, InvalidProfileError
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import certificate

# Real files are judged by the share that is complete; every refusal is printed with its reason.
_FILES, _PROFILES, _SHARE = 400, 200, 0.97


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


@pytest.mark.slow
def test_small_real_profiles_are_certified(retrieval):
    """Of the 200 profiles with the fewest edges, one from a file, at least 97 in a hundred; the others are refused."""
    files = sorted((*retrieval.rglob("*.dxf"), *retrieval.rglob("*.step")), key=lambda path: path.stat().st_size)
    profiles = [part.profiles[0] for path in files[:_FILES] if (part := read(path)).profiles]
    verdicts = Counter(_verdict(profile) for profile in sorted(profiles, key=lambda p: len(p.edges))[:_PROFILES])
    print(dict(verdicts))  # noqa: T201 - the reasons, for whoever looks at a failure
    assert verdicts["ok"] >= _SHARE * verdicts.total()
    assert verdicts["not certified"] == 0
