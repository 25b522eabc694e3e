import numpy as np
import pytest

from mashape_cad.findings import Severity
from mashape_cad.geometry.edge import Arc, BSpline, Line
from mashape_cad.geometry.profile import Plane
from mashape_cad.kernel.faces import BrokenFace, FlatWire, PlanarFace, PlanarFaces
from mashape_cad.kernel.flattening import FlatEdge
from mashape_cad.reading.faces import face_profiles

_PLANE = Plane((1.0, 2.0, 3.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))  # its y axis is z


def _lines(*corners):
    return [Line.of(*ends) for ends in zip(corners, [*corners[1:], corners[0]], strict=True)]


def _square(size, x=0.0, y=0.0):
    return _lines((x, y), (x + size, y), (x + size, y + size), (x, y + size))


def _wire(edges, slits=0, **more):
    flat = [FlatEdge(edge, **({"error": 0.0, "height": 0.0, "is_approximation": False} | more)) for edge in edges]
    return FlatWire(tuple(flat), slits)


def _face(*wires, number=1, is_side=False, is_flat_spline=False):
    wires = [wire if isinstance(wire, FlatWire) else _wire(wire) for wire in wires]
    return PlanarFace(number, _PLANE, tuple(wires), is_side, is_flat_spline)


def _made(*faces, broken=(), curved=(), loose_edges=0, gap_rel=1e-4):
    return face_profiles(PlanarFaces(faces, broken, curved, loose_edges), gap_rel)


def _codes(made):
    return [finding.code for finding in made.findings]


def test_a_face_with_a_hole_is_one_profile_that_knows_its_face():
    """The hole keeps its sense; number and plane are kept."""
    hole = [Arc.of((2, 2), 1.0).reversed()]
    made = _made(_face(_square(4), hole, number=7))
    (profile,) = made.profiles
    assert profile.area == pytest.approx(16 - np.pi, rel=1e-14)
    assert profile.origin.face == 7
    assert profile.origin.plane == _PLANE
    assert made.findings == ()


def test_order_of_wires_does_not_matter():
    """The largest loop is the outline, wherever it stands."""
    hole = [Arc.of((2, 2), 1.0).reversed()]
    (profile,) = _made(_face(hole, _square(4))).profiles
    assert len(profile.outer.edges) == 4
    assert len(profile.holes) == 1


def test_sides_come_last_and_the_largest_face_first():
    """However large a side is."""
    sizes = {1: 5, 2: 50, 3: 7, 4: 60}
    faces = [_face(_square(size), number=number, is_side=number in (2, 4)) for number, size in sizes.items()]
    assert [profile.origin.face for profile in _made(*faces).profiles] == [3, 1, 4, 2]


def test_equal_faces_come_in_the_order_of_their_numbers():
    """Areas that differ in the tenth digit are equal: top and bottom of a plate."""
    faces = [_face(_square(5 * (1 + 1e-12 * number)), number=number) for number in (1, 2, 3)]
    assert [profile.origin.face for profile in _made(*faces).profiles] == [1, 2, 3]


def test_edges_meet_exactly_where_they_nearly_met():
    """Ends 1e-9 apart are moved together; nothing is said of such rounding."""
    edges = [
        Line.of((0, 0), (4, 0)),
        Line.of((4, 1e-9), (4, 4)),
        Arc.of((2, 4), 2.0, 0.0, np.pi),
        Line.of((1e-9, 4), (0, 0)),
    ]
    made = _made(_face(edges))
    loop = made.profiles[0].outer
    for before, edge in zip([loop.edges[-1], *loop.edges], loop.edges, strict=False):
        assert edge.start == pytest.approx(before.end, abs=1e-15)
    assert isinstance(loop.edges[2], Arc)
    assert made.findings == ()


def test_wider_gaps_are_bridged_and_told():
    """A gap of 1e-5 of the diagonal is repaired: one finding for all faces together."""
    edges = [*_square(1)[:3], Line.of((0, 1), (0, 1.4e-5))]
    made = _made(_face(edges, number=1), _face(edges, number=2))
    assert _codes(made) == ["chain-gap"]
    assert made.findings[0].count == 2
    assert made.findings[0].severity is Severity.REPAIRED
    assert len(made.profiles) == 2


def test_edges_in_no_order_are_chained():
    """Some kernels lose the order of a wire's edges."""
    edges = _square(4)
    shuffled = [edges[2], edges[0].reversed(), edges[3], edges[1]]
    made = _made(_face(shuffled))
    assert made.profiles[0].area == pytest.approx(16, rel=1e-14)
    assert made.findings == ()


def test_an_open_outline_is_a_finding_at_its_place_in_space():
    """The gap is wider than allowed: no profile, and where the loose end is."""
    made = _made(_face(_square(4)[:3], number=5))
    assert made.profiles == ()
    assert _codes(made) == ["chain-open", "entity-face-open", "file-no-planar-face"]
    assert made.findings[0].entity == "face 5"
    assert made.findings[0].place in ((1.0, 2.0, 3.0), (1.0, 2.0, 7.0))


def test_a_wire_of_one_open_edge_is_a_finding():
    """A single line or arc closes nothing."""
    for edge in (Line.of((0, 0), (1, 0)), Arc.of((0, 0), 1.0, 0.0, 3.0)):
        assert "entity-face-open" in _codes(_made(_face([edge])))


def test_circles_that_share_a_wire_are_loops_of_their_own():
    """Two circles that touch: each is closed in itself."""
    made = _made(_face([Arc.of((0, 0), 2.0), Arc.of((5, 0), 3.0)]))
    assert sorted(profile.area for profile in made.profiles) == pytest.approx([4 * np.pi, 9 * np.pi])


def test_two_outlines_in_one_face_are_two_profiles():
    """Wires side by side cannot be outline and hole."""
    made = _made(_face(_square(4), _square(3, x=10)))
    assert [profile.area for profile in made.profiles] == pytest.approx([16, 9])
    assert {profile.origin.face for profile in made.profiles} == {1}


def test_a_face_seen_from_the_wrong_side_is_turned():
    """If all wires run the wrong way, material still ends up on the left."""
    hole = [Arc.of((2, 2), 1.0)]
    clockwise = [edge.reversed() for edge in reversed(_square(4))]
    (profile,) = _made(_face(clockwise, hole)).profiles
    assert profile.outer.signed_area > 0
    assert profile.holes[0].signed_area < 0


def test_points_and_slivers_are_left_out():
    """Edges without length, and loops without area."""
    point = Line.of((4, 0), (4, 0))
    edges = _square(4)
    made = _made(_face([edges[0], point, *edges[1:]], _lines((1, 1), (2, 1))))
    assert len(made.profiles[0].edges) == 4
    assert _codes(made) == ["loop-flat"]


def test_splines_are_cut_at_kinks_and_round_ones_become_arcs():
    """As drawings are read, so that a part is the same from either."""
    polyline = BSpline.of(1, [0, 0, 1, 2, 2], [(0, 0), (4, 0), (4, 4)])
    half = Arc.of((2, 4), 2.0, 0.0, np.pi).spans()[0]
    points = half[..., :2] / half[..., 2:]
    poles, weights = np.concatenate([points[0], points[1][1:]]), np.concatenate([half[0, :, 2], half[1, 1:, 2]])
    round_end = BSpline.of(2, [0, 0, 0, 1, 1, 2, 2, 2], poles, weights)
    made = _made(_face([polyline, round_end, Line.of((0, 4), (0, 0))]))
    assert [type(edge) for edge in made.profiles[0].edges] == [Line, Line, Arc, Line]


def test_free_splines_keep_their_numbers():
    """Poles, knots and weights as the kernel gave them, where ends meet already."""
    poles = [(4, 0), (6, 1), (5, 4), (2, 6), (0, 0)]
    spline = BSpline.of(3, [0, 0, 0, 0, 0.3, 1, 1, 1, 1], poles, [1, 2, 1, 0.5, 1])
    made = _made(_face([Line.of((0, 0), (4, 0)), spline]))
    kept = made.profiles[0].edges[1]
    assert np.array_equal(kept.poles, spline.poles)
    assert np.array_equal(kept.knots, spline.knots)
    assert np.array_equal(kept.weights, spline.weights)


@pytest.mark.parametrize(
    ("face", "code", "severity"),
    [
        (_face(_square(4), is_flat_spline=True), "entity-flat-spline", Severity.INFO),
        (_face(_wire(_square(4), slits=2)), "entity-slit", Severity.REPAIRED),
        (_face(_wire(_square(4), is_approximation=True, error=1e-9)), "entity-approximated", Severity.REPAIRED),
        (_face(_wire(_square(4), error=1e-6)), "entity-approximated", Severity.REPAIRED),
        (_face(_wire(_square(4), height=1e-3)), "entity-not-flat", Severity.REPAIRED),
    ],
)
def test_what_was_changed_or_is_special_is_told_with_its_face(face, code, severity):
    """And the profile is there all the same."""
    made = _made(face)
    assert _codes(made) == [code]
    assert made.findings[0].severity is severity
    assert made.findings[0].entity == "face 1"
    assert len(made.profiles) == 1


def test_what_is_no_profile_is_told():
    """Broken faces one by one, curved ones and loose edges as sums."""
    made = _made(_face(_square(4)), broken=(BrokenFace(3, "no plane"),), curved=(2, 4), loose_edges=5)
    found = {finding.code: finding for finding in made.findings}
    assert set(found) == {"entity-face-broken", "entity-curved-face", "entity-loose-edge"}
    assert found["entity-face-broken"].entity == "face 3"
    assert found["entity-curved-face"].count == 2
    assert found["entity-loose-edge"].count == 5


def test_scaled_are_profiles_planes_and_places():
    """A part in inches is 25.4 times as large everywhere."""
    made = _made(_face(_wire(_square(4), height=1e-3))).scaled(25.4)
    assert made.profiles[0].area == pytest.approx(16 * 25.4**2, rel=1e-14)
    assert made.profiles[0].origin.plane.origin == pytest.approx((25.4, 50.8, 76.2))
    assert made.profiles[0].origin.plane.normal == _PLANE.normal
    assert made.findings[0].place == pytest.approx((25.4, 50.8, 76.2))
