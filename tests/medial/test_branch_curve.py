"""Branches evaluated anywhere, held against closed forms, the kernel, and differences of their own values."""

from itertools import pairwise

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, polygon, profile_of

from mashape_cad.geometry.edge import BSpline, Line, Similarity
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.kernel import DistanceQuery, KernelCurve
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.branch_curve import BranchDiscs, discs_on_branch
from mashape_cad.medial.graph import Branch, MedialAxis

_ALL = [*KNOWN, *NAMED]
# Far from ends and from one another; and close to the ends of pieces.
_INSIDE = np.array([0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97])
_CLOSE = np.array([1e-9, 1e-6, 1e-4, 1e-3, 1e-2])


def _parameters(branch: Branch) -> np.ndarray:
    """Both nodes, all settled discs, places between them and places very close to them."""
    inside = np.concatenate([_CLOSE, _INSIDE, 1 - _CLOSE])
    count = len(branch.pieces)
    return np.concatenate([np.arange(count + 1.0), *(k + inside for k in range(count))])


def _differences(axis: MedialAxis, branch: Branch, s: np.ndarray, h: float) -> tuple[np.ndarray, ...]:
    """Unit tangent, rate of the radius, curvature by five-point differences, and what rounding does to the last."""
    near = [discs_on_branch(axis, branch, s + k * h) for k in (-2, -1, 0, 1, 2)]
    p = [np.column_stack([discs.centre, discs.radius]) for discs in near]
    first = (p[0] - 8 * p[1] + 8 * p[3] - p[4]) / (12 * h)
    second = (-p[0] + 16 * p[1] - 30 * p[2] + 16 * p[3] - p[4]) / (12 * h * h)
    speed = np.hypot(*first[:, :2].T)
    curvature = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / speed**3
    rounding = 100 * np.finfo(float).eps * axis.frame.size / (h * speed) ** 2
    return first[:, :2] / speed[:, None], first[:, 2] / speed, curvature, rounding


def _every(axis: MedialAxis) -> list[BranchDiscs]:
    return [discs_on_branch(axis, branch, _parameters(branch)) for branch in axis.branches]


@pytest.mark.parametrize("name", _ALL)
def test_discs_are_within_their_stated_error(name):
    """The kernel's distance from each centre to the boundary is the radius, but for the error, itself small."""
    axis, diagonal = axis_of(name), profile_of(name).diagonal
    for discs in _every(axis):
        off = np.abs(DistanceQuery(axis.profile).distances(discs.centre) - discs.radius)
        # The kernel takes feet up to 1e-7 beyond the end of an edge, which shortens its distances by 1e-14 / 2r.
        assert np.all(off <= discs.error + 1e-14 * diagonal)
        assert np.all(discs.error <= 1e-9 * diagonal)
        assert np.all(off <= 1e-10 * diagonal)


@pytest.mark.parametrize("name", [name for name in KNOWN if KNOWN[name].pieces])
def test_branches_are_those_of_the_closed_form(name):
    """Centre and radius fulfil the equation of one of the pieces that are known."""
    for discs in _every(axis_of(name)):
        points = np.column_stack([discs.centre, discs.radius])
        off = np.min([piece.off(points) for piece in KNOWN[name].pieces], axis=0)
        assert off.max() <= 1e-10 * profile_of(name).diagonal


@pytest.mark.parametrize("name", _ALL)
def test_a_branch_runs_from_node_to_node(name):
    """At the ends of its parameter it has the very discs of its nodes, at whole numbers those settled in between."""
    axis = axis_of(name)
    for branch in axis.branches:
        discs = discs_on_branch(axis, branch, np.arange(len(branch.pieces) + 1))
        inner = [int(axis.pieces.disc[piece, int(forward)]) for piece, forward in branch.pieces[:-1]]
        settled = [axis.nodes.disc[branch.start], *inner, axis.nodes.disc[branch.end]]
        assert np.array_equal(discs.centre, axis.discs.centre[settled])
        assert np.array_equal(discs.radius, axis.discs.radius[settled])


@pytest.mark.parametrize("name", _ALL)
def test_feet_touch_the_exact_edges(name):
    """The kernel's point at each foot's parameter is the foot, a radius off the centre, the spoke at right angles."""
    axis = axis_of(name)
    diagonal, edges = axis.profile.diagonal, axis.profile.edges
    curves = [KernelCurve(edge) for edge in edges]
    for discs in _every(axis):
        spokes = discs.foot - discs.centre[:, None]
        assert np.abs(np.linalg.norm(spokes, axis=2) - discs.radius[:, None]).max() <= 1e-10 * diagonal
        for k, side in np.ndindex(discs.foot_u.shape):
            number, u = int(discs.foot_edge[k, side]), float(discs.foot_u[k, side])
            point, tangent = curves[number].derivatives([u])[0, :2]
            assert np.hypot(*(point - discs.foot[k, side])) <= 1e-12 * diagonal
            bend = discs.boundary_curvature[k, side]
            if np.isfinite(bend):
                assert bend == pytest.approx(float(curves[number].curvature([u])[0]), rel=1e-9, abs=1e-9 / diagonal)
                slant = abs(tangent @ spokes[k, side]) / np.hypot(*tangent)
                assert slant <= 1e-7 * diagonal
            else:
                assert u == 0.0  # a reflex vertex is where its edge starts


@pytest.mark.parametrize("name", _ALL)
def test_tangent_rate_and_curvature_are_those_of_differences(name):
    """To the accuracy of five-point differences; the signs too."""
    axis = axis_of(name)
    size, telling = axis.frame.size, []
    for branch in axis.branches:
        s = np.concatenate([k + _INSIDE for k in range(len(branch.pieces))])
        discs = discs_on_branch(axis, branch, s)
        coarse, fine = (_differences(axis, branch, s, h) for h in (2e-4, 1e-4))
        tangent, rate, curvature, rounding = fine
        assert np.abs(discs.tangent - tangent).max() <= 1e-6
        assert np.abs(discs.rate - rate).max() <= 1e-6
        # Where two steps of the differences disagree they say nothing about a third number.
        doubt = np.abs(curvature - coarse[2]) + rounding
        assert np.all(np.abs(discs.curvature - curvature) <= 20 * doubt + 1e-4 * (np.abs(curvature) + 1 / size))
        telling += (doubt <= 1e-3 * (np.abs(curvature) + 1 / size)).tolist()
    assert not telling or np.mean(telling) > 0.5


@pytest.mark.parametrize("name", _ALL)
def test_tangents_join_along_a_branch(name):
    """A branch has no corner: just before and just behind a settled disc it runs in the direction at the disc."""
    axis = axis_of(name)
    for branch in axis.branches:
        joins = np.arange(1.0, len(branch.pieces))
        if not len(joins):
            continue
        at, before, behind = (discs_on_branch(axis, branch, joins + step).tangent for step in (0.0, -1e-7, 1e-7))
        assert np.abs(at - before).max() <= 1e-5
        assert np.abs(at - behind).max() <= 1e-5


def test_the_axis_of_an_ellipse():
    """At its ends it runs straight out of the boundary, into it, and the clearance changes as the centre moves."""
    axis = axis_of("ellipse")
    (branch,) = axis.branches
    discs = discs_on_branch(axis, branch, _parameters(branch))
    sign = np.sign(axis.nodes.centre[branch.end, 0])
    assert np.abs(discs.tangent - [sign, 0.0]).max() <= 1e-7
    ends = discs_on_branch(axis, branch, [0.0, len(branch.pieces)])
    assert ends.rate == pytest.approx([1.0, -1.0])
    assert ends.object_angle == pytest.approx(0.0, abs=1e-7)
    assert ends.boundary_curvature == pytest.approx(2.0)  # a / b^2
    # r = b sqrt(1 - x^2 / 3), so that r' = -x / (3 r)
    assert discs.rate * sign == pytest.approx(-discs.centre[:, 0] / (3 * discs.radius), abs=1e-7)
    assert np.abs(discs.curvature).max() <= 1e-3


def test_the_diagonal_of_a_rectangle():
    """From a corner at 45 degrees; the clearance is the distance over the root of 2, also right at the corner."""
    axis = axis_of("rectangle")
    for branch in axis.branches:
        discs = discs_on_branch(axis, branch, _parameters(branch))
        assert np.array_equal(discs.curvature, np.zeros(len(discs.radius)))
        if axis.nodes.radius[[branch.start, branch.end]].min() == 0.0:
            assert np.abs(discs.rate) == pytest.approx(np.sqrt(0.5), abs=1e-12)
            assert discs.object_angle == pytest.approx(np.pi / 4, abs=1e-12)
        else:
            assert np.abs(discs.rate).max() <= 1e-12
            assert discs.object_angle == pytest.approx(np.pi / 2, abs=1e-12)


def test_between_two_reflex_vertices():
    """Straight, with the vertices as feet, at which the boundary bends without bound."""
    axis = axis_of("wedged room")
    tour, pieces = axis.tour, axis.pieces
    found = 0
    for branch in axis.branches:
        for k, (piece, _) in enumerate(branch.pieces):
            if (tour.degree[pieces.element[piece]] == 0).all():
                discs = discs_on_branch(axis, branch, k + _INSIDE)
                assert np.abs(discs.curvature).max() <= 1e-9
                assert np.all(np.isneginf(discs.boundary_curvature))
                assert np.abs(discs.foot[:, 0] + discs.foot[:, 1]).max() <= 1e-14  # the tips mirror one another
                found += 1
    assert found


def test_a_parabola():
    """In the L, between the reflex corner and an outer wall: it bends towards the corner by (w / 2r)^1.5 / w.

    w is the distance from the corner to the wall.
    """
    axis, width, found = axis_of("ell"), 1.3, 0
    for branch in axis.branches:
        for k, (piece, _) in enumerate(branch.pieces):
            if sorted(axis.tour.degree[axis.pieces.element[piece]]) != [0, 1]:
                continue
            discs = discs_on_branch(axis, branch, k + np.linspace(0, 1, 21)[:-1])
            focus = np.array([width, width]) - discs.centre
            left = np.sign(discs.tangent[:, 0] * focus[:, 1] - discs.tangent[:, 1] * focus[:, 0])
            assert discs.curvature * left == pytest.approx((width / (2 * discs.radius)) ** 1.5 / width, rel=1e-12)
            found += 1
    assert found == 2


@pytest.mark.parametrize("name", ["blob with holes", "bracket", "wave"])
def test_running_a_branch_backwards(name):
    """The same discs; left and right, coming and going change places."""
    axis = axis_of(name)
    for branch in axis.branches:
        back = Branch(branch.end, branch.start, tuple((p, not forward) for p, forward in branch.pieces[::-1]))
        s = np.concatenate([k + _INSIDE for k in range(len(branch.pieces))])
        there, here = discs_on_branch(axis, branch, s), discs_on_branch(axis, back, len(branch.pieces) - s)
        assert here.centre == pytest.approx(there.centre, abs=1e-12)
        assert here.tangent == pytest.approx(-there.tangent, abs=1e-9)
        assert here.rate == pytest.approx(-there.rate, abs=1e-9)
        assert here.curvature == pytest.approx(-there.curvature, rel=1e-6, abs=1e-6)
        assert here.foot == pytest.approx(there.foot[:, ::-1], abs=1e-9)
        assert np.array_equal(here.foot_edge, there.foot_edge[:, ::-1])


def test_far_from_the_origin_the_error_is_stated_larger():
    """Coordinates of 1e6 keep ten digits of a part of size 1, and the error says so."""
    profile = profile_of("blob").transformed(Similarity.of(1.0, 0.7, (1e6, -2e6)))
    axis = medial_axis(profile)
    for branch in axis.branches:
        discs = discs_on_branch(axis, branch, _parameters(branch))
        assert np.all(discs.error >= 1e-10)
        assert np.all(np.abs(DistanceQuery(profile).distances(discs.centre) - discs.radius) <= discs.error)


def test_parameters_are_taken_in_any_order():
    """Each disc comes in the place of its parameter."""
    axis = axis_of("blob")
    branch = max(axis.branches, key=lambda each: len(each.pieces))
    s = _parameters(branch)
    mixed = np.random.default_rng(5).permutation(s)
    whole, single = discs_on_branch(axis, branch, mixed), [discs_on_branch(axis, branch, [t]) for t in mixed]
    assert np.array_equal(whole.centre, np.concatenate([each.centre for each in single]))
    assert np.array_equal(whole.tangent, np.concatenate([each.tangent for each in single]))


def test_the_centre_moves_forward():
    """Its parameter grows along the branch: each step goes in the direction of the tangent."""
    for name in ("blob", "bracket", "wave", "ell"):
        axis = axis_of(name)
        for branch in axis.branches:
            s = np.linspace(0, len(branch.pieces), 200 * len(branch.pieces) + 1)
            discs = discs_on_branch(axis, branch, s)
            steps = np.diff(discs.centre, axis=0)
            still = np.hypot(*steps.T) <= 1e-12
            assert np.all(still | (np.einsum("ij,ij->i", steps, discs.tangent[:-1]) > 0))


def _catmull_rom() -> Profile:
    """A closed cubic spline whose curvature jumps at each of its knots, as outlines in files often are."""
    points = np.array([[2, 0], [1.2, 0.9], [0.1, 0.8], [-1.1, 1.2], [-2, 0.1], [-1.0, -0.7], [0.2, -1.0], [1.3, -0.8]])
    slopes = (np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)) / 2
    points, slopes = (np.concatenate([array, array[:1]]) for array in (points, slopes))
    inner = np.stack([points[:-1] + slopes[:-1] / 3, points[1:] - slopes[1:] / 3], axis=1).reshape(-1, 2)
    knots = [*[0.0] * 2, *np.repeat(np.arange(9.0), 2), *[8.0] * 2]
    return Profile.of(Loop((BSpline.of(3, knots, np.concatenate([points[:1], inner, points[-1:]])),)))


def _kinked(turn: float) -> Profile:
    """A plate whose lower side has a vertex in its middle that turns by hardly anything, outwards or inwards."""
    return Profile.of(polygon([(0, 0), (2, -turn), (4, 0), (4, 1), (0, 1)]))


_SPECIAL = {
    "curvature jumps": _catmull_rom,
    "kink 4e-7": lambda: _kinked(4e-7),
    "kink 1e-5": lambda: _kinked(1e-5),
    "kink 1e-3": lambda: _kinked(1e-3),
    "kink 0.1": lambda: _kinked(0.1),
    "reflex kink 4e-7": lambda: _kinked(-4e-7),
}


@pytest.mark.parametrize("name", _SPECIAL)
def test_special_profiles(name):
    """Splines with jumps of curvature, kinks that are hardly any: discs within their error, which is small itself."""
    profile = _SPECIAL[name]()
    axis, diagonal = medial_axis(profile), profile.diagonal
    for discs in _every(axis):
        off = np.abs(DistanceQuery(profile).distances(discs.centre) - discs.radius)
        assert np.all(off <= discs.error + 1e-14 * diagonal)
        assert np.all(discs.error <= 1e-6 * diagonal)
        assert np.all(off <= 1e-10 * diagonal)
        assert np.isfinite(discs.curvature).all()


@pytest.mark.parametrize("turn", [4e-7, 1e-5, 1e-3])
def test_the_branch_at_a_kink(turn):
    """From the vertex straight up to the middle, the radius growing as the centre rises, to rounding of the angle."""
    axis = medial_axis(_kinked(turn))
    vertex = int(np.argmin(np.hypot(*(axis.nodes.centre - [2, -turn]).T)))
    (branch,) = (each for each in axis.branches if vertex in (each.start, each.end))
    discs = discs_on_branch(axis, branch, np.linspace(0, len(branch.pieces), 101))
    assert np.abs(discs.centre[:, 0] - 2).max() <= 1e-9
    assert np.abs(np.abs(discs.tangent) - [0, 1]).max() <= 1e-9
    assert discs.radius == pytest.approx((discs.centre[:, 1] + turn) * np.cos(turn / 2), abs=1e-9)
    rises = np.diff(discs.centre[:, 1]) * (1 if branch.start == vertex else -1)
    assert np.all(rises > 0)
    assert discs.object_angle == pytest.approx(turn / 2, rel=1e-3)


def test_curvature_where_spans_meet():
    """At a knot, seen from the piece that follows: its boundary curvature is that of the span which it runs along."""
    axis = medial_axis(_catmull_rom())
    jumps = 0
    for branch in axis.branches:
        at = np.arange(1.0, len(branch.pieces))
        here, behind, before = (discs_on_branch(axis, branch, at + step) for step in (0, 1e-7, -1e-7))
        assert here.boundary_curvature == pytest.approx(behind.boundary_curvature, rel=1e-3, abs=1e-4)
        assert here.curvature == pytest.approx(behind.curvature, rel=1e-2, abs=1e-3)
        jumps += int(np.sum(np.abs(here.boundary_curvature - before.boundary_curvature) > 1e-2))
    assert jumps >= 4


def test_feet_at_a_kink_inside_a_spline():
    """A reflex kink between two spans of one edge: the foot is at the knot, not where the edge starts."""
    side = BSpline.of(1, [0, 0, 0.3, 1, 1], [(0, 0), (1.2, 2e-7), (4, 0)])
    lines = [Line.of(p, q) for p, q in pairwise([(4, 0), (4, 1), (0, 1), (0, 0)])]
    axis = medial_axis(Profile.of(Loop((side, *lines))))
    found = 0
    for discs in _every(axis):
        for k, column in np.argwhere(np.isneginf(discs.boundary_curvature)):
            assert (discs.foot_edge[k, column], discs.foot_u[k, column]) == (0, pytest.approx(0.3))
            assert discs.foot[k, column] == pytest.approx([1.2, 2e-7], abs=1e-12)
            found += 1
    assert found > 3


@pytest.mark.parametrize("s", [-1e-9, 1.5, np.nan, np.inf])
def test_parameters_outside_are_refused(s):
    """The message names the range."""
    axis = axis_of("square")
    with pytest.raises(ValueError, match="lies between 0 and 1"):
        discs_on_branch(axis, axis.branches[0], [0.5, s])


def test_no_parameters_give_no_discs():
    """Arrays of the right shapes, with no rows."""
    axis = axis_of("square")
    discs = discs_on_branch(axis, axis.branches[0], [])
    assert (discs.centre.shape, discs.foot.shape, discs.radius.shape) == ((0, 2), (0, 2, 2), (0,))


def test_values_are_read_only():
    """As all values are."""
    axis = axis_of("square")
    discs = discs_on_branch(axis, axis.branches[0], 0.5)
    for name in BranchDiscs.__slots__:
        assert not getattr(discs, name).flags.writeable


def test_settled_discs_carry_their_tolerance():
    """At a node the error is at least what its contacts were allowed to miss."""
    axis = axis_of("rounded rectangle")
    for branch in axis.branches:
        ends = discs_on_branch(axis, branch, [0, len(branch.pieces)])
        for error, node in zip(ends.error, (branch.start, branch.end), strict=True):
            assert error >= axis.discs.tolerance[axis.nodes.disc[node]]


def test_neighbouring_pieces_share_their_disc():
    """The last disc of a piece is the first of the next, whichever way they run."""
    axis = axis_of("blob with holes")
    for branch in axis.branches:
        for (a, onward), (b, forward) in pairwise(branch.pieces):
            assert axis.pieces.disc[a, int(onward)] == axis.pieces.disc[b, 1 - int(forward)]
