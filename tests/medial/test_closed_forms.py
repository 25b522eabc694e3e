"""The axes of which every number is known: nodes, radii, and points all along the branches, to 1e-9 of the size."""

import numpy as np
import pytest
from catalogue import KNOWN, Known
from courses import off_branches, runs

from mashape_cad.geometry.edge import Floats, Similarity
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.certificate import STATIONS, certificate
from mashape_cad.medial.graph import MedialAxis

# Of the larger side of the bounding box.
_ACCURACY = 1e-9
_NAMED = {
    "ellipse": "ellipse",
    "rectangle": "rectangle",
    "L": "ell",
    "stadium": "stadium",
    "ring with different centres": "eccentric ring",
    "disc": "disc",
    "parabola and line": "parabola and line",
    "two parallel offset splines": "offset splines",
    "gear with a bore": "gear with a bore",
    "square with a square hole": "frame",
}
_POSES = {
    "as drawn": Similarity.of(),
    "small and turned": Similarity.of(1e-3, 2.1, (0.02, -0.01)),
    "large and mirrored": Similarity.of(1e4, -0.7, (3e4, 5e4), mirror=True),
}


def _as_drawn(pose: Similarity, discs: Floats) -> Floats:
    """Discs (n, 3) of a profile that was moved, where they were."""
    centre = (discs[:, :2] - pose.offset) @ np.linalg.inv(pose.matrix).T
    return np.column_stack([centre, discs[:, 2] / pose.scale])


def _moved(pose: Similarity, discs: Floats) -> Floats:
    return np.column_stack([pose.apply(discs[:, :2]), discs[:, 2] * pose.scale])


def _size(known: Known) -> float:
    return float(np.ptp(known.profile.bounds, axis=0).max())


def _axis(known: Known, pose: Similarity) -> MedialAxis:
    return medial_axis(known.profile.transformed(pose))


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", _NAMED)
def test_nodes_have_the_places_radii_and_degrees_of_the_closed_form(name, pose):
    """Each expected node is there once, and no other."""
    known, similarity = KNOWN[_NAMED[name]], _POSES[pose]
    nodes = _axis(known, similarity).nodes
    kept = np.array(nodes.kind) != "seam"  # stands anywhere on a branch that closes on itself
    found = _as_drawn(similarity, np.column_stack([nodes.centre, nodes.radius])[kept])
    expected = np.array(known.nodes).reshape(-1, 4)
    off = np.abs(expected[:, None, :3] - found[None]).max(axis=2)
    assert len(found) == len(expected)
    assert off.min(axis=1, initial=np.inf if len(expected) else 0.0).max(initial=0.0) <= _ACCURACY * _size(known)
    assert nodes.degree[kept][off.argmin(axis=1) if len(expected) else []].tolist() == expected[:, 3].tolist()
    assert len(set(off.argmin(axis=1).tolist() if len(expected) else [])) == len(expected)


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", [name for name in _NAMED if KNOWN[_NAMED[name]].pieces])
def test_branches_are_the_closed_form_from_end_to_end(name, pose):
    """Every disc of a branch fulfils the formula, and every disc of the formula lies on a branch."""
    known, similarity = KNOWN[_NAMED[name]], _POSES[pose]
    axis, tol = _axis(known, similarity), _ACCURACY * _size(known)
    assert len(axis.branches) == known.branches
    discs = _as_drawn(similarity, np.concatenate([discs for _, _, discs in runs(axis, 60)]))
    assert np.min([piece.off(discs) for piece in known.pieces], axis=0).max() <= tol
    expected = np.concatenate([piece.along(31) for piece in known.pieces])
    tol *= similarity.scale
    assert off_branches(axis, _moved(similarity, expected), tol).max() <= tol


@pytest.mark.parametrize("pose", _POSES)
@pytest.mark.parametrize("name", _NAMED)
def test_closed_forms_are_certified(name, pose):
    """By the definition too."""
    found = certificate(_axis(KNOWN[_NAMED[name]], _POSES[pose]), STATIONS)
    assert found.reason == ""
    assert found.completeness_error <= _ACCURACY
