"""Model space as loose edges: blocks unfolded, hidden things left out, all of it in mm.

A block reference (INSERT) may be nested, repeated in rows and columns, mirrored, and scaled unevenly. How many entities
it unfolds to is counted before it is unfolded: a few nested blocks can stand for a thousand million lines.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np
from ezdxf.document import Drawing
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.insert import Insert
from ezdxf.lldxf.const import DXFError
from ezdxf.xclip import XClip

from mashape_cad.findings import Finding, Severity
from mashape_cad.geometry.affine import affine_image
from mashape_cad.geometry.drawing import Strand
from mashape_cad.geometry.edge import Floats
from mashape_cad.reading.dxf.curves import Drawn, UnusableEntityError, draws_curve, entity_edges
from mashape_cad.reading.dxf.tally import Tally, why_ignored

__all__ = ["Unfolded", "unfold"]

# Entities that the blocks of one drawing may unfold to. Real ones stay below 5,000; this many take about a minute.
_MOST_ENTITIES = 50_000
# Direction cosines, and coordinates: see `curves`.
_TILT = 1e-6
_FARTHEST = 1e15
# Determinant over square of the largest entry: a flatter image has no width.
_FLAT = 1e-9
# Of the drawing's size: heights that differ by less are the same.
_LEVEL = 1e-6
# AutoCAD's own layer for the points of dimensions; it is never plotted, whatever its flags say.
_NEVER_PLOTTED = "defpoints"


@dataclass(frozen=True, slots=True)
class Unfolded:
    """Loose edges of a drawing, mm, and what was left out."""

    strands: tuple[Strand, ...]
    findings: tuple[Finding, ...]


def unfold(document: Drawing, scale: float) -> Unfolded:
    """Collect the visible edges of model space.

    Parameters
    ----------
    document : ezdxf.document.Drawing
    scale : float
        Millimetres of one drawing unit.
    """
    walk = _Walk(document, Tally(scale))
    matrix = np.diag([scale, scale, scale, 1.0])
    walk.entities(document.modelspace(), _Place(matrix))
    return Unfolded(tuple(walk.strands), tuple(walk.findings()))


@dataclass(frozen=True, slots=True, eq=False)
class _Place:
    """Where a block's entities go: a (4, 4) matrix for row vectors (x, y, z, 1), and what they inherit."""

    matrix: Floats
    handles: tuple[str, ...] = ()
    layer: str = "0"

    def name_of(self, entity: DXFEntity) -> str:
        """Return the handles of the references on the way, then the entity's own: ``2A/1F``."""
        return "/".join((*self.handles, str(entity.dxf.handle)))

    def within(self, single: Insert, insert: Insert, layer: str) -> "_Place":
        """Return the place of a block that is referred to from here; `single` is one of an array's references."""
        inner = np.array(list(single.matrix44()), float).reshape(4, 4)
        _check_flat(matrix := inner @ self.matrix)
        return _Place(matrix, (*self.handles, str(insert.dxf.handle)), layer)

    def image(self, drawn: Drawn) -> Drawn:
        """Move what was drawn."""
        plane, offset = self.matrix[:2, :2].T, self.matrix[3, :2]
        edges = tuple(affine_image(edge, plane, offset) for edge in drawn.edges)
        heights = sorted(self.matrix[2, 2] * height + self.matrix[3, 2] for height in (drawn.low, drawn.high))
        return Drawn(edges, *heights)


def _singles(insert: Insert) -> list[Insert]:
    """Return the references of an array one by one."""
    try:
        return list(insert.multi_insert())
    except (DXFError, ValueError, TypeError, ArithmeticError) as error:
        raise UnusableEntityError("entity-invalid", f"its numbers make no place ({error})") from error


def _check_flat(matrix: Floats) -> None:
    """See that a block placed by a matrix lies flat and has an extent.

    Raises
    ------
    UnusableEntityError
        If not.
    """
    plane, tilt = matrix[:2, :2], matrix[:2, 2]
    size = np.abs(plane).max()
    if not np.all(np.isfinite(matrix)) or np.abs(matrix).max() > _FARTHEST:
        raise UnusableEntityError("entity-invalid", "its place is not a number or beyond all measure")
    if np.abs(tilt).max() > _TILT * size:
        raise UnusableEntityError("entity-tilted", "it does not lie flat in the xy plane")
    if abs(np.linalg.det(plane)) <= _FLAT * size**2:
        raise UnusableEntityError("entity-degenerate", "it is scaled to nothing")


class _Walk:
    """One way through a drawing, collecting."""

    def __init__(self, document: Drawing, tally: Tally) -> None:
        self._document = document
        self._tally = tally
        self._drawn: dict[int, Drawn] = {}  # by id: an entity of a block is drawn once for each reference
        self._hidden_layers: dict[str, str | None] = {}
        self._sizes: dict[str, float] = {}
        self._unfolded = 0.0
        self._entity = 0
        self._levels: list[tuple[float, float]] = []
        self.strands: list[Strand] = []

    def entities(self, entities: Iterable[DXFEntity], place: _Place) -> None:
        """Collect entities of model space or of a block."""
        for entity in entities:
            layer = self._layer(entity, place)
            hidden = self._why_hidden(entity, layer)
            if hidden is not None:
                self._leave_out(entity, place, "entity-hidden", hidden)
            elif isinstance(entity, Insert):
                self._reference(entity, place, layer)
            elif draws_curve(entity):
                self._curve(entity, place, layer)
            else:
                self._leave_out(entity, place, *why_ignored(entity.dxftype()))

    def findings(self) -> list[Finding]:
        """Report what was left out, and heights that a flat drawing does not have."""
        return [*self._tally.findings(), *self._height_findings()]

    def _curve(self, entity: DXFEntity, place: _Place, layer: str) -> None:
        try:
            drawn = place.image(self._drawn_once(entity))
        except UnusableEntityError as error:
            self._leave_out(entity, place, error.code, str(error))
            return
        self._entity += 1
        self._levels.append((drawn.low, drawn.high))
        handle = place.name_of(entity)
        self.strands += [Strand(edge, self._entity, handle, layer) for edge in drawn.edges]

    def _drawn_once(self, entity: DXFEntity) -> Drawn:
        if id(entity) not in self._drawn:
            self._drawn[id(entity)] = entity_edges(entity)
        return self._drawn[id(entity)]

    def _reference(self, insert: Insert, place: _Place, layer: str) -> None:
        """Unfold a block reference, if there is something to unfold and an end to it."""
        for attribute in insert.attribs:
            self._leave_out(attribute, place, *why_ignored("ATTRIB"))
        reason = self._why_not_unfolded(insert)
        if reason is not None:
            self._leave_out(insert, place, *reason)
            return
        if insert.has_extension_dict and XClip(insert).has_clipping_path:
            reason_clipped = "shown clipped, read whole"
            self._leave_out(insert, place, "entity-clipped", reason_clipped, severity=Severity.INFO)
        try:
            places = [place.within(single, insert, layer) for single in _singles(insert)]
        except UnusableEntityError as error:
            self._leave_out(insert, place, error.code, str(error))
            return
        for inner in places:
            self.entities(insert.block() or (), inner)

    def _why_not_unfolded(self, insert: Insert) -> tuple[str, str] | None:
        name = _attribute(insert, "name", None)
        block = insert.block() if name else None
        if block is None:
            return "entity-missing-block", f"refers to block {name!r}, which is not in the file"
        if block.block is not None and (block.block.is_xref or block.block.is_xref_overlay):
            return (
                "entity-xref",
                f"refers to the file {block.block.dxf.get('xref_path', '')!r}, which is not read; bind it",
            )
        size = self._size(insert)
        if size == inf:
            return "entity-cycle", f"block {insert.dxf.name!r} contains itself"
        self._unfolded += size
        if self._unfolded > _MOST_ENTITIES:
            return "entity-limit", f"unfolds to {size:.3g} entities; more than {_MOST_ENTITIES} are not read"
        return None

    def _size(self, insert: Insert) -> float:
        """Count what a reference unfolds to, infinite where a block contains itself."""
        name = str(_attribute(insert, "name", "")).casefold()
        if name not in self._sizes:
            self._sizes[name] = inf  # as long as its own count is under way
            block = insert.block() if name else None
            inner = () if block is None else block
            self._sizes[name] = 1 + sum(self._size(one) if isinstance(one, Insert) else 1 for one in inner)
        return self._sizes[name] * max(1, insert.dxf.row_count) * max(1, insert.dxf.column_count)

    def _layer(self, entity: DXFEntity, place: _Place) -> str:
        """Return the layer that counts: in a block, layer 0 stands for the layer of the reference."""
        layer = str(_attribute(entity, "layer", "0"))
        return place.layer if layer == "0" else layer

    def _why_hidden(self, entity: DXFEntity, layer: str) -> str | None:
        if _attribute(entity, "invisible", 0):
            return "marked as invisible"
        if layer not in self._hidden_layers:
            self._hidden_layers[layer] = self._why_layer_hidden(layer)
        return self._hidden_layers[layer]

    def _why_layer_hidden(self, name: str) -> str | None:
        if name.casefold() == _NEVER_PLOTTED:
            return f"on layer {name!r}, which is never plotted"
        if name not in self._document.layers:
            return None
        layer = self._document.layers.get(name)
        states = ((layer.is_frozen(), "is frozen"), (layer.is_off(), "is off"), (not layer.dxf.plot, "is not plotted"))
        return next((f"on layer {name!r}, which {state}" for applies, state in states if applies), None)

    def _leave_out(
        self, entity: DXFEntity, place: _Place, code: str, reason: str, severity: Severity = Severity.LOST
    ) -> None:
        self._tally.add(entity, code, reason, handle=place.name_of(entity), severity=severity)

    def _height_findings(self) -> list[Finding]:
        if not self._levels:
            return []
        levels = np.array(self._levels)
        size = max(float(np.abs(strand.edge.point([0.0, 1.0])).max()) for strand in self.strands)
        low, high = float(levels[:, 0].min()), float(levels[:, 1].max())
        if high - low <= _LEVEL * size:
            return []
        slanted = int(np.count_nonzero(levels[:, 1] - levels[:, 0] > _LEVEL * size))
        text = f"heights (z) from {low:.4g} to {high:.4g} mm, projected to the xy plane; {slanted} curves are not level"
        return [Finding("entity-height", Severity.REPAIRED if slanted else Severity.INFO, text, count=max(1, slanted))]


def _attribute(entity: DXFEntity, name: str, default: Any) -> Any:
    """Return an attribute of an entity of any kind, also of one that ezdxf does not know."""
    return entity.dxf.get(name, default) if entity.dxf.is_supported(name) else default
