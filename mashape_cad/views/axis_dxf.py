"""Medial axes as a DXF drawing for CAM programs; the layers are described in ``docs/axis-format.md``.

The one module besides the DXF reader that imports ezdxf: it writes entities, and reads nothing.
"""

import io
import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from ezdxf import units
from ezdxf.document import Drawing
from ezdxf.filemanagement import new
from ezdxf.layouts.layout import Modelspace

from mashape_cad.geometry.edge import Arc, BSpline, Edge, EllipseArc, Floats, Line

if TYPE_CHECKING:
    from mashape_cad.library.tracing import TracedProfile
    from mashape_cad.medial.trace import Trace, TracedBranch

__all__ = ["APPLICATION", "LAYERS", "axes_dxf"]

# Layers and their colours, as AutoCAD numbers them: 7 is black on white and white on black.
LAYERS = {
    "OUTLINE": 7,
    "AXIS": 5,
    "AXIS_END": 4,
    "AXIS_VERTEX": 8,
    "AXIS_VCARVE": 1,
}
APPLICATION = "MASHAPE_CAD"
# Spans of one SPLINE entity: extended data of an entity end at 16 kB, and each span brings two radii of 9 bytes.
_MOST_SPANS = 400
# Arcs that go round by this (radians) are whole.
_FULL = math.tau - 1e-12


def axes_dxf(traced: Sequence["TracedProfile"]) -> bytes:
    """Return a drawing of outlines and axes, in mm.

    Parameters
    ----------
    traced : sequence of TracedProfile
        With splines.
    """
    document = new("R2010", units=units.MM)
    document.header["$MEASUREMENT"] = 1
    document.appids.add(APPLICATION)
    space = document.modelspace()
    planes = {each.profile.origin.plane for each in traced}
    for each in traced:
        # Faces of a solid have planes of their own: they lie on top of each other, but on layers that tell them apart.
        face = each.profile.origin.face if len(planes) > 1 else None
        _draw(document, space, each, "" if face is None else f"_FACE_{face}")
    return _bytes(document)


def _bytes(document: Drawing) -> bytes:
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode(document.output_encoding, errors="dxfreplace")


def _draw(document: Drawing, space: Modelspace, each: "TracedProfile", suffix: str) -> None:
    for name, colour in LAYERS.items():
        if name + suffix not in document.layers:
            document.layers.add(name + suffix, color=colour)
    for edge in each.profile.edges:
        draw_edge(edge, space, {"layer": f"OUTLINE{suffix}"})
    for number, branch in enumerate(each.trace.branches):
        known = [(1071, each.number), (1071, number), (1071, branch.start), (1071, branch.end)]
        _draw_branch(space, branch, {"layer": layer_of(each.trace, branch) + suffix}, known)
        carved = np.column_stack([branch.centre, -branch.radius])
        path = space.add_polyline3d(carved.tolist(), dxfattribs={"layer": f"AXIS_VCARVE{suffix}"})
        path.set_xdata(APPLICATION, [(1000, "branch"), *known])
    if not each.trace.branches:
        _draw_disc(space, each, suffix)


def layer_of(trace: "Trace", branch: "TracedBranch") -> str:
    """Return the layer of a branch: by where it ends."""
    ends = [node for node in (branch.start, branch.end) if trace.kind[node] == "end"]
    if any(trace.radius[node] == 0.0 for node in ends):
        return "AXIS_VERTEX"
    return "AXIS_END" if ends else "AXIS"


def _draw_branch(
    space: Modelspace, branch: "TracedBranch", looks: dict[str, Any], known: list[tuple[int, int]]
) -> None:
    """Add a line where x, y and the radius change in proportion, else one spline, or more of a very long branch."""
    spline = branch.spline
    if spline is None:
        return
    if spline.is_straight:
        (x0, y0, r0), (x1, y1, r1) = spline.poles[[0, -1]].tolist()
        line = space.add_line((x0, y0), (x1, y1), dxfattribs=looks)
        line.set_xdata(APPLICATION, [(1000, "branch"), *known, (1040, r0), (1040, r1)])
        return
    for knots, poles in _parts(spline.knots, spline.poles):
        entity = space.add_spline(degree=3, dxfattribs=looks)
        entity.control_points = [(x, y, 0.0) for x, y in poles[:, :2].tolist()]
        entity.knots = knots.tolist()
        entity.set_xdata(APPLICATION, [(1000, "branch"), *known, *((1040, r) for r in poles[:, 2].tolist())])


def _parts(knots: Floats, poles: Floats) -> Iterator[tuple[Floats, Floats]]:
    """Cut a cubic spline with double inner knots at some of them: each part has the poles of its spans."""
    breaks = np.unique(knots)
    spans = len(breaks) - 1
    borders = [*range(0, spans, _MOST_SPANS), spans]
    for low, high in pairwise(borders):
        inner = poles[1 + 2 * low : 1 + 2 * high]
        ends = [_point(breaks, poles, k) for k in (low, high)]
        part = np.concatenate([ends[:1], inner, ends[1:]])
        yield np.concatenate([breaks[[low, low]], np.repeat(breaks[low : high + 1], 2), breaks[[high, high]]]), part


def _point(breaks: Floats, poles: Floats, k: int) -> Floats:
    """Return the point of the spline at a break: the poles on either side lie on its tangent there."""
    if k in {0, len(breaks) - 1}:
        return poles[0 if k == 0 else -1]
    before, behind = breaks[k] - breaks[k - 1], breaks[k + 1] - breaks[k]
    return (poles[2 * k] * behind + poles[2 * k + 1] * before) / (before + behind)


def _draw_disc(space: Modelspace, each: "TracedProfile", suffix: str) -> None:
    """Add the one point that is the axis of a disc, or all that is left of a pruned one."""
    (x, y), r = each.trace.centre[0].tolist(), float(each.trace.radius[0])
    point = space.add_point((x, y, 0.0), dxfattribs={"layer": f"AXIS{suffix}"})
    point.set_xdata(APPLICATION, [(1000, "node"), (1071, each.number), (1040, r)])
    space.add_point((x, y, -r), dxfattribs={"layer": f"AXIS_VCARVE{suffix}"})


def draw_edge(edge: Edge, space: Modelspace, looks: dict[str, Any]) -> None:
    """Add an edge of the outline as the entity that is exactly it."""
    match edge:
        case Line():
            space.add_line(edge.first.tolist(), edge.last.tolist(), dxfattribs=looks)
        case Arc():
            _draw_arc(edge, space, looks)
        case EllipseArc():
            _draw_ellipse(edge, space, looks)
        case BSpline():
            entity = space.add_spline(degree=edge.degree, dxfattribs=looks)
            entity.control_points = [(x, y, 0.0) for x, y in edge.poles.tolist()]
            entity.knots = edge.knots.tolist()
            if edge.is_rational:
                entity.weights = edge.weights.tolist()


def _draw_arc(edge: Arc, space: Modelspace, looks: dict[str, Any]) -> None:
    turned = _standing(edge)
    if turned.sweep >= _FULL:
        space.add_circle(edge.centre.tolist(), edge.radius, dxfattribs=looks)
        return
    first = float(np.arctan2(turned.axis_a[1], turned.axis_a[0])) + turned.start_angle
    start, end = np.degrees([first, first + turned.sweep]).tolist()
    space.add_arc(edge.centre.tolist(), edge.radius, start % 360.0, end % 360.0, dxfattribs=looks)


def _draw_ellipse(edge: EllipseArc, space: Modelspace, looks: dict[str, Any]) -> None:
    edge = _standing(edge)
    if np.hypot(*edge.axis_a) < np.hypot(*edge.axis_b):  # an entity has its longer semi-axis first
        edge = EllipseArc(edge.centre, edge.axis_b, -edge.axis_a, edge.start_angle - np.pi / 2, edge.sweep)
    ratio = float(np.hypot(*edge.axis_b) / np.hypot(*edge.axis_a))
    # A whole one from 0: some programs take ends that differ by a full turn for the same place.
    start, end = (0.0, math.tau) if edge.sweep >= _FULL else (edge.start_angle, edge.start_angle + edge.sweep)
    space.add_ellipse(edge.centre.tolist(), [*edge.axis_a.tolist(), 0.0], ratio, start, end, dxfattribs=looks)


def _standing(edge: EllipseArc) -> EllipseArc:
    """Return the same arc with right-handed axes, counter-clockwise, as entities have it."""
    if edge.axis_a[0] * edge.axis_b[1] < edge.axis_a[1] * edge.axis_b[0]:
        edge = EllipseArc(edge.centre, edge.axis_a, -edge.axis_b, -edge.start_angle, -edge.sweep)
    if edge.sweep < 0:
        edge = EllipseArc(edge.centre, edge.axis_a, edge.axis_b, edge.start_angle + edge.sweep, -edge.sweep)
    return edge
