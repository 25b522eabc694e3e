"""The kernel's door: the only package that imports OCP. Numbers go in, numbers come out.

* `curves`: an `Edge` as the kernel's own curve, and the kernel's edges as `Edge`.
* `clearances`: the radii of discs, confirmed.
* `queries`: distances of points to a boundary.
* `shapes`: part files and modelling objects as opaque shapes.
* `faces`: the planar faces of a shape, with exact edges in their own planes.
"""

from mashape_cad.kernel.door import open_door

open_door()

# Below the door, so that a system without the kernel gets its one clear line, whichever module is asked for.
from mashape_cad.kernel.clearances import clearances  # noqa: E402
from mashape_cad.kernel.curves import KernelCurve  # noqa: E402
from mashape_cad.kernel.queries import DistanceQuery, distances  # noqa: E402

__all__ = ["DistanceQuery", "KernelCurve", "clearances", "distances"]
