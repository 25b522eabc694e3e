"""From the profiles of a part to their medial axes as samples: what `mashape-cad axis` writes.

Importing this module loads the kernel.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mashape_cad.errors import KernelUnavailableError
from mashape_cad.geometry.profile import Profile
from mashape_cad.library.derivation import refusal
from mashape_cad.library.record import Refusal
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.trace import Trace, trace
from mashape_cad.options import AXIS_STEP_REL, AxisOptions

__all__ = ["TracedProfile", "traced_profiles"]


@dataclass(frozen=True, slots=True, eq=False)
class TracedProfile:
    """One profile of a part with its axis, or the reason why it has none.

    Attributes
    ----------
    number : int
        Of the profile in its part, from 0.
    profile : Profile
    trace : Trace or None
    refused : Refusal or None
        Set where `trace` is None.
    """

    number: int
    profile: Profile
    trace: Trace | None = None
    refused: Refusal | None = None


def traced_profiles(profiles: Sequence[tuple[int, Profile]], options: AxisOptions) -> Iterator[TracedProfile]:
    """Yield the traced axis of each profile, in order; one that is refused costs no other.

    Raises
    ------
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    for number, profile in profiles:
        try:
            yield TracedProfile(number, profile, _trace(profile, options))
        except KernelUnavailableError:
            raise
        except Exception as error:  # noqa: BLE001  (a fault of ours in one profile must not cost the others)
            yield TracedProfile(number, profile, refused=refusal(error))


def _trace(profile: Profile, options: AxisOptions) -> Trace:
    return trace(medial_axis(profile), options.step or AXIS_STEP_REL * profile.diagonal)
