"""JSON for other programs, held against closed forms."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from catalogue import KNOWN, profile_of
from traces import traced

from mashape_cad.geometry.profile import Origin, Plane
from mashape_cad.library.record import Refusal
from mashape_cad.library.tracing import RefusedProfile
from mashape_cad.options import AxisOptions
from mashape_cad.views.axis_json import axes_json


def _document(found, refused=(), options=None, name="part.dxf"):
    return json.loads(axes_json(found, refused, options or AxisOptions(), Path(name)))


@pytest.mark.parametrize("name", KNOWN)
def test_values_are_those_of_the_closed_form(name):
    """Nodes, degrees and every sample."""
    known = KNOWN[name]
    (profile,) = _document(traced(name))["profiles"]
    tol = 1e-9 * known.profile.diagonal
    nodes = sorted((n["x"], n["y"], n["r"], n["degree"]) for n in profile["nodes"] if n["kind"] != "seam")
    assert len(nodes) == len(known.nodes)
    for node in known.nodes:
        assert min(np.abs(np.subtract(node, found)).max() for found in nodes) <= tol
    assert len(profile["branches"]) == known.branches
    for branch in profile["branches"]:
        points = np.column_stack([branch[key] for key in "xyr"])
        assert np.min([piece.off(points) for piece in known.pieces], axis=0).max() <= tol


@pytest.mark.parametrize("name", ["rectangle", "ellipse", "ell", "eccentric ring", "disc", "frame"])
def test_the_document_has_the_form_that_is_described(name):
    """Exactly these keys, numbers where numbers are promised; branches begin and end with their nodes."""
    document = _document(traced(name))
    assert list(document) == ["format", "version", "generator", "source", "unit", "options", "profiles", "refused"]
    assert (document["format"], document["version"], document["unit"]) == ("mashape-axis", 1, "mm")
    (profile,) = document["profiles"]
    assert list(profile) == ["profile", "nodes", "branches"]
    for node in profile["nodes"]:
        assert list(node) == ["x", "y", "r", "kind", "degree"]
        assert node["kind"] in {"junction", "end", "seam", "disc"}
    for branch in profile["branches"]:
        assert list(branch) == ["start", "end", "x", "y", "r"]
        assert len(branch["x"]) == len(branch["y"]) == len(branch["r"]) >= 2
        for node, at in ((branch["start"], 0), (branch["end"], -1)):
            assert {key: branch[key][at] for key in "xyr"} == {key: profile["nodes"][node][key] for key in "xyr"}


def test_several_profiles_and_what_was_refused():
    """Each under its number; a refused one with reason and place, and not among the others."""
    refused = RefusedProfile(2, profile_of("lens"), Refusal("profile-invalid", "it crosses", (1.0, 2.0), "crossing"))
    document = _document(traced("rectangle", "ell"), (refused,))
    assert [each["profile"] for each in document["profiles"]] == [0, 1]
    (left_out,) = document["refused"]
    assert (left_out["profile"], left_out["kind"], left_out["place"]) == (2, "crossing", [1.0, 2.0])


def test_the_plane_of_a_face():
    """Where the profile's coordinates lie in space."""
    plane = Plane((1.0, 2.0, 3.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    profile = replace(profile_of("rectangle"), origin=Origin(face=7, plane=plane))
    (each,) = _document(traced(profile))["profiles"]
    assert each["face"] == 7
    assert each["plane"] == {"origin": [1.0, 2.0, 3.0], "x_axis": [0.0, 1.0, 0.0], "normal": [0.0, 0.0, 1.0]}


def test_names_that_are_no_text():
    """Bytes of a file name, and of a layer, that are not UTF-8."""
    profile = replace(profile_of("rectangle"), origin=Origin(layer="L\udce4nge"))
    document = _document(traced(profile), name="Tr\udce4ger.dxf")
    assert document["source"] == "Tr\ufffdger.dxf"
    assert document["profiles"][0]["layer"] == "L\ufffdnge"


def test_what_shaped_the_axis_is_on_record():
    """A pruned axis says so by the options it was made with."""
    options = AxisOptions(min_angle=46.0)
    document = _document(traced("rectangle", min_angle=46.0), options=options)
    assert document["options"] == {"step": None, "min_angle": 46.0, "min_thickness": 0.0}
    assert len(document["profiles"][0]["branches"]) == 1
