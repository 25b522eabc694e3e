"""L-shaped parts, scaled differently along and across."""

from maker.pen import Pen
from mashape_cad.geometry.profile import Profile

__all__ = ["ells"]


def ells() -> dict[str, Profile]:
    """Return ells of unlike legs with bulged sides."""
    return {
        "ell-1": ell(104, 112, 36, 30, 4),
        "ell-2": ell(120, 100, 34, 26, 4),
        "ell-3": ell(64, 150, 21, 33, 4),
        "ell-4": ell(108, 90, 35, 20, 4),
    }


def ell(reach: float, height: float, leg: float, foot: float, bulge: float) -> Profile:
    """Draw an ell: `leg` and `foot` are how wide its two legs are; their sides bulge by `bulge`."""
    pen = Pen(0, 0, rounded=6).curve((reach / 2, -bulge), (reach, 0), rounded=5)
    pen.curve((reach + bulge, foot / 2), (reach, foot), rounded=5)
    pen.curve(((reach + leg) / 2, foot + bulge), (leg, foot), rounded=10)
    pen.curve((leg + bulge, (height + foot) / 2), (leg, height), rounded=5)
    pen.curve((leg / 2, height + bulge), (0, height), rounded=5)
    pen.curve((-bulge, height / 2), (0, 0))
    return Profile.of(pen.close())
