"""Every option, declared once: its default, unit, range and one sentence.

`describe` returns what is declared; the command line builds its switches from it, the flows refuse values outside the
range with it. No default stands anywhere else.
"""

from dataclasses import dataclass, field, fields
from typing import Any

__all__ = [
    "AXIS_STEP_REL",
    "SAME_SIZE",
    "AxisOptions",
    "Declared",
    "EvaluateOptions",
    "PartOptions",
    "ReadOptions",
    "ScanOptions",
    "SearchOptions",
    "SignatureOptions",
    "describe",
]

# Names as files and people write them; what each is worth in millimetres is the reader's business.
UNIT_NAMES = ("mm", "cm", "m", "in", "ft", "um")
# Spacing of an axis' samples where none is asked for, as a fraction of the profile's diagonal: finer than a screen
# shows, at some hundred samples for a plain part.
AXIS_STEP_REL = 0.005
# How much sizes may differ that count as the same where no number is given: a hole more or less changes the area by
# some per cent.
SAME_SIZE = 0.05


@dataclass(frozen=True, slots=True)
class Declared:
    """What is declared of one option.

    Attributes
    ----------
    sentence : str
        What it does.
    unit : str
        Of its value; empty for counts, names and switches.
    low, high : float or None
        Smallest and largest value that makes sense, both included.
    choices : tuple of str
        The only values allowed, for names.
    """

    sentence: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] = ()

    def complaint(self, value: Any) -> str | None:
        """Return what is wrong with a value, or None."""
        if value is None:
            return None
        if isinstance(value, tuple):
            return next(filter(None, map(self.complaint, value)), None)
        if self.choices and value not in self.choices:
            return f"must be one of {', '.join(self.choices)}, not {value!r}"
        if self.low is not None and value < self.low:
            return f"must be at least {self.low:g}, not {value!r}"
        if self.high is not None and value > self.high:
            return f"must be at most {self.high:g}, not {value!r}"
        return None


def _option(default: Any, sentence: str, **more: Any) -> Any:
    return field(default=default, metadata={"declared": Declared(sentence, **more)})


def describe(options: type, name: str) -> tuple[Any, Declared]:
    """Return default and declaration of one option.

    Parameters
    ----------
    options : type
        One of the classes of this module.
    name : str
        Name of its field.

    Raises
    ------
    KeyError
        If there is no such option.
    """
    found = {each.name: each for each in fields(options)}[name]
    return found.default, found.metadata["declared"]


def _check(options: Any) -> None:
    for each in fields(options):
        declared = each.metadata.get("declared")
        complaint = declared and declared.complaint(getattr(options, each.name))
        if complaint:
            raise ValueError(f"{each.name} {complaint}")


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """How a part file becomes profiles.

    Raises
    ------
    ValueError
        If a value is outside its range.
    """

    unit: str | None = _option(
        None,
        "Unit of a drawing's numbers; not given, the file decides ($INSUNITS, then $MEASUREMENT, then mm).",
        choices=UNIT_NAMES,
    )
    gap_rel: float = _option(
        1e-4,
        "Widest gap between two ends that is bridged; wider, small edges collapse and fewer loops close.",
        unit="fraction of the drawing's diagonal",
        low=0.0,
        high=1e-2,
    )

    def __post_init__(self) -> None:
        _check(self)


@dataclass(frozen=True, slots=True)
class SignatureOptions:
    """How a medial axis becomes a signature.

    Raises
    ------
    ValueError
        If a value is outside its range.
    """

    per_edge: int = _option(
        100,
        "Stations on each edge, evenly in arc length: 100 is the paper's step 0.01 (section 4.5, reading 1).",
        low=2,
        high=10_000,
    )

    def __post_init__(self) -> None:
        _check(self)


@dataclass(frozen=True, slots=True)
class PartOptions:
    """All options that shape what is known of a part: they are on record in its sidecar and decide its freshness."""

    read: ReadOptions = field(default_factory=ReadOptions)
    signature: SignatureOptions = field(default_factory=SignatureOptions)


@dataclass(frozen=True, slots=True)
class ScanOptions:
    """How a folder is scanned; only `part` shapes what the sidecars hold.

    Raises
    ------
    ValueError
        If a value is outside its range.
    """

    jobs: int | None = _option(None, "Worker processes; not given, one for each processor.", low=1, high=1024)
    timeout: float = _option(
        120.0,
        "Longest time that one file may take; then its worker is ended and the file counts as failed.",
        unit="seconds",
        low=0.001,
        high=86_400.0,
    )
    retry_failed: bool = _option(
        default=False, sentence="Try files again that failed before and have not changed since."
    )
    part: PartOptions = field(default_factory=PartOptions)

    def __post_init__(self) -> None:
        _check(self)


@dataclass(frozen=True, slots=True)
class EvaluateOptions:
    """What is found out of a labelled folder."""

    quick: bool = _option(
        default=False,
        sentence="No running times and no coarser sampling: for them each part is computed anew, once.",
    )


@dataclass(frozen=True, slots=True)
class SearchOptions:
    """What is asked of a library.

    Raises
    ------
    ValueError
        If a value is outside its range, or needs a mode that is not asked for.
    """

    mode: str = _option(
        "similar",
        "similar: in the order of the default signatures. reranked: besides, what resembles the best hits rises. same: "
        "those with QUERY's outer loop first, whatever their holes, then in the order of similar, and each hit is laid "
        "over QUERY and compared exactly. part: by how much of QUERY's outline each contains. paper: in the order of "
        "the paper's functions DF, RF and CF.",
        choices=("similar", "reranked", "same", "part", "paper"),
    )
    weights: tuple[float, float, float] | None = _option(
        None, "How much DF, RF and CF count in --mode paper; not given, alike.", low=0.0, high=1e6
    )
    min_score: float = _option(
        0.0,
        "Only parts with at least this score; with --mode part, that contain at least so much of QUERY.",
        unit="per cent",
        low=0.0,
        high=100.0,
    )
    same_size: float | None = _option(
        None,
        f"Only parts of QUERY's size, by the square root of the area; without TOL to within {SAME_SIZE:.0%}.",
        unit="fraction of QUERY's size",
        low=0.0,
        high=10.0,
    )
    holes: int | None = _option(None, "Only parts whose profile has so many holes.", low=0, high=1_000_000)
    no_mirror: bool = _option(
        default=False, sentence="Leave out mirror images, which signatures do not tell apart: for --mode same."
    )
    tolerance: float = _option(
        1e-3,
        "Up to this deviation outlines count as the same in --mode same, if the drawings are not exact to more.",
        unit="fraction of QUERY's diagonal",
        low=0.0,
        high=0.1,
    )

    def __post_init__(self) -> None:
        _check(self)
        if self.no_mirror and self.mode != "same":
            raise ValueError("no_mirror needs mode 'same': a signature does not tell mirror images apart")
        if self.weights is not None and self.mode != "paper":
            raise ValueError("weights need mode 'paper': the default signature has no functions DF, RF and CF")
        if self.weights is not None and not any(self.weights):
            raise ValueError("weights must not all be 0: then nothing is compared")


@dataclass(frozen=True, slots=True)
class AxisOptions:
    """How a medial axis is written to a file.

    Raises
    ------
    ValueError
        If a value is outside its range.
    """

    step: float | None = _option(
        None,
        f"Largest spacing of samples along a branch; not given, {AXIS_STEP_REL:.1%} of the profile's diagonal.",
        unit="mm",
        low=1e-9,
        high=1e9,
    )
    min_angle: float = _option(
        0.0,
        "Leave out end branches whose object angle, half the angle between the spokes, stays below this.",
        unit="degrees",
        low=0.0,
        high=90.0,
    )
    min_thickness: float = _option(
        0.0,
        "Leave out end branches whose erosion thickness, what the outline loses with them, is below this.",
        unit="mm",
        low=0.0,
        high=1e9,
    )

    def __post_init__(self) -> None:
        _check(self)
