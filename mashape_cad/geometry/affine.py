"""Images of edges under affine maps, which may shear: an arc becomes an arc of an ellipse, all else keeps its kind.

Similarities have `Edge.transformed`; this is for the rest, such as a drawing's block that is scaled unevenly.

References
----------
Rytz's construction: the principal semi-axes of an ellipse from any two conjugate ones.
"""

from dataclasses import replace

import numpy as np

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line, Similarity, frozen

__all__ = ["affine_image", "ellipse_arc"]

# Relative: semi-axes that differ by less belong to a circle, a matrix that is off by less keeps shapes. Files carry
# 15 digits, and products of a few matrices lose one or two of them.
_SAME_SCALE = 1e-12


def affine_image(edge: Edge, matrix: Floats, offset: Floats) -> Edge:
    """Return the image of an edge under ``p -> matrix @ p + offset``.

    Parameters
    ----------
    edge : Edge
    matrix : (2, 2) array
        Regular; may mirror, shear and scale unevenly.
    offset : (2,) array
        mm.
    """
    if _keeps_shapes(matrix):
        return edge.transformed(Similarity(frozen(matrix), frozen(offset)))
    if isinstance(edge, Line):
        return Line.of(matrix @ edge.first + offset, matrix @ edge.last + offset)
    if isinstance(edge, BSpline):
        return replace(edge, poles=frozen(edge.poles @ matrix.T + offset))
    if isinstance(edge, EllipseArc):
        return ellipse_arc(
            matrix @ edge.centre + offset, matrix @ edge.axis_a, matrix @ edge.axis_b, edge.start_angle, edge.sweep
        )
    raise TypeError(f"no affine image of a {type(edge).__name__}")


def ellipse_arc(centre: Floats, half_a: Floats, half_b: Floats, start_angle: float, sweep: float) -> EllipseArc:
    """Make an arc from any two conjugate half diameters: ``centre + cos(t) half_a + sin(t) half_b``.

    Returns
    -------
    EllipseArc
        With perpendicular semi-axes; an `Arc` where they have the same length.
    """
    shift = 0.5 * np.arctan2(2 * half_a @ half_b, half_a @ half_a - half_b @ half_b)
    cos, sin = np.cos(shift), np.sin(shift)
    axis_a, axis_b = cos * half_a + sin * half_b, cos * half_b - sin * half_a
    size_a, size_b = np.hypot(*axis_a), np.hypot(*axis_b)
    if abs(size_a - size_b) <= _SAME_SCALE * size_a:
        # Any two perpendicular half diameters of a circle do: the ones given keep their angles free of rounding.
        return Arc(frozen(centre), frozen(half_a), frozen(half_b), float(start_angle), float(sweep))
    return EllipseArc(frozen(centre), frozen(axis_a), frozen(axis_b), float(start_angle - shift), float(sweep))


def _keeps_shapes(matrix: Floats) -> bool:
    (a, b), (c, d) = matrix
    scale = np.abs(matrix).max()
    direct = max(abs(a - d), abs(b + c))
    mirrored = max(abs(a + d), abs(b - c))
    return bool(min(direct, mirrored) <= _SAME_SCALE * scale)
