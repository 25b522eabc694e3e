"""Which parts contain a portion of a query: found by their branches, then laid over one another.

All is taken from the light pictures in sidecars, good to 1/5000 of the size, so that no part is opened. First every
branch of the query looks for its like in the whole library; one that few parts have tells more than one that is
everywhere, as a rare word does in a text. The parts with the most in common are then compared as outlines.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.distance import cdist

from mashape_cad.geometry.edge import Floats
from mashape_cad.library.polylines import branches_of, loops_of
from mashape_cad.library.record import ProfileRecord
from mashape_cad.matching.containing import Contour, common_portion
from mashape_cad.matching.frames import Frames, frames
from mashape_cad.matching.portion import Portion

__all__ = ["Portions"]

# Branches whose signatures are this far apart have nothing in common.
_ALIKE = 0.6
# So many parts are compared as outlines, those with the most in common.
_COMPARED = 60
# A portion of less than this share of the query is chance: any two outlines have a corner in common.
_LEAST = 0.15


class Portions:
    """The branches of a library's profiles.

    Parameters
    ----------
    records : sequence of ProfileRecord
    """

    def __init__(self, records: Sequence[ProfileRecord]) -> None:
        self._records = records
        self._frames = [frames(branches_of(record.thumbnail)) for record in records]
        self._row = np.repeat(np.arange(len(records)), [len(each.radius) for each in self._frames])
        self._signature = np.concatenate([each.signature for each in self._frames])

    def found(self, asked: ProfileRecord, rows: NDArray[np.intp]) -> list[tuple[int, Portion]]:
        """Return which of some rows contain a portion of a query, the largest first.

        Parameters
        ----------
        asked : ProfileRecord
        rows : (n,) array
            Those that take part.

        Returns
        -------
        list of (row, Portion)
        """
        own = frames(branches_of(asked.thumbnail))
        votes = self._votes(own)[rows]
        contour = Contour.of(loops_of(asked.thumbnail))
        found = []
        for row in rows[np.argsort(-votes, kind="stable")[:_COMPARED]].tolist():
            hit = Contour.of(loops_of(self._records[row].thumbnail))
            portion = common_portion(contour, own, hit, self._frames[row])
            if portion is not None and portion.share >= _LEAST:
                found.append((row, portion))
        return sorted(found, key=lambda each: -each[1].share)

    def _votes(self, own: Frames) -> Floats:
        """Return how much each row has in common with the query's branches, (n,)."""
        likeness = np.zeros((len(own.radius), len(self._records)))
        for signature in (own.signature, own.mirrored):
            alike = 1 - cdist(signature, self._signature, "sqeuclidean") / _ALIKE**2
            np.maximum.at(likeness.T, self._row, alike.T)
        rarity = np.log((1 + len(self._records)) / (1 + np.count_nonzero(likeness > 0, axis=1)))
        return rarity @ likeness
