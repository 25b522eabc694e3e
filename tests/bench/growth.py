"""How time grows with the number of edges: a plate with more and more holes, a star with more and more spans."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from cpu import median_ms
from peers import ours
from shapes import plate_of_holes, star

from mashape_cad.errors import AxisError
from mashape_cad.geometry.profile import Profile

__all__ = ["COUNTS", "Growth", "growth"]

COUNTS = (25, 50, 100, 200, 400, 800, 1500)
_FAMILIES: dict[str, Callable[[int], Profile]] = {"plate with holes": plate_of_holes, "star spline": star}


@dataclass(frozen=True, slots=True)
class Growth:
    """CPU times of one family; NaN where the axis was refused.

    Attributes
    ----------
    counts : tuple of int
        Edges of the plate, spans of the star.
    cpu_ms : tuple of float
    """

    family: str
    counts: tuple[int, ...]
    cpu_ms: tuple[float, ...]

    @property
    def exponent(self) -> float:
        """The k in time ~ count^k, by least squares of the logarithms."""
        points = [(math.log(n), math.log(t)) for n, t in zip(self.counts, self.cpu_ms, strict=True) if math.isfinite(t)]
        return float(np.polyfit(*np.array(points).T, 1)[0]) if len(points) > 1 else math.nan


def growth(counts: tuple[int, ...], repeats: int, tell: Callable[[str], None]) -> Iterator[Growth]:
    """Measure all families."""
    for family, make in _FAMILIES.items():
        profiles = [make(count) for count in counts]
        sizes = [max(len(profile.edges), len(profile.edges[0].spans()[0])) for profile in profiles]
        times = []
        for profile, size in zip(profiles, sizes, strict=True):
            tell(f"{family}, {size}")
            times.append(_time(profile, repeats))
        yield Growth(family, tuple(sizes), tuple(times))


def _time(profile: Profile, repeats: int) -> float:
    try:
        return median_ms(lambda: ours.medial_axis(profile).parts_ms, repeats)["all"]
    except AxisError:
        return math.nan
