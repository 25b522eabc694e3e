"""A `Drawing` as SVG text: small, readable, the same bytes for the same drawing."""

from collections.abc import Iterator
from xml.sax.saxutils import escape, quoteattr

from mashape_cad.views.drawing import Area, Circle, Difference, Drawing, Floats, Label, Lines, Shape, printable

__all__ = ["FONT", "svg"]

FONT = "'DejaVu Sans', Verdana, 'Segoe UI', sans-serif"


def svg(drawing: Drawing) -> str:
    """Return the text of an SVG element; it stands alone as a file, and inside an HTML page."""
    width, height = _number(drawing.width), _number(drawing.height)
    title = printable(drawing.title)
    size = f'viewBox="0 0 {width} {height}" {_size(drawing, width, height)}'
    spoken = f'role="img" aria-label={quoteattr(title)}'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} {spoken} font-family="{FONT}">',
        f"<title>{escape(title)}</title>",
    ]
    if drawing.background:
        lines.append(f'<rect width="{width}" height="{height}" fill="{drawing.background}"/>')
    lines += [line for shape in drawing.shapes for line in _element(shape)]
    return "\n".join([*lines, "</svg>"])


def _size(drawing: Drawing, width: str, height: str) -> str:
    if drawing.pixel is not None:
        # The sides of the view box as they are written, so that both directions have the same scale.
        width, height = (f"{float(side) * drawing.pixel:.9g}mm" for side in (width, height))
    return f'width="{width}" height="{height}"'


def _element(shape: Shape) -> Iterator[str]:
    match shape:
        case Area(rings=rings) if rings:
            outline = f' stroke="{shape.stroke}" stroke-width="{_number(shape.width)}"' if shape.stroke else ""
            path = "".join(_path(ring) + "Z" for ring in rings)
            yield f'<path d="{path}" fill="{shape.fill}" fill-rule="evenodd" stroke-linejoin="round"{outline}/>'
        case Difference():
            path = "".join(_path(ring) + "Z" for ring in shape.one + shape.other)
            yield f'<path d="{path}" fill="{shape.fill}" fill-rule="evenodd"/>'
        case Lines(runs=runs) if runs:
            path = "".join(_path(run) for run in runs)
            yield (
                f'<path d="{path}" fill="none" stroke="{shape.colour}" stroke-width="{_number(shape.width)}"'
                ' stroke-linecap="round" stroke-linejoin="round"/>'
            )
        case Circle():
            opacity = f' fill-opacity="{_number(shape.opacity)}"' if shape.opacity < 1 else ""
            yield (
                f'<circle cx="{_number(shape.x)}" cy="{_number(shape.y)}" r="{_number(shape.radius)}"'
                f' fill="{shape.fill}"{opacity} stroke="{shape.stroke}" stroke-width="{_number(shape.width)}"/>'
            )
        case Label():
            anchor = f' text-anchor="{shape.anchor}"' if shape.anchor != "start" else ""
            weight = ' font-weight="bold"' if shape.bold else ""
            yield (
                f'<text x="{_number(shape.x)}" y="{_number(shape.y)}" font-size="{_number(shape.size)}"'
                f' fill="{shape.colour}"{anchor}{weight}>{escape(printable(shape.text))}</text>'
            )


def _path(points: Floats) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points.tolist())


def _number(value: float) -> str:
    """Hundredths of a pixel are finer than any screen; adding zero takes the sign from minus zero."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")
