"""Make the twenty parts that the FreeCAD tests search for, beside a copy of the samples: make_library.py FOLDER.

``outlines.json`` beside them tells their corners and holes, so that a test can draw the same outline again.
"""

import json
import math
import random
import sys
from pathlib import Path

import ezdxf
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder, BRepPrimAPI_MakePrism
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt, gp_Vec
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

THICKNESS = 5.0
# Not symmetric in any way: its mirror image is another part.
ANGLE = ([(0, 0), (60, 0), (60, 15), (20, 15), (20, 40), (0, 40)], [(10, 10, 4)])


def outline(number):
    """Return corners and holes (x, y, radius) of one part: a star-shaped polygon, no two alike."""
    if number == 0:
        return ANGLE
    chance = random.Random(number)  # noqa: S311
    count = 5 + number % 8
    turns = [(k + chance.uniform(-0.2, 0.2)) / count * math.tau for k in range(count)]
    radii = [chance.uniform(25, 60) for _ in turns]
    corners = [(round(r * math.cos(t), 6), round(r * math.sin(t), 6)) for r, t in zip(radii, turns, strict=True)]
    return corners, [(0, 0, 4 + number % 5)] if number % 2 else []


def write_drawing(path, corners, holes):
    """Write the outline as a DXF drawing in mm."""
    document = ezdxf.new("R2000", units=4)
    document.modelspace().add_lwpolyline(corners, close=True)
    for x, y, radius in holes:
        document.modelspace().add_circle((x, y), radius)
    document.saveas(path)


def write_solid(path, corners, holes):
    """Write the outline as a plate in a STEP file."""
    polygon = BRepBuilderAPI_MakePolygon()
    for x, y in corners:
        polygon.Add(gp_Pnt(float(x), float(y), 0.0))
    polygon.Close()
    solid = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, THICKNESS)).Shape()
    for x, y, radius in holes:
        drill = gp_Ax2(gp_Pnt(float(x), float(y), -1.0), gp_Dir(0, 0, 1))
        solid = BRepAlgoAPI_Cut(solid, BRepPrimAPI_MakeCylinder(drill, float(radius), THICKNESS + 2).Shape()).Shape()
    writer = STEPControl_Writer()
    writer.Transfer(solid, STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(path))


def main(folder):
    """Make the parts."""
    folder.mkdir(parents=True)
    outlines = {}
    for number in range(20):
        name = f"part-{number:02}{'.dxf' if number % 2 == 0 else '.step'}"
        outlines[name] = outline(number)
        write = write_drawing if number % 2 == 0 else write_solid
        write(folder / name, *outlines[name])
    (folder / "outlines.json").write_text(json.dumps(outlines), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
