"""Airplanes seen from above: nose up, symmetric about x = 0."""

from dataclasses import dataclass

from maker.pen import Pen
from mashape_cad.geometry.profile import Profile

__all__ = ["airplanes"]


@dataclass(frozen=True, slots=True)
class Surface:
    """One half of a wing or tailplane: where its leading edge meets the fuselage, and its tip, mm."""

    root: float  # y of the leading edge at the fuselage
    chord: float  # length along the fuselage
    span: float  # x of the tip
    sweep: float  # how far the tip's leading edge lies behind the root's
    tip: float  # chord at the tip
    bow: float = 0.0  # how far the leading edge bows forward


@dataclass(frozen=True, slots=True)
class Engine:
    """A nacelle before the wing's leading edge."""

    x: float
    width: float
    ahead: float


def airplanes() -> dict[str, Profile]:
    """Return airliners, bombers, propeller aircraft, business jets, jet fighters and a glider."""
    return {
        "airplane-1": airplane(
            nose=22, width=7.5, length=160, wing=Surface(-55, 34, 76, 44, 9, 1.5), tail=Surface(-132, 17, 29, 17, 6),
            engines=(Engine(25, 8.5, 11),),
        ),
        "airplane-2": airplane(
            nose=26, width=10, length=200, wing=Surface(-62, 46, 98, 66, 10, 2), tail=Surface(-168, 21, 37, 22, 7),
            engines=(Engine(30, 9.5, 13), Engine(58, 8.5, 11)),
        ),
        "airplane-3": airplane(
            nose=22, width=7.5, length=132, wing=Surface(-40, 34, 80, 20, 9, 1.5),
            tail=Surface(-107, 17, 31, 11, 6, 0.5), engines=(Engine(25, 9, 13),),
        ),
        "airplane-4": airplane(
            nose=34, width=7.5, length=140, wing=Surface(-50, 40, 52, 40, 9, 1), tail=Surface(-112, 17, 27, 16, 6)
        ),
        "airplane-5": airplane(
            nose=26, width=7, length=150, wing=Surface(-66, 28, 66, 30, 8, 1), tail=Surface(-126, 15, 28, 16, 6)
        ),
        "airplane-6": airplane(
            nose=20, width=6, length=112, wing=Surface(-36, 20, 112, 8, 8, 1.5), tail=Surface(-96, 12, 24, 5, 6)
        ),
        "airplane-7": airplane(
            nose=20, width=8, length=150, wing=Surface(-42, 36, 104, 16, 12, 2), tail=Surface(-122, 18, 40, 8, 8, 1),
            engines=(Engine(27, 9, 14), Engine(60, 9, 13)),
        ),
        "airplane-8": airplane(
            nose=44, width=8, length=150, wing=Surface(-62, 58, 50, 48, 9, 0.5), tail=Surface(-130, 14, 24, 12, 6)
        ),
        "airplane-9": airplane(
            nose=24, width=11, length=184, wing=Surface(-60, 44, 92, 52, 11, 2), tail=Surface(-150, 21, 36, 20, 8),
            engines=(Engine(32, 11, 15),),
        ),
        "airplane-10": airplane(
            nose=18, width=8, length=126, wing=Surface(-46, 26, 74, 6, 12, 1), tail=Surface(-104, 16, 30, 6, 8, 0.5),
            engines=(Engine(26, 9, 17),),
        ),
    }  # fmt: skip


def airplane(
    nose: float, width: float, length: float, wing: Surface, tail: Surface, engines: tuple[Engine, ...] = ()
) -> Profile:
    """Draw an airplane; `nose` is how long the nose is, `width` half of the fuselage's."""
    pen = Pen(0, 0).curve((0.62 * width, -0.25 * nose), (width, -nose), leave=0, arrive=-90)
    pen.curve((1.06 * width, (wing.root - nose) / 2), (width, wing.root), leave=-90, rounded=3)
    _surface(pen, wing, width, engines)
    stern = 0.55 * width
    slim = (width + stern) / 2 + 0.1 * width
    middle = (wing.root - wing.chord + tail.root) / 2
    pen.curve((slim, middle), (stern, tail.root), leave=-90, arrive=-94, rounded=2.5)
    _surface(pen, tail, stern * 0.8, ())
    pen.curve((0.45 * stern, -length + 0.12 * nose), (0, -length), arrive=180)
    return Profile.of(pen.mirror_close())


def _surface(pen: Pen, wing: Surface, root: float, engines: tuple[Engine, ...]) -> None:
    """Draw a wing from the fuselage (x = `root`) to its tip and back."""

    def leading(x: float) -> float:
        t = (x - root) / (wing.span - root)
        return wing.root - wing.sweep * t + 4 * wing.bow * t * (1 - t)

    for engine in engines:
        inner, outer, radius = engine.x - engine.width / 2, engine.x + engine.width / 2, engine.width / 2
        front = leading(engine.x) + engine.ahead
        pen.line(inner, leading(inner), rounded=1.5).line(inner, front - radius)
        pen.curve((engine.x, front), (outer, front - radius), leave=90, arrive=-90)
        pen.line(outer, leading(outer), rounded=1.5)
    size = min(0.45 * wing.tip, 6)
    half = (engines[-1].x if engines else root) / 2 + wing.span / 2
    pen.curve((half, leading(half)), (wing.span, leading(wing.span)), rounded=size)
    pen.line(wing.span + 1, leading(wing.span) - wing.tip, rounded=0.5 * size)
    pen.line(root, wing.root - wing.chord, rounded=3)
