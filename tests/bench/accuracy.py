"""How far an axis is from the exact one.

Exact is the closed form where there is one, else our certified axis. An axis with junctions is judged by them: the
error is the largest distance from one of them to the nearest that was found. One without has a closed form here, and is
judged by its points: how far they are from fulfilling it. The radius of any point can be judged by the kernel.
"""

from dataclasses import dataclass

import numpy as np
from found import Found
from scipy.spatial import cKDTree
from shapes import SIZE, Known, known

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Profile
from mashape_cad.kernel.queries import distances
from mashape_cad.medial.axis import medial_axis

__all__ = ["Exact", "radius_error"]

# Of more points than this, the kernel is asked for an even choice: it takes up to 0.3 ms for each.
_ASKED = 500


@dataclass(frozen=True, slots=True, eq=False)
class Exact:
    """The exact axis of a shape, mm.

    Attributes
    ----------
    junctions : (k, 3) array
    form : Known or None
        The closed form, in the catalogue's size.
    factor : float
        From the catalogue's size to that of the shape.
    """

    junctions: Floats
    form: Known | None
    factor: float

    @classmethod
    def of(cls, name: str, profile: Profile) -> "Exact":
        """Return the exact axis of a shape; `profile` may be an approximation of it that a peer was given."""
        form = known(name)
        if form is None:
            nodes = medial_axis(profile).nodes
            points = np.column_stack([nodes.centre, nodes.radius])
            return cls(points[nodes.degree > 2], None, 1.0)
        there, factor = form
        nodes = np.array(there.nodes).reshape(-1, 4)
        return cls(nodes[nodes[:, 3] > 2, :3] * factor, there, factor)

    def error(self, found: Found) -> float:
        """Return the largest error by the size; infinite if nothing, or none of the junctions, was found."""
        if not len(found.points):
            return float("inf")
        if self.form and not len(self.junctions):
            off = [piece.off(found.points / self.factor) for piece in self.form.pieces]
            return float(np.max(np.min(off, axis=0))) * self.factor / SIZE
        if not len(found.junctions):
            return float("inf")
        apart, _ = cKDTree(found.junctions[:, :2]).query(self.junctions[:, :2])
        return float(apart.max()) / SIZE


def radius_error(profile: Profile, found: Found) -> float:
    """Return the largest difference of a radius and the kernel's distance from its centre, by the size."""
    if not len(found.points):
        return float("nan")
    points = found.points[np.linspace(0, len(found.points) - 1, min(len(found.points), _ASKED)).astype(int)]
    return float(np.max(np.abs(distances(profile, points[:, :2]) - points[:, 2]))) / SIZE
