"""The medial axis as a whole: closed forms, what holds for every profile, and the definition itself."""

from collections.abc import Callable

import numpy as np
import pytest
from catalogue import (
    KNOWN,
    NAMED,
    Known,
    axis_of,
    ellipse,
    plate_with_slot,
    polygon,
    profile_of,
    rectangle,
)
from closed_forms import BetweenCircles, InEllipse, Straight
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from invariants import check_axis
from oracle import check_definition, check_restored, samples_of
from scipy.spatial import cKDTree
from strategies import ALMOST_DEGENERATE, EVERYDAY, similarities

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.branch import discs_on_piece, sampled_branches
from mashape_cad.medial.certificate import certificate

# Relative to the diagonal. Promised is 1e-7.
_ACCURACY = 1e-10

_POSES = {
    "as drawn": Similarity.of(),
    "moved": Similarity.of(offset=(812.7, -3041.9)),
    "turned by 37 degrees": Similarity.of(angle=np.deg2rad(37)),
    "in inches": Similarity.of(25.4),
    "mirrored": Similarity.of(mirror=True),
    "all at once": Similarity.of(1 / 25.4, np.deg2rad(-143), (5.5, 0.3), mirror=True),
}


def _split(loop: Loop) -> Loop:
    return Loop(tuple(part for edge in loop.edges for part in edge.split(0.37)))


def _started_later(loop: Loop) -> Loop:
    if len(loop.edges) == 1:  # a closed curve can only begin elsewhere on itself
        first, second = loop.edges[0].split(0.41)
        return Loop((second, first))
    return Loop((*loop.edges[1:], loop.edges[0]))


def _as_splines(loop: Loop) -> Loop:
    return Loop(tuple(spline for edge in loop.edges for spline in _splines(edge)))


def _splines(edge: Edge) -> list[BSpline]:
    spans, _ = edge.spans()
    ends = [0.0] * spans.shape[1] + [1.0] * spans.shape[1]
    return [BSpline.of(spans.shape[1] - 1, ends, span[:, :2] / span[:, 2:], span[:, 2]) for span in spans]


def _each_loop(change: Callable[[Loop], Loop]) -> Callable[[Profile], Profile]:
    return lambda profile: Profile.of(change(profile.outer), [change(hole) for hole in profile.holes])


_DRAWN_OTHERWISE = {
    "edges split": _each_loop(_split),
    "other start edge": _each_loop(_started_later),
    "loops reversed": _each_loop(Loop.reversed),
    "holes in another order": lambda profile: Profile.of(profile.outer, profile.holes[::-1]),
    "all edges as splines": _each_loop(_as_splines),
}


def check_known(known: Known, pose: Similarity, profile: Profile) -> None:
    """The axis of a profile is the known one, seen from the pose in which it was drawn."""
    axis = medial_axis(profile)
    tol = _ACCURACY * known.profile.diagonal
    inverse = np.linalg.inv(pose.matrix)
    nodes = np.column_stack(
        [(axis.nodes.centre - pose.offset) @ inverse.T, axis.nodes.radius / pose.scale, axis.nodes.degree]
    )
    check_nodes(np.array(known.nodes).reshape(-1, 4), nodes[np.array(axis.nodes.kind) != "seam"], tol)
    assert len(axis.branches) == known.branches
    if known.pieces:
        step = known.profile.diagonal / 100
        samples = samples_of(sampled_branches(axis, step * pose.scale))
        samples = np.column_stack([(samples[:, :2] - pose.offset) @ inverse.T, samples[:, 2] / pose.scale])
        assert np.min([piece.off(samples) for piece in known.pieces], axis=0).max() <= tol
        tree = cKDTree(samples[:, :2])
        assert max(tree.query(piece.along(60)[:, :2])[0].max() for piece in known.pieces) <= step
    assert certificate(axis).ok


def check_nodes(expected: np.ndarray, actual: np.ndarray, tol: float) -> None:
    """As many nodes, each where one is expected and of its degree."""
    assert len(actual) == len(expected)
    if len(expected):
        off = np.abs(expected[:, None] - actual[None]).max(axis=2)
        assert off.min(axis=1).max() <= tol
        assert len(set(off.argmin(axis=1))) == len(expected)


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", KNOWN)
def test_closed_forms(name, pose):
    """Nodes, degrees, radii and the course of all branches are those of the closed form, in every pose."""
    known, similarity = KNOWN[name], _POSES[pose]
    check_known(known, similarity, known.profile.transformed(similarity))


@pytest.mark.parametrize("change", _DRAWN_OTHERWISE)
@pytest.mark.parametrize("name", KNOWN)
def test_closed_forms_drawn_otherwise(name, change):
    """The axis belongs to the domain: how its boundary is divided, directed and numbered does not matter."""
    known = KNOWN[name]
    check_known(known, Similarity.of(), _DRAWN_OTHERWISE[change](known.profile))


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_what_holds_for_every_axis(name):
    """Discs inside with radii as the kernel measures them, feet on the curves, and a graph that counts up."""
    check_axis(profile_of(name), axis_of(name))
    assert certificate(axis_of(name)).ok


@pytest.mark.parametrize("change", _DRAWN_OTHERWISE)
@pytest.mark.parametrize("name", NAMED)
def test_profiles_drawn_otherwise_have_the_same_axis(name, change):
    """The nodes stay where they are, also where no closed form is known."""
    profile = _DRAWN_OTHERWISE[change](profile_of(name))
    axis, expected = medial_axis(profile), axis_of(name).nodes
    rows = [np.column_stack([nodes.centre, nodes.radius, nodes.degree]) for nodes in (expected, axis.nodes)]
    check_nodes(*rows, _ACCURACY * profile.diagonal)
    assert certificate(axis).ok


@pytest.mark.parametrize("power", range(1, 13))
def test_rectangles_that_are_nearly_square(power):
    """Two junctions as long as they can be told apart; then one of degree 4. The count is right at every step."""
    known = rectangle(1 + 10.0**-power, 1.0)
    axis = medial_axis(known.profile)
    check_axis(known.profile, axis, accuracy=1e-8)
    joins = [int(d) for d in axis.nodes.degree if d > 2]
    assert joins in ([3, 3], [4])
    if power <= 7:
        check_known(known, Similarity.of(), known.profile)
    if power >= 11:
        assert joins == [4]


@pytest.mark.parametrize("power", range(1, 8))
def test_ellipses_that_are_nearly_circles(power):
    """The branch shrinks with the difference of the semi-axes, and keeps its closed form."""
    known = ellipse(1.0, 1 - 10.0**-power)
    axis = medial_axis(known.profile)
    samples = samples_of(sampled_branches(axis, 1e-2))
    assert InEllipse(1.0, 1 - 10.0**-power).off(samples).max() <= 1e-9
    check_axis(known.profile, axis)


def test_an_ellipse_that_is_a_circle_by_another_name():
    """Semi-axes that agree to the last digits of a file make a disc, not a branch of noise."""
    whole = EllipseArc(frozen([0, 0]), frozen([1, 0]), frozen([0, 1 - 1e-12]), 0.0, 2 * np.pi)
    axis = medial_axis(Profile.of(Loop((whole,))))
    assert axis.nodes.kind == ("disc",)
    assert axis.nodes.radius[0] == pytest.approx(1.0, abs=1e-11)


@pytest.mark.parametrize("power", [4, 5, 6])
def test_nearly_round_in_many_poses(power):
    """Every pose rounds otherwise: a short branch or a disc, never a failure."""
    rng = np.random.default_rng(0)
    profile = ellipse(1.0, 1 - 10.0**-power).profile
    for _ in range(100):
        pose = Similarity.of(1.0, rng.uniform(-np.pi, np.pi), rng.uniform(-30, 30, 2))
        assert medial_axis(profile.transformed(pose)).nodes.kind in {("disc",), ("end", "end")}


@pytest.mark.parametrize("power", range(1, 7))
def test_a_tiny_bump(power):
    """At its two vertices discs roll whose centres lie a hair beyond the bump's sides: the kernel confirms each."""
    size = 10.0**-power
    bump = [(1.0, 0.0), (1.0, size), (1 + size, size), (1 + size, 0.0)]
    profile = Profile.of(polygon([(0.0, 0.0), *bump, (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)]))
    axis = medial_axis(profile)
    query = DistanceQuery(profile)
    for piece in range(len(axis.pieces.disc)):
        low, high = axis.pieces.low[piece, 0], axis.pieces.high[piece, 0]
        x, y, r, _ = discs_on_piece(axis, piece, np.linspace(low, high, 200)[1:-1]).T * axis.frame.size
        assert query.distances(np.column_stack([x, y]) + axis.frame.middle) == pytest.approx(r, abs=1e-13)


@pytest.mark.parametrize("power", range(1, 15))
def test_rings_that_are_nearly_concentric(power):
    """From a clear ellipse to one that no digit tells from a circle."""
    outer, inner = (0.0, 0.0, 1.0), (10.0**-power, 0.0, 0.4)
    loops = [Loop((Arc.of(c[:2], c[2]),)) for c in (outer, inner)]
    profile = Profile.of(loops[0], loops[1:])
    axis = medial_axis(profile)
    assert BetweenCircles(outer, inner).off(samples_of(sampled_branches(axis, 0.05))).max() <= 1e-10
    check_axis(profile, axis)


@pytest.mark.parametrize("power", range(1, 8))
def test_holes_that_nearly_touch_the_wall(power):
    """The passage narrows; the closed form stays."""
    known = plate_with_slot(2.0, 1.0, 0.0, 1 - 10.0**-power)
    check_known(known, Similarity.of(), known.profile)


@pytest.mark.parametrize("power", range(1, 8))
def test_slots_whose_sides_are_nearly_parallel(power):
    """The radius changes along the branch by as little as the ends differ."""
    small = 1 - 10.0**-power
    lean = np.pi / 2 - np.arcsin((1 - small) / 3)
    (x0, y0), (x1, y1) = ((p + r * np.cos(lean), r * np.sin(lean)) for p, r in ((0, 1), (3, small)))
    outer = Loop(
        (
            Arc.of((0, 0), 1.0, lean, 2 * np.pi - 2 * lean),
            Line.of((x0, -y0), (x1, -y1)),
            Arc.of((3, 0), small, -lean, 2 * lean),
            Line.of((x1, y1), (x0, y0)),
        )
    )
    ends = ((0.0, 0.0, 1.0), (3.0, 0.0, small))
    known = Known("", Profile.of(outer), tuple((*end, 1) for end in ends), (Straight(*ends),), 1)
    check_known(known, Similarity.of(), known.profile)


_QUICK = settings(
    max_examples=4, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck)
)
_LONG = settings(_QUICK, max_examples=120)


def check_drawn(data: st.DataObject, strategy: st.SearchStrategy[Profile], places: int) -> None:
    """Draw a profile and a pose; the axis in that pose is complete."""
    profile = data.draw(strategy).transformed(data.draw(similarities()))
    axis = medial_axis(profile)
    check_axis(profile, axis, accuracy=1e-8)
    assert certificate(axis).ok
    check_restored(profile, axis)
    check_definition(profile, axis, seed=1, count=places)


@pytest.mark.parametrize("family", [*EVERYDAY, *ALMOST_DEGENERATE])
@given(data=st.data())
@_QUICK
def test_random_profiles(family, data):
    """Splines, polygons, fillets, plates, and what nearly degenerates: complete axes in any pose."""
    check_drawn(data, (EVERYDAY | ALMOST_DEGENERATE)[family](), places=3)


@pytest.mark.slow
@pytest.mark.parametrize("family", [*EVERYDAY, *ALMOST_DEGENERATE])
@given(data=st.data())
@_LONG
def test_many_random_profiles(family, data):
    """The same, thirty times as many."""
    check_drawn(data, (EVERYDAY | ALMOST_DEGENERATE)[family](), places=12)
