import numpy as np

from mashape_cad.geometry.joining import bridged_ends, coincident_ends


def joined(ends, noise=1e-9, tolerance=0.1):
    """Nodes of edges given by their ends, with straight lengths."""
    ends = np.array(ends, float)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return bridged_ends(coincident_ends(ends, noise), ends, lengths, noise, tolerance)


def degrees(nodes):
    """How many ends the nodes have, sorted."""
    return sorted(np.unique(nodes, return_counts=True)[1].tolist())


def test_ends_at_the_same_place_are_one_node_however_many():
    """Three edges that meet exactly make a branch."""
    assert degrees(coincident_ends(np.array([[[0, 0], [1, 0]], [[0, 0], [0, 1]], [[0, 0], [-1, 0]]], float), 1e-9)) == [
        *(1, 1, 1),
        3,
    ]


def test_a_gap_up_to_the_tolerance_is_bridged_and_a_wider_one_is_not():
    """0.09 closes at 0.1, 0.11 does not."""
    assert degrees(joined([[(0, 0), (5, 0)], [(5.09, 0), (9, 3)]])) == [1, 1, 2]
    assert degrees(joined([[(0, 0), (5, 0)], [(5.11, 0), (9, 3)]])) == [1, 1, 1, 1]


def test_an_edge_smaller_than_the_tolerance_does_not_collapse():
    """A chamfer of 0.05 between long sides with gaps of 0.01 keeps two ends, at a tolerance of 0.1."""
    nodes = joined([[(0, 0), (5, 0)], [(5.01, 0), (5.05, 0.03)], [(5.05, 0.04), (5.05, 5)]])
    assert nodes[1, 0] != nodes[1, 1]
    assert nodes[0, 1] == nodes[1, 0]
    assert nodes[1, 1] == nodes[2, 0]


def test_the_nearest_ends_find_each_other_first():
    """Two joints less than the tolerance apart are not mixed up."""
    gap, apart = 0.02, 0.06
    nodes = joined([[(-5, 0), (0, 0)], [(gap, 0), (3, 4)], [(-5, apart), (0, apart)], [(gap, apart), (3, 9)]])
    assert nodes[0, 1] == nodes[1, 0]
    assert nodes[2, 1] == nodes[3, 0]
    assert nodes[0, 1] != nodes[2, 1]


def test_a_loose_end_near_a_finished_joint_stays_loose():
    """A centre line that ends beside a corner does not become part of it."""
    nodes = joined([[(0, 0), (5, 0)], [(5, 0), (5, 5)], [(4.95, 0.02), (1, 1)]])
    assert degrees(nodes) == [1, 1, 1, 1, 2]


def test_three_loose_ends_at_one_place_make_a_branch():
    """Rounded apart by 1e-4, still one point; no end is preferred by chance."""
    nodes = joined([[(0, 0), (5, 0)], [(5.0001, 0), (9, 0)], [(5, 0.0001), (5, 4)]])
    assert len({nodes[0, 1], nodes[1, 0], nodes[2, 0]}) == 1


def test_a_curve_with_its_ends_close_together_is_closed_and_a_short_line_is_not():
    """Length decides: a C shape of length 30 with a gap of 0.05 closes, a line of 0.05 keeps two ends."""
    ends = np.array([[(5, 0), (5, 0.05)], [(20, 0), (20, 0.05)]], float)
    nodes = bridged_ends(coincident_ends(ends, 1e-9), ends, np.array([30.0, 0.05]), 1e-9, 0.1)
    assert nodes[0, 0] == nodes[0, 1]
    assert nodes[1, 0] != nodes[1, 1]
