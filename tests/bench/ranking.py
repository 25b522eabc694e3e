"""How long one query takes in a large library: ``python tests/bench/ranking.py [--profiles N]``.

CPU milliseconds, medians, of signatures drawn at random: numpy's plain matrix product, the distances that a search
computes with it, and these with the order of all profiles.
"""

import argparse
import sys

import numpy as np
from cpu import median_ms, timed

from mashape_cad.library.ranking import rising
from mashape_cad.library.shapes import UNIT, Shapes

REPEATS = 25


def main(arguments: list[str] | None = None) -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--profiles", type=int, default=100_000)
    given = parser.parse_args(arguments)
    rng = np.random.default_rng(1)
    rows = np.rint(rng.normal(scale=UNIT / 16, size=(given.profiles, 256)))
    shapes, query = Shapes.of(np.clip(rows, -127, 127)), np.clip(rows[0], -127, 127)

    def once() -> dict[str, float]:
        single = query.astype(np.float32)
        distances, all_of_it = timed(lambda: shapes.distances(query))
        return {
            "numpy's matrix product": timed(lambda: shapes.rows @ single)[1],
            "distances": all_of_it,
            "order of them": timed(lambda: rising(distances))[1],
        }

    for name, milliseconds in median_ms(once, REPEATS).items():
        print(f"{name}: {milliseconds:.1f} ms")
    return 0


if __name__ == "__main__":
    sys.exit(main())
