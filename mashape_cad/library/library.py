"""One or more folders of sidecars, searchable: `Library`."""

import shlex
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mashape_cad.errors import LibraryError, SidecarError
from mashape_cad.library.folders import check_folder, part_files
from mashape_cad.library.freshness import freshness
from mashape_cad.library.match import Match
from mashape_cad.library.ranking import PAPER_VECTORS, Floats, Singles, Stack, rising
from mashape_cad.library.record import CURRENT_SHAPE, CURRENT_SIGNATURE, ProfileRecord, Sidecar
from mashape_cad.library.score import scores
from mashape_cad.library.selection import comparable, profiles_of
from mashape_cad.library.shapes import Shapes
from mashape_cad.library.sidecar import UnknownVersionError, read_sidecar, sidecar_path
from mashape_cad.options import PartOptions, SearchOptions

if TYPE_CHECKING:
    from mashape_cad.library.outer_loops import OuterLoops
    from mashape_cad.library.portions import Portions

__all__ = ["Library", "Query"]


@dataclass(frozen=True, slots=True)
class Query:
    """One profile to search with.

    Attributes
    ----------
    record : ProfileRecord
    path : Path or None
        Its file, if it comes from one.
    profile : int or None
        Its number in that file or object.
    thing : Profile or kernel object or None
        What it was made of, if not of a file.
    """

    record: ProfileRecord
    path: Path | None = None
    profile: int | None = None
    thing: Any = None


# Shares are sums: all of them may be a digit short of 100.
_ROUNDING = 1e-9


class Library:
    """The scanned parts below one or more folders.

    Sidecars are read once, when the library is made; the kernel is not needed, unless a query has no sidecar.

    Parameters
    ----------
    *folders : path
        Walked through with all their subfolders.

    Attributes
    ----------
    parts : tuple of (Path, Sidecar)
        Those with at least one comparable profile, by name.
    options : PartOptions
        What shaped all their sidecars; a query without sidecar is read with the same.
    unscanned : tuple of Path
        Part files without a sidecar that can be read.
    outdated : tuple of Path
        Part files whose size or time is no longer what their sidecar says.

    Raises
    ------
    LibraryError
        If a folder does not exist or was not scanned, or its sidecars cannot be compared with one another.
    """

    def __init__(self, *folders: str | PathLike[str]) -> None:
        self.folders = tuple(Path(folder) for folder in folders)
        read = dict(_sidecars(self.folders))
        self.unscanned = tuple(path for path, sidecar in read.items() if sidecar is None)
        known = {path: sidecar for path, sidecar in read.items() if sidecar is not None}
        self.outdated = tuple(path for path, sidecar in known.items() if _is_outdated(path, sidecar))
        self.parts = tuple(
            (path, sidecar)
            for path, sidecar in sorted(known.items(), key=lambda item: item[0].as_posix())
            if any(_comparable(sidecar))
        )
        self._check_there_is_something(len(read), len(known))
        self.options = self._common_options()
        self._rows = _Rows.of(self.parts)

    def search(
        self, query: Any, k: int = 10, *, profile: int | None = None, options: SearchOptions | None = None
    ) -> list[Match]:
        """Return the parts that resemble a query most, the nearest first.

        Parameters
        ----------
        query : path, Profile, kernel object, ProfileRecord or Query
            See `query`.
        k : int
            At most so many parts.
        profile : int, optional
            Which profile of the query, from 0.
        options : SearchOptions, optional
            In mode ``same`` each match has a `Match.relation`: its file is read again and compared with the query's;
            those with the query's outer loop come before all others. In mode ``part`` each has a `Match.portion`, and
            the matches are ordered by its share.

        Returns
        -------
        list of Match
            One for each part: a drawing by the first of its profiles in the order of the mode, a solid by its first
            face (all plates have similar sides). The query's own file takes part, with the very profile that was asked
            with, and comes first, at distance 0. Equal distances are ordered by name, the query's own file before all
            others.

        Raises
        ------
        QueryError, NoProfileError, UnreadableFileError
            If the query has no profile that can be compared.
        ValueError
            If `k` is not positive.
        """
        if k < 1:
            raise ValueError(f"k must be at least 1, not {k}")
        return list(islice(self.matches(self.query(query, profile), options or SearchOptions()), k))

    def matches(self, asked: Query, options: SearchOptions) -> Iterator[Match]:
        """Yield the parts that resemble a query, the nearest first, as `search` returns them.

        In mode ``same`` those with the query's outer loop are first, and each is compared with the query when its turn
        comes; in mode ``part`` only parts that have a portion of the query come at all.
        """
        if options.mode == "part":
            return self._containing(asked, options)
        if options.mode != "same":
            return self._ranked(asked, options)
        from mashape_cad.library.verification import verified  # noqa: PLC0415  (loads the kernel)

        return verified(asked, self._ranked(asked, options), self.options, options)

    def _ranked(self, asked: Query, options: SearchOptions) -> Iterator[Match]:
        shape_distances = self._rows.shapes.distances(asked.record.shape or ())
        score = scores(shape_distances)
        distances = shape_distances if options.mode != "paper" else self._paper_distances(asked, options)
        passing = self._passing(asked, options) & (score >= options.min_score)
        ranked = self._order(asked, distances)
        if options.mode == "reranked":
            ranked = self._reranked(asked, ranked)
        if options.mode == "same":
            ranked = self._same_outer_loop_first(asked, ranked)
        order = ranked[passing[ranked]]
        _, first = np.unique(self._rows.part[order], return_index=True)
        for rank, place in enumerate(np.sort(first).tolist(), start=1):
            row = int(order[place])
            yield self._match(rank, row, float(distances[row]), float(score[row]))

    def _containing(self, asked: Query, options: SearchOptions) -> Iterator[Match]:
        """Yield the parts that contain a portion of the query, the largest first; of equal ones the most alike.

        A least score is one of portions here: a part that contains all of a query in a larger body is unlike it.
        """
        distances = self._rows.shapes.distances(asked.record.shape or ())
        score = scores(distances)
        order = self._order(asked, distances)
        listed = set[int]()
        for row, portion in self._portions.found(asked.record, order[self._passing(asked, options)[order]]):
            if 100 * portion.share < options.min_score - _ROUNDING:
                return
            if (part := int(self._rows.part[row])) not in listed:
                listed.add(part)
                match = self._match(len(listed), row, float(distances[row]), float(score[row]))
                yield replace(match, portion=portion)

    def _same_outer_loop_first(self, asked: Query, order: NDArray[np.intp]) -> NDArray[np.intp]:
        """Return rows in their order, those first whose outer loop may be the query's, whatever their holes."""
        same = self._outer_loops.same(asked.record)[order]
        return np.concatenate([order[same], order[~same]])

    @cached_property
    def _outer_loops(self) -> "OuterLoops":
        """Made when it is asked for: it looks at every outline of the library."""
        from mashape_cad.library.outer_loops import OuterLoops  # noqa: PLC0415  (no other search looks at outlines)

        return OuterLoops(self._rows.records)

    @cached_property
    def _portions(self) -> "Portions":
        """Made when it is asked for: it looks at every branch of the library."""
        from mashape_cad.library.portions import Portions  # noqa: PLC0415  (loads scipy)

        return Portions(self._rows.records)

    def _reranked(self, asked: Query, order: NDArray[np.intp]) -> NDArray[np.intp]:
        """Return rows that are in plain order by their neighbours' neighbours as well; the query's own entry first."""
        from mashape_cad.library.neighbours import SHORTLIST, reranked  # noqa: PLC0415  (loads scipy)

        own, chosen, rest = order[:0], order[:SHORTLIST], order[SHORTLIST:]
        if self._is_asked(asked)[chosen[0]]:
            own, chosen = chosen[:1], chosen[1:]
        rows = np.vstack([np.asarray(asked.record.shape, dtype=np.float32), self._rows.shapes.rows[chosen]])
        places = reranked(Shapes.of(rows).pairs(), 0)
        return np.concatenate([own, chosen[places[1:] - 1], rest])

    def _paper_distances(self, asked: Query, options: SearchOptions) -> Floats:
        weights = dict(zip(PAPER_VECTORS, options.weights or (1.0, 1.0, 1.0), strict=True))
        return self._paper_stack.distances(asked.record.vectors or {}, weights)

    @cached_property
    def _paper_stack(self) -> Stack:
        """Made when it is asked for: its medians take longer than a search."""
        return Stack.of([record.vectors or {} for record in self._rows.records], self._rows.stands_for_part)

    def _passing(self, asked: Query, options: SearchOptions) -> NDArray[np.bool_]:
        """Return whether each row has the size and the holes that are asked for."""
        passing = np.ones(len(self._rows.part), dtype=np.bool_)
        if options.holes is not None:
            passing &= self._rows.holes == options.holes
        if options.same_size is not None:
            passing &= np.abs(np.sqrt(self._rows.area / asked.record.area) - 1) <= options.same_size
        return passing

    def query(self, query: Any, profile: int | None = None) -> Query:
        """Return the profile to search with.

        Parameters
        ----------
        query : path, Profile, kernel object, ProfileRecord or Query
            A file's fresh sidecar is used; without one the file is read and its medial axis computed here, as for a
            profile or an object of the kernel (or one that wraps such: a face, wire or sketch).
        profile : int, optional
            Which profile of it, from 0; not given, the first that can be compared.

        Raises
        ------
        QueryError, NoProfileError, UnreadableFileError
            If there is none.
        """
        if isinstance(query, Query):
            return query
        if isinstance(query, str | PathLike):
            path = Path(query)
            records = profiles_of(self.known(path) or self._derived(path), str(path))
            number = comparable(records, profile, str(path))
            return Query(records[number], path, number)
        records = (query,) if isinstance(query, ProfileRecord) else self._records(query)
        number = comparable(records, profile, "query")
        return Query(records[number], profile=number, thing=None if isinstance(query, ProfileRecord) else query)

    def known(self, path: Path) -> Sidecar | None:
        """Return the sidecar of a file if it is fresh and can be compared with this library, else None.

        Raises
        ------
        UnreadableFileError
            If there is no such file.
        UnknownVersionError
            If its sidecar was written by a newer release.
        """
        return freshness(path, self.options).sidecar

    def _derived(self, path: Path) -> Sidecar:
        from mashape_cad.library.derivation import derive  # noqa: PLC0415  (loads the kernel)

        return derive(path, self.options)

    def _records(self, thing: Any) -> tuple[ProfileRecord, ...]:
        from mashape_cad.library.derivation import records_of  # noqa: PLC0415  (loads the kernel)

        return records_of(thing, self.options)

    def _check_there_is_something(self, files: int, known: int) -> None:
        names = ", ".join(map(str, self.folders))
        if self.parts:
            return
        if not files:
            raise LibraryError(f"{names}: no part files in it; give a folder of DXF, STEP or BREP files")
        if not known:
            raise LibraryError(f"{names}: not scanned yet; run: {self._scan_command()}", self.folders)
        raise LibraryError(f"{names}: no profile that can be compared; to see why, run: {self._scan_command()} --json")

    def _common_options(self) -> PartOptions:
        shaped = {(sidecar.signature, sidecar.shape_signature, sidecar.options) for _, sidecar in self.parts}
        if len(shaped) > 1 or next(iter(shaped))[:2] != (CURRENT_SIGNATURE, CURRENT_SHAPE):
            raise LibraryError(
                "its sidecars were made with other signatures or options, so that their distances mean nothing; "
                f"run: {self._scan_command()}",
                self.folders,
            )
        return next(iter(shaped))[2]

    def _scan_command(self) -> str:
        return shlex.join(["mashape-cad", "scan", *map(str, self.folders)])

    def _order(self, asked: Query, distances: Floats | Singles) -> NDArray[np.intp]:
        """Return the rows, nearest first; of equal ones the query's own file first, then by name, then by number."""
        rows, is_asked = self._rows, self._is_asked(asked)
        taking_part = np.flatnonzero(rows.stands_for_part | is_asked)
        # Rows are in the order of names and numbers already: what is left to sort is quickly sorted, stably.
        after = np.where(is_asked, 0, np.where(rows.part == self._own_part(asked.path), 1, 2)).astype(np.uint8)
        taking_part = taking_part[np.argsort(after[taking_part], kind="stable")]
        return taking_part[rising(distances[taking_part])]

    def _is_asked(self, asked: Query) -> NDArray[np.bool_]:
        """Return whether each row is the very profile that is asked with."""
        return (self._rows.part == self._own_part(asked.path)) & (self._rows.profile == asked.profile)

    def _own_part(self, path: Path | None) -> int:
        """Return which part is the query's own file, -1 if none."""
        named = self._numbers_by_name.get(path.name, []) if path is not None else []
        return next((number for number in named if path and _is_same(self.parts[number][0], path)), -1)

    @cached_property
    def _numbers_by_name(self) -> dict[str, list[int]]:
        """Numbers of the parts by the names of their files."""
        found = dict[str, list[int]]()
        for number, (part, _) in enumerate(self.parts):
            found.setdefault(part.name, []).append(number)
        return found

    def _match(self, rank: int, row: int, distance: float, score: float) -> Match:
        path, _ = self.parts[self._rows.part[row]]
        return Match(rank, path, int(self._rows.profile[row]), distance, self._rows.records[row], score)


@dataclass(frozen=True, slots=True, eq=False)
class _Rows:
    """All comparable profiles of a library, a row each: whose they are, and whether they stand for their part."""

    part: NDArray[np.intp]
    profile: NDArray[np.intp]
    stands_for_part: NDArray[np.bool_]
    records: tuple[ProfileRecord, ...]
    area: Floats
    holes: NDArray[np.intp]
    shapes: Shapes

    @classmethod
    def of(cls, parts: tuple[tuple[Path, Sidecar], ...]) -> "_Rows":
        rows = [
            (part, number, position == 0 or record.origin.face is None, record)
            for part, (_, sidecar) in enumerate(parts)
            for position, (number, record) in enumerate(_comparable(sidecar))
        ]
        part, profile, stands_for_part, records = zip(*rows, strict=True)
        area, holes = (np.array([getattr(record, name) for record in records]) for name in ("area", "holes"))
        shapes = Shapes.of([record.shape or () for record in records])
        return cls(np.array(part), np.array(profile), np.array(stands_for_part), records, area, holes, shapes)


def _comparable(sidecar: Sidecar) -> Iterator[tuple[int, ProfileRecord]]:
    return ((number, record) for number, record in enumerate(sidecar.profiles) if record.vectors)


def _sidecars(folders: tuple[Path, ...]) -> Iterator[tuple[Path, Sidecar | None]]:
    """Yield each part file once with its sidecar, or None if it has none that can be read."""
    seen = set[Path]()
    for folder in folders:
        check_folder(folder)
        for path in part_files(folder, lambda *_: None):  # what a scan could not list has no sidecars either
            if path.absolute() not in seen:
                seen.add(path.absolute())
                yield path, _sidecar(path)


def _sidecar(path: Path) -> Sidecar | None:
    try:
        return read_sidecar(sidecar_path(path))
    except UnknownVersionError as error:
        raise LibraryError(str(error)) from error
    except SidecarError:
        return None


def _is_same(one: Path, other: Path) -> bool:
    try:
        return one.samefile(other)
    except OSError:  # gone since
        return False


def _is_outdated(path: Path, sidecar: Sidecar) -> bool:
    try:
        status = path.stat()
    except OSError:
        return True
    return (status.st_size, status.st_mtime_ns) != (sidecar.source.size, sidecar.source.mtime_ns)
