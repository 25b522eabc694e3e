"""Worker processes: a time limit for each item, and one that dies costs its own item only."""

import os
import subprocess
import sys
import time
from functools import partial

import pytest
import stand_ins

from mashape_cad.workers import WorkerDiedError, WorkersUnavailableError, outcomes

# Forking from a process that has loaded the kernel is not what is tested here.
_run = partial(outcomes, prepare=stand_ins.warm_up, preload="json")


def twice(number):
    """Stand in for work; negative numbers are deadly."""
    if number < 0:
        os._exit(5)
    if number > 1000:
        time.sleep(100)
    if number == 13:
        raise ValueError("thirteen")
    return 2 * number


def test_every_item_comes_back_with_its_value():
    """In any order."""
    assert sorted(_run(range(10), twice, jobs=2, timeout=30)) == [(i, 2 * i) for i in range(10)]


@pytest.mark.parametrize(("theirs", "found"), [({}, "1"), ({"OMP_NUM_THREADS": "4"}, None)])
def test_workers_take_one_thread_each(theirs, found):
    """Unless the environment says how many; that of whoever starts them stays as it is. In a process of its own."""
    program = """
import os
from mashape_cad.workers import outcomes
if __name__ == "__main__":
    before = dict(os.environ)
    [(_, found)] = outcomes(["OPENBLAS_NUM_THREADS"], os.getenv, jobs=1, timeout=30, prepare=dict, preload="json")
    assert dict(os.environ) == before
    print(found)
"""
    kept = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    done = subprocess.run(
        [sys.executable, "-c", program], env=kept | theirs, capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.strip() == str(found)


def test_no_items():
    """Nothing to do, no workers."""
    assert list(_run([], twice, jobs=2, timeout=30)) == []


def test_an_exception_is_an_outcome():
    """It does not end the worker."""
    found = dict(_run([13, 1], twice, jobs=1, timeout=30))
    assert isinstance(found[13], ValueError)
    assert found[1] == 2


def test_dying_workers_cost_their_own_item_only():
    """Many deaths in a row, among others that live: each is blamed on the right one."""
    items = [1, -1, 2, -2, -3, 3, -4, 4, -5, -6, 5, 6]
    found = dict(_run(items, twice, jobs=2, timeout=30))
    assert {item for item, outcome in found.items() if isinstance(outcome, WorkerDiedError)} == {-1, -2, -3, -4, -5, -6}
    assert {item: found[item] for item in items if item > 0} == {i: 2 * i for i in range(1, 7)}
    assert str(found[-1]) == "exit code 5"


def test_an_item_that_takes_too_long_is_ended():
    """Its worker is killed; the others are done meanwhile and after."""
    started = time.monotonic()
    found = dict(_run([1, 1001, 2, 3], twice, jobs=1, timeout=0.5))
    assert isinstance(found[1001], TimeoutError)
    assert (found[1], found[2], found[3]) == (2, 4, 6)
    assert time.monotonic() - started < 30


def test_preparation_is_outside_the_time_limit():
    """What is loaded once does not count against the first item."""
    found = dict(_run([1], twice, jobs=1, timeout=0.5, prepare=stand_ins.slow_warm_up))
    assert found == {1: 2}


def test_workers_that_cannot_start_end_it_all():
    """It does not go on starting them for ever."""
    with pytest.raises(WorkersUnavailableError, match=r"cannot start \(exit code 9\)"):
        list(_run([1, 2], twice, jobs=1, timeout=30, prepare=stand_ins.deadly_warm_up))


def test_closing_kills_the_workers_at_once():
    """Nobody waits for an item that nobody wants any more."""
    found = _run([1, 1001, 1002], twice, jobs=2, timeout=100)
    assert next(found) == (1, 2)
    started = time.monotonic()
    found.close()
    assert time.monotonic() - started < 3
