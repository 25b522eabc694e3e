"""The default signature: what it does not see, and what it does see."""

import hashlib
from importlib.resources import files

import numpy as np
import pytest
from catalogue import axis_of, box, circle, polygon, profile_of
from hypothesis import HealthCheck, given, settings
from strategies import similarities

from mashape_cad.geometry.edge import Line
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.library.record import CURRENT_SHAPE
from mashape_cad.library.shapes import UNIT
from mashape_cad.medial.axis import medial_axis
from mashape_cad.signatures import paper
from mashape_cad.signatures.constants import FILE, VERSION, shipped
from mashape_cad.signatures.shape import NAME, NORM, SIZE, shape_signature

_NAMES = ("ellipse", "bracket", "blob with holes", "plate with holes", "keyhole", "cross", "wave")
# In the sets that it is measured on, the nearest other shape is 0.45 away in the median: what must not show stays below
# a twentieth of that.
_SAME = 0.022


def _vector(profile):
    return shape_signature(medial_axis(profile)).vectors["shape"]


def _kept(name):
    return shape_signature(axis_of(name)).vectors["shape"]


def _apart(a, b):
    return float(np.linalg.norm(a - b)) / NORM


@pytest.mark.parametrize("name", [*_NAMES, "disc", "hole grid"])
def test_it_is_256_whole_numbers_that_fit_into_bytes(name):
    """One vector, of norm 400 but for rounding."""
    found = shape_signature(axis_of(name))
    (vector,) = found.vectors.values()
    assert (found.name, found.version) == (NAME, VERSION)
    assert len(vector) == SIZE == 256
    assert (vector == vector.astype(np.int8)).all()
    assert np.linalg.norm(vector) == pytest.approx(NORM, rel=0.02)
    assert not vector.flags.writeable


def test_sidecars_and_libraries_mean_the_same_signature():
    """They state name, version and unit without loading it."""
    assert (CURRENT_SHAPE.name, CURRENT_SHAPE.version, UNIT) == (NAME, VERSION, NORM)


@pytest.mark.parametrize("name", _NAMES)
@given(pose=similarities())
@settings(max_examples=2, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
def test_neither_motion_nor_scale_nor_a_mirror_shows(name, pose):
    """All of them at once."""
    assert _apart(_vector(profile_of(name).transformed(pose)), _kept(name)) < _SAME


@pytest.mark.parametrize("name", _NAMES)
def test_how_the_boundary_is_divided_does_not_show(name):
    """Split edges, another start, the other direction."""
    profile = profile_of(name)
    halves = [Loop(tuple(half for edge in loop.edges for half in edge.split(0.37))) for loop in profile.loops]
    turned = [Loop(loop.edges[2:] + loop.edges[:2]) for loop in halves]
    back = [loop.reversed() for loop in halves]
    for loops in (halves, turned, back):
        assert _apart(_vector(Profile.of(loops[0], loops[1:])), _kept(name)) < _SAME


def test_steps_on_a_round_outline_start_alike_in_its_mirror_image(freeform80):
    """Where the largest disc touches three times, the touch that comes first is another one in the mirror image."""
    from mashape_cad import Similarity, read

    [profile] = read(freeform80 / "bracket-9.dxf").profiles
    assert _apart(_vector(profile.transformed(Similarity.of(mirror=True))), _vector(profile)) < _SAME / 4


def _roughened(loop, reach, rng):
    """A polygon of equal steps along a loop, its corners moved at random."""
    points = loop.flattened(40)
    closed = np.vstack([points, points[:1]])
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(closed, axis=0).T)))
    places = np.linspace(0.0, along[-1], int(along[-1] / (5 * reach)), endpoint=False)
    steps = np.column_stack([np.interp(places, along, each) for each in closed.T])
    return polygon([tuple(map(float, point)) for point in steps + rng.uniform(-reach, reach, steps.shape)])


@pytest.mark.parametrize("name", ["bracket", "blob", "plate with holes", "wave"])
def test_noise_of_the_outline_keeps_a_shape_its_own_neighbour(name):
    """Corners moved by up to 0.3 % of the size at random: nearer to itself than to any other."""
    rng = np.random.default_rng(7)
    profile = profile_of(name)
    reach = 0.003 * float(np.max(profile.bounds[1] - profile.bounds[0]))
    outer, *holes = (_roughened(loop, reach, rng) for loop in profile.loops)
    noisy = _vector(Profile.of(outer, holes))
    others = [_apart(noisy, _kept(other)) for other in (*_NAMES, "blob", "hole grid") if other != name]
    assert _apart(noisy, _kept(name)) < min(others)


def _comb(teeth):
    """A strip with slots of one size at some places of its upper side."""
    upper = [(20.0, 2.0)]
    for place in sorted(teeth, reverse=True):
        upper += [(place + 0.5, 2.0), (place + 0.5, 1.2), (place - 0.5, 1.2), (place - 0.5, 2.0)]
    return Profile.of(polygon([(0.0, 0.0), (20.0, 0.0), *upper, (0.0, 2.0)]))


def _tree(lengths):
    """A bar with arms of several lengths, in some order."""
    lower = [(0.0, 0.0), (20.0, 0.0), (20.0, 1.0)]
    for k, length in reversed(list(enumerate(lengths))):
        x = 3.0 + 4 * k
        lower += [(x + 1.0, 1.0), (x + 1.0, 1.0 + length), (x, 1.0 + length), (x, 1.0)]
    return Profile.of(polygon([*lower, (0.0, 1.0)]))


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (_comb([4.0, 8.0, 12.0, 16.0]), _comb([4.0, 6.0, 8.0, 16.0])),
        (_tree([2.0, 4.0, 6.0, 8.0]), _tree([8.0, 2.0, 6.0, 4.0])),
        (_tree([2.0, 2.0, 8.0, 8.0]), _tree([2.0, 8.0, 2.0, 8.0])),
    ],
    ids=["slots moved", "arms in another order", "arms paired"],
)
def test_arrangement_shows(first, second):
    """The paper's histograms hardly differ; the default signature tells them apart, by many times what noise does."""
    a, b = medial_axis(first), medial_axis(second)
    pairs = zip(paper.signature(a).vectors.values(), paper.signature(b).vectors.values(), strict=True)
    assert max(float(np.linalg.norm(one - other)) for one, other in pairs) < 0.08
    assert _apart(shape_signature(a).vectors["shape"], shape_signature(b).vectors["shape"]) > 0.15


def test_holes_show_softly():
    """A small hole more moves the signature a little, a large one more."""
    plate = box(0, 0, 6, 4)
    plain, small, large = (
        _vector(Profile.of(plate, holes)) for holes in ([], [circle(2, 2, 0.15)], [circle(2, 2, 1.2)])
    )
    assert 0.05 < _apart(plain, small) < _apart(plain, large)


def test_the_constants_are_those_of_this_version():
    """Whoever changes them raises the version: the file is known by its hash."""
    content = files("mashape_cad.signatures").joinpath(FILE).read_bytes()
    assert hashlib.blake2b(content, digest_size=8).hexdigest() == "edca4e2c3e61994b"
    assert len(content) < 1_300_000
    assert sum(metric.unit.size for metric in shipped().metrics) == SIZE


@pytest.mark.parametrize(
    "profile",
    [
        Profile.of(Loop((Line.of((0, 0), (1, 0)), Line.of((1, 0), (0, 1)), Line.of((0, 1), (0, 0))))),
        Profile.of(box(0, 0, 100, 0.01)),
        Profile.of(circle(0, 0, 1)),
    ],
    ids=["triangle", "sliver", "disc"],
)
def test_plain_shapes_have_signatures_too(profile):
    """Nothing is divided by nothing."""
    assert np.isfinite(_vector(profile)).all()
