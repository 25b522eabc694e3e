"""Trials are made once, in workers, and kept."""

import stand_ins
from stand_ins import profile_record, put_part

from mashape_cad.evaluation.labelled import labelled_set
from mashape_cad.evaluation.trials import STORE, trials
from mashape_cad.library.freshness import Status
from mashape_cad.options import ScanOptions
from mashape_cad.scanning import ScanStarted


def attempt(folder):
    """The trials of a folder, and how many were made just now."""
    events = []
    stood_in = {"function": stand_ins.tried, "warm_up": stand_ins.warm_up}
    found = trials(labelled_set(folder), ScanOptions(jobs=1), events.append, **stood_in)
    return found, sum(each.total for each in events if isinstance(each, ScanStarted)), events


def test_the_second_time_nothing_is_computed(folder):
    """What was found out lies in the folder, under a name that no scan looks at."""
    first, made, _ = attempt(folder)
    assert (len(first), made) == (7, 7)
    again, made, _ = attempt(folder)
    assert (again, made) == (first, 0)
    assert (folder / STORE).exists()
    assert len(labelled_set(folder).shapes) == 7


def test_what_has_changed_is_tried_again(folder):
    """That part only; a part that was moved is known by its content."""
    attempt(folder)
    (folder / "nut-3.dxf").write_bytes(b"another nut")
    stand_ins.write_sidecar(
        stand_ins.sidecar_path(folder / "nut-3.dxf"),
        stand_ins.sidecar(stand_ins.source_of(folder / "nut-3.dxf"), profile_record(1, 2)),
    )
    _, made, _ = attempt(folder)
    assert made == 1


def test_a_store_that_cannot_be_read_is_as_good_as_none(folder):
    """It is a cache."""
    attempt(folder)
    for content in (b"", b'{"format": 99, "trials": []}', b'{"format": 1, "trials": [{}]}'):
        (folder / STORE).write_bytes(content)
        assert attempt(folder)[1] == 7


def test_a_part_that_fails_costs_no_other(folder):
    """It is told of, and missing."""
    put_part(folder / "bug-1.dxf", profile_record(1, 2))
    found, made, events = attempt(folder)
    assert (len(found), made) == (7, 8)
    [failed] = [each for each in events if getattr(each, "status", None) is Status.FAILED]
    assert (failed.path.name, failed.failure.text) == ("bug-1.dxf", "division by zero")
