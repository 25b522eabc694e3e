"""Pruning: what goes is insignificant by its closed form, what stays is as connected as before."""

import time

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of, polygon, profile_of

from mashape_cad.geometry.edge import Arc, Line, Similarity
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.branch_curve import discs_on_branch
from mashape_cad.medial.pruning import PrunedAxis, simplify

_ALL = [*KNOWN, *NAMED]
# Of the size: nothing, little, much, everything.
_THRESHOLDS = [(0.0, 0.0), (np.radians(20), 0.0), (0.0, 0.05), (np.radians(46), 0.3), (0.0, 100.0), (np.pi / 2, 0.0)]


def _components(pruned: PrunedAxis) -> int:
    """Connected parts of what is left, counted anew."""
    parts = {int(node): {int(node)} for node in pruned.nodes}
    for branch in pruned.branches:
        whole = parts[branch.start] | parts[branch.end]
        parts |= dict.fromkeys(whole, whole)
    return len({id(part) for part in parts.values()})


@pytest.mark.parametrize("name", _ALL)
@pytest.mark.parametrize(("angle", "thickness"), _THRESHOLDS)
def test_the_homotopy_type_stays(name, angle, thickness):
    """Whatever goes: one piece, as many cycles as holes, not empty; degrees and kinds are those of what is left."""
    axis = axis_of(name)
    pruned = simplify(axis, angle, thickness * axis.frame.size)
    assert len(pruned.nodes) > 0
    assert _components(pruned) == 1
    assert len(pruned.branches) - len(pruned.nodes) + 1 == len(axis.profile.holes)
    ends = [node for branch in pruned.branches for node in (branch.start, branch.end)]
    assert pruned.degree.tolist() == [ends.count(int(node)) for node in pruned.nodes]
    names = {0: "disc", 1: "end", 2: "seam"}
    assert pruned.kind == tuple(names.get(int(degree), "junction") for degree in pruned.degree)
    assert "seam" not in pruned.kind or pruned.kind == ("seam",)  # else a node of degree 2 was not merged


@pytest.mark.parametrize("name", _ALL)
@pytest.mark.parametrize(("angle", "thickness"), _THRESHOLDS[2:4])
def test_nothing_is_lost_but_what_is_on_record(name, angle, thickness):
    """The pieces that are left and those of the branches that went are all pieces of the axis, each once."""
    axis = axis_of(name)
    pruned = simplify(axis, angle, thickness * axis.frame.size)
    left = [piece for branch in pruned.branches for piece, _ in branch.pieces]
    gone = [piece for number in pruned.removed for piece, _ in axis.branches[number].pieces]
    assert sorted(left + gone) == list(range(len(axis.pieces.disc)))
    for branch in pruned.branches:
        discs = discs_on_branch(axis, branch, np.arange(len(branch.pieces) + 1))
        assert np.array_equal(discs.centre[[0, -1]], axis.nodes.centre[[branch.start, branch.end]])
        assert np.array_equal(discs.radius[[0, -1]], axis.nodes.radius[[branch.start, branch.end]])


@pytest.mark.parametrize("name", _ALL)
def test_without_thresholds_nothing_goes(name):
    """All nodes, all branches, in their order."""
    axis = axis_of(name)
    pruned = simplify(axis)
    assert pruned.branches == axis.branches
    assert pruned.nodes.tolist() == list(range(len(axis.nodes.kind)))
    assert pruned.kind == axis.nodes.kind
    assert pruned.removed == ()


@pytest.mark.parametrize("count", [3, 5, 6, 8, 12])
def test_object_angle_of_a_regular_polygon(count):
    """Half of its exterior angle, pi / n: asked for more only the middle is left, asked for less nothing goes."""
    axis, angle = axis_of(f"{count}-gon"), np.pi / count
    assert len(simplify(axis, angle - 1e-9).branches) == count
    least = simplify(axis, angle + 1e-9)
    assert (least.branches, least.kind) == ((), ("disc",))
    assert axis.nodes.radius[least.nodes[0]] == axis.nodes.radius.max()


def test_erosion_thickness_of_a_rectangle():
    """Height / 2 (sqrt 2 - 1) at the branches into corners, and what the fire takes along the middle one."""
    axis = axis_of("rectangle")
    thickness = 1.5 * (np.sqrt(2) - 1)
    assert len(simplify(axis, min_thickness=thickness * (1 - 1e-9)).branches) == 5
    pruned = simplify(axis, min_thickness=thickness * (1 + 1e-9))
    assert len(pruned.branches) == 1
    assert pruned.kind == ("end", "end")
    # From one of its ends the fire has 1.5 sqrt 2 behind it, then 4, and is 1.5 from the outline.
    whole = 1.5 * np.sqrt(2) + 4.0 - 1.5
    assert len(simplify(axis, min_thickness=whole * (1 - 1e-9)).branches) == 1
    assert simplify(axis, min_thickness=whole * (1 + 1e-9)).kind == ("disc",)


def test_erosion_thickness_of_a_curved_branch():
    """Along the parabola of the L the fire takes its arc length."""
    axis, width, length = axis_of("ell"), 1.3, 4.5
    arm = width / 2 * np.sqrt(2)  # from a corner of an arm to its junction
    level = length - 1.5 * width  # to where the parabola begins
    # Of the parabola r = (s^2 + w^2) / (2 w), s from 0 to w (sqrt 2 - 1), from apex to bend.
    reach = np.sqrt(2) - 1
    parabola = width / 2 * (reach * np.sqrt(1 + reach**2) + np.arcsinh(reach))
    bend = width * (2 - np.sqrt(2))
    thickness = arm + level + parabola - bend
    assert len(simplify(axis, min_thickness=thickness * (1 - 1e-6)).branches) == 1
    assert simplify(axis, min_thickness=thickness * (1 + 1e-6)).kind == ("disc",)


def test_cycles_are_never_opened():
    """A plate with nine holes loses what leads to its corners, and not more."""
    axis = axis_of("hole grid")
    pruned = simplify(axis, np.pi / 2, 1e9)
    assert len(pruned.removed) == 4
    assert "end" not in pruned.kind
    assert len(pruned.branches) - len(pruned.nodes) + 1 == 9


def test_a_cycle_without_nodes_gets_a_seam():
    """A frame without its corner branches is one branch that closes on itself."""
    pruned = simplify(axis_of("frame"), np.radians(46))
    (branch,) = pruned.branches
    assert branch.start == branch.end
    assert pruned.kind == ("seam",)
    assert pruned.degree.tolist() == [2]


def _bumpy(height: float) -> Profile:
    """A plate 10 x 4 whose upper side has 19 little teeth."""
    top = [(0.5 * k, 4.0 + (height if k % 2 else 0.0)) for k in range(19, 0, -1)]
    return Profile.of(polygon([(0, 0), (10, 0), (10, 4), *top, (0, 4)]))


@pytest.mark.parametrize("height", [1e-3, 0.05, 0.1])
def test_little_teeth_are_pruned_and_the_rest_stays(height):
    """Their branches go by either measure, none sticking out further than a tooth; those of the rectangle are left."""
    axis = medial_axis(_bumpy(height))
    assert len(axis.branches) > 20
    flank = np.arctan(height / 0.5)  # by which the outline turns at a tooth's foot; the object angle at its tip
    for pruned in (simplify(axis, min_angle=flank * (1 + 1e-9)), simplify(axis, min_thickness=height)):
        assert len(pruned.branches) == 5
        assert sorted(pruned.kind) == ["end"] * 4 + ["junction"] * 2
        assert sum(int(axis.nodes.radius[node] == 0) for node in pruned.nodes) == 4


def test_the_order_of_edges_does_not_matter():
    """Started elsewhere, turned, mirrored and scaled: as many branches go."""
    profile = profile_of("blob with holes")
    counts = set()
    for similarity in (Similarity.of(), Similarity.of(7.0, 1.1, (3.0, -2.0)), Similarity.of(0.01, mirror=True)):
        moved = profile.transformed(similarity)
        edges = moved.holes[1].edges
        moved = Profile(moved.outer, (Loop(edges[1:] + edges[:1]), moved.holes[0]))
        pruned = simplify(medial_axis(moved), np.radians(30), 0.1 * similarity.scale)
        counts.add((len(pruned.branches), len(pruned.removed)))
    assert len(counts) == 1


def test_of_the_last_branch_the_larger_disc_is_left():
    """A drop: one end is a vertex, the other the arc's centre."""
    tip = (-3.0, 0.0)
    half = float(np.arccos(1.0 / 3.0))
    first, last = ((-np.cos(half), sign * np.sin(half)) for sign in (-1, 1))
    arc = Arc.of((0, 0), 1.0, -(np.pi - half), 2 * (np.pi - half))
    axis = medial_axis(Profile.of(Loop((Line.of(tip, first), arc, Line.of(last, tip)))))
    assert len(axis.branches) == 1
    pruned = simplify(axis, min_thickness=100.0)
    assert axis.nodes.radius[pruned.nodes].tolist() == pytest.approx([1.0])
    assert len(simplify(axis, min_thickness=1.999).branches) == 1  # 3 long, 1 from the outline


@pytest.mark.parametrize("bad", [-1.0, np.nan])
def test_thresholds_below_nothing_are_refused(bad):
    """Each by its name."""
    with pytest.raises(ValueError, match="min_angle must be 0 or more"):
        simplify(axis_of("square"), min_angle=bad)
    with pytest.raises(ValueError, match="min_thickness must be 0 or more"):
        simplify(axis_of("square"), min_thickness=bad)


def test_many_branches_are_burnt_in_turn():
    """A plate with a comb of short slots: all branches into their corners go, in the time that sampling takes."""
    count = 160
    teeth = [(0.1 * k, 0.0 if k % 4 in {0, 1} else 0.05) for k in range(count)]
    profile = Profile.of(polygon([*teeth, (0.1 * count, 0.0), (0.1 * count, 3.0), (0.0, 3.0)]))
    axis = medial_axis(profile)
    started = time.process_time()
    pruned = simplify(axis, min_thickness=0.1)
    assert len(pruned.branches) == 5
    assert len(pruned.removed) > count / 2
    assert time.process_time() - started < 5.0
