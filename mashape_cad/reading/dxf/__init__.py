"""Drawings in the DXF format: `read_dxf`. The only package that imports ezdxf."""

from mashape_cad.reading.dxf.reader import read_dxf

__all__ = ["read_dxf"]
