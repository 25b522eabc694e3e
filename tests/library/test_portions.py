"""Parts of a library that contain a portion of the query."""

from dataclasses import replace

import numpy as np
import pytest
from hooks import BODIES, bare, with_hook
from lights import branches_of
from stand_ins import profile_record, put_part

from mashape_cad.geometry.profile import Profile
from mashape_cad.library.library import Library
from mashape_cad.library.record import ProfileRecord
from mashape_cad.library.thumbnail import thumbnail
from mashape_cad.options import SearchOptions

_PART = SearchOptions(mode="part")


def _record(profile: Profile, number: int) -> ProfileRecord:
    light = thumbnail(profile, profile.bounds, branches_of(profile))
    (low, high) = profile.bounds.tolist()
    return replace(profile_record(number), thumbnail=light, bounds=(*low, *high))


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    """Three bodies with a hook and the same three without, each with a signature like no other."""
    folder = tmp_path_factory.mktemp("hooks")
    for number, body in enumerate(BODIES):
        put_part(folder / f"{body} hook.dxf", _record(with_hook(body), 10 * number))
        put_part(folder / f"{body}.dxf", _record(bare(body), 10 * number + 5))
    return folder


@pytest.mark.parametrize("body", BODIES)
def test_hooks_come_before_bodies(parts, body):
    """The part itself first, the two others with its hook next, though no signature says so."""
    matches = Library(parts).search(parts / f"{body} hook.dxf", options=_PART)
    names = [match.path.name for match in matches]
    assert names[0] == f"{body} hook.dxf"
    hooked = {f"{other} hook.dxf" for other in BODIES if other != body}
    # What is left of the query without its hook is its body, which one part has too.
    assert hooked <= set(names[1:4])
    assert set(names[1:4]) - hooked <= {f"{body}.dxf"}
    assert [match.rank for match in matches] == list(range(1, len(matches) + 1))
    shares = [match.portion.share for match in matches]
    assert shares == sorted(shares, reverse=True)
    assert shares[0] == pytest.approx(1.0)


def test_a_least_score_is_of_the_portion(parts):
    """It keeps a part that contains most of the query, however unlike its whole outline is."""
    library, query = Library(parts), parts / "block hook.dxf"
    every = library.search(query, options=_PART)
    least = 100 * every[2].portion.share
    kept = library.search(query, options=SearchOptions(mode="part", min_score=least - 1e-9))
    assert [match.path for match in kept] == [
        match.path for match in every if 100 * match.portion.share >= least - 1e-9
    ]


def test_what_is_found_lies_where_it_is_said_to(parts):
    """The stretches are on the hit, in its coordinates; the placement lays the query there."""
    [first, second, *_] = Library(parts).search(parts / "block hook.dxf", options=_PART)
    assert first.portion.placement.matrix == pytest.approx(np.eye(2), abs=1e-3)
    points = np.concatenate(second.portion.stretches)
    xmin, ymin, xmax, ymax = second.record.bounds
    assert np.all((points >= (xmin - 0.1, ymin - 0.1)) & (points <= (xmax + 0.1, ymax + 0.1)))


def test_filters_count_here_too(parts):
    """Of parts that do not pass, none is looked at."""
    matches = Library(parts).search(parts / "block hook.dxf", options=replace(_PART, holes=3))
    assert matches == []


def test_a_library_of_discs_has_no_branches(tmp_path):
    """Nothing to look for: no answer, and no fault."""
    put_part(
        tmp_path / "a.dxf", replace(profile_record(1), thumbnail=replace(profile_record(1).thumbnail, branches=()))
    )
    library = Library(tmp_path)
    assert library.search(tmp_path / "a.dxf", options=_PART) == []
