"""Hits laid over the query: the question whether a part is the same one again.

A signature only says that two outlines resemble one another. Here the part files are read again, those of the hits and
the query's, since a sidecar keeps no exact curves; its light outline is good for pictures only. Importing this module
loads the kernel.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from mashape_cad.errors import KernelUnavailableError, MashapeError, QueryError
from mashape_cad.geometry.profile import Profile
from mashape_cad.library.freshness import freshness
from mashape_cad.library.match import Match
from mashape_cad.library.selection import numbered
from mashape_cad.matching.outline import Outline
from mashape_cad.matching.relating import related
from mashape_cad.matching.relation import Kind, Relation
from mashape_cad.options import PartOptions, SearchOptions
from mashape_cad.reading.reader import read

if TYPE_CHECKING:
    from mashape_cad.library.library import Query

__all__ = ["verified"]


def verified(asked: "Query", matches: Iterable[Match], parts: PartOptions, options: SearchOptions) -> Iterator[Match]:
    """Yield matches with their relation to the query, in their order, each when its file has been read and compared.

    Parameters
    ----------
    asked : Query
    matches : iterable of Match
    parts : PartOptions
        How the files were read when they were scanned.
    options : SearchOptions
        `no_mirror` leaves matches out; the ranks of the others close up.

    Yields
    ------
    Match
        One that cannot be compared, because its file has changed, is gone or has become unreadable, says why in
        `unverified`.

    Raises
    ------
    QueryError
        If the query itself has no exact outline here.
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    target = Outline(_query_profile(asked, parts))
    rank = 0
    for match in matches:
        found = _compared(target, match, parts, options)
        if options.no_mirror and found.relation and _is_mirror_image(found.relation):
            continue
        rank += 1
        yield replace(found, rank=rank)


def _is_mirror_image(relation: Relation) -> bool:
    """Whether a hit is one; what is no more than similar may lie better turned over by chance."""
    return relation.is_mirrored and relation.kind is not Kind.SIMILAR


def _query_profile(asked: "Query", parts: PartOptions) -> Profile:
    if isinstance(asked.thing, Profile):
        return asked.thing
    source = asked.path if asked.thing is None else asked.thing
    if source is None:
        raise QueryError("a record holds no exact outline to compare with; give the file, profile or object itself")
    return numbered(read(source, parts.read).profiles, asked.profile or 0, str(asked.path or "query"))


def _compared(target: Outline, match: Match, parts: PartOptions, options: SearchOptions) -> Match:
    try:
        source = Outline(_hit_profile(match.path, match.profile, parts))
        return replace(match, relation=related(target, source, options.tolerance))
    except KernelUnavailableError:
        raise
    except MashapeError as error:
        return replace(match, unverified=str(error))
    except Exception as error:  # noqa: BLE001  (a fault of ours in one hit must not cost the others)
        return replace(match, unverified=f"{match.path}: a fault of this program ({type(error).__name__}: {error})")


def _hit_profile(path: Path, number: int, parts: PartOptions) -> Profile:
    if freshness(path, parts).sidecar is None:
        raise QueryError(f"{path}: it has changed since it was scanned; scan it again")
    return numbered(read(path, parts.read).profiles, number, str(path))
