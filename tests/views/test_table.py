"""Answers for people."""

import io
from dataclasses import replace
from pathlib import Path

from stand_ins import AXIS, face_record, profile_record

from mashape_cad.library.match import Match
from mashape_cad.matching.relation import Kind, Relation
from mashape_cad.views.table import certificate_line, print_matches


def _printed(*matches, width=None, compared=False):
    stream = io.StringIO()
    if width:
        stream.isatty = lambda: True
    print_matches(matches, stream, compared=compared)
    return stream.getvalue().splitlines()


def test_matches_in_order_with_size():
    """Rank, part, profile, score, distance, size."""
    record = replace(profile_record(1), bounds=(1.0, 2.0, 124.456, 14.0))
    lines = _printed(
        Match(1, Path("a.dxf"), 0, 0.0, record, 100.0), Match(12, Path("dir/b.step"), 3, 1.23456, record, 7.4)
    )
    assert lines[1].split() == ["1", "a.dxf", "0", "100", "0.0000", "123.5", "x", "12"]
    assert lines[2].split() == ["12", str(Path("dir/b.step")), "3", "7", "1.2346", "123.5", "x", "12"]


def test_a_long_name_is_not_cut_in_a_pipe():
    """Programs and files get it whole, on one line."""
    name = "x" * 500 + ".dxf"
    assert name in _printed(Match(1, Path(name), 0, 0.0, profile_record(1), 100.0))[1]


def test_names_are_not_markup():
    """Brackets and emoji codes are letters."""
    assert "[red]:smile: a.dxf" in _printed(Match(1, Path("[red]:smile: a.dxf"), 0, 0.0, profile_record(1), 100.0))[1]


def test_certificates():
    """First the verdict, then the figures or the reason."""
    assert certificate_line(0, profile_record(1)).startswith("ok  profile 0: 4 edges, 0 holes; 4 branches, 1 junctions")
    assert (
        certificate_line(3, face_record()) == "no  profile 3: 4 edges, 1 holes; the outline crosses itself; redraw it"
    )
    doubtful = replace(profile_record(1), axis=replace(AXIS, connected=False, ok=False))
    assert certificate_line(0, doubtful).startswith("no  ")


def test_hits_that_were_compared_say_what_they_are():
    """With the numbers that justify it; one that could not be read says that."""
    relation = Relation(Kind.SCALED, 25.4, False, 1.234e-9, 0.00021, 1.0, 0.1, (1.0, 0.0, 0.0, 1.0, 0.0, 0.0))
    told = Match(1, Path("a.dxf"), 0, 0.0, profile_record(1), 100.0, relation=relation)
    lines = _printed(told, Match(2, Path("b.dxf"), 0, 0.5, profile_record(1), 80.0, unverified="gone"), compared=True)
    assert lines[1].endswith("scaled by 25.4 (inch/mm?)               0         0.02%")
    assert lines[2].rstrip().endswith("not compared")
