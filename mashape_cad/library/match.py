"""One answer of a search: `Match`."""

from dataclasses import dataclass
from pathlib import Path

from mashape_cad.library.record import ProfileRecord
from mashape_cad.matching.portion import Portion
from mashape_cad.matching.relation import Relation

__all__ = ["Match"]


@dataclass(frozen=True, slots=True)
class Match:
    """One part of a library that resembles the query, by the one of its profiles that resembles it most.

    Attributes
    ----------
    rank : int
        From 1, in the order of the search's mode.
    path : Path
        The part file.
    profile : int
        Number of the profile in its file, from 0.
    distance : float
        Of the signatures, 0 for equal ones: from 0 to 2, or in mode ``paper`` about 3 between two parts of this library
        that have nothing in common.
    record : ProfileRecord
        What the sidecar keeps of that profile: size, outline and axis for pictures.
    score : float
        How sure it is that both are of one kind, 0 to 100: see `mashape_cad.library.score`.
    relation : Relation or None
        What it is to the query, if the two were laid over one another.
    unverified : str or None
        Why they could not be, if that was asked for.
    portion : Portion or None
        What it has of the query's outline, if that was asked for.
    """

    rank: int
    path: Path
    profile: int
    distance: float
    record: ProfileRecord
    score: float
    relation: Relation | None = None
    unverified: str | None = None
    portion: Portion | None = None
