"""What a shape is compared by: named, versioned vectors."""

from collections.abc import Mapping
from dataclasses import dataclass

from mashape_cad.geometry.edge import Floats

__all__ = ["Signature"]


@dataclass(frozen=True, slots=True, eq=False)
class Signature:
    """The signature of one profile.

    Attributes
    ----------
    name : str
        Which kind of signature.
    version : int
        Raised whenever the numbers change; only equal kinds and versions can be compared.
    vectors : mapping of str to (k,) arrays
        The vectors by name.
    """

    name: str
    version: int
    vectors: Mapping[str, Floats]
