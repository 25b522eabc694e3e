"""``mashape-cad search``."""
# ruff: noqa: PLC0415  -- what a command needs is imported when it runs, so that --help answers at once

import sys
import time
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mashape_cad.cli.switches import as_json, option, output, quiet
from mashape_cad.options import SAME_SIZE, SearchOptions

if TYPE_CHECKING:
    from mashape_cad.library.library import Library, Query
    from mashape_cad.library.match import Match

__all__ = ["search"]


@click.command(short_help="Rank the parts of scanned folders by how they resemble a query.")
@click.argument("query", metavar="QUERY", type=click.Path(path_type=Path))
@click.option(
    "--profile", type=click.IntRange(0), metavar="N", help="Which profile of QUERY, from 0. [default: its first]"
)
@click.option(
    "--in",
    "folders",
    metavar="DIR",
    multiple=True,
    type=click.Path(path_type=Path),
    help="Scanned folder to search in; repeat it for more. [default: QUERY's own]",
)
@click.option("-k", "count", type=click.IntRange(1), default=10, show_default=True, help="At most so many parts.")
@option(SearchOptions, "mode")
@option(SearchOptions, "weights", nargs=3, metavar="DF RF CF")
@option(SearchOptions, "min_score", metavar="SCORE")
@option(SearchOptions, "same_size", bare=SAME_SIZE, metavar="[TOL]")
@option(SearchOptions, "holes", metavar="N")
@option(SearchOptions, "no_mirror")
@option(SearchOptions, "tolerance", metavar="TOL")
@output(".html", ".png")
@as_json
@quiet
def search(
    query: Path,
    profile: int | None,
    folders: tuple[Path, ...],
    count: int,
    mode: str,
    weights: tuple[float, float, float] | None,
    min_score: float,
    same_size: float | None,
    holes: int | None,
    no_mirror: bool,
    tolerance: float,
    output: Path | None,
    as_json: bool,
    quiet: bool,
) -> int:
    """Rank the parts of scanned folders by how much their profiles resemble one of the file QUERY.

    QUERY itself need not be scanned; if it is, it takes part and comes first, at distance 0. Each part is listed once:
    a drawing by the first of its profiles in the order of the mode, a solid by its first face.

    The score says how sure it is that a hit is of QUERY's kind: 100 for the same outline, whatever its place, size and
    edges; docs/signature.md says how it was measured.

    With --mode part the parts come first that contain most of QUERY's outline, in any place, size and sense; the
    picture shows the portion on each.

    With --mode same each hit is laid over QUERY, and said to be identical, mirrored, scaled, modified or similar, with
    the largest distance between the two outlines and the share of their area that differs.
    """
    from mashape_cad.library.folders import check_file
    from mashape_cad.library.library import Library
    from mashape_cad.views import table

    started = time.perf_counter()
    if no_mirror and mode != "same":
        raise click.UsageError("--no-mirror needs --mode same: a signature does not tell mirror images apart")
    if weights is not None and mode != "paper":
        raise click.UsageError("--weights needs --mode paper: the default signature has no functions DF, RF and CF")
    if weights is not None and not any(weights):
        raise click.UsageError("--weights must not all be 0: then nothing is compared")
    options = SearchOptions(mode, weights, min_score, same_size, holes, no_mirror, tolerance)
    check_file(query)
    library = Library(*(folders or (query.parent,)))
    if not quiet:
        _tell_what_to_know(library, query)
    asked = library.query(query, profile)
    matches = _found(library, asked, count, options, quiet)
    if as_json:
        from mashape_cad.views.answer import answer_lines

        parts = len(library.parts)
        for line in answer_lines(matches, query=query, profile=asked.profile, parts=parts, started=started):
            click.echo(line)
    else:
        table.print_matches(matches, sys.stdout, mode)
    if output is not None:
        from mashape_cad.views.page import write_sheet

        write_sheet(output, asked.record, matches, name=query.name)
    return 0


def _found(library: "Library", asked: "Query", count: int, options: SearchOptions, quiet: bool) -> "list[Match]":
    """Search; how the comparing gets on, and what could not be compared, goes to stderr."""
    if options.mode != "same":
        return library.search(asked, count, options=options)
    from mashape_cad.views.progress import comparing_progress

    bar = sys.stderr.isatty() and not quiet
    with comparing_progress(sys.stderr, min(count, len(library.parts)), bar=bar) as advance:
        matches = []
        for match in islice(library.matches(asked, options), count):
            matches.append(match)
            advance()
    for match in matches:
        if match.unverified:
            click.echo(f"not compared: {match.unverified}", err=True)
    return matches


def _tell_what_to_know(library: "Library", query: Path) -> None:
    if library.unscanned:
        click.echo(f"{len(library.unscanned)} files are not scanned yet and take no part", err=True)
    if library.outdated:
        click.echo(f"{len(library.outdated)} files have changed since they were scanned", err=True)
    if library.known(query) is None:
        click.echo(f"reading {query}, which has no sidecar that fits", err=True)
