"""What share of pairs belongs together at which distance: ``python research/calibration.py --retrieval DIR``.

Of scanned labelled folders ``DIR/SET/CLASS/FILE``. The last column but one is what `mashape_cad.library.score` was laid
through, the last one what it says in the middle of the step.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from mashape_cad.evaluation.labelled import labelled_set
from mashape_cad.library.score import scores
from mashape_cad.library.shapes import Shapes

SETS = ("outlines30", "glyphs40", "parts")
STEPS = np.arange(0.0, 1.6, 0.1)


def counts(folder: Path) -> np.ndarray:
    """Return how many pairs belong together, and how many do not, by steps of distance: (2, n)."""
    found = labelled_set(folder)
    apart = Shapes.of([shape.record.shape for shape in found.shapes]).pairs()
    pairs = np.triu_indices(len(apart), 1)
    labels = np.array(found.labels)
    together = (labels[:, None] == labels)[pairs]
    return np.array([np.histogram(apart[pairs][chosen], STEPS)[0] for chosen in (together, ~together)])


def main(arguments: list[str] | None = None) -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--retrieval", type=Path, required=True)
    parser.add_argument("--sets", nargs="+", default=SETS)
    given = parser.parse_args(arguments)
    found = [counts(given.retrieval / name) for name in given.sets]
    columns = [*found, sum(found)]
    print("| distance | " + " | ".join(given.sets) + " | all | score |")
    print("|---|" + "---|" * (len(columns) + 1))
    for k, low in enumerate(STEPS[:-1]):
        shares = [f"{share(column[:, k])} of {column[:, k].sum()}" for column in columns]
        print(f"| {low:.1f} to {low + 0.1:.1f} | " + " | ".join(shares) + f" | {scores(low + 0.05):.0f} |")
    return 0


def share(pairs: np.ndarray) -> str:
    """Return the share that belongs together, per cent."""
    return f"{100 * pairs[0] / pairs.sum():.0f}" if pairs.sum() else "-"


if __name__ == "__main__":
    sys.exit(main())
