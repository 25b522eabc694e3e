"""From the profiles of a part to their medial axes as samples: what `mashape-cad axis` writes.

Importing this module loads the kernel.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mashape_cad.errors import KernelUnavailableError
from mashape_cad.geometry.profile import Profile
from mashape_cad.library.derivation import refusal
from mashape_cad.library.record import Refusal
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.pruning import simplify
from mashape_cad.medial.trace import Trace, trace
from mashape_cad.options import AXIS_STEP_REL, AxisOptions

__all__ = ["RefusedProfile", "TracedProfile", "traced_profiles"]

# Of the profile's diagonal: how far a spline may be off its branch. Finer than any machine cuts; ten times finer costs
# twice the poles.
_SPLINE_ACCURACY = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class TracedProfile:
    """One profile of a part with its axis.

    Attributes
    ----------
    number : int
        Of the profile in its part, from 0.
    profile : Profile
    trace : Trace
    """

    number: int
    profile: Profile
    trace: Trace


@dataclass(frozen=True, slots=True, eq=False)
class RefusedProfile:
    """One profile of a part that has no axis, and why."""

    number: int
    profile: Profile
    refused: Refusal


def traced_profiles(
    profiles: Sequence[tuple[int, Profile]], options: AxisOptions, *, splines: bool = False
) -> tuple[tuple[TracedProfile, ...], tuple[RefusedProfile, ...]]:
    """Trace the axis of each profile; one that is refused costs no other.

    Parameters
    ----------
    profiles : sequence of (int, Profile)
        With their numbers in the part.
    options : AxisOptions
    splines : bool
        Whether each branch is wanted as a spline too.

    Raises
    ------
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    traced, refused = [], []
    for number, profile in profiles:
        try:
            traced.append(TracedProfile(number, profile, _trace(profile, options, splines=splines)))
        except KernelUnavailableError:
            raise
        except Exception as error:  # noqa: BLE001  (a fault of ours in one profile must not cost the others)
            refused.append(RefusedProfile(number, profile, refusal(error)))
    return tuple(traced), tuple(refused)


def _trace(profile: Profile, options: AxisOptions, *, splines: bool) -> Trace:
    axis = medial_axis(profile)
    pruned = simplify(axis, math.radians(options.min_angle), options.min_thickness)
    step = options.step or AXIS_STEP_REL * profile.diagonal
    return trace(pruned, step, _SPLINE_ACCURACY * profile.diagonal if splines else None)
