"""What becomes of one profile: certified, invalid, refused or crashed, and the CPU time that its axis took."""

import re
import time
from dataclasses import dataclass
from typing import Literal

from mashape_cad.errors import AxisError, InvalidProfileError
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import certificate

__all__ = ["Fate", "Task", "Verdict", "lost", "verdict"]

Fate = Literal["certified", "invalid", "refused", "crashed"]

# A message without its place and its figures: what is left is the reason, by which refusals are counted.
_PLACE = re.compile(r"\s*(?:near|at) \([^)]*\).*|:? its radius is off.*|; .*")


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """One profile and where it comes from; its axis is computed `repeats` times."""

    collection: str
    file: str
    number: int
    profile: Profile
    repeats: int


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of a task.

    Attributes
    ----------
    collection, file : str
        Set, and path within what was searched.
    number, edges : int
        Number of the profile in its file, and of its edges.
    fate : str
    reason : str
        The kind of an invalid profile, or the message of a refusal without its figures; empty if certified.
    message : str
        The whole message.
    cpu_ms : float
        Of `medial_axis` alone, the smallest of the repeats, ms.
    """

    collection: str
    file: str
    number: int
    edges: int
    fate: Fate
    reason: str
    message: str
    cpu_ms: float


def verdict(task: Task) -> Verdict:
    """Compute the axis and its certificate."""
    best = float("inf")
    for _ in range(task.repeats):
        start = time.process_time()
        try:
            axis = medial_axis(task.profile)
        except InvalidProfileError as error:
            return _told(task, "invalid", error.kind, str(error), time.process_time() - start)
        except AxisError as error:
            return _told(task, "refused", _PLACE.sub("", str(error)), str(error), time.process_time() - start)
        except Exception as error:  # noqa: BLE001  (a crash is a result here)
            return _told(task, "crashed", type(error).__name__, repr(error), time.process_time() - start)
        best = min(best, time.process_time() - start)
    found = certificate(axis)
    if found.ok:
        return _told(task, "certified", "", "", best)
    return _told(task, "refused", "not certified", str(getattr(found, "reason", None) or found), best)


def lost(task: Task, error: Exception) -> Verdict:
    """Return the verdict on a task whose worker was killed for taking too long, or died."""
    return _told(task, "crashed", type(error).__name__, str(error), float("nan"))


def _told(task: Task, fate: Fate, reason: str, message: str, seconds: float) -> Verdict:
    edges = len(task.profile.edges)
    return Verdict(task.collection, task.file, task.number, edges, fate, reason, message, 1000 * seconds)
