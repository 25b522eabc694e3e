import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mashape_cad.findings import Severity
from mashape_cad.geometry.chain import chain
from mashape_cad.geometry.drawing import Strand
from mashape_cad.geometry.edge import Arc, BSpline, Line, Similarity

# An outline of all kinds: 60 long, with a round end, a spline and a small chamfer.
OUTLINE = (
    Line.of((0, 0), (40, 0)),
    Arc.of((40, 10), 10.0, -np.pi / 2, np.pi),
    Line.of((40, 20), (20, 20)),
    BSpline.of(3, [0, 0, 0, 0, 1, 2, 2, 2, 2], [(20, 20), (15, 20), (12, 14), (5, 17), (0.5, 20)]),
    Line.of((0.5, 20), (0, 19.5)),
    Line.of((0, 19.5), (0, 0)),
)
AREA = sum(edge.area_integral() for edge in OUTLINE)
DIAGONAL = float(np.hypot(50, 20))


def strands(*edges, layer="0"):
    """Edges as entities of their own."""
    return [Strand(edge, i, f"{i:X}", layer) for i, edge in enumerate(edges)]


def polyline(points, entity=0, closed=True, layer="0"):
    """One entity of lines through points."""
    points = np.array(points, float)
    ends = zip(points, np.roll(points, -1, axis=0), strict=True)
    edges = [Line.of(a, b) for a, b in ends][: None if closed else -1]
    return [Strand(edge, entity, f"{entity:X}", layer) for edge in edges]


def codes(chained):
    """Codes of the findings, in order."""
    return [finding.code for finding in chained.findings]


def open_joints(loop):
    """Largest distance between ends that should meet."""
    return max(float(np.linalg.norm(a.end - b.start)) for a, b in zip(loop.edges, np.roll(loop.edges, -1), strict=True))


@settings(max_examples=80, deadline=None)
@given(
    order=st.permutations(range(len(OUTLINE))),
    backwards=st.lists(st.booleans(), min_size=len(OUTLINE), max_size=len(OUTLINE)),
    angles=st.lists(st.floats(0, 6.28), min_size=len(OUTLINE), max_size=len(OUTLINE)),
    gap=st.sampled_from([0.0, 1e-9, 1e-7, 1e-5, 0.9e-4, 1e-3]),
    far=st.sampled_from([0.0, 1e5]),
)
def test_edges_in_any_order_and_direction_with_gaps_are_the_loop_again(order, backwards, angles, gap, far):
    """Edges are moved apart by up to `gap` of the diagonal: they make one loop, which closes, keeps its kinds of edges,
    and its area to within gap times perimeter.
    """
    edges = []
    for i in order:
        shift = gap * DIAGONAL / 2 * np.array([np.cos(angles[i]), np.sin(angles[i])]) + far
        edge = OUTLINE[i].transformed(Similarity.of(offset=shift))
        edges.append(edge.reversed() if backwards[i] else edge)
    chained = chain(strands(*edges), 1e-4)
    (one,) = chained.loops
    kinds = sorted(type(edge).__name__ for edge in one.loop.edges)
    assert kinds == sorted(type(edge).__name__ for edge in OUTLINE)
    assert abs(one.loop.signed_area) == pytest.approx(AREA, rel=1e-9, abs=2 * gap * DIAGONAL * 120 + 1e-6 * bool(far))
    assert open_joints(one.loop) <= 1e-13 * (far + 100)
    assert sorted(one.handles) == [f"{i:X}" for i in range(len(OUTLINE))]


def test_no_edges_no_loops():
    """An empty drawing chains to nothing."""
    assert chain([], 1e-4).loops == ()


def test_a_bridged_gap_is_on_record_with_its_width_and_place():
    """Wider than rounding it counts as repaired."""
    loose = strands(*OUTLINE[1:], OUTLINE[0].transformed(Similarity.of(offset=(0, 0.004))))
    (finding,) = chain(loose, 1e-4).findings
    assert (finding.code, finding.severity, finding.count) == ("chain-gap", Severity.REPAIRED, 2)
    assert "0.004 mm" in finding.text
    assert min(np.linalg.norm(np.array(finding.place) - corner) for corner in [(0, 0), (40, 0)]) < 0.01


def test_a_gap_that_is_wide_beside_the_loop_stays_open():
    """A tenth of the side: the outline is reported, with its handle and the distance to the next loose end."""
    chained = chain(polyline([(0, 0), (40, 0), (40, 20), (0, 20), (0, 4)], closed=False), 1e-4)
    (finding,) = chained.findings
    assert chained.loops == ()
    assert (finding.code, finding.severity, finding.entity) == ("chain-open", Severity.LOST, "0")
    assert finding.place in {(0.0, 0.0), (0.0, 4.0)}
    assert "4 edges" in finding.text
    assert "4 mm away" in finding.text


def test_lines_side_by_side_are_not_joined_to_a_sliver():
    """Two parallel lines nearer than the widest gap stay two open chains."""
    chained = chain([*strands(*OUTLINE), *strands(Line.of((5, 5), (30, 5)), Line.of((5, 5.05), (30, 5.05)))], 1e-4)
    assert len(chained.loops) == 1
    assert codes(chained) == ["chain-open", "chain-open"]


def test_edges_drawn_twice_count_once_and_are_reported():
    """The whole outline again, backwards."""
    chained = chain(strands(*OUTLINE, *(edge.reversed() for edge in OUTLINE)), 1e-4)
    assert len(chained.loops) == 1
    assert [(finding.code, finding.count) for finding in chained.findings] == [("chain-duplicate", 6)]


def test_a_loop_drawn_as_lines_and_as_a_polyline_counts_once():
    """The entity that is closed in itself and the loose lines are the same loop."""
    corners = [(0, 0), (9, 0), (9, 5), (0, 5)]
    loose = [Strand(strand.edge, 5 + i, f"L{i}", "0") for i, strand in enumerate(polyline(corners))]
    chained = chain([*polyline(corners), *loose], 1e-4)
    assert len(chained.loops) == 1
    assert codes(chained) == ["loop-duplicate"]


def test_edges_without_length_are_left_out_and_counted():
    """A polyline that repeats a vertex still closes."""
    chained = chain(polyline([(0, 0), (9, 0), (9, 0), (9, 5), (0, 5), (0, 5)]), 1e-4)
    assert len(chained.loops[0].loop.edges) == 4
    assert [(finding.code, finding.count) for finding in chained.findings] == [("chain-zero-length", 2)]


def test_a_feature_of_a_millionth_of_the_drawing_survives():
    """A chamfer of 1e-4 on a plate of 100, with exact ends."""
    chained = chain(polyline([(0, 0), (100, 0), (100, 60), (1e-4, 60), (0, 60 - 1e-4)]), 1e-4)
    assert len(chained.loops[0].loop.edges) == 5


def test_a_centre_line_that_touches_a_corner_does_not_cost_the_outline():
    """It is reported as open; the outline is a loop."""
    chained = chain(strands(*OUTLINE, Line.of((0, 0), (20, 10)), Line.of((20, 10), (20, 30))), 1e-4)
    assert len(chained.loops) == 1
    (finding,) = chained.findings
    assert (finding.code, finding.place) == ("chain-open", (20.0, 30.0))
    assert "2 edges" in finding.text


def test_closed_polylines_that_share_a_side_are_two_loops():
    """An entity that is closed in itself is a loop, whatever its neighbours do."""
    left, right = [(0, 0), (5, 0), (5, 5), (0, 5)], [(5, 0), (9, 0), (9, 5), (5, 5)]
    chained = chain([*polyline(left), *polyline(right, entity=1)], 1e-4)
    assert len(chained.loops) == 2
    assert chained.findings == ()


def test_loops_that_share_a_point_are_two_loops():
    """Two triangles tip to tip, as loose lines."""
    tips = [(0, 0), (4, 0), (2, 3)], [(2, 3), (0, 6), (4, 6)]
    loose = [strand.edge for corners in tips for strand in polyline(corners)]
    assert [len(one.loop.edges) for one in chain(strands(*loose), 1e-4).loops] == [3, 3]


def test_where_the_graph_cannot_tell_the_layers_do():
    """A bend line from corner to corner on its own layer is set aside, the outline stays."""
    corners = [(0, 0), (9, 0), (9, 5), (0, 5)]
    loose = [Strand(strand.edge, i, f"{i}", "CUT") for i, strand in enumerate(polyline(corners))]
    bend = Strand(Line.of((0, 0), (9, 5)), 9, "B", "BEND")
    chained = chain([*loose, bend], 1e-4)
    assert [len(one.loop.edges) for one in chained.loops] == [4]
    assert [(finding.code, finding.entity) for finding in chained.findings] == [("chain-open", "B")]


def test_where_nothing_tells_all_is_reported_with_the_place_of_the_branch():
    """The same on one layer."""
    loose = [strand.edge for strand in polyline([(0, 0), (9, 0), (9, 5), (0, 5)])]
    chained = chain(strands(*loose, Line.of((0, 0), (9, 5))), 1e-4)
    assert chained.loops == ()
    (finding,) = chained.findings
    assert (finding.code, finding.severity) == ("chain-branch", Severity.LOST)
    assert finding.place in {(0.0, 0.0), (9.0, 5.0)}


def test_a_loop_without_width_is_reported():
    """There and back again on the same line."""
    chained = chain(polyline([(0, 0), (9, 0)]), 1e-4)
    assert chained.loops == ()
    assert codes(chained) == ["loop-flat"]


def test_many_open_chains_are_reported_one_by_one_up_to_a_number_then_summed():
    """A drawing of hatch lines does not flood the record."""
    chained = chain(strands(*(Line.of((0, i), (5, i)) for i in range(50))), 1e-4)
    assert len(chained.findings) == 21
    assert chained.findings[-1].count == 30
    assert sum(finding.count for finding in chained.findings) == 50


def test_a_drawing_far_from_the_origin_joins_what_its_digits_can_tell():
    """At 1e13 neighbouring numbers are 0.002 apart: ends that rounded apart by that much are the same."""
    far = 1e13
    corners = np.array([(0, 0), (100, 0), (100, 50), (0, 50)]) + far
    loose = [strand.edge for strand in polyline(corners)]
    loose[0] = Line.of(corners[0] + (0, 0.002), corners[1])
    assert len(chain(strands(*loose), 1e-9).loops) == 1


def test_an_edge_that_rounding_closes_is_no_loop():
    """Three points in a row, each within rounding of the next: the line between the outer ones has no inside."""
    step = 0.9e-9 * 100
    chained = chain(
        strands(
            Line.of((0, 0), (2 * step, 0)),
            Line.of((step, 0), (60, 80)),
            Line.of((60, 80), (0, 80)),
            Line.of((0, 80), (-9, 40)),
        ),
        1e-4,
    )
    assert chained.loops == ()
    assert set(codes(chained)) == {"chain-open"}
