"""Places where the axis may end, and what becomes of each."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from catalogue import KNOWN, NAMED, axis_of

from mashape_cad.medial.candidates import candidate_objections, candidates, touched_arcs


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("rectangle", {"convex vertex": 4}),
        ("ell", {"convex vertex": 5}),
        ("stadium", {"arc": 2}),
        ("ellipse", {"curvature maximum": 2}),
        ("lens", {"convex vertex": 2, "arc": 2}),
        ("disc", {"arc": 1}),
        ("frame", {"convex vertex": 4}),
    ],
)
def test_candidates_can_be_told_without_a_computer(name, expected):
    """Convex vertices, the two sharp ends of an ellipse, and arcs, which need not touch as a whole."""
    axis = axis_of(name)
    found = Counter(candidate.kind for candidate in candidates(axis.tour, touched_arcs(axis)))
    # On an arc that no disc touches as a whole, rounding makes maxima of curvature.
    assert {kind: count for kind, count in found.items() if kind in expected} == expected


@pytest.mark.parametrize("name", [*KNOWN, *NAMED])
def test_every_candidate_of_the_catalogue_is_accounted_for(name):
    """As a disc of the axis, or by a witness: the arcs of the lens have one, the chord of the half disc is one."""
    assert not list(candidate_objections(axis_of(name)))


def test_a_vertex_that_the_tour_does_not_call_convex_is_a_candidate_all_the_same():
    """Its tangents say so."""
    axis = axis_of("rectangle")
    element = axis.tour.element.copy()
    element["convex"][2] = False
    found = candidates(axis.tour._replace(element=element), touched_arcs(axis))
    assert sum(candidate.kind == "convex vertex" for candidate in found) == 4


def test_an_end_that_is_no_candidate_is_named():
    """A junction that calls itself an end."""
    axis = axis_of("rectangle")
    junction = axis.nodes.kind.index("junction")
    degree = axis.nodes.degree.copy()
    degree[junction] = 1
    [objection] = candidate_objections(replace(axis, nodes=replace(axis.nodes, degree=degree)))
    assert f"end {junction} is no convex vertex" in objection.text
    assert objection.place == pytest.approx(tuple(axis.nodes.centre[junction]))


def test_a_disc_that_touches_twice_at_a_candidate_has_passed_it_by():
    """A station between two feet beside a vertex of curvature has the disc of an end, but is none."""
    axis = axis_of("ellipse")
    end = axis.nodes.kind.index("end")
    disc = int(axis.nodes.disc[end])
    contact = int(np.flatnonzero(axis.contacts.disc == disc)[0])
    assert not list(candidate_objections(axis))
    contacts = axis.contacts
    twice = replace(
        contacts,
        first=np.insert(contacts.first, contact, contacts.first[contact], axis=0),
        last=np.insert(contacts.last, contact, contacts.last[contact], axis=0),
        disc=np.insert(contacts.disc, contact, disc),
        piece=np.insert(contacts.piece, contact, 0),
        side=np.insert(contacts.side, contact, 0),
    )
    texts = [str(objection) for objection in candidate_objections(replace(axis, contacts=twice))]
    assert any("the curvature maximum on edge 0" in text and "ends no branch" in text for text in texts)
