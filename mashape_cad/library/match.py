"""One answer of a search: `Match`."""

from dataclasses import dataclass
from pathlib import Path

from mashape_cad.library.record import ProfileRecord
from mashape_cad.matching.relation import Relation

__all__ = ["Match"]


@dataclass(frozen=True, slots=True)
class Match:
    """One part of a library that resembles the query, by the one of its profiles that resembles it most.

    Attributes
    ----------
    rank : int
        From 1, the nearest first.
    path : Path
        The part file.
    profile : int
        Number of the profile in its file, from 0.
    distance : float
        0 for equal signatures; 3 is as far as two parts of this library typically are apart.
    record : ProfileRecord
        What the sidecar keeps of that profile: size, outline and axis for pictures.
    relation : Relation or None
        What it is to the query, if the two were laid over one another.
    unverified : str or None
        Why they could not be, if that was asked for.
    """

    rank: int
    path: Path
    profile: int
    distance: float
    record: ProfileRecord
    relation: Relation | None = None
    unverified: str | None = None
