"""Objects of modelling scripts to profiles: `read_object`.

CadQuery and build123d are not imported: what they make is told by its attributes.

* Shapes of both wrap the kernel's shape as ``wrapped``.
* A CadQuery ``Workplane`` has ``vals()``, and in ``ctx`` the wires and edges that wait for an extrusion; a ``Sketch``
  yields faces when iterated; an ``Assembly`` has ``toCompound()``.
* The builders of build123d hold what they build as ``sketch``, ``part`` or ``line``.
"""

from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import Any

from mashape_cad.errors import QueryError
from mashape_cad.kernel.faces import PlanarFaces, planar_faces
from mashape_cad.kernel.outlines import outline
from mashape_cad.kernel.shapes import Shape, has_faces, is_shape, together
from mashape_cad.options import ReadOptions
from mashape_cad.reading.faces import face_profiles
from mashape_cad.reading.part import Part, Unit

__all__ = ["read_object"]

_BUILT = ("sketch", "part", "line")
# How deep lists of lists are looked into: also an end to what contains itself.
_DEPTH = 4


def read_object(thing: object, options: ReadOptions | None = None) -> Part:
    """Make profiles of an object of a modelling script, each in its own plane.

    Parameters
    ----------
    thing : object
        A kernel shape, or anything of CadQuery or build123d that is or holds a face, wire, sketch or solid, or a list
        of such. Solids give all their planar faces, wires and edges the profiles that they bound.
    options : ReadOptions, optional
        Lengths are mm unless a unit is given.

    Raises
    ------
    QueryError
        If it is nothing of that kind, holds nothing, or its wires do not lie in one plane.
    KernelUnavailableError
        If the geometry kernel cannot be imported.
    """
    options = options or ReadOptions()
    module = type(thing).__module__.partition(".")[0]
    name = type(thing).__name__ if module == "builtins" else f"{module} {type(thing).__name__}"
    shapes = []
    with suppress(Exception):  # whatever the object's own code does when it is empty
        shapes = list(_shapes_of(thing, _DEPTH))
    if not shapes:
        wanted = "give a face, wire, sketch or solid of CadQuery or build123d"
        raise QueryError(f"a {name} holds no shape to compare; {wanted}")
    try:
        found = _planar_faces(shapes)
    except ValueError as error:
        raise QueryError(f"the {name} has no flat outline: {error}; give a face or a closed flat wire") from error
    unit = Unit.named(options.unit, "option") if options.unit else Unit.named("mm", "default")
    made = face_profiles(found, options.gap_rel).scaled(unit.millimetres)
    return Part(None, "object", unit, made.profiles, made.findings)


def _planar_faces(shapes: list[Shape]) -> PlanarFaces:
    with_faces = [shape for shape in shapes if has_faces(shape)]
    if with_faces:
        return planar_faces(together(with_faces))
    return PlanarFaces((outline(together(shapes)),), (), (), 0)


def _shapes_of(thing: Any, depth: int) -> Iterator[Shape]:
    """Find the kernel shapes in something."""
    wrapped = thing if is_shape(thing) else _attribute(thing, "wrapped")
    if is_shape(wrapped):
        yield wrapped
    elif depth > 0:
        for part in _parts_of(thing):
            yield from _shapes_of(part, depth - 1)


def _parts_of(thing: Any) -> Iterable[Any]:
    if callable(_attribute(thing, "toCompound")):
        return [thing.toCompound()]
    if callable(_attribute(thing, "vals")) and _attribute(thing, "ctx") is not None:
        return _on_workplane(thing)
    built = [part for part in (_attribute(thing, name) for name in _BUILT) if part is not None]
    if built:
        return built
    return thing if isinstance(thing, Iterable) and not isinstance(thing, str | bytes) else ()


def _on_workplane(workplane: Any) -> list[Any]:
    """Return what is selected; if that has no face, all that waits for an extrusion, where anything does."""
    selected = workplane.vals()
    waiting = [*workplane.ctx.pendingWires, *workplane.ctx.pendingEdges]
    if not waiting or any(has_faces(shape) for shape in _shapes_of(selected, _DEPTH)):
        return selected
    return waiting


def _attribute(thing: Any, name: str) -> Any:
    """Return an attribute or None; some properties of empty objects fail instead of being absent."""
    with suppress(Exception):
        return getattr(thing, name, None)
    return None
