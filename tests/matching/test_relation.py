import subprocess
import sys

import pytest

from mashape_cad.matching.relation import Kind, Relation

HERE = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("kind", "scale", "mirrored", "said"),
    [
        (Kind.IDENTICAL, 1.0, False, "identical"),
        (Kind.MIRRORED, 1.0, True, "mirrored"),
        (Kind.SCALED, 25.4, False, "scaled by 25.4 (inch/mm?)"),
        (Kind.SCALED, 1 / 25.4, False, "scaled by 0.0393701 (inch/mm?)"),
        (Kind.SCALED, 1.37, True, "scaled by 1.37, mirrored"),
        (Kind.MODIFIED, 1.0, False, "modified"),
        (Kind.MODIFIED, 25.4, True, "modified, scaled by 25.4 (inch/mm?), mirrored"),
        (Kind.SIMILAR, 0.7, True, "similar"),
    ],
)
def test_what_is_said(kind, scale, mirrored, said):
    """In the words of the user's question; what is merely similar is not worth more."""
    assert str(Relation(kind, scale, mirrored, 0.0, 0.0, 1.0, 0.1, HERE)) == said


def test_a_factor_of_25_is_no_inch():
    """Only 25.4 is."""
    assert Relation(Kind.SCALED, 25.0, False, 0.0, 0.0, 1.0, 0.1, HERE).hint is None


def test_showing_a_relation_loads_no_kernel():
    """Nor numpy: a search by sidecars alone imports this module."""
    code = (
        "import sys, mashape_cad.matching.relation; print([m for m in ('OCP', 'numpy', 'scipy') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
