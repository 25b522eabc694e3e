"""Make the sample parts of this folder: `python samples/make_samples.py [FOLDER]`.

Drawings go to its sub-folder `freeform80`, some of them as solids beside it. Nothing is left to chance but the
proportions of some ells, whose seed is fixed, so the files are the same whenever they are made.
"""

import sys
from pathlib import Path

import numpy as np
from maker.airplane import airplanes
from maker.bird import birds
from maker.bracket import brackets
from maker.chassis import chassis
from maker.ell import ells
from maker.files import write_dxf, write_step
from maker.gear import gears
from maker.map import maps
from maker.rect import rects
from shapely.geometry import LinearRing, Polygon

from mashape_cad.geometry.edge import BSpline, Edge
from mashape_cad.geometry.profile import Loop, Profile

DATABASE = "freeform80"
# These are written as extruded STEP parts too.
EXTRUDED = ("airplane-1", "bird-1", "bracket-1", "bracket-2", "chassis-3", "ell-1", "gear-2", "map-3", "rect-1")
CLOSED = 1e-12  # mm, how well ends meet
SMOOTH, SHARP = 1e-9, 0.2  # radians: where edges meet, the heading turns by less or by more, never by a little
SMALLEST_RADIUS = 0.5  # mm, of curvature: tighter turns are drawn as corners
SIZES = (40.0, 250.0)  # mm, the larger side


def parts() -> dict[str, Profile]:
    """Return all sample profiles by name."""
    return airplanes() | birds() | brackets() | chassis() | ells() | gears() | maps() | rects()


def check(profile: Profile) -> None:
    """Raise ValueError if a drawing is not what a good part is: closed, simple, smooth, of a handy size."""
    for loop in profile.loops:
        _check_loop(loop)
    rings = [loop.flattened(24) for loop in profile.loops]
    if not Polygon(rings[0], rings[1:]).is_valid:
        raise ValueError("loops cross or touch")
    size = float(np.max(np.ptp(rings[0], axis=0)))
    if not SIZES[0] <= size <= SIZES[1]:
        raise ValueError(f"{size:.1f} mm is no handy size")


def _check_loop(loop: Loop) -> None:
    for edge, following in zip(loop.edges, (*loop.edges[1:], loop.edges[0]), strict=True):
        if np.max(np.abs(edge.end - following.start)) > CLOSED:
            raise ValueError(f"edges do not meet at {edge.end}")
        if SMOOTH < _turn(edge, following) < SHARP:
            raise ValueError(f"a kink of {_turn(edge, following):.1e} radians at {edge.end}")
        if isinstance(edge, BSpline) and _smallest_radius(edge) < SMALLEST_RADIUS:
            raise ValueError(f"a turn of radius {_smallest_radius(edge):.2f} mm near {edge.start}")
    if not LinearRing(loop.flattened(24)).is_simple:
        raise ValueError("a loop crosses itself")


def _turn(edge: Edge, following: Edge) -> float:
    """Angle between the headings where two edges meet, radians."""
    (a, b), (c, d) = edge.derivatives([1.0])[0, 1], following.derivatives([0.0])[0, 1]
    return abs(float(np.arctan2(a * d - b * c, a * c + b * d)))


def _smallest_radius(edge: BSpline) -> float:
    _, first, second = np.moveaxis(edge.derivatives(np.linspace(0, 1, 400)), 1, 0)
    cross = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    return float(np.min(np.hypot(*first.T) ** 3 / np.maximum(cross, 1e-300)))


def make(folder: Path) -> list[Path]:
    """Write all parts into `folder`; return the files."""
    written = []
    drawings = folder / DATABASE
    drawings.mkdir(parents=True, exist_ok=True)
    for name, profile in parts().items():
        try:
            check(profile)
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from error
        written.append(drawings / f"{name}.dxf")
        write_dxf(written[-1], profile)
        if name in EXTRUDED:
            written.append(folder / f"{name}.step")
            write_step(written[-1], profile)
    return written


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    sys.stdout.write(f"{len(make(target))} files in {target}\n")
