import numpy as np
import pytest
from matching.shapes import SHAPES, as_polylines, bracket

from mashape_cad.geometry.edge import Similarity
from mashape_cad.matching.outline import Outline


@pytest.mark.parametrize("name", SHAPES)
def test_stations_stand_for_the_whole_boundary(name):
    """Their weights add up to its length, and every vertex is one."""
    profile = SHAPES[name]()
    stations = Outline(profile).stations
    assert stations.weight.sum() == pytest.approx(profile.perimeter, rel=3e-3)
    vertices = np.array([edge.start for edge in profile.edges])
    away = np.linalg.norm(stations.point[:, None] - vertices, axis=2).min(axis=0)
    assert away.max() < 1e-9


@pytest.mark.parametrize("name", SHAPES)
def test_rings_enclose_what_the_profile_does(name):
    """To a millionth."""
    profile = SHAPES[name]()
    assert Outline(profile).area == pytest.approx(profile.area, rel=5e-6)


@pytest.mark.parametrize("name", SHAPES)
def test_the_nearest_places_are_the_kernels(name):
    """From points on a turned copy near the outline, to a few millionths of the size."""
    outline = Outline(SHAPES[name]())
    points = Similarity.of(1.0, 0.004, (0.3, -0.2)).apply(outline.stations.point)
    feet = outline.nearest(points)
    assert feet.distance == pytest.approx(outline.query.distances(points), abs=5e-6 * outline.size)
    assert np.linalg.norm(points - feet.point, axis=1) == pytest.approx(feet.distance)
    assert np.linalg.norm(feet.normal, axis=1) == pytest.approx(1.0)


def test_polylines_of_curves_are_known_by_their_gentle_turns():
    """A drawn L is none; each of its loops as a polyline is, with its own step."""
    assert not Outline(bracket()).is_tessellated
    outline = Outline(as_polylines(bracket(), 300))
    assert outline.is_tessellated
    assert len(outline.stations.point) == 300 * 4  # vertices alone
    assert outline.nearest(np.array([[40.0, 0.0]])).step[0] == pytest.approx(bracket().outer.length / 300, rel=0.01)


def test_the_centre_is_that_of_the_outer_loop():
    """A hole more does not move it."""
    assert Outline(bracket()).centre == pytest.approx(Outline(bracket(hole=(40.0, 9.0))).centre)
