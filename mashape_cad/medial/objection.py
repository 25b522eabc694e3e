"""What stands against a medial axis: `Objection`.

Every check of a certificate ends in an objection or in none. It names the check, what it looked at, and the place, so
that whoever reads it can look there.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mashape_cad.medial.graph import MedialAxis

__all__ = ["Objection"]


@dataclass(frozen=True, slots=True)
class Objection:
    """One reason why an axis is not certified.

    Attributes
    ----------
    check : str
        ``disc``, ``foot``, ``pairing``, ``graph``, ``count``, ``candidate``, ``piece``, ``area`` or ``definition``.
    text : str
        What is wrong, of which disc, contact, candidate, piece, branch or edge.
    place : tuple of float or None
        Where, mm, in the profile's coordinates.
    """

    check: str
    text: str
    place: tuple[float, float] | None = None

    @classmethod
    def at(cls, check: str, text: str, place: ArrayLike) -> "Objection":
        """Make an objection with a place in mm."""
        x, y = np.asarray(place, float).tolist()
        return cls(check, text, (x, y))

    @classmethod
    def in_frame(cls, check: str, text: str, axis: MedialAxis, place: ArrayLike) -> "Objection":
        """Make an objection with a place in the tour's scale."""
        return cls.at(check, text, np.asarray(place, float) * axis.frame.size + axis.frame.middle)

    def __str__(self) -> str:
        at = "" if self.place is None else f", near ({self.place[0]:.6g}, {self.place[1]:.6g}) mm"
        return f"{self.check}: {self.text}{at}"
