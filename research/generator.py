"""Random shapes in groups of variants: what code books and metric are learned on.

A *plan* is what a shape is made from: lengths, angles and points that may vary, and choices that may not. A family
draws plans; `group` jitters one plan and deforms what is built from it, so that the shapes of a group are of one kind
as the parts of a class are: bent, stretched, thicker, mirrored, turned, drawn with another pen.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
import shapely
from shapely import affinity
from shapely.geometry import LinearRing, LineString, MultiPolygon, Point, Polygon
from shapely.ops import unary_union

Rng = np.random.Generator
# A stroke that bends by less is straight.
BENT = 0.12


@dataclass(frozen=True)
class Plan:
    """What a shape is built from.

    Attributes
    ----------
    build : callable
        Makes the polygon from the plan.
    lengths : mapping of str to array
        Positive; vary by factors.
    angles : mapping of str to array
        Radians; vary by sums.
    points : mapping of str to (n, 2) array
        In a frame of size 1; vary by sums.
    choices : mapping
        Counts and switches; the same in all variants.
    styles : mapping of str to float
        How the pen draws: widths and ratios that vary widely.
    """

    build: Callable[["Plan"], Polygon]
    lengths: dict[str, np.ndarray] = field(default_factory=dict)
    angles: dict[str, np.ndarray] = field(default_factory=dict)
    points: dict[str, np.ndarray] = field(default_factory=dict)
    choices: dict[str, object] = field(default_factory=dict)
    styles: dict[str, float] = field(default_factory=dict)


def blob(rng: Rng) -> Plan:
    """A closed curve by a few waves of its radius, sometimes n-fold."""
    fold = int(rng.choice([1, 1, 1, 1, 2, 3, 4, 5, 6, 8]))
    orders = fold * np.arange(1, 1 + int(rng.integers(2, 9 if fold == 1 else 3)))
    size = (
        rng.uniform(0.15, 0.6)
        * np.exp(0.5 * rng.normal(size=len(orders)))
        / np.arange(1, len(orders) + 1) ** rng.uniform(0.3, 1.2)
    )
    return Plan(_blob, {"size": size}, {"phase": rng.uniform(0, 2 * np.pi, len(orders))}, choices={"orders": orders})


def _blob(plan: Plan) -> Polygon:
    t = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    waves = plan.lengths["size"][:, None] * np.cos(plan.choices["orders"][:, None] * t + plan.angles["phase"][:, None])
    radius = np.exp(np.clip(waves.sum(axis=0), -1.6, 1.6))
    return Polygon(np.column_stack([radius * np.cos(t), radius * np.sin(t)]))


def limbs(rng: Rng) -> Plan:
    """A body with limbs, each a chain of tapered bars: animals, tools, aeroplanes."""
    body = int(rng.integers(1, 5))
    count = int(rng.integers(1, 8))
    joints = rng.integers(1, 4, count)
    wide = rng.uniform(0.06, 0.35)
    bars = body + int(joints.sum())
    length = np.empty(bars)
    length[:body] = rng.uniform(0.3, 0.9, body)
    length[body:] = rng.uniform(0.15, 0.8, bars - body)
    width = np.empty(bars + count + 1)
    width[: body + 1] = wide * np.exp(0.35 * rng.normal(size=body + 1))
    width[body + 1 :] = wide * rng.uniform(0.12, 0.8, len(width) - body - 1)
    turn = np.empty(bars)
    turn[:body] = rng.normal(0, 0.35, body)
    turn[body:] = rng.normal(0, 0.35, bars - body)
    side = rng.choice([-1.0, 1.0], count)
    symmetric = bool(rng.random() < 0.35)
    head = rng.uniform(0.6, 2.0, 2) * wide
    return Plan(
        _limbs,
        {"length": length, "width": width, "head": head},
        {"turn": turn, "leave": side * rng.uniform(0.35, 2.6, count)},
        choices={
            "body": body,
            "joints": joints,
            "at": rng.uniform(0, 1, count),
            "symmetric": symmetric,
            "heads": rng.random(2) < 0.4,
        },
    )


def _bar(a: np.ndarray, b: np.ndarray, ra: float, rb: float) -> Polygon:
    return unary_union([Point(a).buffer(ra, 12), Point(b).buffer(rb, 12)]).convex_hull


def _limbs(plan: Plan) -> Polygon:
    body, joints = plan.choices["body"], plan.choices["joints"]
    length, width, turn = plan.lengths["length"], plan.lengths["width"], plan.angles["turn"]
    where, way = [np.zeros(2)], 0.0
    parts, ways = [], []
    for k in range(body):
        way += 0.0 if plan.choices["symmetric"] else turn[k]
        ways.append(way)
        where.append(where[-1] + length[k] * np.array([math.cos(way), math.sin(way)]))
        parts.append(_bar(where[-2], where[-1], width[k], width[k + 1]))
    for end, (size, there) in enumerate(zip(plan.lengths["head"], plan.choices["heads"], strict=True)):
        if there:
            parts.append(Point(where[0 if end == 0 else -1]).buffer(size, 16))
    bar, thick = body, body + 1
    for k, count in enumerate(joints):
        place = plan.choices["at"][k] * body
        low = min(int(place), body - 1)
        root = where[low] + (place - low) * (where[low + 1] - where[low])
        direction = ways[low] + plan.angles["leave"][k]
        at = root
        for _ in range(count):
            to = at + length[bar] * np.array([math.cos(direction), math.sin(direction)])
            piece = _bar(at, to, width[thick], width[thick + 1])
            parts.append(piece)
            if plan.choices["symmetric"]:
                parts.append(affinity.scale(piece, 1, -1, origin=(0, 0)))
            at = to
            bar, thick = bar + 1, thick + 1
            direction += turn[bar - 1]
        thick += 1
    return unary_union(parts)


def polygon(rng: Rng) -> Plan:
    """A polygon or star, its corners sharp or rounded."""
    count = int(rng.integers(3, 13))
    star = rng.random() < 0.35
    if star:
        radius = np.tile([1.0, rng.uniform(0.25, 0.85)], count)
        angle = np.arange(2 * count) * np.pi / count
    else:
        radius = rng.uniform(0.35, 1.0, count)
        angle = np.sort((np.arange(count) + rng.uniform(-0.4, 0.4, count)) * 2 * np.pi / count)
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]) * [1.0, rng.uniform(0.35, 1.0)]
    rounding = float(rng.choice([0.0, 0.0, rng.uniform(0.01, 0.12)]))
    return Plan(_polygon, {"rounding": np.array([rounding])}, points={"corners": points})


def _polygon(plan: Plan) -> Polygon:
    shape = shapely.make_valid(Polygon(plan.points["corners"]))
    rounding = float(plan.lengths["rounding"][0])
    return shape.buffer(-rounding, 8).buffer(2 * rounding, 8).buffer(-rounding, 8) if rounding > 0 else shape


def assembly(rng: Rng) -> Plan:
    """Unions and cuts of plain shapes, some repeated around the centre: machine parts."""
    count = int(rng.integers(2, 7))
    kinds = rng.choice(["disc", "box", "box", "slot", "ngon", "ring"], count)
    cut = rng.random(count) < 0.45
    cut[0] = False
    fold = np.where(rng.random(count) < 0.35, rng.integers(2, 13, count), 1)
    fold[0] = 1
    size = rng.uniform(0.08, 0.45, (count, 2))
    size[0] = rng.uniform(0.5, 1.0, 2)
    size[fold > 4] *= 0.45
    # Much of a part lies on its axes.
    centre = rng.uniform(-0.9, 0.9, (count, 2)) * rng.choice([0.0, 1.0], (count, 2), p=[0.4, 0.6])
    centre[0] = 0.0
    mirrored = rng.random(count) < 0.3
    return Plan(
        _assembly,
        {"size": size},
        {"turn": rng.choice([0.0, 0.0, np.pi / 4, np.pi / 2, rng.uniform(0, np.pi)], count)},
        {"centre": centre},
        {
            "kinds": kinds,
            "cut": cut,
            "fold": fold,
            "ngon": rng.integers(3, 9, count),
            "mirrored": mirrored,
            "round": rng.choice([0, 0, 0.02, 0.05]),
        },
    )


def _plain(kind: str, width: float, height: float, ngon: int) -> Polygon:
    if kind in ("disc", "ring"):
        return Point(0, 0).buffer(width, 24)
    if kind == "slot":
        return LineString([(-width, 0), (width, 0)]).buffer(min(height, width) * 0.5, 12)
    if kind == "ngon":
        t = 2 * np.pi * np.arange(ngon) / ngon
        return Polygon(np.column_stack([np.cos(t), np.sin(t)]) * width)
    return shapely.box(-width, -height, width, height)


def _assembly(plan: Plan) -> Polygon:
    shape: Polygon = Polygon()
    for k, kind in enumerate(plan.choices["kinds"]):
        width, height = plan.lengths["size"][k]
        one = affinity.rotate(
            _plain(kind, width, height, plan.choices["ngon"][k]),
            plan.angles["turn"][k],
            origin=(0, 0),
            use_radians=True,
        )
        one = affinity.translate(one, *plan.points["centre"][k])
        fold = int(plan.choices["fold"][k])
        many = unary_union([affinity.rotate(one, 360 * j / fold, origin=(0, 0)) for j in range(fold)])
        if plan.choices["mirrored"][k]:
            many = many.union(affinity.scale(many, -1, 1, origin=(0, 0)))
        shape = shape.difference(many) if plan.choices["cut"][k] else shape.union(many)
        if kind == "ring":
            shape = shape.difference(
                affinity.translate(Point(0, 0).buffer(width * 0.55, 24), *plan.points["centre"][k])
            )
    corner = float(plan.choices["round"])
    return shape.buffer(-corner, 6).buffer(2 * corner, 6).buffer(-corner, 6) if corner else shape


def strokes(rng: Rng) -> Plan:
    """Stems, bars, diagonals and bows on a coarse grid, and rings, joined: letters and signs."""
    return _drawn(rng, wander=0.04, along=0.6, bows=0.35, weight=(0.05, 0.11))


def sketches(rng: Rng) -> Plan:
    """Strokes in any direction, bent a little: signs of no order."""
    return _drawn(rng, wander=0.06, along=0.0, bows=0.15, weight=(0.03, 0.15))


def _drawn(rng: Rng, wander: float, along: float, bows: float, weight: tuple[float, float]) -> Plan:
    """Strokes between points of a grid.

    Parameters
    ----------
    rng : numpy.random.Generator
    wander : float
        How far points lie off the grid.
    along, bows : float
        Shares of strokes that follow a row or column, and of strokes that are half ellipses.
    weight : tuple of float
        Range of the pen's half width.
    """
    columns, rows = int(rng.integers(2, 4)), int(rng.integers(2, 5))
    places = [(x / max(columns - 1, 1), 1.5 * y / max(rows - 1, 1)) for x in range(columns) for y in range(rows)]
    grid = np.array(places) * [rng.uniform(0.6, 1.2), 1.0] + rng.normal(0, wander, (len(places), 2))
    count = int(rng.integers(1, 6))
    ends, bends, rings = [], [], []
    reached = {int(rng.integers(len(grid)))}
    for _ in range(count):
        a = int(rng.choice(sorted(reached)))
        others = [k for k in range(len(grid)) if k != a]
        straight = [k for k in others if k // rows == a // rows or k % rows == a % rows]
        b = int(rng.choice(straight if straight and rng.random() < along else others))
        rings.append(bool(rng.random() < 0.18))
        if not rings[-1]:
            reached.add(b)
        ends.append((a, b))
        bow = rng.choice([-1.0, 1.0]) * rng.uniform(0.5, 1.1)
        bends.append(float(bow if rng.random() < bows else rng.choice([0.0, 0.0, 0.0, rng.normal(0, 0.4)])))
    return Plan(
        _strokes,
        {"ring": rng.uniform(0.2, 0.5, (count, 2))},
        points={"grid": grid, "bend": np.column_stack([bends, np.zeros(count)])},
        choices={"ends": ends, "rings": rings, "weight": rng.uniform(*weight)},
        styles={"pen": 1.0},
    )


def _strokes(plan: Plan) -> Polygon:
    grid, choices, styles = plan.points["grid"], plan.choices, plan.styles
    width = choices["weight"] * styles["pen"]
    lines, degree = [], {}
    for k, (a, b) in enumerate(choices["ends"]):
        p, q = grid[a], grid[b]
        if choices["rings"][k] or a == b:
            t = np.linspace(0, 2 * np.pi, 40)
            w, h = plan.lengths["ring"][k]
            lines.append((np.column_stack([p[0] + w - w * np.cos(t), p[1] + h * np.sin(t)]), None))
            continue
        for node in (a, b):
            degree[node] = degree.get(node, 0) + 1
        bend, chord = plan.points["bend"][k, 0], q - p
        bent = abs(bend) > BENT
        t = (1 - np.cos(np.linspace(0, np.pi, 24 if bent else 2)[:, None])) / 2
        across = np.array([-chord[1], chord[0]]) * bend * bent
        lines.append((p + t * chord + across * np.sqrt(t * (1 - t)), (a, b)))
    square = styles.get("square", 0.0) > 0.5
    contrast = styles.get("contrast", 1.0)
    parts = []
    for line, nodes in lines:
        # A broad pen is a stretched plane: strokes along its direction come out thin.
        pen = np.array([[1.0, 0.0], [0.0, contrast]])
        path = LineString(line @ pen.T) if nodes is not None else LinearRing((line @ pen.T)[:-1])
        drawn = path.buffer(
            width,
            8,
            cap_style="flat" if square else "round",
            join_style="mitre" if square else "round",
            mitre_limit=2.0,
        )
        if square and nodes is not None:
            # Square ends reach over the joint, so that strokes meet.
            drawn = unary_union(
                [
                    drawn,
                    *(
                        Point(line[i] @ pen.T).buffer(width, 8)
                        for i, n in ((0, nodes[0]), (-1, nodes[1]))
                        if degree[n] > 1
                    ),
                ]
            )
        parts.append(affinity.scale(drawn, 1.0, 1.0 / contrast, origin=(0, 0)))
        if nodes is not None and styles.get("serif", 0.0) > 0.5:
            for i, n in ((0, nodes[0]), (-1, nodes[1])):
                if degree[n] == 1:
                    long, flat = styles["serif_length"] * width, styles["serif_height"] * width
                    x, y = line[i]
                    parts.append(shapely.box(x - long, y - flat, x + long, y + flat))
    return unary_union(parts)


@dataclass(frozen=True)
class Amounts:
    """How much the variants of a group differ (standard deviations)."""

    angle: float = 0.2
    length: float = 0.14
    point: float = 0.035
    pen: float = 0.45
    stretch: float = 0.13
    warp: float = 0.025
    bumps: float = 0.004
    dilation: float = 0.012
    noise: float = 0.0012


def jittered(plan: Plan, rng: Rng, amounts: Amounts) -> Plan:
    """Vary what may vary."""
    scale = rng.uniform(0.3, 1.3)
    styles = dict(plan.styles)
    if "pen" in styles:
        styles = {
            "pen": math.exp(amounts.pen * rng.normal()),
            "contrast": math.exp(0.35 * rng.normal()),
            "square": float(rng.random() < 0.6),
            "serif": float(rng.random() < 0.35),
            "serif_length": rng.uniform(1.4, 3.2),
            "serif_height": rng.uniform(0.25, 0.9),
        }
    return replace(
        plan,
        lengths={k: v * np.exp(scale * amounts.length * rng.normal(size=v.shape)) for k, v in plan.lengths.items()},
        angles={k: v + scale * amounts.angle * rng.normal(size=v.shape) for k, v in plan.angles.items()},
        # What lies on an axis stays there.
        points={k: v + scale * amounts.point * rng.normal(size=v.shape) * (v != 0) for k, v in plan.points.items()},
        styles=styles,
    )


def largest(shape: shapely.Geometry) -> Polygon | None:
    """The largest polygon, without specks of holes; None if there is none."""
    if isinstance(shape, MultiPolygon) or hasattr(shape, "geoms"):
        parts = [g for g in shape.geoms if isinstance(g, Polygon)]
        if not parts:
            return None
        shape = max(parts, key=lambda g: g.area)
    if shape.is_empty or shape.area <= 0:
        return None
    x0, y0, x1, y1 = shape.bounds
    size = max(x1 - x0, y1 - y0)
    if shape.area < 0.01 * size**2:
        return None
    holes = [h for h in shape.interiors if Polygon(h).area > 4e-4 * size**2]
    shape = affinity.translate(Polygon(shape.exterior, holes), -(x0 + x1) / 2, -(y0 + y1) / 2)
    return affinity.scale(shape, 100 / size, 100 / size, origin=(0, 0))


def deformed(shape: Polygon, rng: Rng, amounts: Amounts) -> Polygon | None:
    """Warp, shear, thicken, roughen, mirror and turn."""
    scale = rng.uniform(0.2, 1.3)
    swell = 100 * amounts.dilation * rng.normal() * scale
    grown = largest(shape.buffer(swell, 6)) if rng.random() < 0.5 else shape
    shape = grown or shape
    shape = shapely.segmentize(shape, 1.0)
    waves = rng.normal(size=(4, 2)) / np.arange(1, 5)[:, None]
    direction = rng.normal(size=(4, 2)) * 2 * np.pi / 100 * 0.8
    phase = rng.uniform(0, 2 * np.pi, 4)
    matrix = np.eye(2) + scale * amounts.stretch * rng.normal(size=(2, 2)) * [[1, 0.7], [0.7, 1]]
    turn, mirror = rng.uniform(0, 2 * np.pi), rng.random() < 0.5
    cosine, sine = math.cos(turn), math.sin(turn)
    rigid = np.array([[cosine, -sine], [sine, cosine]]) @ np.diag([-1.0 if mirror else 1.0, 1.0])
    rough = rng.random() < 0.5
    bump_scale = 100 * amounts.bumps * abs(rng.normal()) * (rng.random() < 0.5)
    noise_scale = 100 * amounts.noise * rng.uniform(0, 2)
    bump_way, bump_phase = rng.normal(size=(6, 2)) * 2 * np.pi / 12, rng.uniform(0, 2 * np.pi, 6)
    bump_size = rng.normal(size=(6, 2))

    def moved(points: np.ndarray) -> np.ndarray:
        shift = 100 * amounts.warp * scale * np.sin(points @ direction.T + phase) @ waves
        shift = shift + bump_scale * np.sin(points @ bump_way.T + bump_phase) @ bump_size / 2.5
        if rough:
            shift = shift + noise_scale * _smoothed(rng.normal(size=points.shape))
        return (points + shift) @ matrix.T @ rigid.T

    outer = moved(np.array(shape.exterior.coords)[:-1])
    holes = [moved(np.array(h.coords)[:-1]) for h in shape.interiors]
    bent = Polygon(outer, holes)
    return largest(bent if bent.is_valid else bent.buffer(0))


def _smoothed(noise: np.ndarray) -> np.ndarray:
    return (noise + np.roll(noise, 1, axis=0) + np.roll(noise, -1, axis=0)) / 3


# Drawn by machine: proportions vary more, outlines are clean. Drawn with a pen: widths and stretch vary.
LOOSE = Amounts()
MACHINED = Amounts(angle=0.12, length=0.2, point=0.05, stretch=0.1, warp=0.006, bumps=0.001, noise=0.0004)
PENNED = Amounts(point=0.05, stretch=0.17, warp=0.012, bumps=0.002, noise=0.0006)
# In turn, each with how its variants differ. Twice as many strokes, since styles of drawing differ most.
FAMILIES = (
    (blob, LOOSE),
    (strokes, PENNED),
    (limbs, LOOSE),
    (assembly, MACHINED),
    (sketches, LOOSE),
    (polygon, LOOSE),
    (strokes, PENNED),
)


def group(number: int, count: int, seed: int) -> list[Polygon]:
    """Return the variants of one kind of shape; fewer than asked for if some could not be made.

    Parameters
    ----------
    number : int
        Of the group: it decides family and shape.
    count : int
        Variants.
    seed : int
    """
    rng = np.random.default_rng([seed, number])
    family, amounts = FAMILIES[number % len(FAMILIES)]
    plan = family(rng)
    made = []
    for _ in range(count):
        built = largest(plan.build(jittered(plan, rng, amounts)))
        bent = built and deformed(built, rng, amounts)
        if bent:
            made.append(bent)
    return made
