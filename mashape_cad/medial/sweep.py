"""The area that spokes sweep, from boundary places to the centres of their discs: compiled quadrature.

Areas and lengths are in the tour's scale.

References
----------
R. Piessens, E. de Doncker-Kapenga, C. W. Ueberhuber, D. K. Kahaner, QUADPACK (1983): the pair of rules with 7 and 15
points, whose difference tells the error. A third rule is ours.
"""

import numpy as np

from mashape_cad.geometry.edge import Floats
from mashape_cad.medial.compiled import compiled
from mashape_cad.medial.disc import twin_on_stretch
from mashape_cad.medial.tour import Ints, Tour, site

__all__ = ["swept_by_arcs", "swept_by_pieces"]

# Quadrature of a side of a piece is halved while its two rules differ by more than this (areas of the frame), no
# further than so often and into no more parts: next to an end at a jump of curvature the radius changes like a root.
_QUADRATURE, _HALVINGS, _PARTS = 1e-11, 24, 100
# Next to a vertex between edges that hardly turn, the radius leaves 0 within a millionth of the stretch, where no point
# of quadrature lies. That is seen by how far from proportional it is at two shares of the stretch; the stretch is then
# cut at every tenth towards the vertex, so often.
_NEAR, _FAR, _GRADES = 1e-4, 1e-1, 8
_ROUNDING = 1e-15  # of coordinates of the frame and what is computed of them
# A radius of which rounding may take this share counts for nothing. One in proportion to the place is taken instead, as
# in a wedge between straight edges, and all of it is uncertain.
_LOST = 0.1
_NODES = np.array(
    [
        0.991455371120812639206854697526329,
        0.949107912342758524526189684047851,
        0.864864423359769072789712788640926,
        0.741531185599394439863864773280788,
        0.586087235467691130294144691693013,
        0.405845151377397166906606412076961,
        0.207784955007898467600689403773245,
        0.0,
    ]
)
_KRONROD = np.array(
    [
        0.022935322010529224963732008058970,
        0.063092092629978553290700663189204,
        0.104790010322250183839876322541518,
        0.140653259715525918745189590510238,
        0.169004726639267902826583426598550,
        0.190350578064785409913256402421014,
        0.204432940075298892414161999234649,
        0.209482141084727828012999174891714,
    ]
)
_GAUSS = np.array(
    [
        0.129484966168869693270611432679082,
        0.279705391489276667901467771423780,
        0.381830050505118944950369775488975,
        0.417959183673469387755102040816327,
    ]
)
# The rule on the eight points that the rule of Gauss leaves out: two rules of few points may agree by chance, as
# happened where a radius falls like a root, three hardly do.
_OTHERS = np.array(
    [
        0.043787914992233266740657581024,
        0.209136164496178001188554321837,
        0.338314908133113070265386760078,
        0.408761012378475661805401337059,
    ]
)


@compiled
def swept_by_pieces(
    tour: Tour, element: Ints, low: Floats, high: Floats, disc: Ints, centre: Floats, radius: Floats
) -> tuple[Floats, Floats, Floats]:
    """Return the area that each piece's spokes sweep, that of its region, and what rounding may do to the former."""
    count = len(element)
    swept, region, uncertain = np.zeros(count), np.zeros(count), np.zeros(count)
    for p in range(count):
        for side in range(2):
            e, f = element[p, side], element[p, 1 - side]
            ends = radius[disc[p, side]], radius[disc[p, 1 - side]]
            here, there = (low[p, side], high[p, side]), (low[p, 1 - side], high[p, 1 - side])
            area, outline, doubt = _side(tour, e, here, f, there, ends)
            swept[p] += area
            region[p] += outline
            uncertain[p] += doubt
        region[p] += _spokes(tour, element[p], low[p], high[p], centre[disc[p, 0]], centre[disc[p, 1]])
    return swept, region, uncertain


@compiled
def _side(
    tour: Tour, e: int, here: tuple[float, float], f: int, there: tuple[float, float], ends: tuple[float, float]
) -> tuple[float, float, float]:
    """Return the area swept along one side of a piece, the outline integral of that side, and the uncertainty."""
    low, high = here
    stack = np.empty((2 * _HALVINGS + 2 + _GRADES, 2))
    top = _first_parts(tour, e, here, f, there, ends, stack)
    parts = top
    swept, outline, uncertain = 0.0, 0.0, 0.0
    shortest = (high - low) * 0.5**_HALVINGS
    while top > 0:
        top -= 1
        a, b = stack[top]
        error, fine, around, doubt = _gauss_kronrod(tour, e, a, b, here, f, there, ends)
        if error > _QUADRATURE + doubt and b - a > shortest * 1.5 and parts < _PARTS:
            half = (a + b) / 2
            stack[top], stack[top + 1] = (half, b), (a, half)
            top, parts = top + 2, parts + 1
            continue
        swept += fine
        outline += around
        uncertain += doubt
    return swept, outline, uncertain


@compiled
def _first_parts(
    tour: Tour,
    e: int,
    here: tuple[float, float],
    f: int,
    there: tuple[float, float],
    ends: tuple[float, float],
    stack: Floats,
) -> int:
    """Lay a side out for quadrature: as a whole, or graded towards a vertex where the radius leaves 0 all at once."""
    low, high = here
    stack[0] = here
    if (ends[0] == 0.0) == (ends[1] == 0.0):
        return 1
    vertex, width = (low, high - low) if ends[0] == 0.0 else (high, low - high)
    near = twin_on_stretch(tour, e, vertex + _NEAR * width, f, there[0], there[1])[2]
    far = twin_on_stretch(tour, e, vertex + _FAR * width, f, there[0], there[1])[2]
    if near <= 2 * far * _NEAR / _FAR:
        return 1
    for k in range(_GRADES):
        inner, outer = vertex + width * 0.1 ** (k + 1), vertex + width * 0.1**k
        stack[k] = min(inner, outer), max(inner, outer)
    innermost = vertex + width * 0.1**_GRADES
    stack[_GRADES] = min(vertex, innermost), max(vertex, innermost)
    return _GRADES + 1


@compiled
def _gauss_kronrod(
    tour: Tour,
    e: int,
    a: float,
    b: float,
    here: tuple[float, float],
    f: int,
    there: tuple[float, float],
    ends: tuple[float, float],
) -> tuple[float, float, float, float]:
    """Integrate on [a, b]: the error and the value of the area swept, outline and uncertainty."""
    coarse, other, fine, around, doubt = 0.0, 0.0, 0.0, 0.0, 0.0
    half, middle = (b - a) / 2, (a + b) / 2
    for k in range(15):
        i = k if k < 8 else 14 - k
        t = middle - half * _NODES[i] if k < 8 else middle + half * _NODES[i]
        x, y, nx, ny, curvature, speed = site(tour, e, t)
        _, _, r, s = twin_on_stretch(tour, e, t, f, there[0], there[1])
        qx, qy, _, _, _, _ = site(tour, f, s)
        apart_sq = max((qx - x) ** 2 + (qy - y) ** 2, _ROUNDING**2)
        off = min(_ROUNDING * r * r / apart_sq, r)
        if off > _LOST * r:
            off = min(r, max(ends))
            r = ends[0] + (ends[1] - ends[0]) * (t - here[0]) / (here[1] - here[0])
            off = max(off, r)
        if tour.element[e].degree == 0:
            value = -tour.element[e].cone_turn * r * r / 2
            doubt -= _KRONROD[i] * tour.element[e].cone_turn * r * off
        else:
            value = (r - curvature * r * r / 2) * speed
            doubt += _KRONROD[i] * max(1.0, 1.0 - curvature * r) * off * speed
            around += _KRONROD[i] * (-nx * x - ny * y) / 2 * speed  # x dy - y dx, the normal being (-dy, dx)
        fine += _KRONROD[i] * value
        if i % 2 == 1:
            coarse += _GAUSS[i // 2] * value
        else:
            other += _OTHERS[i // 2] * value
    error = max(abs(coarse - fine), abs(other - fine))
    return half * error, half * fine, half * around, half * doubt


@compiled
def _spokes(tour: Tour, element: Ints, low: Floats, high: Floats, first: Floats, last: Floats) -> float:
    """Outline integral along the spokes of a piece's two end discs, in the sense of the boundary."""
    ax, ay, _, _, _, _ = site(tour, element[0], high[0])
    bx, by, _, _, _, _ = site(tour, element[1], low[1])
    cx, cy, _, _, _, _ = site(tour, element[1], high[1])
    dx, dy, _, _, _, _ = site(tour, element[0], low[0])
    onward = (ax * last[1] - ay * last[0]) + (last[0] * by - last[1] * bx)
    back = (cx * first[1] - cy * first[0]) + (first[0] * dy - first[1] * dx)
    return (onward + back) / 2


@compiled
def swept_by_arcs(tour: Tour, first: Floats, last: Floats, radius: Floats) -> Floats:
    """Area that the spokes of each contact sweep: 0 but where a disc touches along an arc."""
    swept = np.zeros(len(radius))
    for c in range(len(radius)):
        e, t = int(first[c, 0]), first[c, 1]
        f, s = int(last[c, 0]), last[c, 1]
        if e == f and t == s:
            continue
        for _ in range(len(tour.element)):
            to = s if e == f and s > t else 1.0
            swept[c] += _arc_swept(tour, e, t, to, radius[c])
            if (
                to < 1.0
                or (tour.element[e].after == f and s == 0.0)
                or (f == len(tour.element) and tour.element[e].after == 0)
            ):
                break
            e, t = tour.element[e].after, 0.0
    return swept


@compiled
def _arc_swept(tour: Tour, e: int, a: float, b: float, r: float) -> float:
    """Area that spokes of one length sweep on [a, b]."""
    half, middle, swept = (b - a) / 2, (a + b) / 2, 0.0
    for k in range(15):
        i = k if k < 8 else 14 - k
        t = middle - half * _NODES[i] if k < 8 else middle + half * _NODES[i]
        _, _, _, _, curvature, speed = site(tour, e, t)
        swept += _KRONROD[i] * (r - curvature * r * r / 2) * speed
    return half * swept
