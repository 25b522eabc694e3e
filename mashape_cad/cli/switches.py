"""Command line switches made from declared options, so that a default stands in one place."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from mashape_cad.options import Declared, ReadOptions, describe

__all__ = ["as_json", "option", "output", "quiet", "read_switches"]

Command = TypeVar("Command", bound=Callable[..., Any])


def option(
    options: type,
    name: str,
    *declarations: str,
    bare: float | None = None,
    metavar: str | None = None,
    nargs: int = 1,
) -> Callable[[Command], Command]:
    """Return a switch for the field `name` of a class of `mashape_cad.options`.

    Given `bare`, the switch may stand without a value and then means that. It takes `nargs` values.
    """
    default, declared = describe(options, name)
    kind = _kind(options, name, declared)
    help_text = f"{declared.sentence} [{declared.unit}]" if declared.unit else declared.sentence
    return click.option(
        *(declarations or (f"--{name.replace('_', '-')}",)),
        name,
        type=kind,
        is_flag=kind is click.BOOL,
        flag_value=bare if bare is not None else kind is click.BOOL or None,
        metavar=metavar,
        nargs=nargs,
        default=default,
        show_default=default is not None and kind is not click.BOOL,
        help=help_text,
    )


def _kind(options: type, name: str, declared: Declared) -> click.ParamType[Any]:
    annotation = str(options.__annotations__[name])
    if declared.choices:
        return click.Choice(declared.choices)
    if "bool" in annotation:
        return click.BOOL
    if "int" in annotation:
        return click.IntRange(_whole(declared.low), _whole(declared.high))
    return click.FloatRange(declared.low, declared.high)


def _whole(number: float | None) -> int | None:
    return None if number is None else int(number)


def read_switches(command: Command) -> Command:
    """Add the switches that say how a file is read."""
    return option(ReadOptions, "unit")(option(ReadOptions, "gap_rel", "--gap")(command))


def output(*suffixes: str, required: bool = False, what: str = "Picture to draw") -> Callable[[Command], Command]:
    """Return the switch ``-o``; the file's suffix, one of `suffixes`, says what is drawn."""

    def check(_context: click.Context, _parameter: click.Parameter, path: Path | None) -> Path | None:
        if path is not None and path.suffix.lower() not in suffixes:
            raise click.BadParameter(f"{path.name!r} must end in {' or '.join(suffixes)}")
        return path

    return click.option(
        "-o",
        "--output",
        "output",
        type=click.Path(path_type=Path),
        required=required,
        callback=check,
        metavar="OUT" + "|OUT".join(suffixes),
        help=f"{what}; its suffix says which kind.",
    )


as_json = click.option("--json", "as_json", is_flag=True, help="One JSON object a line, the summary last.")
quiet = click.option("-q", "--quiet", is_flag=True, help="No progress, notes and summary.")
