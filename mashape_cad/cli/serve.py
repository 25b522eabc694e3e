"""``mashape-cad serve``."""
# ruff: noqa: PLC0415  -- what a command needs is imported when it runs, so that --help answers at once

import click

__all__ = ["serve"]


@click.command(short_help="Answer a plug-in of a CAD program, in JSON lines over stdin and stdout.")
def serve() -> int:
    """Answer a plug-in of a CAD program, in JSON lines over stdin and stdout, until stdin ends.

    For programs, not for people: docs/serve.md describes the lines.
    """
    from mashape_cad.serving.channel import claimed_stdout, lines_of

    answers = claimed_stdout()  # before anything else can write there
    from mashape_cad.serving.server import serve as answer

    answer(lines_of(0), answers)
    return 0
