"""The frame of a planar face: points of space as coordinates in the plane, seen from outside the material."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike
from OCP.gp import gp_Pln

from mashape_cad.geometry.edge import Floats
from mashape_cad.geometry.profile import Plane

__all__ = ["Frame", "coordinates"]


def coordinates(triple: object) -> Floats:
    """Return the numbers of a kernel's point, vector or direction: (3,)."""
    return np.array([triple.X(), triple.Y(), triple.Z()])  # type: ignore[attr-defined]


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """A right-handed frame in space.

    Attributes
    ----------
    origin : (3,) array
        mm.
    axes : (3, 3) array
        Rows: x axis, y axis, normal; unit length.
    """

    origin: Floats
    axes: Floats

    @classmethod
    def of(cls, plane: gp_Pln, *, reverse: bool) -> "Frame":
        """Make the frame of a kernel's plane; reversed, it is seen from the other side.

        The plane's own axes may be left-handed. Outside is where ``x cross y`` points, as the kernel has it.
        """
        position = plane.Position()
        x, y = coordinates(position.XDirection()), coordinates(position.YDirection())
        if reverse:
            y = -y
        return cls(coordinates(position.Location()), np.stack([x, y, np.cross(x, y)]))

    def flat(self, points: ArrayLike) -> Floats:
        """Return coordinates in the plane of points (..., 3): (..., 2)."""
        return (np.asarray(points, float) - self.origin) @ self.axes[:2].T

    def heights(self, points: ArrayLike) -> Floats:
        """Return signed distances from the plane of points (..., 3): (...)."""
        return (np.asarray(points, float) - self.origin) @ self.axes[2]

    def turned(self, vector: ArrayLike) -> Floats:
        """Return the components in the plane of a vector (3,): (2,)."""
        return self.axes[:2] @ np.asarray(vector, float)

    def moved_near(self, points: Floats) -> "Frame":
        """Move the origin near points (n, 3), by whole steps as wide as they extend, rounded to a power of two.

        A part may lie far from where its plane starts, and the digits spent on that distance would be lost. Most
        designs draw around or beside the plane's origin; then it stays.
        """
        flat = self.flat(points)
        extent = float(np.ptp(flat, axis=0).max())
        if not extent > 0:
            return self
        step = 2.0 ** np.ceil(np.log2(extent))
        steps = np.round((flat.max(axis=0) + flat.min(axis=0)) / 2 / step)
        return replace(self, origin=self.origin + step * steps @ self.axes[:2])

    def plane(self) -> Plane:
        """Return the frame as numbers that a profile keeps."""
        origin, x, normal = ((row + 0.0).tolist() for row in (self.origin, self.axes[0], self.axes[2]))  # no -0.0
        return Plane(tuple(origin), tuple(x), tuple(normal))
