"""How far two signatures are apart (paper, section 3.1.2; reading 16)."""

from collections.abc import Mapping

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.signatures.vectors import Signature

__all__ = ["distances"]


def distances(first: Signature, second: Signature) -> Mapping[str, float]:
    """Return the Euclidean distance of each pair of vectors with the same name.

    Raises
    ------
    ValueError
        If the signatures are of different kinds or versions.
    """
    if (first.name, first.version) != (second.name, second.version):
        raise ValueError(
            f"a signature {first.name} {first.version} cannot be compared with {second.name} {second.version}"
        )
    return {name: _norm(vector - second.vectors[name]) for name, vector in first.vectors.items()}


def _norm(difference: Floats) -> float:
    return float(np.linalg.norm(difference))
