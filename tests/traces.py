"""Traced profiles for the tests of what is made of them."""

from catalogue import profile_of

from mashape_cad.geometry.edge import Similarity
from mashape_cad.geometry.profile import Profile
from mashape_cad.library.tracing import TracedProfile, traced_profiles
from mashape_cad.options import AxisOptions


def traced(*profiles: str | Profile, splines: bool = False, **options: float) -> tuple[TracedProfile, ...]:
    """Trace profiles, or those of the catalogue by their names; none may be refused."""
    numbered = [(k, profile_of(each) if isinstance(each, str) else each) for k, each in enumerate(profiles)]
    found, refused = traced_profiles(numbered, AxisOptions(**options), splines=splines)
    assert refused == ()
    return found


def moved(name: str, x: float, y: float) -> Profile:
    """A profile of the catalogue, elsewhere."""
    return profile_of(name).transformed(Similarity.of(offset=(x, y)))
