"""JSON lines for other programs."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from stand_ins import AXIS, REFUSED, face_record, profile_record

from mashape_cad.geometry.edge import Similarity
from mashape_cad.library.match import Match
from mashape_cad.matching.portion import Portion
from mashape_cad.matching.relation import Kind, Relation
from mashape_cad.views.messages import certificate_message, match_message, readable

PROMISED = {
    "path", "profile", "edges", "holes", "area_mm2", "perimeter_mm", "max_radius_mm", "branches", "junctions", "ends",
    "cycles", "connected", "max_disc_error", "max_foot_error", "ok", "certified", "euler_ok", "counting_ok",
    "area_error", "completeness_error", "reason",
}  # fmt: skip


def _certificate(record):
    return json.loads(certificate_message(Path("a.dxf"), 2, record))


def test_certificate_has_all_that_is_promised():
    """Others rely on these fields."""
    message = _certificate(profile_record(1))
    assert message["message_type"] == "certificate"
    assert set(message) >= PROMISED
    assert (message["path"], message["profile"], message["area_mm2"], message["perimeter_mm"]) == (
        "a.dxf",
        2,
        100.0,
        40.0,
    )
    assert (message["max_radius_mm"], message["branches"], message["ok"], message["reason"]) == (5.0, 4, True, None)


def test_certificate_of_a_refused_profile_says_why():
    """The fields are there, the figures are null, ok is false."""
    message = _certificate(face_record())
    assert set(message) >= PROMISED
    assert (message["ok"], message["connected"], message["max_radius_mm"]) == (False, False, None)
    assert message["reason"] == REFUSED.text
    assert message["refused"]["kind"] == "crossing"


@pytest.mark.parametrize(
    ("axis", "text"),
    [
        (replace(AXIS, connected=False, ok=False), "not connected"),
        (replace(AXIS, cycles=1, ok=False), "1 cycles around 0 holes"),
        (replace(AXIS, max_disc_error=1e-3, ok=False), "errors are too large"),
    ],
)
def test_certificate_that_is_not_ok_says_what_is_in_doubt(axis, text):
    """An axis that is there, but not proven."""
    assert text in _certificate(replace(profile_record(1), axis=axis))["reason"]


def test_a_reason_on_record_is_told():
    """The certificate's own, with its place."""
    axis = replace(AXIS, ok=False, reason="candidate: the arc on edge 2 ends no branch, near (1, 2) mm")
    message = _certificate(replace(profile_record(1), axis=axis))
    assert (message["certified"], message["reason"]) == (False, axis.reason)


def test_paths_are_valid_text():
    """Whatever bytes a file name has."""
    assert readable(Path("L\udce4nge/ä.dxf")) == str(Path("L\ufffdnge/ä.dxf"))


def _match(**more):
    return json.loads(match_message(Match(1, Path("a.dxf"), 0, 0.25, profile_record(1), 90.0, **more)))


def test_a_match_has_no_relation_unless_it_was_compared():
    """The field is there, and null."""
    message = _match()
    assert (message["relation"], message["distance"]) == (None, 0.25)
    assert "scale" not in message


def test_a_match_that_was_compared_has_the_numbers():
    """Others rely on these fields."""
    relation = Relation(Kind.SCALED, 25.4, True, 0.5, 0.02, 0.9, 0.1, (0.0, 1.0, -1.0, 0.0, 3.0, 4.0))
    message = _match(relation=relation)
    assert (message["relation"], message["scale"], message["mirrored"]) == ("scaled", 25.4, True)
    assert (message["deviation_mm"], message["area_difference"], message["hint"]) == (0.5, 0.02, "inch/mm?")
    assert message["placement"] == [0.0, 1.0, -1.0, 0.0, 3.0, 4.0]
    assert message["unverified"] is None


def test_a_match_that_could_not_be_compared_says_why():
    """The numbers are null."""
    message = _match(unverified="a.dxf: it is gone")
    assert (message["relation"], message["scale"], message["unverified"]) == (None, None, "a.dxf: it is gone")


def test_a_portion_is_told_with_its_placement():
    """How much, how large, turned over or not; six numbers lay the query on the hit."""
    placement = Similarity.of(2.0, 0.0, (5.0, -1.0), mirror=True)
    match = Match(1, Path("a.dxf"), 0, 0.5, profile_record(1), 12.0, portion=Portion(0.75, placement, ()))
    assert json.loads(match_message(match))["portion"] == {
        "share": 0.75,
        "scale": pytest.approx(2.0),
        "mirrored": True,
        "placement": pytest.approx([2.0, 0.0, 0.0, -2.0, 5.0, -1.0]),
    }
