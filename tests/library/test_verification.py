"""Hits laid over the query: what is said of them, and what becomes of those that cannot be read again."""

from dataclasses import replace

import numpy as np
import pytest
from drawings import write_drawing
from matching.shapes import MIRRORED, bracket
from stand_ins import profile_record, sidecar

from mashape_cad.errors import QueryError
from mashape_cad.geometry.edge import Similarity
from mashape_cad.library.freshness import source_of
from mashape_cad.library.library import Library
from mashape_cad.library.record import Thumbnail
from mashape_cad.library.sidecar import sidecar_path, write_sidecar
from mashape_cad.matching.relation import Kind
from mashape_cad.options import SearchOptions

SAME = SearchOptions(mode="same")
L_SHAPE = np.array([(0, 0), (80, 0), (80, 18), (20, 18), (20, 50), (0, 50)], float)


def put_drawing(path, points, *filled):
    """A drawing of one polygon, beside it a sidecar with a signature of the test's choice."""
    write_drawing(path, lambda space: space.add_lwpolyline(points.tolist(), close=True))
    write_sidecar(sidecar_path(path), sidecar(source_of(path), profile_record(*filled)))
    return path


@pytest.fixture
def folder(tmp_path):
    """An L, then its mirror image, the same in inches, a longer one, and a square, in the order of their distance."""
    put_drawing(tmp_path / "a.dxf", L_SHAPE, 0, 1, 2, 3)
    put_drawing(tmp_path / "mirrored.dxf", MIRRORED.apply(L_SHAPE), 0, 1, 2, 4)
    put_drawing(tmp_path / "inch.dxf", Similarity.of(25.4).apply(L_SHAPE), 0, 1, 5, 6)
    put_drawing(tmp_path / "longer.dxf", np.where(L_SHAPE == 80, 84.0, L_SHAPE), 0, 7, 8, 9)
    put_drawing(tmp_path / "square.dxf", np.array([(0, 0), (9, 0), (9, 9), (0, 9)], float), 20, 21, 22, 23)
    return tmp_path


def relations(matches):
    """Names and kinds, in order."""
    return {match.path.stem: match.relation and match.relation.kind for match in matches}


def test_hits_keep_their_order_and_are_said_what_they_are(folder):
    """By the exact outlines, whatever the signatures say."""
    matches = Library(folder).search(folder / "a.dxf", options=SAME)
    assert [match.rank for match in matches] == [1, 2, 3, 4, 5]
    assert list(relations(matches).items()) == [
        ("a", Kind.IDENTICAL),
        ("mirrored", Kind.MIRRORED),
        ("inch", Kind.SCALED),
        ("longer", Kind.MODIFIED),
        ("square", Kind.SIMILAR),
    ]
    assert matches[2].relation.scale == pytest.approx(25.4)
    assert matches[3].relation.deviation_mm == pytest.approx(4.0)


def test_the_same_outer_loop_comes_first_whatever_its_holes(folder):
    """By signature the plate with a hole more is the farthest; among themselves parts keep their order."""
    outline = Thumbnail((0.0, 0.0), 0.016, ((0, 0, 5000, 0, 5000, 1125, 1250, 1125, 1250, 3125, 0, 3125),))
    turned = Thumbnail((7.0, 0.0), 0.032, ((0, 0, 3125, 0, 3125, 1250, 1125, 1250, 1125, 5000, 0, 5000), (9, 9) * 3))
    put_drawing(folder / "hole.dxf", L_SHAPE, 40, 41, 42, 43)
    for name, light, filled in (("hole", turned, (40, 41, 42, 43)), ("a", outline, (0, 1, 2, 3))):
        record = replace(profile_record(*filled), thumbnail=light)
        path = folder / f"{name}.dxf"
        write_sidecar(sidecar_path(path), sidecar(source_of(path), record))
    order = ["a", "hole", "mirrored", "inch", "longer", "square"]
    assert [match.path.stem for match in Library(folder).search(folder / "a.dxf", options=SAME)] == order
    plain = [match.path.stem for match in Library(folder).search(folder / "a.dxf")]
    assert plain.index("hole") > plain.index("longer")


def test_nothing_is_compared_unless_asked(folder):
    """By default a search is one by signatures."""
    assert set(relations(Library(folder).search(folder / "a.dxf")).values()) == {None}


def test_only_as_many_as_asked_are_read(folder):
    """The others may be broken."""
    (folder / "square.dxf").unlink()
    matches = Library(folder).search(folder / "a.dxf", k=2, options=SAME)
    assert [match.unverified for match in matches] == [None, None]


def test_mirror_images_can_be_left_out(folder):
    """The ranks of the others close up."""
    options = SearchOptions(mode="same", no_mirror=True)
    matches = Library(folder).search(folder / "a.dxf", k=3, options=options)
    assert [(match.rank, match.path.stem) for match in matches] == [(1, "a"), (2, "inch"), (3, "longer")]
    with pytest.raises(ValueError, match="no_mirror needs mode 'same'"):
        SearchOptions(no_mirror=True)


def test_a_hit_that_is_gone_or_has_changed_costs_that_hit_only(folder):
    """It stays in the list, with the reason."""
    library = Library(folder)
    (folder / "mirrored.dxf").unlink()
    write_drawing(folder / "longer.dxf", lambda space: space.add_circle((0, 0), 5))
    found = {match.path.stem: match for match in library.search(folder / "a.dxf", options=SAME)}
    assert found["inch"].relation.kind is Kind.SCALED
    assert found["mirrored"].relation is found["longer"].relation is None
    assert "mirrored.dxf" in found["mirrored"].unverified
    assert "changed since it was scanned" in found["longer"].unverified


def test_a_hit_that_was_only_touched_is_compared(folder):
    """Another time and the same content: it has not changed."""
    import os

    os.utime(folder / "inch.dxf", (1, 1))
    assert relations(Library(folder).search(folder / "a.dxf", options=SAME))["inch"] is Kind.SCALED


def test_a_fault_in_one_hit_costs_that_hit_only(folder, monkeypatch):
    """It is told as what it is."""
    from mashape_cad.library import verification

    def broken(*_arguments):
        raise ZeroDivisionError("oh")

    monkeypatch.setattr(verification, "related", broken)
    matches = Library(folder).search(folder / "a.dxf", options=SAME)
    assert all("fault of this program (ZeroDivisionError: oh)" in match.unverified for match in matches)


def test_a_query_can_be_a_profile(folder, monkeypatch):
    """Then its exact outline is at hand."""
    library = Library(folder)
    records = (profile_record(0, 1, 2, 3),)
    monkeypatch.setattr(library, "_records", lambda _thing: records)
    assert relations(library.search(bracket(), options=SAME))["a"] is Kind.MODIFIED


def test_a_record_alone_cannot_be_compared(folder):
    """It keeps no exact outline."""
    with pytest.raises(QueryError, match="holds no exact outline"):
        Library(folder).search(profile_record(0, 1, 2, 3), options=SAME)
