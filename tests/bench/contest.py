"""All ways on all shapes, measured in one run."""

from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from accuracy import Exact, radius_error
from cpu import median_ms, pooled
from found import Found
from peers import boost, flomat, occt, ours, samples
from polygons import Polygon, polygonised, sampled
from row import Row
from shapes import SHAPES, SIZE

from mashape_cad.geometry.profile import Profile
from mashape_cad.workers import outcomes

__all__ = ["CHORD_ERRORS", "STEPS", "contest"]

# Chord errors of polygons and distances of samples, by the size.
CHORD_ERRORS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
STEPS = (2e-2, 5e-3, 1e-3, 2e-4)
# More points than this are not tried: Qhull takes seconds for them, and the line in the plot is long enough.
_MOST_POINTS = 20_000
# Seconds that the kernel's bisecting locus may take for a shape.
_PATIENCE = 60.0


def contest(names: list[str], repeats: int, flomat_folder: Path | None, tell: Callable[[str], None]) -> Iterator[Row]:
    """Measure shape by shape; pyvoronoi and FloMat are left out where they are not installed."""
    for name in names:
        tell(name)
        profile = SHAPES[name]()
        yield from _Shape(name, profile, len(profile.edges), Exact.of(name, profile), repeats).rows(flomat_folder)


@dataclass(frozen=True, slots=True, eq=False)
class _Shape:
    name: str
    profile: Profile
    edges: int
    exact: Exact
    repeats: int

    def rows(self, flomat_folder: Path | None) -> Iterator[Row]:
        """Measure all ways; ours before and after the others, since a machine's speed changes while others use it."""
        found = ours.medial_axis(self.profile)
        before = self._our_time()
        peers = [*self._polygon_rows(), *self._sample_rows(), *self._kernel_rows()]
        peers += self._flomat_rows(flomat_folder) if flomat_folder else []
        yield self._row("ours", "", self.edges, Found(found.points, found.degree, pooled([before, self._our_time()])))
        yield from peers

    def _our_time(self) -> dict[str, float]:
        return median_ms(lambda: ours.medial_axis(self.profile).parts_ms, self.repeats)

    def _polygon_rows(self) -> Iterator[Row]:
        for error in CHORD_ERRORS if boost.is_at_hand() else ():
            polygon = polygonised(self.profile, error * SIZE)
            yield self._diagram_row("pyvoronoi", f"{error:.0e}", polygon, boost.medial_axis)

    def _sample_rows(self) -> Iterator[Row]:
        for step in STEPS:
            polygon = sampled(self.profile, step * SIZE)
            if len(polygon.points) <= _MOST_POINTS:
                yield self._diagram_row("scipy", f"{step:.0e}", polygon, samples.medial_axis)

    def _diagram_row(self, way: str, setting: str, polygon: Polygon, function: Callable[[Polygon], Found]) -> Row:
        found = function(polygon)
        parts = median_ms(lambda: function(polygon).parts_ms, self.repeats)
        return self._row(way, setting, len(polygon.points), Found(found.points, found.degree, parts))

    def _kernel_rows(self) -> Iterator[Row]:
        task = (self.profile, self.repeats)
        preload = "mashape_cad.library.preload"
        work = outcomes([task], _kernel_axis, jobs=1, timeout=_PATIENCE, prepare=_nothing, preload=preload)
        with closing(work):
            for _, outcome in work:
                if isinstance(outcome, Exception):
                    failure = f"{type(outcome).__name__}: {outcome}"
                    yield Row(self.name, "OCCT", "", self.edges, self.edges, failure=failure)
                else:
                    yield self._row("OCCT", "", self.edges, outcome)

    def _flomat_rows(self, folder: Path) -> Iterator[Row]:
        given = flomat.approximated(self.profile)
        inputs = len(given.edges)
        there = _Shape(self.name, given, self.edges, Exact.of(self.name, given), self.repeats)
        for answer in flomat.medial_axes(given, folder, self.repeats):
            if answer.found is None:
                yield Row(self.name, "FloMat", answer.setting, self.edges, inputs, failure=answer.failure)
            else:
                yield there._row("FloMat", answer.setting, inputs, answer.found)

    def _row(self, way: str, setting: str, inputs: int, found: Found) -> Row:
        return Row(
            self.name,
            way,
            setting,
            self.edges,
            inputs,
            found.parts_ms,
            self.exact.error(found),
            radius_error(self.profile, found),
            len(found.junctions),
            len(self.exact.junctions),
        )


def _kernel_axis(task: tuple[Profile, int]) -> Found:
    return occt.medial_axis(*task)


def _nothing() -> None:
    """Prepare nothing."""
