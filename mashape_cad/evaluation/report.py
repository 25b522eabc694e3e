"""All that is said of a labelled set: its evaluation, the coarser sampling beside it, times, and the paper's tables."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mashape_cad.evaluation.evaluation import Evaluation, Times, evaluated, total_times
from mashape_cad.evaluation.labelled import LabelledSet
from mashape_cad.evaluation.modes import Mode, stacked
from mashape_cad.evaluation.published import PublishedTable, published
from mashape_cad.evaluation.trial import Trial, coarser

__all__ = ["Report", "report"]


@dataclass(frozen=True, slots=True, eq=False)
class Report:
    """An evaluated set.

    Attributes
    ----------
    labelled : LabelledSet
    full : Evaluation
        With the signatures that the sidecars hold.
    coarse : Evaluation or None
        With signatures from half as many stations; None if not asked for, or not known of every shape.
    times : Times or None
        None if not asked for, or not known of every shape.
    published : tuple of PublishedTable
        The paper's tables whose modes were evaluated, if the set has the paper's classes.
    drawn : tuple of str
        Names of the modes whose hits are worth a picture.
    """

    labelled: LabelledSet
    full: Evaluation
    coarse: Evaluation | None
    times: Times | None
    published: tuple[PublishedTable, ...]
    drawn: tuple[str, ...]

    @property
    def per_edge(self) -> int:
        """Stations on an edge of the signatures that the sidecars hold."""
        return self.labelled.options.signature.per_edge

    def evaluation(self, per_edge: int) -> Evaluation | None:
        """Return the evaluation with so many stations on an edge, if there is one."""
        return {self.per_edge: self.full, coarser(self.per_edge): self.coarse}.get(per_edge)


def report(labelled: LabelledSet, modes: Sequence[Mode], trials: Mapping[Path, Trial]) -> Report:
    """Evaluate a set.

    Parameters
    ----------
    labelled : LabelledSet
    modes : sequence of Mode
    trials : mapping of Path to Trial
        Those of its shapes; with fewer than all, the report is without sampling and times.
    """
    shapes, labels = labelled.shapes, labelled.labels
    full = evaluated(labels, stacked([shape.record.compared for shape in shapes]), modes)
    tables = tuple(table for table in published(labels) if table.mode in full.modes)
    drawn = tuple(mode.name for mode in modes if mode.name in full.modes and (mode.is_drawn or len(modes) == 1))
    if any(shape.path not in trials for shape in shapes):
        return Report(labelled, full, None, None, tables, drawn)
    made = [trials[shape.path] for shape in shapes]
    coarse = evaluated(labels, stacked([each.coarse for each in made]), modes)
    return Report(labelled, full, coarse, total_times(made, full, coarse), tables, drawn)
