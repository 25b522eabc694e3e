"""Medial axes as JSON for other programs; the format is described in ``docs/axis-format.md``."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from mashape_cad.library.json_text import json_text, valid_text
from mashape_cad.library.record import GENERATOR
from mashape_cad.options import AxisOptions

if TYPE_CHECKING:
    from mashape_cad.library.tracing import RefusedProfile, TracedProfile

__all__ = ["FORMAT", "FORMAT_VERSION", "axes_json"]

FORMAT = "mashape-axis"
FORMAT_VERSION = 1


def axes_json(
    traced: Sequence["TracedProfile"], refused: Sequence["RefusedProfile"], options: AxisOptions, source: Path
) -> bytes:
    """Return the document as UTF-8."""
    document = {
        "format": FORMAT,
        "version": FORMAT_VERSION,
        "generator": GENERATOR,
        "source": valid_text(source.name),
        "unit": "mm",
        "options": msgspec.to_builtins(options),
        "profiles": [_profile(each) for each in traced],
        "refused": [_refused(each) for each in refused],
    }
    return json_text(document)


def _profile(each: "TracedProfile") -> dict[str, Any]:
    trace = each.trace
    nodes = zip(trace.centre.tolist(), trace.radius.tolist(), trace.kind, trace.degree.tolist(), strict=True)
    return {
        "profile": each.number,
        **_origin(each),
        "nodes": [{"x": x, "y": y, "r": r, "kind": kind, "degree": degree} for (x, y), r, kind, degree in nodes],
        "branches": [
            {
                "start": branch.start,
                "end": branch.end,
                "x": branch.centre[:, 0].tolist(),
                "y": branch.centre[:, 1].tolist(),
                "r": branch.radius.tolist(),
            }
            for branch in trace.branches
        ],
    }


def _refused(each: "RefusedProfile") -> dict[str, Any]:
    return {"profile": each.number, **_origin(each), **msgspec.to_builtins(each.refused)}


def _origin(each: "TracedProfile | RefusedProfile") -> dict[str, Any]:
    """Say where in its file a profile lies: only what that kind of file has."""
    origin = each.profile.origin
    found = {
        "layer": None if origin.layer is None else valid_text(origin.layer),
        "face": origin.face,
        "plane": None if origin.plane is None else msgspec.to_builtins(origin.plane),
    }
    return {name: value for name, value in found.items() if value is not None}
