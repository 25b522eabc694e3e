"""The axis belongs to the domain: however its boundary is drawn, and wherever it lies, graph and branches are the same.

Branches are compared as curves along their whole length, both ways, to 1e-9 of the size.
"""

import os
from collections import Counter
from collections.abc import Callable

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, profile_of
from courses import doubt, off_branches, runs
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.interpolate import insert
from strategies import profiles, similarities

from mashape_cad import read
from mashape_cad.geometry.edge import Arc, BSpline, Edge, Floats, Similarity
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.graph import MedialAxis

# Of the larger side of the bounding box.
_ACCURACY = 1e-9
# Discs of each piece that are compared, both its ends included, and the most that are compared of one axis.
_PER_PIECE, _MOST = 5, 400


def check_same(axis: MedialAxis, other: MedialAxis, pose: Similarity) -> None:
    """The other axis is this one, moved: nodes, which branches join them, and the course of each."""
    tol = _ACCURACY * axis.frame.size * pose.scale
    numbers = _matched(axis, other, pose, tol)
    assert _joined(other, np.arange(len(other.nodes.degree))) == _joined(axis, numbers)
    inverse = np.linalg.inv(pose.matrix)
    for from_, to, there in ((axis, other, True), (other, axis, False)):
        discs, doubts = _some_discs(from_)
        centre = pose.apply(discs[:, :2]) if there else (discs[:, :2] - pose.offset) @ inverse.T
        scale, limit = (pose.scale, tol) if there else (1 / pose.scale, tol / pose.scale)
        # Between sides that part by a millionth of a degree, a disc is known less well, and says so; on both axes.
        limits = np.maximum(limit, 2 * doubts * scale)
        assert np.all(off_branches(to, np.column_stack([centre, discs[:, 2] * scale]), limits) <= limits)


def _some_discs(axis: MedialAxis) -> tuple[Floats, Floats]:
    """Discs along all branches with their doubts, both ends of each piece among them; of many, some at random."""
    along = [(discs, doubt(axis, branch, s)) for branch, s, discs in runs(axis, _PER_PIECE - 1)]
    discs = np.concatenate([np.empty((0, 3)), *(discs for discs, _ in along)])
    doubts = np.concatenate([np.empty(0), *(doubts for _, doubts in along)])
    chosen = np.random.default_rng(len(discs)).permutation(len(discs))[:_MOST]
    return discs[chosen], doubts[chosen]


def _matched(axis: MedialAxis, other: MedialAxis, pose: Similarity, tol: float) -> np.ndarray:
    """The number that each node has in the other axis; a seam stands anywhere."""
    nodes, others = axis.nodes, other.nodes
    assert Counter(nodes.kind) == Counter(others.kind)
    here = np.column_stack([pose.apply(nodes.centre), nodes.radius * pose.scale])
    there = np.column_stack([others.centre, others.radius])
    off = np.abs(here[:, None] - there[None]).max(axis=2)
    numbers = off.argmin(axis=1)
    seam = np.array(nodes.kind) == "seam"
    numbers[seam] = np.flatnonzero(np.array(others.kind) == "seam")
    assert off.min(axis=1)[~seam].max(initial=0.0) <= tol
    assert len(set(numbers.tolist())) == len(numbers)
    assert np.array_equal(others.degree[numbers], nodes.degree)
    return numbers


def _joined(axis: MedialAxis, numbers: np.ndarray) -> Counter:
    return Counter(tuple(sorted((int(numbers[b.start]), int(numbers[b.end])))) for b in axis.branches)


def _each_loop(change: Callable[[Loop], Loop]) -> Callable[[Profile], Profile]:
    return lambda profile: Profile.of(change(profile.outer), [change(hole) for hole in profile.holes])


def _split(at: float) -> Callable[[Loop], Loop]:
    return lambda loop: Loop(tuple(part for edge in loop.edges for part in edge.split(at)))


def _started_later(loop: Loop) -> Loop:
    if len(loop.edges) == 1:  # a closed curve can only begin elsewhere on itself
        first, second = loop.edges[0].split(0.41)
        return Loop((second, first))
    half = len(loop.edges) // 2
    return Loop(loop.edges[half:] + loop.edges[:half])


def _with_knots(loop: Loop) -> Loop:
    """All edges as splines, each with three more knots, one of them twice."""
    return Loop(tuple(_inserted(spline) for edge in loop.edges for spline in _splines(edge)))


def _splines(edge: Edge) -> list[BSpline]:
    if isinstance(edge, BSpline):
        return [edge]
    spans, _ = edge.spans()
    ends = [0.0] * spans.shape[1] + [1.0] * spans.shape[1]
    return [BSpline.of(spans.shape[1] - 1, ends, span[:, :2] / span[:, 2:], span[:, 2]) for span in spans]


def _inserted(spline: BSpline) -> BSpline:
    degree, knots = spline.degree, spline.knots
    homogeneous = np.column_stack([spline.poles * spline.weights[:, None], spline.weights])
    low, high = knots[degree], knots[-degree - 1]
    for share, times in ((0.21, 1), (0.5, min(2, degree)), (0.83, 1)):
        at = low + share * (high - low)
        if np.any(np.abs(knots - at) < 1e-9 * (high - low)):
            continue
        # The library pads the coefficients with zeros that it does not use.
        padded = np.concatenate([homogeneous, np.zeros((degree + 1, 3))])
        knots, columns, _ = insert(at, (knots, list(padded.T), degree), times)
        homogeneous = np.column_stack(columns)[: len(knots) - degree - 1]
    return BSpline.of(degree, knots, homogeneous[:, :2] / homogeneous[:, 2:], homogeneous[:, 2])


_CHANGES: dict[str, Callable[[Profile], Profile]] = {
    "every edge split": _each_loop(_split(0.37)),
    "every edge split, and again": _each_loop(lambda loop: _split(0.52)(_split(0.08)(loop))),
    "loops reversed": _each_loop(Loop.reversed),
    "another start": _each_loop(_started_later),
    "knots inserted": _each_loop(_with_knots),
    "holes in another order": lambda profile: Profile.of(profile.outer, profile.holes[::-1]),
}
_POSES = {
    "turned": Similarity.of(angle=0.7),
    "moved": Similarity.of(offset=(71.3, -24.9)),
    "a thousandth": Similarity.of(1e-3, -2.2, (0.01, 0.04)),
    "ten thousand": Similarity.of(1e4, 1.9, (-6e4, 2e4)),
    "mirrored": Similarity.of(1.0, 0.4, (-3.0, 8.0), mirror=True),
}
_FEW = ["ell", "ellipse", "eccentric ring", "gear with a bore", "blob with holes", "bracket", "rational blob", "wave"]
_STAYS = Similarity.of()


def _changed(profile: Profile, names: list[str]) -> Profile:
    for name in names:
        profile = _CHANGES[name](profile)
    return profile


@pytest.mark.parametrize("change", _CHANGES)
@pytest.mark.parametrize("name", ["bracket", "blob with holes"])
def test_drawn_otherwise(name, change):
    """How the boundary is divided, directed and numbered does not matter."""
    profile = profile_of(name)
    check_same(medial_axis(profile), medial_axis(_CHANGES[change](profile)), _STAYS)


@pytest.mark.slow
@pytest.mark.parametrize("change", _CHANGES)
@pytest.mark.parametrize("name", _FEW)
def test_shapes_drawn_otherwise(name, change):
    """Of all kinds."""
    test_drawn_otherwise(name, change)


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", ["bracket", "blob with holes"])
def test_moved(name, pose):
    """By any similarity."""
    profile = profile_of(name)
    check_same(medial_axis(profile), medial_axis(profile.transformed(_POSES[pose])), _POSES[pose])


@pytest.mark.slow
def test_all_at_once(drawn):
    """Shapes of the catalogue, drawn in every other way at once, in the smallest and in the largest scale."""
    for name in drawn([*KNOWN, *NAMED], 6):
        profile = profile_of(name)
        axis, otherwise = medial_axis(profile), _changed(profile, [each for each in _CHANGES if "again" not in each])
        for pose in ("a thousandth", "ten thousand"):
            check_same(axis, medial_axis(otherwise.transformed(_POSES[pose])), _POSES[pose])


@pytest.mark.parametrize(
    ("name", "at"),
    [
        *(("stadium", at) for at in (1e-7, 1e-5, 1e-4, 0.01, 0.2, 0.5, 0.77, 0.999, 1 - 1e-5)),
        *(pytest.param("bracket", at, marks=pytest.mark.slow) for at in (1e-6, 1e-4, 0.01, 0.5, 0.999, 1 - 1e-5)),
        *(pytest.param("rational blob", at, marks=pytest.mark.slow) for at in (1e-5, 1e-3, 0.3, 0.9999)),
    ],
)
def test_one_edge_split(name, at):
    """Close to its end, in the middle, anywhere: an arc that its disc touches as a whole, or a smooth spline."""
    profile = profile_of(name)
    edges = list(profile.outer.edges)
    which = next((k for k, edge in enumerate(edges) if isinstance(edge, Arc)), 0)
    edges[which : which + 1] = edges[which].split(at)
    check_same(medial_axis(profile), medial_axis(Profile.of(Loop(tuple(edges)), profile.holes)), _STAYS)


_QUICK = settings(
    max_examples=5, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck)
)
_REDRAWN = st.lists(st.sampled_from(list(_CHANGES)), max_size=3, unique=True)


@given(profiles(), _REDRAWN, similarities())
@_QUICK
def test_random_profiles(profile, changes, pose):
    """Drawn otherwise in up to three ways, and moved."""
    check_same(medial_axis(profile), medial_axis(_changed(profile, changes).transformed(pose)), pose)


@pytest.mark.slow
@given(profiles(), _REDRAWN, similarities())
@settings(_QUICK, max_examples=60 if os.environ.get("MASHAPE_ALL") else 20)
def test_many_random_profiles(profile, changes, pose):
    """The same, four to twelve times as many."""
    check_same(medial_axis(profile), medial_axis(_changed(profile, changes).transformed(pose)), pose)


@pytest.mark.slow
def test_samples(drawn, freeform80):
    """Outlines as they come from files."""
    for name in drawn(["airplane-4", "bracket-2", "chassis-1", "ell-3", "rect-4"], 2):
        (profile, *_) = read(freeform80 / f"{name}.dxf").profiles
        otherwise = _changed(profile, ["every edge split", "loops reversed", "another start", "knots inserted"])
        pose = _POSES["a thousandth"]
        check_same(medial_axis(profile), medial_axis(otherwise.transformed(pose)), pose)


@pytest.mark.slow
def test_real_files(drawn, retrieval):
    """The first of each set, and one from its middle."""
    folders = ("glyphs40", "outlines30", "parts", "planted")
    sets = [sorted(p for p in (retrieval / name).rglob("*") if p.suffix in {".dxf", ".step"}) for name in folders]
    for path in drawn([files[k] for files in sets for k in (0, len(files) // 2)], 3):
        (profile, *_) = read(path).profiles
        otherwise = _changed(profile, ["every edge split", "loops reversed", "another start"])
        pose = _POSES["ten thousand"]
        check_same(medial_axis(profile), medial_axis(otherwise.transformed(pose)), pose)
