"""The ten shapes of the benchmark, from 1 to about 400 edges; the larger side of each is 100 mm.

Gear and plate have what parts have: fillets and sharp corners, round holes and others, and much of it alike.
"""

import sys
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from mashape_cad import read
from mashape_cad.geometry.edge import Arc, BSpline, Edge, Line, Similarity
from mashape_cad.geometry.profile import Loop, Profile

_TESTS = Path(__file__).parent.parent
sys.path.insert(0, str(_TESTS))  # the catalogue of known profiles lies beside this folder

from catalogue import KNOWN, Known, blob, box, circle, polygon, rounded, slot  # noqa: E402

__all__ = ["CURVED", "SHAPES", "SIZE", "Known", "known", "plate_of_holes", "star"]

SIZE = 100.0
TAU = 2 * np.pi

# Shapes whose medial axis is known in closed form, by their name in the catalogue.
_CLOSED_FORMS = {"ellipse": "ellipse", "stadium": "stadium", "L": "ell", "ring": "eccentric ring"}


def scaled(profile: Profile) -> tuple[Profile, float]:
    """Return a profile with a larger side of 100 mm, its low corner moved nowhere, and the factor."""
    factor = SIZE / float(np.max(np.diff(profile.bounds, axis=0)))
    return profile.transformed(Similarity.of(factor)), factor


def known(name: str) -> tuple[Known, float] | None:
    """Return the closed form of a shape's axis and the factor from its size to that of the shape, if there is one."""
    if name not in _CLOSED_FORMS:
        return None
    form = KNOWN[_CLOSED_FORMS[name]]
    return form, scaled(form.profile)[1]


def bracket() -> Profile:
    """An angle with three fillets and two round holes: 11 edges."""
    corners = [(0, 0), (100, 0), (100, 28), (30, 28), (30, 80), (0, 80)]
    return Profile.of(rounded(corners, [12, 8, 0, 10, 0, 0]), [circle(15, 62, 6), circle(82, 14, 7)])


def glyph() -> Profile:
    """A letter R in lines and quadratic splines, as fonts have it: 24 edges, one counter."""
    outer = [
        *_lines((0, 0), (9, 0), (9, 2), (4.5, 3.5), (4.5, 33), (12, 33), (27, 0), (44, 0), (44, 2), (39, 3.4)),
        *_quadratics((39, 3.4), [((36, 4.4), (34, 8)), ((28, 20), (24.5, 34.5))]),
        *_quadratics((24.5, 34.5), [((40, 38), (40, 52)), ((40, 70), (18, 70))]),
        *_lines((18, 70), (-6, 70), (-6, 68), (-1, 66.5), (-1, 3.5), (-6, 2), (-6, 0), (0, 0)),
    ]
    counter = [
        *_lines((4.5, 38), (14, 38)),
        *_quadratics((14, 38), [((30, 38), (30, 52)), ((30, 66), (14, 66))]),
        *_lines((14, 66), (4.5, 66), (4.5, 38)),
    ]
    return Profile.of(Loop(tuple(outer)), [Loop(tuple(counter))])


def airplane() -> Profile:
    """A sample: lines, arcs and cubic splines, 36 edges."""
    return read(_TESTS.parent / "samples" / "freeform80" / "airplane-4.dxf").profiles[0]


def gear(teeth: int = 24) -> Profile:
    """Teeth with straight flanks between two circles, a bore and four more holes: 101 edges."""
    tip, root, pitch = 50.0, 43.0, TAU / teeth
    half_tip, half_root = 0.16 * pitch, 0.30 * pitch
    edges: list[Edge] = []
    for middle in pitch * np.arange(teeth):
        foot, top = _polar(root, middle - half_root), _polar(tip, middle - half_tip)
        end, down = _polar(tip, middle + half_tip), _polar(root, middle + half_root)
        gap = pitch - 2 * half_root
        edges += [Line.of(foot, top), Arc.of((0, 0), tip, middle - half_tip, 2 * half_tip), Line.of(end, down)]
        edges += [Arc.of((0, 0), root, middle + half_root, gap)]
    holes = [circle(0, 0, 11), *(circle(*_polar(26, 0.4 + TAU * k / 4), 7) for k in range(4))]
    return Profile.of(Loop(tuple(edges)), holes)


def plate() -> Profile:
    """A plate notched along two sides, with 27 holes: round ones, slots, crosses and wheels; 399 edges."""
    holes = []
    for k in range(27):
        x, y = 10.5 + 10.0 * (k % 9) - 0.13 * (k // 9), 14.0 + 16.2 * (k // 9) + 0.11 * (k % 4)
        make = (_round, _slot, _round, _cross, _wheel, _slot, _round, _cross, _wheel)[(k + k // 9) % 9]
        holes.append(make(x, y, 3.0 + 0.13 * (k % 5)))
    return Profile.of(_notched(100.0, 60.0, 10), holes)


def plate_of_holes(edges: int) -> Profile:
    """A plate with round holes and slots by turns on a grid, not quite even: about so many edges."""
    count = max(1, round((edges - 4) / 2.5))
    columns = int(np.ceil(np.sqrt(1.5 * count)))
    pitch = SIZE / columns
    holes = []
    for k in range(count):
        x, y = pitch * (k % columns + 0.5), pitch * (k // columns + 0.5)
        x, y = x + 0.04 * pitch * np.sin(2.1 * k), y + 0.04 * pitch * np.cos(3.7 * k)
        holes.append(slot(x, y, 0.12 * pitch, 0.15 * pitch) if k % 2 else circle(x, y, (0.2 + 0.002 * (k % 7)) * pitch))
    return Profile.of(box(0, 0, SIZE, pitch * int(np.ceil(count / columns))), holes)


def star(spans: int) -> Profile:
    """A closed cubic spline of so many spans whose lobes differ."""
    angle = TAU * np.arange(spans) / spans
    lobes = max(3, spans // 6)
    radius = 1 + 0.2 * np.sin(lobes * angle) + 0.08 * np.sin(5 * angle + 1) + 0.03 * np.cos(1.7 * np.arange(spans))
    poles = 35.0 * radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    around = np.arange(spans + 3) % spans
    return Profile.of(Loop((BSpline.of(3, np.arange(spans + 7.0), poles[around]),)))


def _polar(radius: float, angle: float) -> tuple[float, float]:
    return float(radius * np.cos(angle)), float(radius * np.sin(angle))


def _lines(*points: tuple[float, float]) -> list[Edge]:
    return [Line.of(a, b) for a, b in pairwise(points)]


def _quadratics(
    start: tuple[float, float], legs: Sequence[tuple[tuple[float, float], tuple[float, float]]]
) -> list[Edge]:
    edges = []
    for control, end in legs:
        edges.append(BSpline.of(2, [0, 0, 0, 1, 1, 1], [start, control, end]))
        start = end
    return edges


def _notched(width: float, height: float, notches: int) -> Loop:
    """Draw a rectangle with notches in its long sides, every other one with rounded mouths."""
    pitch, depth = width / notches, 4.0
    low = [(0.0, 0.0)]
    radii = [2.0]
    for k in range(notches):
        x = pitch * k
        low += [(x + 0.3 * pitch, 0.0), (x + 0.3 * pitch, depth), (x + 0.62 * pitch, depth), (x + 0.62 * pitch, 0.0)]
        radii += [0.0, 0.5, 0.5, 0.0] if k % 2 else [0.4, 0.0, 0.0, 0.4]
    low, radii = [*low, (width, 0.0)], [*radii, 0.0]
    high = [(width - x, height - y) for x, y in low]
    return rounded([*low, *high], [*radii, *radii])


def _round(x: float, y: float, size: float) -> Loop:
    return circle(x, y, size)


def _slot(x: float, y: float, size: float) -> Loop:
    return slot(x, y, 0.6 * size, 0.55 * size)


def _cross(x: float, y: float, size: float) -> Loop:
    a, b = size, 0.4 * size
    arm = [(b, b), (b, a), (-b, a)]
    quarters = (complex(x, y) + complex(*p) * 1j**k for k in range(4) for p in arm)
    return polygon([(z.real, z.imag) for z in quarters])


def _wheel(x: float, y: float, size: float) -> Loop:
    """Draw a toothed hole: seven teeth of two lines and two arcs each."""
    teeth, root = 7, 0.62 * size
    edges: list[Edge] = []
    for middle in TAU * np.arange(teeth) / teeth:
        a, b, gap = 0.14 * TAU / teeth, 0.22 * TAU / teeth, 0.56 * TAU / teeth
        first, second = np.add((x, y), _polar(root, middle - b)), np.add((x, y), _polar(size, middle - a))
        third, fourth = np.add((x, y), _polar(size, middle + a)), np.add((x, y), _polar(root, middle + b))
        edges += [Line.of(first, second), Arc.of((x, y), size, middle - a, 2 * a), Line.of(third, fourth)]
        edges += [Arc.of((x, y), root, middle + b, gap)]
    return Loop(tuple(edges))


SHAPES: dict[str, Callable[[], Profile]] = {
    "ellipse": lambda: scaled(KNOWN["ellipse"].profile)[0],
    "blob": lambda: scaled(blob())[0],
    "ring": lambda: scaled(KNOWN["eccentric ring"].profile)[0],
    "stadium": lambda: scaled(KNOWN["stadium"].profile)[0],
    "L": lambda: scaled(KNOWN["ell"].profile)[0],
    "bracket": lambda: scaled(bracket())[0],
    "glyph": lambda: scaled(glyph())[0],
    "airplane": lambda: scaled(airplane())[0],
    "gear": lambda: scaled(gear())[0],
    "plate": lambda: scaled(plate())[0],
}
CURVED = tuple(name for name in SHAPES if name != "L")
