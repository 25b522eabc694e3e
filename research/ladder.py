"""What each part of the default signature gains: ``python research/ladder.py --retrieval DIR``.

Every line is one candidate, measured on labelled folders ``DIR/SET/CLASS/FILE``: bull's-eye, mean average precision and
nearest neighbour in per cent (Princeton protocol: the query is left out; bull's-eye counts it). Code books and metrics
are those shipped.
"""

import argparse
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from mashape_cad.errors import MashapeError
from mashape_cad.evaluation.measures import Protocol, means, measures
from mashape_cad.evaluation.modes import reordered, summed
from mashape_cad.medial.axis import MedialAxis, medial_axis
from mashape_cad.reading.reader import read
from mashape_cad.signatures import paper
from mashape_cad.signatures.constants import Constants, shipped
from mashape_cad.signatures.shape import described, mapped, whole
from mashape_cad.signatures.spokes import STEPS, THICKNESS, spokes

SETS = ("outlines30", "glyphs40", "parts")
Rows = list[np.ndarray]


def axes(folder: Path) -> Iterator[tuple[str, MedialAxis]]:
    """Yield class and axis of each file's first profile."""
    for path in sorted(each for each in folder.glob("*/*") if each.suffix in {".dxf", ".step"}):
        try:
            yield path.parent.name, medial_axis(read(path).profiles[0])
        except MashapeError as error:
            print(f"{path}: {error}", file=sys.stderr)


def apart(rows: np.ndarray) -> np.ndarray:
    """Return the Euclidean distances of all pairs of rows."""
    squared = (rows**2).sum(axis=1)
    return np.sqrt(np.maximum(squared[:, None] + squared - 2 * rows @ rows.T, 0.0))


def channels(parts: Rows, constants: Constants, chosen: tuple[int, ...]) -> np.ndarray:
    """Return some of the mapped parts, joined."""
    joined = np.hstack([constants.metrics[k].mapped(parts[k]) for k in chosen])
    return joined / np.linalg.norm(joined, axis=1, keepdims=True)


def paper_rungs(shapes: list[MedialAxis]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield the paper's functions and their sum."""
    found = [paper.signature(axis).vectors for axis in shapes]
    stacked = {name: np.array([each[name] for each in found]) for name in ("df", "rf", "cf")}
    for name, rows in stacked.items():
        yield f"paper {name.upper()}", summed({name: rows})
    yield "paper DF + RF + CF", summed(stacked)


def default_rungs(shapes: list[MedialAxis]) -> Iterator[tuple[str, np.ndarray]]:
    """Yield the parts of the default signature, and what its choices cost or gain."""
    constants = shipped()

    def parts(steps: int, thickness: float) -> Rows:
        rows = zip(*(described(spokes(axis, steps, thickness), constants) for axis in shapes), strict=True)
        return [np.array(each) for each in rows]

    found = parts(STEPS, THICKNESS)
    names = ("boundary contexts", "axis contexts", "the whole")
    for name, rows in zip(names, found, strict=True):
        yield f"{name}, {rows.shape[1]} numbers, no metric", apart(rows)
    for k, name in enumerate(names):
        yield f"{name}, metric", apart(channels(found, constants, (k,)))
    yield "both contexts", apart(channels(found, constants, (0, 1)))
    vectors = mapped(tuple(found), constants)
    yield "all three", apart(vectors)
    for steps, thickness in ((STEPS // 2, THICKNESS), (STEPS, 0.0), (STEPS, THICKNESS / 2), (STEPS, THICKNESS * 2)):
        other = mapped(tuple(parts(steps, thickness)), constants)
        yield f"{steps} steps, erosion thickness {thickness:g}", apart(other)
    yield "default: all three in 256 bytes", apart(whole(vectors))
    yield "default, re-ranked", reordered({"shape": whole(vectors)})


def main(arguments: list[str] | None = None) -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--retrieval", type=Path, required=True)
    parser.add_argument("--sets", nargs="+", default=SETS)
    given = parser.parse_args(arguments)
    table: dict[str, list[str]] = {}
    for name in given.sets:
        labels, shapes = zip(*axes(given.retrieval / name), strict=True)
        rungs: tuple[Callable[[list[MedialAxis]], Iterator[tuple[str, np.ndarray]]], ...] = (paper_rungs, default_rungs)
        for rung in rungs:
            for title, distances in rung(list(shapes)):
                mean = means(measures(distances, list(labels), Protocol.PRINCETON))
                figures = [mean["bulls_eye"], mean["average_precision"], mean["nearest_neighbour"]]
                table.setdefault(title, []).append(" / ".join(f"{100 * value:.1f}" for value in figures))
                print(name, title, table[title][-1], file=sys.stderr, flush=True)
    print("| candidate | " + " | ".join(given.sets) + " |")
    print("|---|" + "---|" * len(given.sets))
    for title, cells in table.items():
        print(f"| {title} | " + " | ".join(cells) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
