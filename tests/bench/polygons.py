"""Profiles as polygons, which is what most programs take: within a chord error, or as points a step apart."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mashape_cad.geometry.edge import Edge, Floats, Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.tour import Ints

__all__ = ["Polygon", "polygonised", "sampled"]

# Headings that differ by less (radians) make a smooth vertex: its bisector is no branch.
_SMOOTH = 1e-6
# Parameters of each span at which the second derivative is looked at.
_LOOKS = np.linspace(0.0, 1.0, 9)


@dataclass(frozen=True, slots=True, eq=False)
class Polygon:
    """Closed rings of points, the interior on the left.

    Attributes
    ----------
    points : (n, 2) array
    following : (n,) array
        The next point of the same ring.
    smooth : (n,) array of bool
        Whether the profile has no vertex here.
    """

    points: Floats
    following: Ints
    smooth: Ints

    @property
    def previous(self) -> Ints:
        """The point before each, on the same ring: (n,)."""
        previous = np.empty_like(self.following)
        previous[self.following] = np.arange(len(previous))
        return previous


def polygonised(profile: Profile, error: float) -> Polygon:
    """Make a polygon whose sides stay within `error` mm of the curves."""
    return _joined(profile, lambda edge: _within(edge, error))


def sampled(profile: Profile, step: float) -> Polygon:
    """Make a polygon of points about `step` mm apart, on straight edges too."""
    return _joined(profile, lambda edge: _apart(edge, step))


def _joined(profile: Profile, parameters) -> Polygon:
    points, following, smooth, first = [], [], [], 0
    for loop in profile.loops:
        ring = [edge.point(parameters(edge)[:-1]) for edge in loop.edges]
        count = sum(map(len, ring))
        points += ring
        following.append(first + (np.arange(count) + 1) % count)
        smooth.append(_smooth(loop, [len(part) for part in ring]))
        first += count
    return Polygon(np.concatenate(points), np.concatenate(following), np.concatenate(smooth))


def _smooth(loop: Loop, counts: list[int]) -> Ints:
    """Tell for each point whether it is smooth: all but some of the edges' first points are."""
    smooth = np.ones(sum(counts), dtype=bool)
    for k, at in enumerate(np.cumsum([0, *counts[:-1]])):
        before, after = loop.edges[k - 1].derivatives([1.0])[0, 1], loop.edges[k].derivatives([0.0])[0, 1]
        turn = np.arctan2(before[0] * after[1] - before[1] * after[0], before @ after)
        smooth[at] = abs(turn) < _SMOOTH
    return smooth


def _within(edge: Edge, error: float) -> Floats:
    """Parameters so close that chords stay within `error`: a chord is off by at most |P''| du^2 / 8."""
    if isinstance(edge, Line):
        return np.array([0.0, 1.0])
    _, breaks = edge.spans()
    parts = []
    for low, high in pairwise(breaks):
        bend = np.linalg.norm(edge.derivatives(low + (high - low) * _LOOKS)[:, 2], axis=1).max()
        count = max(1, int(np.ceil((high - low) * np.sqrt(bend / (8 * error)))))
        parts.append(np.linspace(low, high, count + 1)[:-1])
    return np.append(np.concatenate(parts), 1.0)


def _apart(edge: Edge, step: float) -> Floats:
    """Parameters so close that points are at most about `step` apart."""
    _, breaks = edge.spans()
    parts = []
    for low, high in pairwise(breaks):
        speed = np.linalg.norm(edge.derivatives(low + (high - low) * _LOOKS)[:, 1], axis=1).max()
        count = max(1, int(np.ceil((high - low) * speed / step)))
        parts.append(np.linspace(low, high, count + 1)[:-1])
    return np.append(np.concatenate(parts), 1.0)
