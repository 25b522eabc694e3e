from dataclasses import replace

import numpy as np
import pytest
from catalogue import circle, polygon
from hypothesis import given, settings
from hypothesis import strategies as st
from matching.shapes import ELSEWHERE, MIRRORED, SHAPES, as_polylines, bracket, flange, gear, plate, with_edges_cut
from strategies import rounded_polygons, similarities, star_splines

from mashape_cad.geometry.edge import Similarity
from mashape_cad.geometry.profile import Profile
from mashape_cad.matching.outline import Outline
from mashape_cad.matching.relating import related
from mashape_cad.matching.relation import Kind

TOLERANCE = 1e-3


def relation(query, hit, tolerance=TOLERANCE):
    """What a hit is to a query."""
    return related(Outline(query), Outline(hit), tolerance)


@pytest.mark.parametrize("name", SHAPES)
def test_a_moved_part_is_identical(name):
    """Symmetric or not: moved and turned, nothing differs but rounding."""
    shape = SHAPES[name]()
    found = relation(shape, shape.transformed(ELSEWHERE))
    assert (found.kind, found.scale, found.is_mirrored) == (Kind.IDENTICAL, 1.0, False)
    assert found.deviation_mm < 1e-7
    assert found.area_difference < 1e-5


@pytest.mark.parametrize("name", SHAPES)
def test_a_part_cut_into_other_edges_is_identical(name):
    """Where edges begin is no property of the shape."""
    shape = SHAPES[name]()
    found = relation(shape, with_edges_cut(shape).transformed(ELSEWHERE))
    assert found.kind is Kind.IDENTICAL
    assert found.deviation_mm < 1e-7


@pytest.mark.parametrize("name", ["bracket", "blob", "gear"])
def test_a_mirror_image_is_told(name):
    """Of a part that is not its own mirror image; this gear's teeth lean to one side."""
    found = relation(SHAPES[name](), SHAPES[name]().transformed(MIRRORED))
    assert (found.kind, found.is_mirrored, found.scale) == (Kind.MIRRORED, True, 1.0)
    assert found.deviation_mm < 1e-7


@pytest.mark.parametrize("name", ["plate", "flange"])
def test_what_is_its_own_mirror_image_is_identical(name):
    """Nobody could tell that it was turned over."""
    found = relation(SHAPES[name](), SHAPES[name]().transformed(MIRRORED))
    assert (found.kind, found.is_mirrored) == (Kind.IDENTICAL, False)


@pytest.mark.parametrize("scale", [25.4, 1 / 25.4, 1.37, 1.0005])
def test_another_size_is_told_with_its_factor(scale):
    """The hit is so many times as large; the deviation counts at the query's size."""
    found = relation(bracket(), bracket().transformed(Similarity.of(scale, 0.4, (3.0, 4.0))))
    assert (found.kind, found.is_mirrored) == (Kind.SCALED, False)
    assert found.scale == pytest.approx(scale, rel=1e-9)
    assert found.deviation_mm < 1e-7
    assert found.hint == ("inch/mm?" if scale in (25.4, 1 / 25.4) else None)


def test_mirrored_and_scaled_at_once():
    """Then it is scaled, and known to be mirrored."""
    found = relation(bracket(), bracket().transformed(Similarity.of(2.0, 0.4, (3.0, 4.0), mirror=True)))
    assert (found.kind, found.is_mirrored, found.scale) == (Kind.SCALED, True, pytest.approx(2.0))
    assert str(found) == "scaled by 2, mirrored"


def test_rectangles_in_closed_form():
    """One is longer by a tenth: laid on three sides, the last one is off by 10 mm, and 1/11 of the area differs."""
    found = relation(plate(100, 60), plate(110, 60))
    assert (found.kind, found.scale) == (Kind.MODIFIED, 1.0)
    assert found.deviation_mm == pytest.approx(10.0, rel=1e-3)
    assert found.area_difference == pytest.approx(1 / 11, rel=1e-3)


@pytest.mark.parametrize("shift", [0.2, 0.02])
def test_a_hole_moved_a_little_is_a_modification(shift):
    """The deviation is the shift, though that is well within the tolerance: all else agrees exactly."""
    moved = bracket(hole=(55.0 + shift, 9.0)).transformed(ELSEWHERE)
    found = relation(bracket(), moved)
    assert (found.kind, found.scale) == (Kind.MODIFIED, 1.0)
    assert found.deviation_mm == pytest.approx(shift, rel=1e-3)


def test_a_hole_that_is_a_little_wider_is_a_modification():
    """By half a tenth of a millimetre."""
    found = relation(bracket(), bracket(radius=4.05))
    assert found.kind is Kind.MODIFIED
    assert found.deviation_mm == pytest.approx(0.05, rel=1e-3)


@pytest.mark.parametrize("name", SHAPES)
def test_a_hole_more_or_less_is_a_modification(name):
    """Whichever of the two has it: the deviation and the area are those of the hole."""
    shape = SHAPES[name]()
    area = shape.area
    more = replace(
        shape,
        holes=(*shape.holes, Profile.of(circle(0, 0, 1), [circle(17, 22 if name == "plate" else 4, 1.5)]).holes[0]),
    )
    for query, hit in ((shape, more.transformed(ELSEWHERE)), (more, shape.transformed(MIRRORED))):
        found = relation(query, hit)
        assert found.kind is Kind.MODIFIED
        assert found.scale == 1.0
        assert found.area_difference == pytest.approx(np.pi * 1.5**2 / area, rel=0.01)
        assert found.deviation_mm > 1.0


@pytest.mark.parametrize("name", SHAPES)
def test_a_polyline_of_a_part_is_identical(name):
    """Its chords cut corners by more than the tolerance, but what lies between vertices is not told."""
    found = relation(SHAPES[name](), as_polylines(SHAPES[name]()).transformed(ELSEWHERE))
    assert (found.kind, found.scale) == (Kind.IDENTICAL, 1.0)
    assert found.area_difference < 2e-3


def test_a_polyline_of_a_modified_part_is_not_identical():
    """A hole that has moved by more than the tolerance shows in the vertices."""
    found = relation(bracket(), as_polylines(bracket(hole=(56.0, 9.0))))
    assert found.kind is Kind.MODIFIED


def test_a_comb_is_no_polyline():
    """Many short lines with sharp turns are drawn so: another one with a bump is no copy."""
    teeth = [(k + dx, y) for k in range(20) for dx, y in ((0.0, 0.0), (0.5, 0.0), (0.5, 3.0), (1.0, 3.0))]
    comb = [*teeth, (20.0, -4.0), (0.0, -4.0)]
    bump = [*comb[:-1], (10.2, -4.0), (10.1, -4.15), (10.0, -4.0), comb[-1]]
    found = relation(Profile.of(polygon(comb)), Profile.of(polygon(bump)))
    assert found.kind is Kind.MODIFIED
    assert found.deviation_mm == pytest.approx(0.15, rel=0.02)


def test_gaps_of_a_drawing_are_an_excuse():
    """Edges off by a gap that was bridged make no other part; without such a gap they do."""
    shifted = bracket(hole=(55.04, 9.0))
    assert relation(bracket(), shifted).kind is Kind.MODIFIED
    assert relation(bracket(), replace(shifted, gap=0.05)).kind is Kind.IDENTICAL
    wide = replace(bracket(hole=(57.0, 9.0)), gap=5.0)
    assert relation(bracket(), wide).kind is Kind.MODIFIED


def test_the_one_right_turn_of_a_nearly_symmetric_part():
    """One keyway among 14 teeth, one larger hole among six: the turn that fits is found, and nothing else."""
    turned = Similarity.of(1.0, 2.5, (9.0, 9.0))
    for shape in (gear(keyway=3.0), flange(odd=0.05)):
        found = relation(shape, shape.transformed(turned))
        assert found.kind is Kind.IDENTICAL
        assert found.deviation_mm < 1e-7


def test_nearly_symmetric_parts_are_not_confused():
    """A flange with one hole larger by 0.05 mm is not the symmetric one; nor is a bracket its nearly mirror image."""
    assert relation(flange(), flange(odd=0.05)).kind is Kind.MODIFIED
    lopsided = Profile.of(plate().outer, [circle(50.02, 30, 5.0), circle(20, 30, 3.0), circle(80.0, 30, 3.0)])
    found = relation(lopsided, lopsided.transformed(MIRRORED))
    # It can be turned by half and laid on itself but for the holes; turned over in its long axis it is the same.
    assert found.kind is Kind.IDENTICAL
    crooked = Profile.of(plate().outer, [circle(50.02, 30.03, 5.0), circle(20, 30, 3.0), circle(80.0, 30, 3.0)])
    found = relation(crooked, crooked.transformed(MIRRORED))
    assert (found.kind, found.is_mirrored) == (Kind.MIRRORED, True)


def test_what_merely_resembles_is_similar():
    """Flanges with other numbers of holes, an L and a rectangle."""
    assert relation(bracket(), plate()).kind is Kind.SIMILAR
    assert relation(gear(14), gear(11)).kind is Kind.SIMILAR


def test_relations_hold_both_ways():
    """Query and hit exchanged, the scale is turned over and the rest stays."""
    small, large = bracket(), bracket().transformed(Similarity.of(25.4, 1.0, (5.0, 5.0)))
    there, back = relation(small, large), relation(large, small)
    assert there.kind is back.kind is Kind.SCALED
    assert there.scale * back.scale == pytest.approx(1.0)


def test_a_placement_carries_the_hit_onto_the_query():
    """As plain numbers, for whoever draws it."""
    hit = bracket().transformed(ELSEWHERE)
    a, b, c, d, x, y = relation(bracket(), hit).placement
    laid = hit.outer.edges[0].start @ np.array([[a, c], [b, d]]) + (x, y)
    assert Outline(bracket()).query.distances([laid])[0] < 1e-7


@settings(max_examples=25, deadline=None)
@given(st.one_of(star_splines(), rounded_polygons()), similarities())
def test_any_part_is_found_again(profile, similarity):
    """Whatever similarity: the shape is the same, the factor is right, nothing is off."""
    found = relation(profile, profile.transformed(similarity))
    assert found.kind in (Kind.IDENTICAL, Kind.MIRRORED, Kind.SCALED)
    assert found.scale == pytest.approx(similarity.scale, rel=2e-3)
    assert found.deviation_mm < 1e-6 * profile.diagonal
