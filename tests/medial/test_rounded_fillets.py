"""Fillets that are almost something else: ends rounded to a file's digits, or radii that all but meet."""

import numpy as np
import pytest
from catalogue import rounded

from mashape_cad.geometry.edge import Arc, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import STATIONS, certificate

_QUARTER = np.tan(np.pi / 8)  # bulge of a quarter of a circle: the tangent of a fourth of its angle


def plate(radius: float, digits: int, seed: int) -> Profile:
    """A plate of 100 by 60 with four fillets, all ends moved by up to one unit of the last digit that is kept."""
    edges = rounded([(0, 0), (100, 0), (100, 60), (0, 60)], [radius] * 4).edges
    noise = np.random.default_rng(seed).uniform(-1, 1, (len(edges), 2)) * 10.0**-digits
    points = [np.round(edge.start, digits) + off for edge, off in zip(edges, noise, strict=True)]
    ends = zip(edges, points, [*points[1:], points[0]], strict=True)
    return Profile.of(Loop(tuple(Line.of(a, b) if isinstance(e, Line) else _quarter_arc(a, b) for e, a, b in ends)))


def _quarter_arc(a, b):
    """The arc of a quarter turn to the left between two points."""
    chord = b - a
    left = np.array([-chord[1], chord[0]])
    centre = (a + b) / 2 + left * (1 - _QUARTER**2) / (4 * _QUARTER)
    return Arc.of(centre, float(np.linalg.norm(a - centre)), float(np.arctan2(*(a - centre)[::-1])), np.pi / 2)


def check(radius, digits, seeds):
    """All of them are certified, by the definition too."""
    for seed in seeds:
        assert certificate(medial_axis(plate(radius, digits, seed)), STATIONS).reason == "", seed


@pytest.mark.parametrize("digits", range(1, 11))
@pytest.mark.parametrize("radius", [0.7, 5.0, 20.0])
def test_fillets_with_rounded_ends(radius, digits):
    """A kink that its arc's disc can swallow belongs to the arc, a wider one is a vertex with a branch of its own."""
    check(radius, digits, range(3))


@pytest.mark.slow
@pytest.mark.parametrize("digits", range(1, 11))
@pytest.mark.parametrize("radius", [0.7, 5.0, 20.0])
def test_many_fillets_with_rounded_ends(radius, digits):
    """So many that kinks just below and just above the limit are among them."""
    check(radius, digits, range(3, 40))


def test_an_arc_all_but_filled_by_a_disc_next_to_it():
    """The foot on the arc runs along all of it while the radius grows by 1e-8: its last disc is known by its twin."""
    check(5.0, 3, [15])


def test_a_disc_in_a_thin_wedge_turns_by_all_but_a_whole_turn():
    """Its two feet lie 1e-5 radians apart; the rest of the turn is not rounding."""
    check(20.0, 4, [10])


@pytest.mark.parametrize("less", [1e-8, 3e-8, 1e-7, 1e-6, 1e-5, 1e-3])
@pytest.mark.parametrize("shares", [(1, 1, 0, 0), (0, 1, 0, 1e6), (1, 1, 1, 1), (1, 0, 0, 0)])
def test_a_rectangle_that_is_almost_a_stadium(less, shares):
    """Between fillets whose radii are all but half the height lies a line of next to no length."""
    radii = [2 - min(share * less, 0.1) for share in shares]
    profile = Profile.of(rounded([(0, 0), (6, 0), (6, 4), (0, 4)], radii))
    assert certificate(medial_axis(profile), STATIONS).reason == ""


@pytest.mark.parametrize("less", [1e-8, 3e-9])
def test_a_square_that_is_almost_a_disc(less):
    """Four arcs of one circle and four lines shorter than rounding of it: one disc."""
    profile = Profile.of(rounded([(0, 0), (4, 0), (4, 4), (0, 4)], [2 - less] * 4))
    axis = medial_axis(profile)
    assert axis.nodes.kind == ("disc",)
    assert certificate(axis, STATIONS).reason == ""
