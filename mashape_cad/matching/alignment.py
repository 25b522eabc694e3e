"""How one outline is laid over another: `alignments`.

Candidates come from what can be computed outright (centroid and size of the outer loop, angles from
`turning.candidate_turns`, both orientations). Each is then refined by weighted least squares: stations of either
outline against the tangents at their nearest places on the other (Chen and Medioni 1992), a linear problem in the four
numbers of a similarity, or the three of a rigid motion. Residuals count less the larger they are (Geman and McClure
1985) against their own median, so that a hole too many, or one moved, does not drag along what else agrees: of two
outlines of which more than half agree exactly, that half decides in the end alone.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mashape_cad.geometry.edge import Floats, Similarity, frozen
from mashape_cad.matching.outline import Feet, Outline
from mashape_cad.matching.turning import candidate_turns

__all__ = ["Alignment", "alignments", "inverse", "settled"]

# Peaks of the correlation that are tried for each orientation: a gear of 14 teeth has 14 equal ones, and a keyway
# tells which is right only after some refining.
_MOST_TURNS = 16
# Rounds of refining all candidates, then those that are kept.
_ROUGH_ROUNDS, _FINE_ROUNDS = 4, 24
_KEPT = 3
# A candidate this many times further off than the best before refining stays behind it.
_HOPELESS = 3.0
# Stations of either outline that take part in rough and in fine rounds, and in the kernel's.
_ROUGH_STATIONS, _FINE_STATIONS, _KERNEL_STATIONS = 100, 400, 200
# Residuals of this many times their median have lost three quarters of their weight.
_MEDIANS = 3.0
# Of the size: residuals below count as equal, and a step below ends the rounds: what rings are good to.
_RING_FLOOR = 1e-6
# The same for the rounds by the kernel's distances, one each. It sinks from the error of the rings to that of files:
# at once, it would leave only the few residuals that happen to be nearly zero, and they decide nothing.
_KERNEL_FLOORS = (1e-5, 1e-6, 1e-7, 1e-8)
# Of the size: over a shorter way to the foot, its direction is rounding, and that across the outline is taken.
_SHORT_WAY = 1e-5
# Of the size: a distance beyond counts no more when candidates are ordered.
_FAR = 0.05
# A scale that differs from 1 by less is tried as 1 too: of a part whose leg was made longer, the rest has its size.
_NEARLY_ONE = 0.25
# Of the size: shifts that differ by less are votes for the same one. Vertices that vote, of either outline.
_VOTE = 1 / 100
_VOTERS = 400
# Scales beyond this ratio to the first guess are no refinement.
_WILD = 2.0

_ROUGH_FLOORS, _FINE_FLOORS = _ROUGH_ROUNDS * (_RING_FLOOR,), _FINE_ROUNDS * (_RING_FLOOR,)

Nearest = Callable[[Floats], Feet]


@dataclass(frozen=True, slots=True, eq=False)
class Alignment:
    """One way to lay the source over the target.

    Attributes
    ----------
    placement : Similarity
        From the source's coordinates to the target's.
    is_rigid : bool
        Whether the scale was held at 1.
    """

    placement: Similarity
    is_rigid: bool


def alignments(target: Outline, source: Outline, *, mirror: bool = True) -> Iterator[Alignment]:
    """Yield the best alignments: rigid before scaled, direct before mirrored.

    Good to about 1e-6 of the size; see `settled`.

    Parameters
    ----------
    target, source : Outline
    mirror : bool
        Whether mirror images are tried too.
    """
    for mirrored in (False, True) if mirror else (False,):
        shape = np.conj(source.spectrum) if mirrored else source.spectrum
        turns = candidate_turns(target.spectrum, shape, _MOST_TURNS)
        first = [_placement(target, source, turn, mirror=mirrored) for turn in turns.tolist()]
        rough = _Rounds(target, source, _ROUGH_STATIONS, is_rigid=False)
        scaled = _refined(rough, _promising(rough, first))
        if abs(scaled[0].scale - 1) <= _NEARLY_ONE:
            unscaled = [_with_scale_one(each, source) for each in scaled]
            unscaled.append(_shifted(target, source, unscaled[0]))
            yield Alignment(_best(target, source, unscaled, is_rigid=True), is_rigid=True)
        yield Alignment(_best(target, source, scaled, is_rigid=False), is_rigid=False)


def settled(target: Outline, source: Outline, alignment: Alignment) -> Alignment:
    """Refine an alignment by the kernel's distances, to rounding where the outlines agree."""
    rounds = _Rounds(target, source, _KERNEL_STATIONS, is_rigid=alignment.is_rigid)
    placement = rounds.refined(alignment.placement, _KERNEL_FLOORS, by_rings=False)
    return replace(alignment, placement=placement)


def _placement(target: Outline, source: Outline, turn: float, *, mirror: bool) -> Similarity:
    """Lay centre on centre at equal size, mirrored in the x axis if asked, then turned."""
    placed = Similarity.of(target.reach / source.reach, turn, mirror=mirror)
    return Similarity(placed.matrix, frozen(target.centre - placed.matrix @ source.centre))


def _with_scale_one(placement: Similarity, source: Outline) -> Similarity:
    """Return the rigid motion that keeps the source's centre where it is laid."""
    matrix = placement.matrix / placement.scale
    return Similarity(frozen(matrix), frozen(placement.apply(source.centre) - matrix @ source.centre))


def _promising(rough: "_Rounds", first: list[Similarity]) -> list[Similarity]:
    """Leave out what lies much worse than the best before any refining."""
    distances = [rough.distance(each) for each in first]
    return [each for each, distance in zip(first, distances, strict=True) if distance <= _HOPELESS * min(distances)]


def _refined(rough: "_Rounds", first: list[Similarity]) -> list[Similarity]:
    """Return the best few after some rounds on few stations, the best first."""
    tried = [rough.refined(each, _ROUGH_FLOORS, by_rings=True) for each in first]
    return sorted(tried, key=rough.distance)[:_KEPT]


def _best(target: Outline, source: Outline, first: list[Similarity], *, is_rigid: bool) -> Similarity:
    fine = _Rounds(target, source, _FINE_STATIONS, is_rigid=is_rigid)
    return min((fine.refined(each, _FINE_FLOORS, by_rings=True) for each in first), key=fine.distance)


def _shifted(target: Outline, source: Outline, placement: Similarity) -> Similarity:
    """Return a placement moved by the shift that carries most vertices onto vertices, turned as it is.

    Where a part was made longer, or cut off, centre on centre is no good start: nothing of what agrees would meet.
    """
    corners, moved = (_some_rows(each, _VOTERS) for each in (target.vertices, placement.apply(source.vertices)))
    shifts = (corners[:, None] - moved).reshape(-1, 2)
    cells, votes = np.unique(np.rint(shifts / (_VOTE * target.size)), axis=0, return_counts=True)
    shift = cells[np.argmax(votes)] * _VOTE * target.size
    return Similarity(placement.matrix, frozen(placement.offset + shift))


def _some_rows(points: Floats, most: int) -> Floats:
    return points[np.unique(np.linspace(0, len(points) - 1, most).astype(int))]


def _by_rings(outline: Outline) -> Nearest:
    return outline.nearest


def _by_kernel(outline: Outline) -> Nearest:
    def nearest(points: Floats) -> Feet:
        # What lies across the outline is told by the ring: at a distance of rounding the way to the foot has none.
        feet = outline.nearest(points)
        distance, point = outline.query.nearest(points)
        return replace(feet, point=point, distance=distance)

    return nearest


class _Rounds:
    """Rounds of least squares between some stations of two outlines."""

    def __init__(self, target: Outline, source: Outline, most: int | None, *, is_rigid: bool) -> None:
        self._target, self._source, self._is_rigid = target, source, is_rigid
        self._on_target, target_weight = _some(target, most)
        self._on_source, source_weight = _some(source, most)
        self._weight = np.concatenate([source_weight / source_weight.sum(), target_weight / target_weight.sum()])

    def distance(self, placement: Similarity) -> float:
        """Return the mean distance of either outline's stations from the other, far ones counted alike, mm."""
        away = self._target.nearest(placement.apply(self._on_source)).distance
        back = placement.scale * self._source.nearest(inverse(placement).apply(self._on_target)).distance
        return float(self._weight @ np.minimum(np.concatenate([away, back]), _FAR * self._target.size))

    def refined(self, placement: Similarity, floors: Sequence[float], *, by_rings: bool) -> Similarity:
        """Return the placement after a round for each floor, fewer if it stands still; unchanged if it runs away."""
        start = placement
        nearest = _by_rings if by_rings else _by_kernel
        to_target, to_source = nearest(self._target), nearest(self._source)
        for floor in np.multiply(floors, self._target.size).tolist():
            moved, step = self._round(placement, floor, to_target, to_source)
            if not (1 / _WILD < moved.scale / start.scale < _WILD):
                return start
            placement = moved
            if step <= min(floors) * self._target.size:
                break
        return placement

    def _round(
        self, placement: Similarity, floor: float, to_target: Nearest, to_source: Nearest
    ) -> tuple[Similarity, float]:
        laid = placement.apply(self._on_source)
        away, back = to_target(laid), to_source(inverse(placement).apply(self._on_target))
        moving = np.concatenate([laid, placement.apply(back.point)])
        fixed = np.concatenate([away.point, self._on_target])
        distance = np.concatenate([away.distance, placement.scale * back.distance])
        normal = np.concatenate([away.normal, back.normal @ (placement.matrix / placement.scale).T])
        direction = _directions(moving - fixed, distance, normal, _SHORT_WAY * self._target.size)
        told = self._weight * _is_told(np.concatenate([away.step, back.step]))
        return self._solved(placement, moving, fixed, direction, told * _trust(distance, told, floor))

    def _solved(
        self, placement: Similarity, moving: Floats, fixed: Floats, direction: Floats, weight: Floats
    ) -> tuple[Similarity, float]:
        """Solve for the small motion; in a direction that nothing decides (a disc's turn) there is none."""
        pivot = weight @ moving / weight.sum()
        arm = (moving - pivot) / self._target.size
        columns = [direction[:, 0], direction[:, 1], np.sum(direction * (arm @ [[0, 1], [-1, 0]]), axis=1)]
        if not self._is_rigid:
            columns.append(np.sum(direction * arm, axis=1))
        root = np.sqrt(weight / weight.sum())
        residual = np.sum(direction * (fixed - moving), axis=1)
        matrix = root[:, None] * np.stack(columns, axis=1)
        found = np.linalg.lstsq(matrix, root * residual, rcond=1e-6)[0]
        turn = found[2] / self._target.size
        growth = 1.0 if self._is_rigid else 1.0 + found[3] / self._target.size
        cos, sin = growth * np.cos(turn), growth * np.sin(turn)
        small = np.array([[cos, -sin], [sin, cos]])
        offset = small @ (placement.offset - pivot) + pivot + found[:2]
        return Similarity(frozen(small @ placement.matrix), frozen(offset)), float(np.abs(found).max())


def _some(outline: Outline, most: int | None) -> tuple[Floats, Floats]:
    """Return points and weights of at most so many stations, evenly along the outline."""
    stations = outline.stations
    count = len(stations.point)
    if most is None or count <= most:
        return stations.point, stations.weight
    along = np.cumsum(stations.weight)
    chosen = np.unique(np.searchsorted(along, (np.arange(most) + 0.5) * along[-1] / most))
    return stations.point[chosen], np.ones(len(chosen))


def _is_told(step: Floats) -> NDArray[np.bool_]:
    """Return which nearest places tell anything: a chord's do not, unless there is nothing but chords."""
    curved = step == 0
    return curved if curved.any() else np.ones_like(curved)


def _trust(distance: Floats, weight: Floats, floor: float) -> Floats:
    """Return how much each residual counts, from 1 for none to nearly 0."""
    order = np.argsort(distance)
    below = np.cumsum(weight[order])
    median = distance[order][np.searchsorted(below, below[-1] / 2)]
    return 1.0 / (1.0 + (distance / max(_MEDIANS * median, floor)) ** 2) ** 2


def _directions(way: Floats, distance: Floats, normal: Floats, shortest: float) -> Floats:
    """Return unit vectors along which residuals are measured: the way to the foot, or across if there is no way."""
    clear = distance > shortest
    return np.where(clear[:, None], way / np.where(clear, distance, 1.0)[:, None], normal)


def inverse(placement: Similarity) -> Similarity:
    """Return the way back from the target's coordinates to the source's."""
    matrix = placement.matrix.T / placement.scale**2
    return Similarity(frozen(matrix), frozen(-matrix @ placement.offset))
