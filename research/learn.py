"""Learn the constants of the default signature, from generated shapes alone: ``python research/learn.py``.

Same seed and number of groups, same shapes; the last digits of sums differ between processors and releases, and the
choice of words magnifies them: two runs agree to half a point of what the ladder measures. It takes five to thirty
minutes.
"""

import argparse
import multiprocessing
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from generator import group
from learning import books, learned, sample
from outlines import profile
from shapely.errors import GEOSException

from mashape_cad.errors import MashapeError
from mashape_cad.medial.axis import MedialAxis, medial_axis
from mashape_cad.signatures import constants
from mashape_cad.signatures.constants import Constants, write_constants
from mashape_cad.signatures.shape import described
from mashape_cad.signatures.spokes import spokes

SEED = 31
GROUPS = 840
VARIANTS = 8
# Groups from whose shapes the words are learned.
SAMPLED = 150
OUT = Path(constants.__file__).with_name(constants.FILE)


def axes(number: int) -> list[MedialAxis]:
    """Return the axes of a group's variants; outlines that came to cross themselves are left out."""
    try:
        return list(_axes(group(number, VARIANTS, SEED)))
    except GEOSException:
        return []


def _axes(shapes: list) -> Iterator[MedialAxis]:
    for shape in shapes:
        try:
            yield medial_axis(profile(shape))
        except MashapeError:
            continue


def parts_of(task: tuple[int, Constants]) -> list[tuple[np.ndarray, ...]]:
    """Return what a group's shapes are described by."""
    number, known = task
    return [described(spokes(axis), known) for axis in axes(number)]


def sampled(number: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return some contexts of a group's shapes."""
    rng = np.random.default_rng([SEED, number, 1])
    return [sample(spokes(axis), rng) for axis in axes(number)]


def main(arguments: list[str] | None = None) -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--groups", type=int, default=GROUPS)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("-o", "--output", type=Path, default=OUT)
    given = parser.parse_args(arguments)
    rng = np.random.default_rng(SEED)
    with multiprocessing.get_context("spawn").Pool(given.jobs) as pool:
        # Evenly among all groups, so that all families take part.
        some = np.unique(np.linspace(0, given.groups - 1, min(SAMPLED, given.groups)).astype(int))
        contexts = zip(*(each for found in pool.imap(sampled, some.tolist()) for each in found), strict=True)
        known = books(*(np.concatenate(rows) for rows in contexts), rng)
        parts, groups = [], []
        for number, found in enumerate(pool.imap(parts_of, ((k, known) for k in range(given.groups)), chunksize=4)):
            parts += found
            groups += [number] * len(found)
            if number % 50 == 0:
                print(f"{number} of {given.groups} groups, {len(parts)} shapes", file=sys.stderr, flush=True)
    rows = [np.array(part) for part in zip(*parts, strict=True)]
    with given.output.open("wb") as stream:
        write_constants(stream, learned(known, rows, np.array(groups), np.random.default_rng(SEED)))
    print(f"{given.output}: {given.output.stat().st_size} bytes, from {len(groups)} shapes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
