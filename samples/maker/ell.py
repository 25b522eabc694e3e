"""L-shaped parts: some drawn with unlike legs, the others one of these scaled differently along and across."""

import numpy as np

from maker.pen import Pen
from mashape_cad.geometry.edge import BSpline, Edge
from mashape_cad.geometry.profile import Loop, Profile

__all__ = ["ells"]

SEED = 2012  # of the factors by which ells are scaled along
SCALED = 6
FACTORS = (0.45, 2.2)


def ells() -> dict[str, Profile]:
    """Return ells of unlike legs with bulged sides, and the first of them stretched or squeezed along six times."""
    drawn = {
        "ell-1": ell(104, 112, 36, 30, 4),
        "ell-2": ell(120, 100, 34, 26, 4),
        "ell-3": ell(64, 150, 21, 33, 4),
        "ell-4": ell(108, 90, 35, 20, 4),
    }
    factors = np.random.default_rng(SEED).uniform(*FACTORS, SCALED).tolist()
    first = len(drawn) + 1
    return drawn | {f"ell-{first + i}": stretched(drawn["ell-1"], factor, 1) for i, factor in enumerate(factors)}


def ell(reach: float, height: float, leg: float, foot: float, bulge: float) -> Profile:
    """Draw an ell: `leg` and `foot` are how wide its two legs are; their sides bulge by `bulge`."""
    pen = Pen(0, 0, rounded=6).curve((reach / 2, -bulge), (reach, 0), rounded=5)
    pen.curve((reach + bulge, foot / 2), (reach, foot), rounded=5)
    pen.curve(((reach + leg) / 2, foot + bulge), (leg, foot), rounded=10)
    pen.curve((leg + bulge, (height + foot) / 2), (leg, height), rounded=5)
    pen.curve((leg / 2, height + bulge), (0, height), rounded=5)
    pen.curve((-bulge, height / 2), (0, 0))
    return Profile.of(pen.close())


def stretched(profile: Profile, x: float, y: float) -> Profile:
    """Scale a profile of B-splines by `x` along and `y` across: exact, since poles follow any affine map."""
    return Profile.of(Loop(tuple(_stretched(edge, x, y) for edge in profile.outer.edges)))


def _stretched(edge: Edge, x: float, y: float) -> BSpline:
    if not isinstance(edge, BSpline):
        raise TypeError(f"{type(edge).__name__} does not stay what it is")
    return BSpline.of(edge.degree, edge.knots, edge.poles * [x, y])
