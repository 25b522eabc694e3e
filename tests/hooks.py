"""Parts with the same hook on different bodies, and the bodies without it."""

from catalogue import polygon

from mashape_cad.geometry.profile import Profile

__all__ = ["BODIES", "bare", "with_hook"]

# It hangs on something at (0, 0) and (0, 2): from its foot to its tip and back.
_HOOK = [(0, 2), (-9, 2), (-9, -4), (-5, -4), (-5, -3), (-7.2, -2), (-7.2, 0), (0, 0)]
BODIES = {
    "block": [(0, -3), (7, -3), (7, 6), (0, 6)],
    "flag": [(0, -8), (2, -8), (5, -1), (11, 3), (4, 4), (0, 3.5)],
    "comb": [(0, -1), (2, -1), (2, -5), (3, -5), (3, -1), (5, -1), (5, -5), (6, -5), (6, 3), (0, 3)],
}


def with_hook(body: str) -> Profile:
    """Return a body with the hook."""
    return Profile.of(polygon([*_HOOK, *BODIES[body]]))


def bare(body: str) -> Profile:
    """Return a body without it."""
    return Profile.of(polygon(BODIES[body]))
