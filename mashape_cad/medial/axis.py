"""The medial axis of a profile, step by step.

1. Lay the boundary out as a tour of spans and cones (`tour`).
2. Refuse a boundary that bounds no domain (`validity`).
3. Cut the domain by maximal discs until each face holds one piece of a branch (`cutting`).
4. Read the graph off the faces and have the kernel measure every disc (`assembly`).

References
----------
H. I. Choi, S. W. Choi, H. P. Moon, Mathematical theory of medial axis transform, Pacific J. Math. 181 (1997);
O. Aichholzer et al., Medial axis computation for planar free-form shapes, Computer-Aided Design 41 (2009).
"""

import numpy as np

from mashape_cad.errors import AxisError
from mashape_cad.geometry.profile import Profile
from mashape_cad.medial.assembly import assembled, single_disc
from mashape_cad.medial.cutting import cut
from mashape_cad.medial.graph import MedialAxis
from mashape_cad.medial.tour import Frame, tour
from mashape_cad.medial.validity import check_simple

__all__ = ["MedialAxis", "medial_axis"]

# Largest difference between a disc's radius and the kernel's distance from its centre to the boundary, relative to the
# size. The search works to 1e-13; a difference of this size means that a disc is not maximal.
_CONFIRMED = 1e-8


def medial_axis(profile: Profile) -> MedialAxis:
    """Compute the exact medial axis of a profile.

    Parameters
    ----------
    profile : Profile
        Bounded by lines, arcs, elliptic arcs and B-splines in any mix, with any number of holes.

    Returns
    -------
    MedialAxis
        Its discs are accurate to about 1e-13 of the profile's size; discs of clusters carry their own tolerance.

    Raises
    ------
    InvalidProfileError
        If the boundary crosses or touches itself, is open, runs the wrong way round, or has an edge without length or
        a point at which it stands still.
    AxisError
        If the axis could not be completed, or the kernel does not confirm one of its discs.
    """
    boundary, frame = tour(profile)
    try:
        check_simple(boundary, frame)
        faces, is_disc = cut(boundary)
    except AxisError as error:
        raise AxisError(_placed(str(error), error.place, frame), _in_mm(error.place, frame)) from None
    axis = (single_disc if is_disc else assembled)(profile, boundary, frame, faces)
    _check_confirmed(axis)
    return axis


def _check_confirmed(axis: MedialAxis) -> None:
    discs = axis.discs
    error = np.abs(discs.clearance - discs.radius)
    worst = int(np.argmax(error - discs.tolerance))
    if not error[worst] <= _CONFIRMED * axis.frame.size + discs.tolerance[worst]:
        x, y = (float(value) for value in discs.centre[worst])
        text = f"the kernel does not confirm the disc at ({x:.6g}, {y:.6g}): its radius is off by {error[worst]:.2g} mm"
        raise AxisError(text, (x, y))


def _in_mm(place: tuple[float, float] | None, frame: Frame) -> tuple[float, float] | None:
    if place is None:
        return None
    x, y = np.array(place) * frame.size + frame.middle
    return float(x), float(y)


def _placed(text: str, place: tuple[float, float] | None, frame: Frame) -> str:
    at = _in_mm(place, frame)
    return text if at is None else f"{text} near ({at[0]:.6g}, {at[1]:.6g})"
