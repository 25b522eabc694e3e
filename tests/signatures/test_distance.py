"""How far two signatures are apart."""

import numpy as np
import pytest
from catalogue import axis_of

from mashape_cad.signatures.distance import distances
from mashape_cad.signatures.paper import signature
from mashape_cad.signatures.vectors import Signature


def test_the_distance_is_the_euclidean_one():
    """Reading 16: of each vector by itself."""
    a = Signature("paper", 1, {"df": np.array([1.0, 0.0, 0.0]), "rf": np.array([0.2, 0.8])})
    b = Signature("paper", 1, {"df": np.array([0.0, 1.0, 0.0]), "rf": np.array([0.5, 0.4])})
    assert distances(a, b) == pytest.approx({"df": np.sqrt(2), "rf": 0.5})
    assert distances(a, b) == distances(b, a)


def test_equal_signatures_are_at_no_distance():
    """Exactly."""
    found = distances(signature(axis_of("bracket")), signature(axis_of("bracket")))
    assert set(found.values()) == {0.0}


def test_different_shapes_are_apart():
    """In each of the three functions, and never further than two disjoint histograms."""
    shapes = [signature(axis_of(name)) for name in ("bracket", "blob", "ellipse", "ell", "plate with holes")]
    for i, first in enumerate(shapes):
        for second in shapes[:i]:
            found = distances(first, second)
            assert all(0.01 < value <= np.sqrt(2) for value in found.values())


@pytest.mark.parametrize("other", [("paper", 2), ("default", 1)])
def test_unlike_signatures_are_not_compared(other):
    """Another name or another version: an error that names both."""
    a, b = (Signature(*kind, {"df": np.zeros(64)}) for kind in (("paper", 1), other))
    with pytest.raises(ValueError, match=f"paper 1 cannot be compared with {other[0]} {other[1]}"):
        distances(a, b)
