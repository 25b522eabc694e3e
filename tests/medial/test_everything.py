"""Random profiles of everything at once, and regular shapes with noise: all certified, by the definition too."""

import pytest
from mixed import is_simple, mixed_profile
from noise import SHAPES, noisy

from mashape_cad.errors import InvalidProfileError
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import STATIONS, certificate

_SEEDS, _CHUNK = 2000, 100
# Seeds that were refused once: at the border of two spans where curvature jumps the twin lay between two samples; the
# axis' disc at an osculating end was held against one a little further on; a span of a few thousandths of the size was
# taken for an arc, with its centre a little off.
_MENDED = (210, 563, 1794)


def check(seed: int) -> None:
    """The profile's axis is certified; one that crosses or touches itself, as fine polygons tell, is refused."""
    profile = mixed_profile(seed)
    if not is_simple(profile):
        with pytest.raises(InvalidProfileError):
            medial_axis(profile)
    else:
        assert certificate(medial_axis(profile), STATIONS).reason == "", seed


@pytest.mark.parametrize("seed", [*range(12), *_MENDED])
def test_some_profiles_of_everything(seed):
    """Lines, arcs, splines of degree 2 to 5, rational, sharp, smooth and tiny corners, holes of all kinds."""
    check(seed)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, _SEEDS, _CHUNK))
def test_many_profiles_of_everything(first):
    """Two thousand of them, none left out."""
    for seed in range(first, first + _CHUNK):
        check(seed)


@pytest.mark.slow
@pytest.mark.parametrize("power", range(5, 14))
@pytest.mark.parametrize("name", SHAPES)
def test_noise(name, power):
    """Noise on coordinates from 1e-13 to 1e-5 of the size: events that would coincide nearly coincide."""
    for seed in range(12):
        profile = noisy(SHAPES[name](), 10.0**-power, seed)
        assert certificate(medial_axis(profile), STATIONS).reason == "", (name, power, seed)
