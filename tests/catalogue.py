"""Named profiles, and the medial axes that are known in closed form.

An axis is known as its nodes and its *pieces* (`closed_forms`): curves of points (x, y, r).

Sizes differ on purpose, and few of them are round numbers.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from math import comb

import numpy as np
from closed_forms import (
    TAU,
    AlongParabola,
    AroundBore,
    BetweenCircles,
    BetweenPoints,
    Corridor,
    InEllipse,
    Parabola,
    Piece,
    Straight,
    UnderChord,
)

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line, frozen
from mashape_cad.geometry.profile import Loop, Profile
from mashape_cad.medial.axis import medial_axis
from mashape_cad.medial.graph import MedialAxis


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """A profile and its medial axis in closed form.

    Attributes
    ----------
    name : str
    profile : Profile
    nodes : tuple of (x, y, r, degree)
        Without a seam, whose place is arbitrary.
    pieces : tuple of Piece
    branches : int
        Their number; one branch may run through several pieces.
    """

    name: str
    profile: Profile
    nodes: tuple[tuple[float, float, float, int], ...]
    pieces: tuple[Piece, ...]
    branches: int


def polygon(points: Sequence[tuple[float, float]]) -> Loop:
    """Make a loop of lines through points."""
    return Loop(tuple(Line.of(p, points[(k + 1) % len(points)]) for k, p in enumerate(points)))


def box(x: float, y: float, width: float, height: float) -> Loop:
    """Make a rectangle with sides parallel to the axes."""
    return polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])


def circle(x: float, y: float, radius: float, start: float = 0.0) -> Loop:
    """Make a loop of one full arc."""
    return Loop((Arc.of((x, y), radius, start),))


def regular(count: int, radius: float = 1.0, turn: float = 0.3) -> Loop:
    """Make a regular polygon."""
    return polygon([(radius * np.cos(t), radius * np.sin(t)) for t in turn + TAU * np.arange(count) / count])


def slot(x: float, y: float, half: float, radius: float) -> Loop:
    """Make a stadium about (x, y): two lines of length 2 `half` along x, two half circles."""
    low, high = y - radius, y + radius
    return Loop(
        (
            Line.of((x - half, low), (x + half, low)),
            Arc.of((x + half, y), radius, -np.pi / 2, np.pi),
            Line.of((x + half, high), (x - half, high)),
            Arc.of((x - half, y), radius, np.pi / 2, np.pi),
        )
    )


def rounded(points: Sequence[tuple[float, float]], radii: Sequence[float]) -> Loop:
    """Make a polygon with fillets; radius 0 leaves a vertex sharp. Reflex vertices are rounded outwards."""
    corners = np.array(points, float)
    edges: list[Edge] = []
    at = [_fillet(corners[k - 1], corners[k], corners[(k + 1) % len(corners)], r) for k, r in enumerate(radii)]
    for k, (_, arc, leaves) in enumerate(at):
        edges += [] if arc is None else [arc]
        arrives = at[(k + 1) % len(at)][0]
        # Two fillets may meet without a line between them.
        edges += [Line.of(leaves, arrives)] if np.linalg.norm(arrives - leaves) > 1e-9 else []
    return Loop(tuple(edges))


def _fillet(before: Floats, corner: Floats, after: Floats, radius: float) -> tuple[Floats, Arc | None, Floats]:
    """First point, arc and last point of a fillet."""
    if radius == 0.0:
        return corner, None, corner
    u, v = ((p - corner) / np.linalg.norm(p - corner) for p in (before, after))
    turn = float(np.arctan2(v[0] * u[1] - v[1] * u[0], -(u @ v)))
    setback = radius * abs(np.tan(turn / 2))
    first, last = corner + setback * u, corner + setback * v
    side = np.sign(turn)
    centre = first + side * radius * np.array([u[1], -u[0]])
    start = float(np.arctan2(*(first - centre)[::-1]))
    return first, Arc.of(centre, radius, start, turn), last


def periodic_spline(points: Floats, degree: int = 3) -> Loop:
    """Make a loop of one closed B-spline with these poles, smooth at its seam."""
    count = len(points)
    poles = points[np.arange(count + degree) % count]
    return Loop((BSpline.of(degree, np.arange(count + 2 * degree + 1.0), poles),))


def ellipse(a: float = 2.0, b: float = 1.0) -> Known:
    """Two ends of curvature, one branch."""
    whole = EllipseArc(frozen([0, 0]), frozen([a, 0]), frozen([0, b]), 0.4, TAU)
    piece = InEllipse(a, b)
    ends = tuple((s * piece.reach, 0.0, b * b / a, 1) for s in (-1, 1))
    return Known("ellipse", Profile.of(Loop((whole,))), ends, (piece,), 1)


def rectangle(width: float = 7.0, height: float = 3.0) -> Known:
    """Two junctions, four ends."""
    r = height / 2
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    joins = [(r, r, r), (width - r, r, r)]
    spokes = [Straight((*c, 0.0), joins[k in {1, 2}]) for k, c in enumerate(corners)]
    nodes = tuple((*c, 0.0, 1) for c in corners) + tuple((*j, 3) for j in joins)
    return Known("rectangle", Profile.of(polygon(corners)), nodes, (*spokes, Straight(*joins)), 5)


def regular_polygon(count: int) -> Known:
    """One junction of as many branches as there are corners."""
    loop = regular(count)
    r = float(np.cos(np.pi / count))
    corners = [tuple(edge.start.tolist()) for edge in loop.edges]
    nodes = ((0.0, 0.0, r, count), *((*c, 0.0, 1) for c in corners))
    spokes = tuple(Straight((*c, 0.0), (0.0, 0.0, r)) for c in corners)
    return Known(f"{count}-gon", Profile.of(loop), nodes, spokes, count)


def ell(length: float = 4.5, width: float = 1.3) -> Known:
    """At the reflex corner two parabolas: the corner is their focus, the outer walls their directrices."""
    a, w = length, width
    loop = polygon([(0, 0), (a, 0), (a, w), (w, w), (w, a), (0, a)])
    r, h = w * (2 - np.sqrt(2)), w / 2
    bend, right, up = (r, r, r), (a - h, h, h), (h, a - h, h)
    pieces = (
        Straight((0, 0, 0), bend),
        Parabola((w, w), (0, 0), (0, 1), r - w, 0.0),
        Parabola((w, w), (0, 0), (1, 0), 0.0, w - r),
        Straight((w, h, h), right),
        Straight((h, w, h), up),
        *(Straight((*c, 0.0), right) for c in ((a, 0.0), (a, w))),
        *(Straight((*c, 0.0), up) for c in ((0.0, a), (w, a))),
    )
    ends = tuple((x, y, 0.0, 1) for x, y in ((0, 0), (a, 0), (a, w), (0, a), (w, a)))
    return Known("ell", Profile.of(loop), (*ends, (*bend, 3), (*right, 3), (*up, 3)), pieces, 7)


def stadium(half: float = 2.5, radius: float = 0.75) -> Known:
    """Two arcs that their discs touch as a whole."""
    first, last = (-half, 0.0, radius), (half, 0.0, radius)
    nodes = ((*first, 1), (*last, 1))
    return Known("stadium", Profile.of(slot(0, 0, half, radius)), nodes, (Straight(first, last),), 1)


def ring(shift: float, name: str) -> Known:
    """No end and no junction: a branch that closes on itself."""
    outer, inner = (0.2, -0.1, 3.0), (0.2 + shift, -0.1 + shift / 3, 1.1)
    profile = Profile.of(circle(*outer), [circle(*inner)])
    return Known(name, profile, (), (BetweenCircles(outer, inner),), 1)


def disc(radius: float = 1.7) -> Known:
    """One point."""
    return Known("disc", Profile.of(circle(0.3, 0.4, radius)), ((0.3, 0.4, radius, 0),), (), 0)


def rounded_rectangle(width: float = 6.0, height: float = 4.0, fillet: float = 0.8) -> Known:
    """As the rectangle, but the branches end at the fillets' centres."""
    sharp = rectangle(width, height)
    f, r = fillet, height / 2
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    centres = [(f, f, f), (width - f, f, f), (width - f, height - f, f), (f, height - f, f)]
    joins = [(r, r, r), (width - r, r, r)]
    spokes = [Straight(c, joins[k in {1, 2}]) for k, c in enumerate(centres)]
    nodes = (*((*c, 1) for c in centres), *((*j, 3) for j in joins))
    loop = rounded(corners, [fillet] * 4)
    return Known("rounded rectangle", Profile.of(loop), nodes, (*spokes, sharp.pieces[-1]), 5)


def plate_with_slot(a: float = 5.0, b: float = 3.0, half: float = 2.0, hole: float = 0.6) -> Known:
    """A rectangle 2a by 2b with a slot in its middle; `half` = 0 makes the hole round.

    From each corner a diagonal runs to a disc that touches the slot's end: (a - r - half)^2 + (b - r)^2 = (r + hole)^2.
    """
    c = a - half
    total = c + b + hole
    r = float(total - np.sqrt(total**2 - c**2 - b**2 + hole**2))
    corners = [(-a, -b), (a, -b), (a, b), (-a, b)]
    joins = [(np.sign(x) * (a - r), np.sign(y) * (b - r), r) for x, y in corners]
    level = (b - hole) / 2
    sides = [
        Parabola((half, 0), (a, 0), (-1, 0), r - b, b - r, hole),
        Parabola((-half, 0), (-a, 0), (1, 0), r - b, b - r, hole),
        Parabola((half, 0), (0, b), (0, -1), r - c, 0.0, hole),
        Parabola((-half, 0), (0, b), (0, -1), 0.0, c - r, hole),
        Parabola((half, 0), (0, -b), (0, 1), 0.0, c - r, hole),
        Parabola((-half, 0), (0, -b), (0, 1), r - c, 0.0, hole),
    ]
    levels = [Straight((-half, s * (b - level), level), (half, s * (b - level), level)) for s in (-1, 1) if half]
    spokes = [Straight((*p, 0.0), j) for p, j in zip(corners, joins, strict=True)]
    nodes = (*((*p, 0.0, 1) for p in corners), *((*j, 3) for j in joins))
    inner = slot(0, 0, half, hole) if half else circle(0, 0, hole)
    name = "plate with a slot" if half else "plate with a round hole"
    return Known(name, Profile.of(polygon(corners), [inner]), nodes, (*spokes, *sides, *levels), 8)


def frame(a: float = 2.0, b: float = 0.7) -> Known:
    """A square 2a with a square hole 2b: at each reflex corner two parabolas, between the sides level stretches."""
    r, h = np.sqrt(2) * (a - b) / (1 + np.sqrt(2)), (a - b) / 2
    first: list[Piece] = [
        Straight((a, a, 0.0), (a - r, a - r, r)),
        Parabola((b, b), (a, 0), (-1, 0), 0.0, a - r - b),
        Parabola((b, b), (0, a), (0, -1), b + r - a, 0.0),
        Straight((a - h, -b, h), (a - h, b, h)),
    ]
    pieces = [_turned(piece, quarter) for quarter in range(4) for piece in first]
    corners = [(a, a), (-a, a), (-a, -a), (a, -a)]
    nodes = (
        *((x, y, 0.0, 1) for x, y in corners),
        *((np.sign(x) * (a - r), np.sign(y) * (a - r), r, 3) for x, y in corners),
    )
    return Known("frame", Profile.of(box(-a, -a, 2 * a, 2 * a), [box(-b, -b, 2 * b, 2 * b)]), nodes, tuple(pieces), 8)


def _turned(piece: Piece, quarters: int) -> Piece:
    """Turn a piece about the origin by right angles."""

    def turn(point: tuple[float, ...]) -> tuple[float, float]:
        z = complex(*point[:2]) * 1j**quarters
        return (z.real, z.imag)

    if isinstance(piece, Straight):
        return Straight((*turn(piece.first), piece.first[2]), (*turn(piece.last), piece.last[2]))
    return Parabola(turn(piece.focus), turn(piece.wall), turn(piece.normal), piece.low, piece.high, piece.hole)


def parabola_and_line(a: float = 0.6, chord: float = 3.1) -> Known:
    """A parabola closed by a chord across its axis.

    One end where the parabola bends most. Its branch meets those of the two corners where the disc on the axis touches
    the chord too: there sqrt(1 + 4 a^2 x^2) = 2 sqrt(a chord) - 1 at the feet.
    """
    w, s = float(np.sqrt(chord / a)), 2 * np.sqrt(a * chord) - 1
    foot, r = float(np.sqrt(s**2 - 1) / (2 * a)), float(s / (2 * a))
    cap = BSpline.of(2, [0, 0, 0, 1, 1, 1], [(-w, chord), (0, -chord), (w, chord)])
    tip, join = (0.0, 1 / (2 * a), 1 / (2 * a)), (0.0, chord - r, r)
    nodes = ((*tip, 1), (*join, 3), (-w, chord, 0.0, 1), (w, chord, 0.0, 1))
    sides = (UnderChord(a, chord, foot, w), UnderChord(a, chord, -w, -foot))
    loop = Loop((cap, Line.of((w, chord), (-w, chord))))
    return Known("parabola and line", Profile.of(loop), nodes, (AlongParabola(a, chord - r), *sides), 3)


def offset_splines(half: float = 0.25) -> Known:
    """A corridor between the two offsets of a cubic, closed by half circles: the cubic is its axis.

    With u and v linear, the cubic whose derivative is (u^2 - v^2, 2 u v) has speed u^2 + v^2, so that its offsets are
    rational, of degree 5 (Farouki, Sakkalis, Pythagorean hodographs, 1990). Its speed is the same at both ends.
    """
    polynomial = np.polynomial.Polynomial
    u, v = polynomial([1.6, -1.3]), polynomial([-0.3, 1.9])
    x, y, speed = (u * u - v * v).integ(), (2 * u * v).integ(), u * u + v * v
    sides = []
    for shift in (-half, half):
        rows = (x * speed - shift * (2 * u * v), y * speed + shift * (u * u - v * v), speed)
        homogeneous = np.column_stack([_bernstein(row) for row in rows])
        points, weights = homogeneous[:, :2] / homogeneous[:, 2:], homogeneous[:, 2] / homogeneous[0, 2]
        weights[-1] = 1.0  # to the last bit, so that the corridor's sides and caps meet to the last bit
        sides.append(BSpline.of(5, [0.0] * 6 + [1.0] * 6, points, weights))
    right, left = sides
    ends = [np.array([x(t), y(t)]) for t in (0.0, 1.0)]
    caps = []
    for centre, start in ((ends[1], right.end), (ends[0], left.start)):
        caps.append(Arc.of(centre, half, float(np.arctan2(*(start - centre)[::-1])), np.pi))
    nodes = tuple((*end.tolist(), half, 1) for end in ends)
    middle = Corridor(np.column_stack([x.coef, y.coef]), half)
    return Known("offset splines", Profile.of(Loop((right, caps[0], left.reversed(), caps[1]))), nodes, (middle,), 1)


def _bernstein(polynomial: np.polynomial.Polynomial) -> Floats:
    """Coefficients in the Bernstein basis of degree 5."""
    power = np.append(polynomial.coef, np.zeros(6 - len(polynomial.coef)))
    return np.array([sum(comb(k, i) / comb(5, i) * power[i] for i in range(k + 1)) for k in range(6)])


def gear_with_bore(teeth: int = 9, bore: float = 1.2, root: float = 3.0, tip: float = 3.9, half: float = 0.35) -> Known:
    """Teeth with parallel flanks and round tips on a ring: all discs of a tooth lie on its middle line.

    Along the flanks the radius is half the tooth's width; then the discs pass between the two vertices of its root,
    and where they reach the bore, at (root^2 - bore^2) / 2 (foot - bore), three branches meet.
    """
    foot, spread = float(np.sqrt(root**2 - half**2)), float(np.arcsin(half / root))
    join = (root**2 - bore**2) / (2 * (foot - bore))
    edges: list[Edge] = []
    nodes: list[tuple[float, float, float, int]] = []
    pieces: list[Piece] = []
    for number in range(teeth):
        turn, pitch = 0.1 + TAU * number / teeth, TAU / teeth
        along, across = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
        right, left = foot * along - half * across, foot * along + half * across
        ends = tip * along - half * across, tip * along + half * across
        edges += [
            Line.of(right, ends[0]),
            Arc.of(tip * along, half, turn - np.pi / 2, np.pi),
            Line.of(ends[1], left),
            Arc.of((0, 0), root, turn + spread, pitch - 2 * spread),
        ]
        nodes += [(*(tip * along).tolist(), half, 1), (*(join * along).tolist(), join - bore, 3)]
        pieces += [
            Straight((*(tip * along).tolist(), half), (*(foot * along).tolist(), half)),
            BetweenPoints(tuple(right.tolist()), tuple(left.tolist()), tuple(along.tolist()), join - foot, 0.0),
            AroundBore(bore, root, 0.0, spread, turn - spread),
            AroundBore(bore, root, -spread, 0.0, turn + spread),
            AroundBore(bore, root, turn + spread, turn + pitch - spread),
        ]
    profile = Profile.of(Loop(tuple(edges)), [circle(0, 0, bore)])
    return Known("gear with a bore", profile, tuple(nodes), tuple(pieces), 2 * teeth)


def _square() -> Known:
    """Its junction has degree 4."""
    known = regular_polygon(4)
    return Known("square", known.profile, known.nodes, known.pieces, known.branches)


KNOWN: dict[str, Known] = {
    known.name: known
    for known in (
        ellipse(),
        rectangle(),
        _square(),
        ell(),
        stadium(),
        ring(0.9, "eccentric ring"),
        ring(0.0, "concentric ring"),
        disc(),
        *(regular_polygon(count) for count in (3, 5, 6, 8, 12)),
        rounded_rectangle(),
        plate_with_slot(),
        plate_with_slot(half=0.0),
        frame(),
        parabola_and_line(),
        offset_splines(),
        gear_with_bore(),
    )
}


def plate_with_holes() -> Profile:
    """A plate with round holes of two sizes, not quite on a grid."""
    places = [(1.2, 1.1, 0.5), (4.9, 1.0, 0.5), (1.1, 3.1, 0.5), (5.0, 2.9, 0.5), (3.0, 2.05, 0.8)]
    return Profile.of(box(0, 0, 6, 4), [circle(*place) for place in places])


def hole_grid() -> Profile:
    """Equal round holes on a square grid: junctions of degree 4, and many parts alike."""
    return Profile.of(box(-2, -2, 4, 4), [circle(x, y, 0.3) for x in (-1, 0, 1) for y in (-1, 0, 1)])


def blob() -> Profile:
    """A closed cubic B-spline with bays."""
    angle = TAU * np.arange(12) / 12
    radius = 1 + 0.35 * np.sin(3 * angle + 0.4) + 0.1 * np.cos(5 * angle)
    return Profile.of(periodic_spline(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])))


def blob_with_holes() -> Profile:
    """The blob with a round hole and a triangular one."""
    return Profile.of(blob().outer, [circle(0.35, 0.1, 0.12), polygon([(-0.3, -0.2), (0.0, -0.25), (-0.2, 0.1)])])


def bracket() -> Profile:
    """An angle with fillets inside and outside, a hole and a slot."""
    points = [(0, 0), (5, 0), (5, 1.4), (1.4, 1.4), (1.4, 4), (0, 4)]
    return Profile.of(rounded(points, [0.5, 0.3, 0.2, 0.6, 0, 0.4]), [circle(0.7, 3, 0.3), slot(3.4, 0.7, 0.6, 0.25)])


def cross() -> Profile:
    """Four reflex corners about a junction of degree 4."""
    a, b = 1.0, 0.35
    arm = [(b, b), (b, a), (-b, a)]
    quarters = (complex(x, y) * 1j**k for k in range(4) for x, y in arm)
    return Profile.of(polygon([(z.real, z.imag) for z in quarters]))


def keyhole() -> Profile:
    """An arc of more than half a circle with a narrow neck: its disc touches the arc, and the axis goes on."""
    half = 0.3
    angle = float(np.arcsin(half))
    start = -np.pi / 2 + angle
    first, last = (half, -np.cos(angle)), (-half, -np.cos(angle))
    return Profile.of(
        Loop(
            (
                Arc.of((0, 0), 1.0, start, TAU - 2 * angle),
                Line.of(last, (-half, -2.5)),
                Line.of((-half, -2.5), (half, -2.5)),
                Line.of((half, -2.5), first),
            )
        )
    )


def half_disc() -> Profile:
    """A chord and an arc."""
    return Profile.of(Loop((Line.of((-1, 0), (1, 0)), Arc.of((0, 0), 1.0, 0.0, np.pi))))


def lens() -> Profile:
    """Two arcs that meet in two convex vertices."""
    reach, rise = 1.0, 0.4
    radius = (reach**2 + rise**2) / (2 * rise)
    half = float(np.arcsin(reach / radius))
    low = Arc.of((0, radius - rise), radius, -np.pi / 2 - half, 2 * half)
    high = Arc.of((0, rise - radius), radius, np.pi / 2 - half, 2 * half)
    return Profile.of(Loop((low, high)))


def dumbbell() -> Profile:
    """Two rooms and a corridor: a branch between two reflex vertices at each door."""
    points = [(0, 0), (2, 0), (2, 0.9), (3, 0.9), (3, 0), (5, 0), (5, 2), (3, 2), (3, 1.1), (2, 1.1), (2, 2), (0, 2)]
    return Profile.of(polygon(points))


def wedged_room() -> Profile:
    """Two wedges nearly meet: between their tips runs a branch that touches nothing but two reflex vertices."""
    half = [(-1, -1), (-0.05, -1), (0, -0.1), (0.05, -1), (1, -1)]
    return Profile.of(polygon([*half, *((-x, -y) for x, y in half)]))


def rational_blob() -> Profile:
    """A closed spline whose weights differ."""
    angle = TAU * np.arange(9) / 9
    radius = 1.5 + 0.4 * np.cos(3 * angle + 0.2)
    poles = np.column_stack([1.4 * radius * np.cos(angle), radius * np.sin(angle)])
    weights = 1 + 0.5 * np.sin(2 * angle)
    around = np.arange(9 + 3) % 9
    return Profile.of(Loop((BSpline.of(3, np.arange(16.0), poles[around], weights[around]),)))


def symmetric_cap() -> Profile:
    """A cubic on a square: curvature is largest in the very middle of its parameter, with a minimum on either side."""
    cap = BSpline.of(3, [0, 0, 0, 0, 1, 1, 1, 1], [(1, 0), (0.74, 1.22), (-0.74, 1.22), (-1, 0)])
    below = (Line.of((-1, 0), (-1, -2)), Line.of((-1, -2), (1, -2)), Line.of((1, -2), (1, 0)))
    return Profile.of(Loop((cap, *below)))


def wave() -> Profile:
    """Lines, and half ellipses bent both ways."""
    return Profile.of(
        Loop(
            (
                Line.of((-0.5, 0), (4, 0)),
                Line.of((4, 0), (4, 1.5)),
                EllipseArc(frozen([3, 1.5]), frozen([1, 0]), frozen([0, 0.5]), 0.0, np.pi),
                EllipseArc(frozen([1, 1.5]), frozen([1, 0]), frozen([0, -0.5]), 0.0, np.pi),
                Line.of((0, 1.5), (-0.5, 1.5)),
                Line.of((-0.5, 1.5), (-0.5, 0)),
            )
        )
    )


# Profiles whose axis has no closed form here: held against the definition instead.
NAMED: dict[str, Callable[[], Profile]] = {
    make.__name__.replace("_", " "): make
    for make in (
        plate_with_holes,
        hole_grid,
        blob,
        blob_with_holes,
        bracket,
        cross,
        keyhole,
        half_disc,
        lens,
        dumbbell,
        wedged_room,
        rational_blob,
        symmetric_cap,
        wave,
    )
}


@cache
def profile_of(name: str) -> Profile:
    """Return a profile of this catalogue."""
    return KNOWN[name].profile if name in KNOWN else NAMED[name]()


@cache
def axis_of(name: str) -> MedialAxis:
    """Return the medial axis of a profile of this catalogue, computed once."""
    return medial_axis(profile_of(name))
