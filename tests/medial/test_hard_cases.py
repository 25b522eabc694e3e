"""What a trial program could not do: the cubic "circle", tiny chamfers, cusps, boundaries that touch.

Each is certified, or refused with the true kind, at the true place.
"""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from catalogue import TAU, box, circle, polygon, rounded
from invariants import check_axis
from oracle import check_definition, check_densely

from mashape_cad.errors import InvalidProfileError
from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import STATIONS, Certificate, certificate
from mashape_cad.medial.graph import MedialAxis

_POSES = {
    "as drawn": Similarity.of(),
    "moved and turned": Similarity.of(1.0, 0.3, (31.7, -8.2)),
    "small, mirrored": Similarity.of(1e-3, -2.0, (0.05, 0.01), mirror=True),
    "large": Similarity.of(1e4, 1.1, (-2e4, 3e4)),
}
_EVERY_POSE = ["as drawn", *(pytest.param(pose, marks=pytest.mark.slow) for pose in list(_POSES)[1:])]


def check(profile: Profile) -> tuple[MedialAxis, Certificate]:
    """The axis is certified, and brute force agrees."""
    axis = medial_axis(profile)
    found = certificate(axis, STATIONS)
    assert found.reason == ""
    check_axis(profile, axis, accuracy=1e-9)
    check_densely(profile, axis)
    check_definition(profile, axis, seed=3, count=6)
    return axis, found


def _quarter(kappa: float, radius: float) -> Floats:
    return radius * np.array([(1, 0), (1, kappa), (kappa, 1), (0, 1)])


def _cubic_circle(kappa: float, radius: float = 1.0, x: float = 0.0, y: float = 0.0) -> Loop:
    """Four cubics that look like a circle to everyone but us: its curvature has eight maxima."""
    quarter, turn = _quarter(kappa, radius), np.array([[0, 1], [-1, 0]])
    turned = (quarter @ np.linalg.matrix_power(turn, k) + (x, y) for k in range(4))
    return Loop(tuple(BSpline.of(3, [0] * 4 + [1] * 4, poles) for poles in turned))


def _in_one(loop: Loop) -> Loop:
    """The same as one spline."""
    poles = np.concatenate([edge.poles[:3] for edge in loop.edges] + [loop.edges[0].poles[:1]])
    return Loop((BSpline.of(3, [0] * 4 + [1] * 3 + [2] * 3 + [3] * 3 + [4] * 4, poles),))


_KAPPA = 0.5522847498


@pytest.mark.parametrize("pose", _EVERY_POSE)
@pytest.mark.parametrize("kappa", [_KAPPA, 4 / 3 * (np.sqrt(2) - 1), 0.551915024494, 0.55, 0.56])
def test_the_cubic_circle(kappa, pose):
    """Eight branches of a thousandth of its size, or four, from a middle that is one junction or several close ones."""
    profile = Profile.of(_cubic_circle(kappa)).transformed(_POSES[pose])
    axis, found = check(profile)
    assert found.ends in {4, 8}
    assert sum(int(degree) - 2 for degree in axis.nodes.degree if degree > 2) == found.ends - 2
    # Circles of curvature of something so round have their centres close to its middle.
    middle = _POSES[pose].apply((0.0, 0.0))
    assert np.hypot(*(axis.nodes.centre - middle).T).max() <= 0.1 * _POSES[pose].scale


@pytest.mark.parametrize("pose", _EVERY_POSE)
def test_the_cubic_circle_has_eight_ends(pose):
    """With the kappa of every drawing program. In one spline or in four edges."""
    for loop in (_cubic_circle(_KAPPA), _in_one(_cubic_circle(_KAPPA))):
        _, found = check(Profile.of(loop).transformed(_POSES[pose]))
        assert (found.ends, found.cycles) == (8, 0)


_CUBIC_HOLES = {
    "hole in a plate": (box(-2, -2, 4, 4), [_cubic_circle(_KAPPA, 0.7)], 4),
    "hole in a cubic circle": (_cubic_circle(_KAPPA), [_cubic_circle(_KAPPA, 0.4)], 0),
    "hole out of centre": (_cubic_circle(_KAPPA), [_cubic_circle(_KAPPA, 0.4, 0.2, 0.1)], 0),
    "round hole": (_cubic_circle(_KAPPA), [circle(0, 0, 0.4)], 0),
}


@pytest.mark.parametrize("pose", _EVERY_POSE)
@pytest.mark.parametrize("name", _CUBIC_HOLES)
def test_rings_of_cubic_circles(name, pose):
    """Bent outwards, a cubic circle has no ends, however its curvature swings."""
    outer, holes, ends = _CUBIC_HOLES[name]
    _, found = check(Profile.of(outer, holes).transformed(_POSES[pose]))
    assert (found.ends, found.cycles) == (ends, 1)


# Of the larger side.
_CUTS = [0.3, *(10.0**-power for power in range(1, 9))]


@pytest.mark.parametrize("cut", _CUTS)
def test_a_chamfer(cut):
    """Both of its vertices are ends, and their branches meet in the disc of radius c / (2 - sqrt 2)."""
    c = 3 * cut
    axis, found = check(Profile.of(polygon([(0, 0), (3 - c, 0), (3, c), (3, 2), (0, 2)])))
    assert (found.ends, found.junctions) == (5, 3)
    r = c / (2 - np.sqrt(2))
    expected = [(3 - c, 0, 0), (3, c, 0)] + ([(3 - r, r, r)] if r < 1 else [])
    nodes = np.column_stack([axis.nodes.centre, axis.nodes.radius])
    assert np.abs(nodes[None] - np.array(expected)[:, None]).max(axis=2).min(axis=1).max() <= 1e-9 * c + 1e-14


@pytest.mark.parametrize("cut", _CUTS)
def test_chamfers_all_around(cut):
    """Eight ends; on a hole or in a reflex corner chamfers end nothing."""
    c, h = min(3 * cut, 0.9), min(3 * cut, 0.6)
    octagon = polygon([(c, 0), (3 - c, 0), (3, c), (3, 2 - c), (3 - c, 2), (c, 2), (0, 2 - c), (0, c)])
    assert check(Profile.of(octagon))[1].ends == 8
    inner = polygon([(-1, -1), (1 - h, -1), (1, h - 1), (1, 1), (-1, 1)])
    assert check(Profile.of(box(-1.5, -1.5, 3, 3), [inner]))[1].ends == 4
    assert check(Profile.of(polygon([(0, 0), (3, 0), (3, 1), (1 + h, 1), (1, 1 + h), (1, 3), (0, 3)])))[1].ends == 5


@pytest.mark.parametrize("cut", _CUTS)
def test_a_fillet(cut):
    """Its centre is an end, of its own radius."""
    r = 3 * cut
    axis, found = check(Profile.of(rounded([(0, 0), (3, 0), (3, 2), (0, 2)], [0, r, 0, 0])))
    assert found.ends == 4
    off = np.abs(np.column_stack([axis.nodes.centre, axis.nodes.radius]) - (3 - r, r, r)).max(axis=1)
    assert off.min() <= 1e-9 * r + 1e-14


@pytest.mark.parametrize("pose", _POSES)
def test_an_edge_too_short_to_have_a_direction(pose):
    """A thousand-millionth of the size is refused, by its name and its place."""
    c = 1e-9
    error = _refused(Profile.of(polygon([(0, 0), (3 - c, 0), (3, c), (3, 2), (0, 2)])).transformed(_POSES[pose]))
    assert error.kind == "zero-length"
    assert np.hypot(*(_POSES[pose].apply((3, 0)) - error.place)) <= 1e-8 * _POSES[pose].scale


def _refused(profile: Profile) -> InvalidProfileError:
    with pytest.raises(InvalidProfileError) as caught:
        medial_axis(profile)
    assert caught.value.place is not None
    return caught.value


def _semicubical() -> BSpline:
    """Points (t^2, -t^3) for t in [-1, 1]: it stands still at the origin, in the middle of its parameter, and turns."""
    return BSpline.of(3, [0] * 4 + [1] * 4, [(1, 1), (-1 / 3, -1), (-1 / 3, 1), (1, -1)])


def _around(first: Edge, *others: Edge) -> Loop:
    """A room in which a boundary that comes from the right and goes back to it is a spike."""
    start, end = first.start, (others[-1] if others else first).end
    room = [end, (end[0], -3), (-3, -3), (-3, 3), (start[0], 3), start]
    lines = [Line.of(p, q) for p, q in pairwise(room)]
    return Loop((first, *others, *lines))


def _horn(turn: float) -> tuple[Arc, Arc]:
    """Two arcs that bend away from one another, and leave the origin under an angle."""
    bend = np.pi / 3
    up = Arc.of((0, 1), 1.0, -np.pi / 2, bend).transformed(Similarity.of(angle=turn / 2))
    down = Arc.of((0, -1), 1.0, np.pi / 2, -bend).transformed(Similarity.of(angle=-turn / 2))
    return up, down


def _closed(up: Edge, down: Edge) -> Loop:
    """The narrow side of two edges that start in one point."""
    return Loop((down, Line.of(down.end, up.end), up.reversed()))


def _half_circles() -> Loop:
    first, second = (Arc.of((x, 0), 1.0, np.pi, -np.pi) for x in (-1, 1))
    return Loop((first, second, Arc.of((0, 0), 2.0, 0.0, np.pi)))


_EDGE = _semicubical()
_LOWER, _UPPER = _EDGE.reversed().split(0.5)
_CUSPS = {
    "in a curve, the domain inside": Profile.of(Loop((_EDGE, Line.of(_EDGE.end, _EDGE.start)))),
    "in a curve, the domain outside": Profile.of(_around(_EDGE)),
    "of two curves that stand still, inside": Profile.of(Loop((*_EDGE.split(0.5), Line.of(_EDGE.end, _EDGE.start)))),
    "of two curves that stand still, outside": Profile.of(_around(*_EDGE.split(0.5))),
    "of two arcs, the domain inside": Profile.of(_closed(*_horn(0.0))),
    "of two arcs, the domain outside": Profile.of(_around(_horn(0.0)[0].reversed(), _horn(0.0)[1])),
    "of a hole, in a curve": Profile.of(box(-4, -4, 8, 8), [Loop((_EDGE, Line.of(_EDGE.end, _EDGE.start)))]),
    "of a hole, of arcs": Profile.of(box(-4, -4, 8, 8), [_closed(*_horn(0.0))]),
}


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", _CUSPS)
def test_cusps_are_refused(name, pose):
    """Of either sense: the boundary comes back beside itself, with the domain between or on both sides."""
    error = _refused(_CUSPS[name].transformed(_POSES[pose]))
    assert error.kind == "cusp"
    assert np.hypot(*(_POSES[pose].apply((0, 0)) - error.place)) <= 1e-9 * _POSES[pose].scale


def test_half_circles_in_a_half_circle_have_three_cusps():
    """Any of them is named."""
    error = _refused(Profile.of(_half_circles()))
    assert error.kind == "cusp"
    assert min(np.hypot(error.place[0] - x, error.place[1]) for x in (-2, 0, 2)) <= 1e-12


@pytest.mark.parametrize("turn", [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7])
def test_what_is_nearly_a_cusp_is_none(turn):
    """A convex vertex with as small an angle, an end; or a reflex one, none."""
    up, down = _horn(turn)
    axis, _ = check(Profile.of(_closed(up, down)))
    assert np.hypot(*axis.nodes.centre[axis.nodes.radius == 0.0].T).min() <= 1e-12
    _, found = check(Profile.of(_around(up.reversed(), down)))
    assert found.ends == 6


_PLATE = box(0, 0, 10, 6)
_SEGMENT = Loop((Arc.of((0, 0), 3.0, -0.5, 1.0), Line.of((3 * np.cos(0.5), 3 * np.sin(0.5)), (2, 0)),
                 Line.of((2, 0), (3 * np.cos(0.5), -3 * np.sin(0.5)))))  # fmt: skip
_BAY = Loop((Line.of((-4, -3), (4, -3)), Line.of((4, -3), (4, 3)), Line.of((4, 3), (1, 3)), Line.of((1, 3), (1, 1)),
             Arc.of((0, 1), 1.0, 0.0, -np.pi), Line.of((-1, 1), (-1, 3)), Line.of((-1, 3), (-4, 3)),
             Line.of((-4, 3), (-4, -3))))  # fmt: skip
_TONGUES = Loop((Line.of((-4, -3), (-1, -3)), Line.of((-1, -3), (-1, -1)), Arc.of((0, -1), 1.0, np.pi, -np.pi),
                 Line.of((1, -1), (1, -3)), Line.of((1, -3), (4, -3)), *_BAY.edges[1:]))  # fmt: skip
_ROUND = shapely.Point(3, 3).buffer(1.0, 2000).exterior
# Where the boundary touches itself: a point, or a line.
_TOUCHING = {
    "a round hole and the outline": (Profile.of(_PLATE, [circle(9, 3, 1)]), (10, 3)),
    "a vertex of a hole and the outline": (Profile.of(_PLATE, [polygon([(10, 3), (8, 2), (8, 4)])]), (10, 3)),
    "a spline and the outline": (Profile.of(_PLATE, [_cubic_circle(_KAPPA, 1.0, 9, 3)]), (10, 3)),
    "an ellipse and a round wall": (
        Profile.of(circle(0, 0, 3), [Loop((EllipseArc(frozen([1, 0]), frozen([2, 0]), frozen([0, 0.5]), 0.4, TAU),))]),
        (3, 0),
    ),
    "two round holes": (Profile.of(_PLATE, [circle(3, 3, 1), circle(5, 3, 1)]), (4, 3)),
    "vertices of two holes": (Profile.of(_PLATE, [box(2, 2, 1, 1), box(3, 3, 1, 1)]), (3, 3)),
    "a hole and a bay": (Profile.of(_BAY, [circle(0, -1, 1)]), (0, 0)),
    "two round tongues of the outline": (Profile.of(_TONGUES), (0, 0)),
    "a vertex and a side of the outline": (
        Profile.of(polygon([(0, 0), (10, 0), (10, 6), (6, 6), (5, 0), (4, 6), (0, 6)])),
        (5, 0),
    ),
    "two vertices of the outline": (Profile.of(polygon([(0, 0), (2, 2), (4, 0), (4, 4), (2, 2), (0, 4)])), (2, 2)),
    "a side of a hole along the outline": (Profile.of(_PLATE, [box(8, 2, 2, 2)]), ((10, 2), (10, 4))),
    "sides of two holes": (Profile.of(_PLATE, [box(2, 2, 2, 2), box(4, 2.5, 2, 1)]), ((4, 2.5), (4, 3.5))),
    "two sides of the outline": (
        Profile.of(polygon([(0, 0), (6, 0), (6, 2), (2, 2), (2, 0), (1, 0), (1, 4), (0, 4)])),
        ((1, 0), (2, 0)),
    ),
    "an arc of a hole along a round wall": (
        Profile.of(circle(0, 0, 3), [_SEGMENT]),
        tuple((3 * np.cos(t), 3 * np.sin(t)) for t in np.linspace(-0.5, 0.5, 2001)),
    ),
    "a hole that is there twice": (Profile.of(_PLATE, [circle(3, 3, 1), circle(3, 3, 1, 1.0)]), tuple(_ROUND.coords)),
    "a hole that is the outline": (Profile.of(_PLATE, [_PLATE]), (*_PLATE.flattened(1), (0, 0))),
}


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", _TOUCHING)
def test_boundaries_that_touch_are_refused(name, pose):
    """At a point, at several, or all along: the place is one of those where they do."""
    profile, touching = _TOUCHING[name]
    places = shapely.Point(touching) if np.ndim(touching) == 1 else shapely.LineString(np.array(touching))
    error = _refused(profile.transformed(_POSES[pose]))
    assert error.kind in {"crossing", "touching"}
    back = np.linalg.solve(_POSES[pose].matrix, np.subtract(error.place, _POSES[pose].offset))
    # Curves that touch smoothly are closer than a thousand-millionth of the size over its root.
    assert places.distance(shapely.Point(*back)) <= 5e-5 * profile.diagonal


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-6, 1e-7, 1e-8])
def test_boundaries_that_nearly_touch_do_not(gap):
    """Down to a hundred-millionth of the size the passage is narrow, and there."""
    size = 10 * gap
    for holes in ([circle(9 - size, 3, 1)], [circle(3, 3, 1), circle(5 + size, 3, 1)]):
        _, found = check(Profile.of(_PLATE, holes))
        assert (found.ends, found.cycles) == (4, len(holes))
