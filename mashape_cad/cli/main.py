"""The program ``mashape-cad``: its commands, how errors are told, and the exit codes.

0 done, 1 failed, 2 not understood, 3 done but some files failed, 130 interrupted. Results go to stdout, all else to
stderr.
"""

import os
import sys
import warnings
from collections.abc import Callable, Sequence

import click

from mashape_cad.cli.axis import axis
from mashape_cad.cli.certify import certify
from mashape_cad.cli.evaluate import evaluate
from mashape_cad.cli.scan import scan
from mashape_cad.cli.search import search
from mashape_cad.cli.serve import serve
from mashape_cad.cli.show import show
from mashape_cad.errors import MashapeError
from mashape_cad.version import __version__

__all__ = ["main"]

FAILED = 1
INTERRUPTED = 130
# Set to anything, faults of this program end with Python's own report, for whoever looks into them.
TRACEBACK = "MASHAPE_TRACEBACK"


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="mashape-cad")
def commands() -> None:
    """Find parts of similar shape in folders of DXF, STEP and BREP files.

    First scan a folder, then search in it with a file. Profiles are counted from 0: number 0 of a file is its first and
    largest.
    """


for _command in (scan, search, show, axis, certify, evaluate, serve):
    commands.add_command(_command)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the command line unless given.

    Returns
    -------
    int
        The exit code.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # not under a test that replaced it
            stream.reconfigure(encoding="utf-8", errors="replace")
    if not sys.warnoptions:
        warnings.simplefilter("ignore")  # of libraries about bad data; ours are findings
    return _guarded(lambda: int(commands.main(arguments, prog_name="mashape-cad", standalone_mode=False) or 0))


def _guarded(run: Callable[[], int]) -> int:
    """Return the exit code of a run; whatever ends it is told in one line."""
    try:
        code = run()
        sys.stdout.flush()
    except (KeyboardInterrupt, click.Abort):
        code = _told("interrupted; what was written is whole, the next run goes on from there", INTERRUPTED)
    except click.ClickException as error:
        error.show()
        code = error.exit_code
    except BrokenPipeError:
        code = FAILED
        _forget_stdout()
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        code = _told(f"error: {_sentence(error)}", FAILED)
    return code


def _sentence(error: Exception) -> str:
    if isinstance(error, MashapeError):
        return str(error)
    if isinstance(error, OSError):
        return f"{error.filename}: {error.strerror}" if error.filename else str(error)
    return f"a fault of this program ({type(error).__name__}: {error}); please report it, with {TRACEBACK}=1"


def _told(text: str, code: int) -> int:
    click.echo(f"mashape-cad: {' '.join(text.split())}", err=True)
    return code


def _forget_stdout() -> None:
    """Let Python's last flush go nowhere: whoever read our output has had enough."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
