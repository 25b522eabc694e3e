"""The macro as users meet it, in one session of FreeCAD: selections, refusals, a long query, imports, the end."""

import glob
import json
import os
import shutil
import sys
import time

import FreeCAD as App
import FreeCADGui as Gui
import Part

sys.path.insert(0, os.environ["WORK"])
from stage import LIBRARY, WORK, Stage, Window, is_alive, screenshot, set_parameters

COMMAND = open(os.path.join(WORK, "command"), encoding="utf-8").read()
FAKE = '/usr/bin/python3 -E "{}"'.format(os.path.join(WORK, "fake_helper.py"))
OUTLINES = json.load(open(os.path.join(LIBRARY, "parts", "outlines.json"), encoding="utf-8"))
SCORE = 99

window = Window()


def script(stage):
    """Everything, in order; each step leaves a search that works behind."""
    set_parameters(Command=COMMAND, Library=LIBRARY)
    model = Model()
    yield from first_answer(stage, model)
    yield from selections(stage, model)
    yield from places(stage, model)
    yield from refusals_of_selections(stage, model)
    yield from refusals_of_programs(stage, model)
    yield from refusals_of_libraries(stage, model)
    yield from long_query(stage, model)
    yield from many_rows(stage, model)
    yield from picture(stage, model)
    yield from imports(stage, model)
    yield from formats(stage, model)
    yield from end(stage, model)


# What there is to select


class Model:
    """A document with the same outlines as some parts of the library."""

    def __init__(self):
        self.document = App.newDocument("model")
        plate = Part.Shape()
        plate.read(os.path.join(LIBRARY, "parts", "part-07.step"))
        self.plate = self.add("Plate", plate)
        self.angle = self.add("Angle", face_of(*OUTLINES["part-00.dxf"]).extrude(App.Vector(0, 0, 5)))
        self.sketch = self.add_sketch("Sketch", *OUTLINES["part-02.dxf"])
        self.wires = self.add("Wires", Part.Compound(face_of(*OUTLINES["part-05.step"]).Wires))
        self.document.recompute()
        Gui.SendMsgToActiveView("ViewFit")
        Gui.activeDocument().activeView().viewTop()

    def add(self, name, shape):
        """An object with a shape."""
        added = self.document.addObject("Part::Feature", name)
        added.Shape = shape
        return added

    def add_sketch(self, name, corners, holes=(), gap=0.0, owner=None):
        """A sketch of a polygon with round holes; a gap leaves its last corner open."""
        sketch = (owner.newObject if owner else self.document.addObject)("Sketcher::SketchObject", name)
        points = [App.Vector(x, y, 0) for x, y in corners]
        ends = [*points[1:], points[0] + App.Vector(gap, 0, 0)]
        for start, finish in zip(points, ends, strict=True):
            sketch.addGeometry(Part.LineSegment(start, finish), False)
        for x, y, radius in holes:
            sketch.addGeometry(Part.Circle(App.Vector(x, y, 0), App.Vector(0, 0, 1), radius), False)
        return sketch

    def select(self, *wanted):
        """Select objects, or (object, name of a part of it)."""
        Gui.Selection.clearSelection()
        for each in wanted:
            owner, name = each if isinstance(each, tuple) else (each, "")
            Gui.Selection.addSelection(owner.Document.Name, owner.Name, name)


def wire_of(corners):
    """A closed polygon."""
    points = [App.Vector(x, y, 0) for x, y in corners]
    return Part.makePolygon([*points, points[0]])


def face_of(corners, holes=()):
    """A polygon with round holes."""
    face = Part.Face(wire_of(corners))
    for x, y, radius in holes:
        face = face.cut(Part.Face(Part.Wire(Part.makeCircle(radius, App.Vector(x, y, 0))))).Faces[0]
    return face


def face_named(shape, direction, prefix=""):
    """The name of the largest face that looks in a direction."""
    looking = [
        (face.Area, f"{prefix}Face{number}")
        for number, face in enumerate(shape.Faces, start=1)
        if face.normalAt(0, 0).dot(App.Vector(*direction)) > 0.99
    ]
    return max(looking)[1]


def is_first(name):
    """Whether the search has found a part first, and is sure of it."""
    if window.code != "ok" or not window.rows:
        return False
    best = window.rows[0]
    return os.path.basename(best["path"]) == name and best["score"] >= SCORE


def found():
    """What came of a search, in short."""
    first = window.rows[0] if window.rows else {}
    shown = {key: first.get(key) for key in ("score", "relation", "mirrored") if key in first}
    return f"{window.code} {window.names()[:2]} {shown}"


# The checks


def first_answer(stage, model):
    """From nothing to an answer."""
    model.select((model.plate, face_named(model.plate.Shape, (0, 0, 1))))
    began = time.monotonic()
    window.run_macro()
    yield stage.wait_for(lambda: bool(window.code))
    seconds = time.monotonic() - began
    in_time = window.code == "ok" and seconds <= 6
    stage.check("first answer at most 6 s after a cold start", in_time, f"{seconds:.1f} s", timed=True)
    stage.check("a face finds its part first", is_first("part-07.step"), found())
    stage.check("every row has a picture", window.rows and not window.blank_pictures(), window.blank_pictures())
    scores = [row["score"] for row in window.rows]
    stage.check("scores fall", scores == sorted(scores, reverse=True) and len(set(scores)) > 1, scores[:4])
    stage.check("the query has a picture", not window.part("query").pixmap().isNull())
    times = []
    for _ in range(3):
        began = time.monotonic()
        yield stage.wait_for(window.search())
        times.append(time.monotonic() - began)
    in_time = window.code == "ok" and sorted(times)[1] < 0.5
    stage.check("further answers under 0.5 s, in the median", in_time, [round(each, 2) for each in times], timed=True)
    screenshot("results")


def selections(stage, model):
    """All that may be selected."""
    edges = [(model.wires, f"Edge{number + 1}") for number in range(len(model.wires.Shape.Edges))]
    window.part("mode").setCurrentIndex(2)
    yield stage.wait_for(window.search())
    contained = is_first("part-07.step") and "contains 100" in window.part("results").item(0).text()
    stage.check("parts that contain it: first the part itself", contained, found())
    window.part("mode").setCurrentIndex(0)
    cases = [
        ("a whole body", "part-07.step", [model.plate]),
        ("a sketch", "part-02.dxf", [model.sketch]),
        ("one edge of a sketch means the sketch", "part-02.dxf", [(model.sketch, "Edge1")]),
        ("edges that close", "part-05.step", edges),
        ("wires as a whole", "part-05.step", [model.wires]),
    ]
    for name, part, selected in cases:
        model.select(*selected)
        yield stage.wait_for(window.search())
        stage.check(name + ": finds its part first", is_first(part), found())


def places(stage, model):
    """The face as the user sees it, wherever it is."""
    document = model.document
    up, down = (0, 0, 1), (0, 0, -1)
    body = document.addObject("PartDesign::Body", "Body")
    sketch = model.add_sketch("Profile", *OUTLINES["part-00.dxf"], owner=body)
    pad = body.newObject("PartDesign::Pad", "Pad")
    pad.Profile, pad.Length = sketch, 5
    assembly = document.addObject("App::Part", "Assembly")
    assembly.addObject(body)
    assembly.Placement = App.Placement(App.Vector(300, 20, 7), App.Rotation(App.Vector(1, 2, 3), 70))
    body.Placement = App.Placement(App.Vector(5, 0, 0), App.Rotation(App.Vector(0, 1, 0), 20))
    link = document.addObject("App::Link", "Link")
    link.LinkedObject = model.angle
    link.Placement = App.Placement(App.Vector(-300, 0, 0), App.Rotation(App.Vector(0, 0, 1), 33))
    document.recompute()
    inside = "Body.Pad." + face_named(pad.Shape, up)
    cases = [
        ("a face seen from above is not mirrored", (model.angle, face_named(model.angle.Shape, up)), False),
        ("a face seen from below is mirrored", (model.angle, face_named(model.angle.Shape, down)), True),
        ("a face of a body in a part", (assembly, inside), False),
        ("a face of a body in a part, from below", (assembly, "Body.Pad." + face_named(pad.Shape, down)), True),
        ("a face of a link", (link, face_named(model.angle.Shape, up)), False),
    ]
    model.select((assembly, "Body.Profile.Edge2"))
    yield stage.wait_for(window.search())
    stage.check("one edge of a sketch of a body in a part means the sketch", is_first("part-00.dxf"), found())
    twin = document.addObject("App::Link", "Twin")
    twin.LinkedObject = model.angle
    document.recompute()
    model.select(*((each, face_named(model.angle.Shape, up)) for each in (link, twin)))
    window.part("search").click()
    refused(stage, "faces of two links to one object", "many")
    window.close_boxes()
    document.removeObject(twin.Name)
    window.part("mode").setCurrentIndex(1)
    window.part("count").setValue(2)
    for name, selected, mirrored in cases:
        model.select(selected)
        yield stage.wait_for(window.search())
        first = next((row for row in window.rows if row["path"].endswith("part-00.dxf")), {})
        told = (first.get("relation"), first.get("mirrored"))
        stage.check(name, told == ("mirrored" if mirrored else "identical", mirrored), (told, found()))
    window.part("mirrored").setChecked(False)
    yield stage.wait_for(window.search())
    stage.check("a link again, without mirror images", is_first("part-00.dxf"), found())
    model.select((model.angle, face_named(model.angle.Shape, down)))
    yield stage.wait_for(window.search())
    stage.check("mirror images are left out if not wanted", "part-00.dxf" not in window.names(), found())
    window.part("mirrored").setChecked(True)
    window.part("mode").setCurrentIndex(0)
    window.part("count").setValue(20)


def refused(stage, name, code):
    """One box, the code, an empty list, and a text that says what to do."""
    boxes = window.boxes()
    said = [(box.text(), box.informativeText()) for box in boxes]
    right = len(boxes) == 1 and window.code == code and not window.rows and all(all(each) for each in said)
    stage.check(f"refused: {name}", right, (window.code, said, len(window.rows)))


def works_again(stage, model, name):
    """The next search does."""
    window.close_boxes()
    model.select(model.plate)
    yield stage.wait_for(window.search())
    stage.check(f"a search after that works: {name}", is_first("part-07.step"), found())


def refusals_of_selections(stage, model):
    """What no profile can be made of; no process is asked."""
    square = [(0, 0), (20, 0), (20, 20), (0, 20)]
    far = [(x + 50, y) for x, y in square]
    twisted = Part.makePolygon([App.Vector(*each) for each in ((0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 5), (0, 0, 0))])
    eight = [(0, 0), (20, 20), (20, 0), (0, 20)]
    tube = model.add("Tube", Part.makeCylinder(5, 20))
    cases = [
        ("nothing", "nothing", []),
        ("a vertex", "nothing", [(model.plate, "Vertex1")]),
        ("an open sketch", "open", [model.add_sketch("Open", square, gap=1.0)]),
        ("one edge of a body", "open", [(model.plate, "Edge1")]),
        ("disjoint outlines", "disjoint", [model.add("Two", Part.Compound([wire_of(square), wire_of(far)]))]),
        ("an outline that crosses itself", ("crossing", "disjoint"), [model.add("Eight", wire_of(eight))]),
        ("edges not in a plane", "nonplanar", [model.add("Twisted", twisted)]),
        ("a curved face", "nonplanar", [(tube, "Face1")]),
        ("a ball", "nonplanar", [model.add("Ball", Part.makeSphere(5))]),
        ("two faces", "many", [(model.plate, "Face1"), (model.plate, "Face2")]),
        ("two objects", "many", [model.plate, model.angle]),
    ]
    model.document.recompute()
    for name, code, selected in cases:
        model.select(*selected)
        window.part("search").click()
        codes = (code,) if isinstance(code, str) else code
        refused(stage, name, window.code if window.code in codes else codes[0])
        window.close_boxes()
        yield stage.wait_for(lambda: not window.boxes())
    yield from works_again(stage, model, "selections")
    for name in ("Tube", "Open", "Two", "Eight", "Twisted", "Ball"):
        model.document.removeObject(name)


def with_command(stage, command):
    """Set another command, as the settings do."""
    set_parameters(Command=command)
    window.dock._helper.stop()


def refusals_of_programs(stage, model):
    """Programs that are missing, are others, or die."""
    cases = [
        ("another program", "cli", "/bin/false", False),
        ("a program that speaks another protocol", "cli", FAKE + " newer", False),
        ("the command is missing", "cli", "/gone/mashape-cad", True),
        ("the process dies", "died", FAKE + " dies", True),
    ]
    for name, code, command, once_more in cases:
        with_command(stage, command)
        model.select(model.plate)
        yield stage.wait_for(window.search())
        refused(stage, name, code)
        if code == "died":
            screenshot("error")
        with_command(stage, COMMAND)
        if once_more:
            yield from works_again(stage, model, name)
        window.close_boxes()
    killed = window.dock._helper._process
    killed.kill()
    yield stage.wait_for(lambda: not window.dock._helper.is_running())
    yield from works_again(stage, model, "the process was killed while idle")


def refusals_of_libraries(stage, model):
    """Libraries that are not set, not there, not scanned, or scanned by an older release."""
    new, old = (os.path.join(WORK, name) for name in ("not scanned", "scanned long ago"))
    for folder in (new, old):
        os.makedirs(folder)
        for name in ("part-07.step", "part-02.dxf"):
            shutil.copy2(os.path.join(LIBRARY, "parts", name), folder)
    for name in ("part-07.step", "part-02.dxf"):
        sidecar = json.load(open(os.path.join(LIBRARY, "parts", name + ".mashape.json"), encoding="utf-8"))
        sidecar["signature"]["version"] -= 1
        json.dump(sidecar, open(os.path.join(old, name + ".mashape.json"), "w", encoding="utf-8"))
    cases = [
        ("no library is set", "nolib", ""),
        ("the library is gone", "nolib", os.path.join(WORK, "gone")),
        ("the index is missing", "no-index", new),
        ("the index is older", "no-index", old),
    ]
    for name, code, folder in cases:
        set_parameters(Library=folder)
        model.select(model.plate)
        yield stage.wait_for(window.search())
        refused(stage, name, code)
        if folder == new:
            mends = "mashape-cad scan" in window.boxes()[0].informativeText()
            stage.check("a missing index: the box has the command", mends, window.boxes()[0].informativeText())
            screenshot("no-index")
        if not folder:
            yield from first_use(stage)
        set_parameters(Library=LIBRARY)
        yield from works_again(stage, model, name)
    set_parameters(Library=new)
    yield stage.wait_for(window.search())
    stage.pulse.reset()
    window.boxes()[0].findChild(type(window.part("search")), "mend").click()
    yield stage.wait_for(lambda: window.code == "ok")
    stage.check("a missing index: the button scans, then the search works", is_first("part-07.step"), found())
    stage.check(
        "a scan leaves the window alive",
        stage.pulse.longest < 1,
        f"longest gap {stage.pulse.longest:.2f} s",
        timed=True,
    )
    set_parameters(Library=LIBRARY)


def first_use(stage):
    """The box that misses the library has a button that asks for it; the settings keep it."""
    widgets = window.macro["QtWidgets"]
    window.boxes()[0].findChild(widgets.QPushButton, "mend").click()
    picker = window.dock.findChild(widgets.QFileDialog, "path")
    picker.fileSelected.emit(LIBRARY)
    picker.close()
    yield stage.wait_for(lambda: bool(window.code))
    stage.check("first use: a folder picker, then the search works", is_first("part-07.step"), found())
    window.part("configure").click()
    settings = window.dock.findChild(widgets.QDialog, "settings")
    fields = [settings.findChild(widgets.QLineEdit, name) for name in ("command", "library")]
    shown = [field.text() for field in fields]
    settings.accept()
    stage.check("the settings show program and library", shown == [COMMAND, LIBRARY], shown)
    yield stage.wait_for(lambda: not window.dock._helper.is_running())


def long_query(stage, model):
    """One that lays every part of the library over the query."""
    window.part("mode").setCurrentIndex(1)
    window.part("count").setValue(1000)
    model.select(model.plate)
    window.search()
    stage.pulse.reset()
    values = set()
    progress = window.part("progress")

    def has_moved():
        if progress.maximum() > 0:
            values.add(progress.value())
        return len(values) >= 4

    yield stage.wait_for(has_moved)
    gap = stage.pulse.longest
    stage.check("a long query: progress moves", len(values) >= 4, sorted(values))
    stage.check("a long query: no gap of 1 s", gap < 1, f"longest gap {gap:.2f} s", timed=True)
    began, helper = time.monotonic(), window.dock._helper._process
    window.part("cancel").click()
    rows = len(window.rows)
    yield stage.wait_for(lambda: window.code == "cancelled" and not window.dock._unfinished)
    seconds = time.monotonic() - began
    stage.check("cancel ends it within 1 s", seconds < 1, f"{seconds:.2f} s, {rows} rows", timed=True)
    stage.check("cancel needs no new process", window.dock._helper._process is helper)
    end = time.monotonic() + 0.5
    yield lambda: time.monotonic() > end
    stage.check("a late answer is ignored", len(window.rows) == rows and window.code == "cancelled", len(window.rows))
    window.part("mode").setCurrentIndex(0)
    window.part("count").setValue(20)
    yield from works_again(stage, model, "cancelled")
    with_command(stage, FAKE + " deaf")
    window.search()
    end = time.monotonic() + 0.5
    yield lambda: time.monotonic() > end
    window.part("cancel").click()
    stage.check("cancel does not wait for a program that is deaf", window.code == "cancelled", window.code)
    yield stage.wait_for(lambda: not window.dock._helper.is_running(), 5)
    stage.check("a program that is deaf is ended", not window.dock._helper.is_running())
    with_command(stage, COMMAND)
    yield from works_again(stage, model, "deaf")


def many_rows(stage, model):
    """Two hundred of them."""
    with_command(stage, FAKE + " many")
    stage.pulse.reset()
    yield stage.wait_for(window.search())
    gap = stage.pulse.longest
    alive = len(window.rows) == 200 and gap < 0.5
    stage.check("200 rows do not freeze the window", alive, f"longest gap {gap:.2f} s", timed=True)
    with_command(stage, COMMAND)
    yield from works_again(stage, model, "200 rows")


def picture(stage, model):
    """What README shows: a gear, and the gears of the library."""
    document = App.newDocument("gear")
    part = document.addObject("Part::Feature", "Gear")
    shape = Part.Shape()
    shape.read(os.path.join(LIBRARY, "gear-2.step"))
    part.Shape = shape
    document.recompute()
    Gui.activeDocument().activeView().viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, part.Name, face_named(shape, (0, 0, 1)))
    yield stage.wait_for(window.search())
    first = {os.path.basename(row["path"]) for row in window.rows[:2] if row["score"] >= SCORE}
    stage.check("a face of a gear finds both drawings of it", first == {"gear-2.step", "gear-2.dxf"}, found())
    Gui.Selection.clearSelection()
    moment = time.monotonic() + 0.5
    yield lambda: time.monotonic() > moment
    screenshot("gears")
    App.closeDocument(document.Name)
    App.setActiveDocument(model.document.Name)
    yield from works_again(stage, model, "another document")


def imports(stage, model):
    """Double click, undo, no document, no file."""
    document = model.document
    before, undos = len(document.Objects), document.UndoCount
    window.double_click(0)
    added = document.Objects[before:]
    right = len(added) == 1 and added[0].Label == "part-07" and document.UndoCount == undos + 1
    right = right and abs(added[0].Shape.Volume - model.plate.Shape.Volume) < 1e-6
    stage.check("double click imports", right, ([each.Label for each in added], document.UndoNames[:2]))
    document.undo()
    stage.check("undo removes it in one step", len(document.Objects) == before, len(document.Objects))
    for name in list(App.listDocuments()):
        App.closeDocument(name)
    window.double_click(0)
    made = App.ActiveDocument
    stage.check("no open document: one is created", made is not None and len(made.Objects) == 1)
    window.part("open").click()
    stage.check("a part is opened in a document of its own", len(App.listDocuments()) == 2, list(App.listDocuments()))
    row = put_row(os.path.join(WORK, "gone.step"))
    window.double_click(row)
    boxes = window.boxes()
    told = len(boxes) == 1 and "gone.step" in boxes[0].text() and window.code == "import"
    stage.check("the file is gone: a message", told, [box.text() for box in boxes])
    window.close_boxes()
    yield stage.wait_for(lambda: not window.boxes())


def put_row(path):
    """Add a row, as an answer does."""
    window.dock._hear_match({"path": path, "score": 100.0, "size_mm": [1, 1]})
    return window.part("results").count() - 1


def formats(stage, model):
    """Each kind of file, as one undo step, without a dialog, into the active document."""
    folder = os.path.join(WORK, "Teile für alle")
    os.makedirs(folder)
    solid = Part.makeBox(3, 4, 5)
    solid.exportBrep(os.path.join(folder, "box.brep"))
    solid.exportStep(os.path.join(folder, "box.step"))
    shutil.copy2(os.path.join(LIBRARY, "parts", "part-03.step"), os.path.join(folder, "plate.step"))
    shutil.copy2(os.path.join(LIBRARY, "parts", "part-00.dxf"), os.path.join(folder, "angle.dxf"))
    source = App.newDocument("source")
    source.addObject("Part::Box", "Box")
    source.recompute()
    source.saveAs(os.path.join(folder, "box.FCStd"))
    App.closeDocument(source.Name)
    document = App.newDocument("target")
    App.setActiveDocument(document.Name)
    lengths = {"box.brep": 48, "box.step": 48, "angle.dxf": 200 + 8 * 3.14159265, "box.FCStd": 120, "plate.step": None}
    for name, length in lengths.items():
        before, undos, documents = len(document.Objects), document.UndoCount, set(App.listDocuments())
        window.double_click(put_row(os.path.join(folder, name)))
        added = document.Objects[before:]
        facts = (len(added), document.UndoCount - undos, App.ActiveDocument.Name, set(App.listDocuments()) - documents)
        right = facts == (1, 1, document.Name, set()) and added[0].Label == name.partition(".")[0]
        total = sum({edge.hashCode(): edge.Length for edge in added[0].Shape.Edges}.values()) if added else 0
        right = right and (length is None or abs(total - length) < 1e-3)
        dialogs = window.macro["QtWidgets"].QApplication.activeModalWidget()
        stage.check(f"imports {name}", right and dialogs is None and not window.boxes(), (facts, total, dialogs))
        document.undo()
        stage.check(f"undo after {name}", len(document.Objects) == before, len(document.Objects))
        window.close_boxes()
    broken = os.path.join(folder, "broken.FCStd")
    with open(broken, "w", encoding="utf-8") as file:
        file.write("nothing")
    window.double_click(put_row(broken))
    right = len(window.boxes()) == 1 and App.ActiveDocument is not None and App.ActiveDocument.Name == document.Name
    stage.check("a broken file: a message, and the document stays active", right, window.code)
    window.close_boxes()
    yield stage.wait_for(lambda: not window.boxes())


def end(stage, model):
    """Twice the macro, one dock; closed, no process; nothing is left behind."""
    window.run_macro()
    stage.check("running the macro twice gives one dock", len(window.docks) == 1, len(window.docks))
    process = window.dock._helper._process.processId()
    stage.check("the helper runs with the dock", is_alive(process))
    window.dock.close()
    yield stage.wait_for(lambda: not is_alive(process), 5)
    stage.check("closing the dock ends the helper", not is_alive(process))
    window.run_macro()
    stage.check("the macro opens the dock again", len(window.docks) == 1 and window.dock.isVisible())
    left = glob.glob(os.path.join(os.environ["TMPDIR"], "mashape*"))
    stage.check("no temporary file is left", not left, left)
    stage.check("OCP is not in sys.modules", "OCP" not in sys.modules and "mashape_cad" not in sys.modules)
    metadata = App.Metadata(os.path.join(WORK, "package.xml"))
    macro = metadata.Content["macro"][0]
    files = [os.path.exists(os.path.join(WORK, "freecad_macro", name)) for name in (macro.File[0], macro.Icon)]
    stage.check("package.xml names the macro and its icon", files == [True, True], (macro.File, macro.Icon))
    App.saveParameter("User parameter")


Stage("main").play(script)
