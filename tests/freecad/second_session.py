"""A second process of FreeCAD: it knows the settings of the first one, and is killed with the helper running."""

import os
import sys

import FreeCAD as App
import FreeCADGui as Gui
import Part

sys.path.insert(0, os.environ["WORK"])
from stage import LIBRARY, OUT, Stage, Window

window = Window()


def script(stage):
    """Search without setting anything, then wait for the end."""
    document = App.newDocument("model")
    shape = Part.Shape()
    shape.read(os.path.join(LIBRARY, "parts", "part-07.step"))
    plate = document.addObject("Part::Feature", "Plate")
    plate.Shape = shape
    document.recompute()
    Gui.Selection.addSelection(document.Name, plate.Name)
    window.run_macro()
    yield stage.wait_for(lambda: bool(window.code))
    stage.check("settings survive into a second process", window.names()[:1] == ["part-07.step"], window.code)
    stage.keep()
    with open(os.path.join(OUT, "processes"), "w") as file:
        file.write(f"{os.getpid()} {window.dock._helper._process.processId()}\n")
    yield stage.wait_for(lambda: False)


Stage("second").play(script)
