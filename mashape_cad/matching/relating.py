"""From two outlines to what one is to the other: `related`.

All ways to lay the source over the target are tried in the order of plainness: as it is, scaled, mirrored, both.

| the outlines agree | relation |
|---|---|
| everywhere within tolerance, without scaling | ``identical``, or ``mirrored`` |
| everywhere within tolerance, scaled | ``scaled`` |
| on `_MODIFIED_COMMON` of their length, and in all but `_MODIFIED_AREA` of their area | ``modified`` |
| less | ``similar`` |

What the tolerance is depends on how exact the two are:

* as a rule it is the share of the target's size that the caller asks for, or twice the widest gap that was bridged
  to close a loop: such a drawing does not say where its edges are to better than that;
* between the vertices of a tessellated loop it is half a step at least, since what lies there is not told;
* where two exact drawings (without such gaps and loops) agree to rounding on more than half of their length, the rest
  was changed on purpose, and the tolerance is `_CHANGED`, hardly more than rounding: a hole moved by less than the
  usual tolerance still makes a drawing no copy.

Where several ways fit, the plainest is told, unless another one fits ten times better: a part that is nearly its own
mirror image, or nearly of the same size, is not taken for identical where it can be told what it really is.
"""

from dataclasses import dataclass

from mashape_cad.matching.alignment import Alignment, alignments, inverse, settled
from mashape_cad.matching.comparison import Comparison, Deviations, compared, deviations
from mashape_cad.matching.outline import Outline
from mashape_cad.matching.relation import Kind, Relation

__all__ = ["related"]

# Of the size: what a change of format, or six written digits, may move. Half of the outlines that close means that
# both come from the same numbers.
_ROUNDING = 2e-6
_SAME_NUMBERS = 0.5
# Of the size: what counts as changed where all else has the same numbers. Less is seen by no machine: 3 um on 150 mm.
_CHANGED = 2e-5
# Of the size: narrower gaps are rounding, wider ones no excuse.
_NARROWEST_GAP, _WIDEST_GAP = 2e-5, 2e-3
# Two edges that miss each other were moved together by the gap at most, either of them, and bent on the way.
_GAPS = 2.0
# Of the size: outlines that agree to this by their rings agree as well as rings can tell, and nothing else is tried.
_AGREES = 1e-5
# How many times better a less plain way has to fit, and by how much of the length more it has to agree.
_BETTER, _MORE = 10.0, 0.02
# A hole too many, of half the part's width, takes a fifth of its area and adds a third to its outline. Plates that
# share three of four sides agree on three quarters at most: what is longer by a tenth is modified, a longer one not.
_MODIFIED_COMMON, _MODIFIED_AREA = 2 / 3, 0.3
# Of the length: outlines that agree on less by their rings are no more than similar, and the kernel is spared.
_WORTH_SETTLING = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class _Reading:
    alignment: Alignment
    found: Deviations
    tolerance: float


def related(target: Outline, source: Outline, tolerance: float, *, mirror: bool = True) -> Relation:
    """Say what the source is to the target.

    Parameters
    ----------
    target, source : Outline
        The query's outline and the hit's.
    tolerance : float
        Deviation up to which outlines count as the same, as a fraction of the target's size.
    mirror : bool
        Whether mirror images count.
    """
    chosen = _chosen(target, source, tolerance, mirror=mirror)
    alike = chosen.found.share(chosen.tolerance) >= _WORTH_SETTLING
    alignment = settled(target, source, chosen.alignment) if alike else chosen.alignment
    return _judged(target, source, compared(target, source, alignment, by_kernel=alike), tolerance)


def _chosen(target: Outline, source: Outline, tolerance: float, *, mirror: bool) -> _Reading:
    """Return the plainest way that fits; if none does, the one that agrees on most."""
    readings: list[_Reading] = []
    for alignment in alignments(target, source, mirror=mirror):
        found = deviations(target, source, alignment.placement, by_kernel=False)
        readings.append(_Reading(alignment, found, _tolerance(target, source, alignment, found, tolerance)))
        if found.largest <= _AGREES * target.size:
            break
    fitting = [each for each in readings if each.found.share(each.tolerance) == 1.0]
    best, *others = fitting or readings
    for each in others:
        if fitting:
            is_better = each.found.mean * _BETTER < best.found.mean
        else:
            is_better = each.found.share(each.tolerance) > best.found.share(best.tolerance) + _MORE
        best = each if is_better else best
    return best


def _tolerance(target: Outline, source: Outline, alignment: Alignment, found: Deviations, asked: float) -> float:
    """Return the tolerance for these two, mm of the target."""
    gap = max(target.profile.gap, source.profile.gap * alignment.placement.scale) / target.size
    is_exact = gap <= _NARROWEST_GAP and not target.is_tessellated and not source.is_tessellated
    if is_exact and found.share(_ROUNDING * target.size) >= _SAME_NUMBERS:
        return min(asked, _CHANGED) * target.size
    return max(asked, _GAPS * min(gap, _WIDEST_GAP)) * target.size


def _judged(target: Outline, source: Outline, comparison: Comparison, asked: float) -> Relation:
    alignment, found = comparison.alignment, comparison.deviations
    tolerance = _tolerance(target, source, alignment, found, asked)
    common = found.share(tolerance)
    (a, b), (c, d) = alignment.placement.matrix.tolist()
    x, y = alignment.placement.offset.tolist()
    return Relation(
        kind=_kind(alignment, common, comparison.area_difference, fits=bool(found.within(tolerance).all())),
        scale=1.0 if alignment.is_rigid else inverse(alignment.placement).scale,
        is_mirrored=alignment.placement.mirrors,
        deviation_mm=found.largest,
        area_difference=comparison.area_difference,
        common=common,
        tolerance_mm=tolerance,
        placement=(a, b, c, d, x, y),
    )


def _kind(alignment: Alignment, common: float, area_difference: float, *, fits: bool) -> Kind:
    if fits and not alignment.is_rigid:
        return Kind.SCALED
    if fits:
        return Kind.MIRRORED if alignment.placement.mirrors else Kind.IDENTICAL
    if common >= _MODIFIED_COMMON and area_difference <= _MODIFIED_AREA:
        return Kind.MODIFIED
    return Kind.SIMILAR
