"""Our own axis, as its peers are measured: the kernel's confirmation of every disc is part of it."""

import numpy as np
from cpu import timed
from found import Found

from mashape_cad.geometry.profile import Profile
from mashape_cad.medial import axis

__all__ = ["medial_axis"]


def medial_axis(profile: Profile) -> Found:
    """Compute the axis; its points are the nodes and all other discs that were settled."""
    result, spent = timed(lambda: axis.medial_axis(profile))
    discs = result.discs
    return Found(np.column_stack([discs.centre, discs.radius]), discs.degree, {"all": spent})
