"""The answer to one query as JSON lines, the same ones for `search --json` and for `serve`."""

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from mashape_cad.library.match import Match
from mashape_cad.views.messages import match_message, search_summary

__all__ = ["answer_lines"]


def answer_lines(
    matches: Iterable[Match],
    *,
    query: Path | None,
    profile: int | None,
    parts: int,
    started: float,
    always: Mapping[str, Any] | None = None,
    more: Callable[[Match], Mapping[str, Any]] | None = None,
) -> Iterator[str]:
    """Yield a line for each match as soon as it is there, the summary last.

    Parameters
    ----------
    matches : iterable of Match
    query : Path or None
        File of the query, if it comes from one.
    profile : int or None
        Which of its profiles it is.
    parts : int
        How many parts took part.
    started : float
        When the search began, by `time.perf_counter`.
    always : mapping, optional
        Fields of every line.
    more : callable, optional
        Further fields of a match.
    """
    always = always or {}
    found = 0
    for found, match in enumerate(matches, start=1):  # noqa: B007  (the last number is wanted)
        yield match_message(match, **always, **(more(match) if more else {}))
    yield search_summary(query, profile, found, parts, time.perf_counter() - started, **always)
