"""DXF drawings of axes, read back by ezdxf."""

import io
from dataclasses import replace

import ezdxf
import numpy as np
import pytest
import shapely
from catalogue import KNOWN, NAMED, profile_of
from ezdxf import recover
from scipy.interpolate import BSpline
from traces import moved, traced

from mashape_cad.geometry.edge import Arc, EllipseArc, Line, Similarity, frozen
from mashape_cad.geometry.profile import Loop, Origin, Plane, Profile
from mashape_cad.kernel import DistanceQuery
from mashape_cad.views import axis_dxf
from mashape_cad.views.axis_dxf import APPLICATION, axes_dxf

_ALL = [*KNOWN, *NAMED]
# Of the diagonal: what docs/axis-format.md promises of the splines.
ACCURACY = 1e-6


def _read(*profiles, **options):
    content = axes_dxf(traced(*profiles, splines=True, **options))
    document, auditor = recover.read(io.BytesIO(content))
    assert not auditor.has_errors
    assert not auditor.has_fixes
    return document


def _branch_entities(document, profile=0):
    """Entities of each branch of a profile with their extended data: number, profile, branch, start, end; radii."""
    for entity in document.modelspace().query("LINE SPLINE"):
        if entity.dxf.layer.startswith("AXIS"):
            data = entity.get_xdata(APPLICATION)
            assert data[0].value == "branch"
            known = [tag.value for tag in data if tag.code == 1071]
            if known[0] == profile:
                yield entity, known, [tag.value for tag in data if tag.code == 1040]


def _points(entity, radii):
    """Points (x, y, r) along an entity."""
    if entity.dxftype() == "LINE":
        share = np.linspace(0, 1, 50)[:, None]
        ends = np.array([[*entity.dxf.start.vec2, radii[0]], [*entity.dxf.end.vec2, radii[1]]])
        return ends[0] + share * (ends[1] - ends[0])
    poles = np.column_stack([np.array(entity.control_points)[:, :2], radii])
    knots = np.array(entity.knots)
    curve = BSpline(knots, poles, entity.dxf.degree)
    points = curve(np.linspace(knots[0], knots[-1], 400))
    tool = np.array([tuple(p) for p in entity.construction_tool().points(np.linspace(0, knots[-1] - knots[0], 400))])
    if knots[0] == 0.0:
        assert tool[:, :2] == pytest.approx(points[:, :2], abs=1e-9)  # ezdxf sees the same curve
    return points


@pytest.mark.parametrize("name", _ALL)
def test_branches_are_on_the_exact_axis(name):
    """All along each entity, its point is as far from the boundary as its radius says, by the kernel."""
    profile = profile_of(name)
    query, branches = DistanceQuery(profile), set()
    for entity, (_, branch, _, _), radii in _branch_entities(_read(name)):
        points = _points(entity, radii)
        measured = query.distances(points[:, :2])
        assert np.abs(measured - points[:, 2]).max() <= 1.5 * ACCURACY * profile.diagonal
        branches.add(branch)
    assert branches == set(range(len(traced(name)[0].trace.branches)))


@pytest.mark.parametrize("name", [name for name in KNOWN if KNOWN[name].pieces])
def test_branches_are_those_of_the_closed_form(name):
    """The same against the equations."""
    for entity, _, radii in _branch_entities(_read(name)):
        off = np.min([piece.off(_points(entity, radii)) for piece in KNOWN[name].pieces], axis=0)
        assert off.max() <= 2 * ACCURACY * KNOWN[name].profile.diagonal


@pytest.mark.parametrize("name", _ALL)
def test_carving_paths_have_the_radius_as_depth(name):
    """3D polylines whose vertices are settled discs, z = -r; one for each branch."""
    profile = profile_of(name)
    paths = _read(name).modelspace().query("POLYLINE")
    trace = traced(name)[0].trace
    assert len(paths) == len(trace.branches)
    for path, branch in zip(paths, trace.branches, strict=True):
        assert path.is_3d_polyline
        assert path.dxf.layer == "AXIS_VCARVE"
        vertices = np.array([tuple(vertex.dxf.location) for vertex in path.vertices])
        assert vertices[:, :2] == pytest.approx(branch.centre, abs=1e-9 * profile.diagonal)
        assert -vertices[:, 2] == pytest.approx(branch.radius, abs=1e-9 * profile.diagonal)
        known = [tag.value for tag in path.get_xdata(APPLICATION) if tag.code == 1071]
        assert known[2:] == [branch.start, branch.end]


def test_units_and_header():
    """Millimetres, metric, and a version that CAM programs read."""
    document = _read("ell")
    assert document.header["$INSUNITS"] == 4
    assert document.header["$MEASUREMENT"] == 1
    assert document.dxfversion == "AC1024"
    assert APPLICATION in document.appids


def test_layers_tell_where_a_branch_ends():
    """Into a vertex, in an osculating disc, or in junctions only."""
    counts = {}
    for name in ("rectangle", "rounded rectangle", "ellipse", "eccentric ring"):
        layers = [entity.dxf.layer for entity, _, _ in _branch_entities(_read(name))]
        counts[name] = {layer: layers.count(layer) for layer in sorted(set(layers))}
    assert counts == {
        "rectangle": {"AXIS": 1, "AXIS_VERTEX": 4},
        "rounded rectangle": {"AXIS": 1, "AXIS_END": 4},
        "ellipse": {"AXIS_END": 1},
        "eccentric ring": {"AXIS": 1},
    }


def test_straight_branches_are_lines():
    """Where radius and place change in proportion; the radii of both ends stand with it."""
    entities = list(_branch_entities(_read("rectangle")))
    assert [entity.dxftype() for entity, _, _ in entities] == ["LINE"] * 5
    assert max(radii for _, _, radii in entities) == pytest.approx([1.5, 1.5])


def test_a_disc_is_a_point():
    """In the plane, and at its depth; the radius stands with it."""
    flat, deep = sorted(_read("disc").modelspace().query("POINT"), key=lambda point: -point.dxf.location.z)
    assert tuple(flat.dxf.location) == pytest.approx((0.3, 0.4, 0.0))
    assert tuple(deep.dxf.location) == pytest.approx((0.3, 0.4, -1.7))
    assert flat.get_xdata(APPLICATION)[-1].value == pytest.approx(1.7)


def test_very_long_branches_are_cut(monkeypatch):
    """Into splines that join, since extended data have room for so many radii."""
    monkeypatch.setattr(axis_dxf, "_MOST_SPANS", 5)
    entities = list(_branch_entities(_read("eccentric ring")))
    assert len(entities) > 5
    runs = [_points(entity, radii) for entity, _, radii in entities]
    for before, behind in zip(runs, runs[1:] + runs[:1], strict=True):
        assert before[-1] == pytest.approx(behind[0], abs=1e-9)
    measured = DistanceQuery(profile_of("eccentric ring")).distances(np.concatenate(runs)[:, :2])
    assert np.abs(measured - np.concatenate(runs)[:, 2]).max() <= 1.5 * ACCURACY * 10


# The outline


def _outline_points(document):
    """Points of all entities of the outline, by the formulas of the format."""
    for entity in document.modelspace().query('*[layer=="OUTLINE"]'):
        match entity.dxftype():
            case "LINE":
                yield np.array([tuple(entity.dxf.start), tuple(entity.dxf.end)])[:, :2]
            case "CIRCLE":
                yield np.array([tuple(p) for p in entity.vertices(np.linspace(0, 360, 40))])[:, :2]
            case "ARC":
                span = (entity.dxf.end_angle - entity.dxf.start_angle) % 360
                angles = entity.dxf.start_angle + np.linspace(0, span, 40)
                yield np.array([tuple(p) for p in entity.vertices(angles)])[:, :2]
            case "ELLIPSE":
                u = np.linspace(entity.dxf.start_param, entity.dxf.end_param, 40)
                yield np.array([tuple(p) for p in entity.vertices(u)])[:, :2]
            case "SPLINE":
                tool = entity.construction_tool()
                yield np.array([tuple(p) for p in tool.points(np.linspace(0, tool.max_t, 60))])[:, :2]


def _check_outline(profile):
    """All points of the outline lie on the profile's edges, and those of the edges on it."""
    edges = np.concatenate([edge.flattened(24) for edge in profile.edges])
    drawn = list(_outline_points(_read(profile)))
    assert len(drawn) == len(profile.edges)
    assert DistanceQuery(profile).distances(np.concatenate(drawn)).max() <= 1e-9 * profile.diagonal
    lines = shapely.union_all([shapely.LineString(points) for points in drawn])
    assert max(lines.distance(shapely.Point(p)) for p in edges) <= 2e-2 * profile.diagonal


@pytest.mark.parametrize("name", _ALL)
def test_the_outline_is_exact(name):
    """Lines, arcs, ellipses and splines, rational ones too, as entities of their own kind."""
    _check_outline(profile_of(name))


@pytest.mark.parametrize("name", ["bracket", "wave", "keyhole", "rational blob"])
def test_the_outline_of_a_mirrored_part(name):
    """Mirrored arcs have left-handed axes, which entities do not know."""
    _check_outline(profile_of(name).transformed(Similarity.of(2.0, 0.7, (30.0, -5.0), mirror=True)))


@pytest.mark.parametrize("sweep", [2 * np.pi, -2 * np.pi])
@pytest.mark.parametrize("axes", [((3, 0), (0, 1)), ((1, 0), (0, 3)), ((0, 3), (1, 0)), ((3, 0), (0, -1))])
def test_whole_ellipses(axes, sweep):
    """Either semi-axis first, either hand, either way round."""
    edge = EllipseArc(frozen([1, 2]), frozen(axes[0]), frozen(axes[1]), 0.3, sweep)
    _check_outline(Profile.of(Loop((edge,))))


def test_holes_are_drawn():
    """A circle that runs clockwise is a circle."""
    document = _read("plate with a round hole")
    assert len(document.modelspace().query("CIRCLE")) == 1


def test_arcs_through_zero_degrees():
    """Their angles are those of a counter-clockwise arc."""
    arc = Arc.of((0, 0), 2.0, -0.5, 1.0)
    _check_outline(Profile.of(Loop((arc, Line.of(arc.end, arc.start)))))


# Several profiles


def test_profiles_of_a_drawing_share_their_layers():
    """They lie beside one another as in the file; extended data tell them apart."""
    document = _read("rectangle", moved("ell", 20, 0))
    assert {entity.dxf.layer for entity in document.modelspace()} == {"OUTLINE", "AXIS", "AXIS_VERTEX", "AXIS_VCARVE"}
    assert len(list(_branch_entities(document, 0))) == 5
    assert len(list(_branch_entities(document, 1))) == 7


def test_faces_in_different_planes_have_layers_of_their_own():
    """They lie on top of each other, so that somebody has to switch between them."""
    top, bottom = (
        replace(profile_of("rectangle"), origin=Origin(face=face, plane=Plane((0.0, 0.0, z), (1.0, 0, 0), (0, 0, 1.0))))
        for face, z in ((3, 0.0), (7, 5.0))
    )
    layers = {entity.dxf.layer for entity in _read(top, bottom).modelspace()}
    assert {"OUTLINE_FACE_3", "OUTLINE_FACE_7", "AXIS_VCARVE_FACE_7"} <= layers
    assert "OUTLINE" not in layers
    assert "OUTLINE" in {entity.dxf.layer for entity in _read(top).modelspace()}


def test_a_pruned_axis_can_be_drawn():
    """What is left of the rectangle is a line between its two junctions."""
    ((entity, _, _),) = _branch_entities(_read("rectangle", min_angle=46.0))
    assert entity.dxftype() == "LINE"
    assert entity.dxf.layer == "AXIS_END"


def test_ezdxf_reads_it_without_recovering(tmp_path):
    """As a file."""
    path = tmp_path / "Träger 1.dxf"
    path.write_bytes(axes_dxf(traced("blob", splines=True)))
    assert len(ezdxf.readfile(path).modelspace().query("SPLINE")) > 3
