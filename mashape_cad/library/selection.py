"""Which profile of a file is meant, and what to say when there is none."""

from collections.abc import Sequence
from typing import TypeVar

from mashape_cad.errors import NoProfileError, QueryError, UnreadableFileError
from mashape_cad.library.record import ProfileRecord, Sidecar

__all__ = ["comparable", "numbered", "profiles_of"]

Profile = TypeVar("Profile")

_ERRORS = {"no-profile": NoProfileError, "unreadable": UnreadableFileError}


def profiles_of(sidecar: Sidecar, label: str) -> tuple[ProfileRecord, ...]:
    """Return the profiles of a file.

    Parameters
    ----------
    sidecar : Sidecar
    label : str
        What messages call the file.

    Raises
    ------
    NoProfileError, UnreadableFileError, QueryError
        If the file gave nothing, for the reason on record.
    """
    if sidecar.failure is not None:
        raise _ERRORS.get(sidecar.failure.kind, QueryError)(f"{label}: {sidecar.failure.text}")
    return sidecar.profiles


def numbered(profiles: Sequence[Profile], number: int, label: str) -> Profile:
    """Return one of the profiles of a file, counted from 0.

    Raises
    ------
    QueryError
        If there is no such.
    """
    if not 0 <= number < len(profiles):
        held = f"it has {len(profiles)}, numbered from 0" if profiles else "it has none"
        raise QueryError(f"{label}: no profile {number}; {held}")
    return profiles[number]


def comparable(profiles: Sequence[ProfileRecord], number: int | None, label: str) -> int:
    """Return the number of a profile that has a signature: the one asked for, else the first that has.

    Raises
    ------
    QueryError
        If there is no such, or it has no signature.
    """
    if number is None:
        number = next((each for each, record in enumerate(profiles) if record.vectors), 0)
    record = numbered(profiles, number, label)
    if not record.vectors:
        reason = record.refused.text if record.refused else "it has no signature"
        raise QueryError(f"{label}: profile {number} cannot be compared: {reason}")
    return number
