"""FloMat (`flo-mat` of npm), the one exact program there is for curved outlines, run by node in one process.

It takes Bezier curves up to cubics, so an arc becomes one cubic for each quarter, which is off by 2.7e-4 of the radius.
What it is measured against is the axis of what it was given.
"""

import json
import shutil
import statistics
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from found import Found

from mashape_cad.geometry.edge import BSpline, Edge, EllipseArc, Line
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["SETTINGS", "Answer", "approximated", "install", "is_at_hand", "medial_axes"]

_RUNNER = Path(__file__).with_name("flomat.mjs")
# Version 3.0.3 asks for any 7.x of flo-poly and any 4.x of flo-vector2d. Their newest ask for versions of big-float-ts
# and double-double that were never published, so the ones before are asked for.
_PACKAGE = {
    "private": True,
    "dependencies": {"flo-mat": "3.0.3"},
    "overrides": {"flo-poly": "7.0.1", "flo-vector2d": "4.0.5"},
}
# Neither its pruning (SAT) nor its simplification is part of a medial axis. "coarse" asks for as few discs within
# branches as it allows, which is closest to what a graph of junctions and ends is.
_PLAIN = {"applySat": False, "simplify": False}
SETTINGS = {"plain": _PLAIN, "coarse": {**_PLAIN, "maxCurviness": 3, "maxLength": 1024}}
# ms for which a case is repeated before it is measured, and again while it is, and the most repetitions: node compiles
# what has run some hundred times.
_WARM_MS, _MOST = 1500, 400


@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """What FloMat made of a shape: nothing, if `failure` says why."""

    setting: str
    found: Found | None
    failure: str = ""


def is_at_hand() -> bool:
    """Whether node and npm are installed."""
    return bool(shutil.which("node") and shutil.which("npm"))


def install(folder: Path) -> None:
    """Install flo-mat into a folder, unless it is there."""
    if (folder / "node_modules" / "flo-mat").exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.json").write_text(json.dumps(_PACKAGE), encoding="utf-8")
    command = ["npm", "install", "--no-audit", "--no-fund", "--ignore-scripts", "--silent"]
    subprocess.run(command, cwd=folder, check=True, timeout=300)


def medial_axes(profile: Profile, folder: Path, repeats: int) -> Iterator[Answer]:
    """Compute the axis of a profile made by `approximated`, in every setting."""
    loops = _loops(profile)
    cases = [{"setting": setting, "options": options, "loops": loops} for setting, options in SETTINGS.items()]
    task = folder / "task.json"
    content = {"warm_ms": _WARM_MS if repeats > 1 else 0, "most": _MOST if repeats > 1 else 1, "cases": cases}
    task.write_text(json.dumps(content), encoding="utf-8")
    done = subprocess.run(["node", _RUNNER, folder, task], capture_output=True, text=True, check=True, timeout=900)
    for line in done.stdout.splitlines():
        yield _answer(json.loads(line))


def _answer(answer: dict) -> Answer:
    if "failure" in answer:
        return Answer(answer["setting"], None, answer["failure"])
    discs = np.array(answer["discs"]).reshape(-1, 4)
    found = Found(discs[:, :3], discs[:, 3].astype(np.int64), {"all": statistics.median(answer["times"])})
    return Answer(answer["setting"], found)


def approximated(profile: Profile) -> Profile:
    """Return a profile of lines and polynomial Bezier curves of degree 2 and 3."""
    loops = [Loop(tuple(part for edge in loop.edges for part in _beziers(edge))) for loop in profile.loops]
    return Profile.of(loops[0], loops[1:])


def _beziers(edge: Edge) -> Iterator[Edge]:
    if isinstance(edge, Line):
        yield edge
        return
    control, breaks = edge.spans()
    if isinstance(edge, EllipseArc):
        yield from _cubics(edge, breaks)
        return
    if np.ptp(control[..., 2]) > 0 or control.shape[1] > 4:
        raise ValueError("FloMat takes polynomial curves up to degree 3")
    for poles in control[..., :2]:
        yield _bezier(poles)


def _cubics(edge: EllipseArc, breaks: np.ndarray) -> Iterator[Edge]:
    """One cubic a piece, as drawing programs make it: its handles put its middle on the arc."""
    reach = 4 / 3 * np.tan(edge.sweep * np.diff(breaks) / 4) / edge.sweep
    values = edge.derivatives(breaks)
    for k, length in enumerate(reach):
        (p, leave, _), (q, arrive, _) = values[k], values[k + 1]
        yield _bezier(np.array([p, p + length * leave, q - length * arrive, q]))


def _bezier(poles: np.ndarray) -> BSpline:
    degree = len(poles) - 1
    return BSpline.of(degree, [0.0] * (degree + 1) + [1.0] * (degree + 1), poles)


def _loops(profile: Profile) -> list:
    """Control points of each loop, ends of neighbours alike to the last digit."""
    loops = []
    for loop in profile.loops:
        curves = [edge.spans()[0][0, :, :2].tolist() for edge in loop.edges]
        for curve, following in zip(curves, [*curves[1:], curves[0]], strict=True):
            curve[-1] = following[0]
        loops.append(curves)
    return loops
