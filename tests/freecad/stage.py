"""What both sessions in FreeCAD share: a script that waits without blocking the window, checks, and the macro's parts.

Runs inside FreeCAD, and so with the Python of the oldest generation, 3.11, and no packages.
"""

import json
import os
import sys
import threading
import time
import traceback

import FreeCAD as App
import FreeCADGui as Gui
from PySide import QtCore, QtGui

try:
    from PySide import QtWidgets
except ImportError:  # FreeCAD 0.20
    from PySide2 import QtWidgets

WORK = os.environ["WORK"]
OUT = os.path.join(WORK, "out")
LIBRARY = os.path.join(WORK, "library")
MACRO = os.path.join(WORK, "FindSimilarProfiles.FCMacro")
PARAMETERS = "User parameter:BaseApp/Preferences/Macros/FindSimilarProfiles"
PATIENCE = 60.0  # seconds: far above what anything here takes
DEADLINE = 400.0  # seconds for a whole session


class Stage:
    """Runs a script, which is a generator: it yields what it waits for, a function that tells whether it has come."""

    def __init__(self, name):
        self._name = name
        self._checks = []
        self._began = time.monotonic()
        self._timer = QtCore.QTimer(interval=10)
        self._timer.timeout.connect(self._step)
        self.pulse = Pulse()
        threading.Thread(target=self._give_up_late, daemon=True).start()

    def play(self, script):
        """Begin, once FreeCAD has shown its window."""
        self._script, self._awaited = script(self), lambda: True
        QtCore.QTimer.singleShot(500, self._timer.start)

    def check(self, name, passed, detail="", timed=False):
        """Put one result on record; a timed one says something only if the machine has nothing else to do."""
        seconds = round(time.monotonic() - self._began, 1)
        about = {"name": name, "passed": bool(passed), "detail": str(detail), "timed": timed, "at": seconds}
        self._checks.append(about)

    def wait_for(self, condition, seconds=PATIENCE):
        """Return what a script yields to wait until a condition holds, or too long."""
        end = time.monotonic() + seconds
        return lambda: condition() or time.monotonic() > end

    def _step(self):
        try:
            if self._awaited():
                self._awaited = next(self._script)
        except StopIteration:
            self._leave(0)
        except Exception:  # noqa: BLE001  (whatever it is, it is the result)
            self.check("the session runs to its end", False, traceback.format_exc())
            self._leave(1)

    def _give_up_late(self):
        time.sleep(DEADLINE)
        self.check("the session runs to its end", False, f"no end after {DEADLINE} s")
        self._leave(3)

    def keep(self):
        """Write what is on record to a file."""
        with open(os.path.join(OUT, self._name + ".json"), "w", encoding="utf-8") as file:
            json.dump({"freecad": ".".join(App.Version()[:3]), "checks": self._checks}, file)

    def _leave(self, code):
        self.keep()
        os._exit(code)


class Pulse:
    """A timer of 50 ms that notices how long the window stood still."""

    def __init__(self):
        self._timer = QtCore.QTimer(interval=50)
        self._timer.timeout.connect(self._beat)
        self._timer.start()
        self.reset()

    def reset(self):
        """Begin anew."""
        self._last, self.longest = time.monotonic(), 0.0

    def _beat(self):
        now = time.monotonic()
        self.longest, self._last = max(self.longest, now - self._last), now


class Window:
    """The macro's dock, by the names of its parts."""

    def run_macro(self):
        """As a user does; what the macro defines is kept."""
        self.macro = {"__name__": "__main__", "__file__": MACRO}
        with open(MACRO, encoding="utf-8") as file:
            exec(compile(file.read(), MACRO, "exec"), self.macro)  # noqa: S102  (as FreeCAD runs it)

    @property
    def docks(self):
        """All docks of the macro."""
        return Gui.getMainWindow().findChildren(QtWidgets.QDockWidget, "MashapeFindSimilarProfiles")

    @property
    def dock(self):
        """The one that there should be."""
        return self.docks[0]

    def part(self, name):
        """A widget of the dock."""
        return self.dock.findChild(QtWidgets.QWidget, name)

    @property
    def code(self):
        """How the last search ended."""
        return self.dock.property("code")

    @property
    def rows(self):
        """What each row of the list knows of its part."""
        results = self.part("results")
        return [results.item(row).data(QtCore.Qt.UserRole) for row in range(results.count())]

    def names(self):
        """The files of the rows."""
        return [os.path.basename(row["path"]) for row in self.rows]

    def boxes(self):
        """Message boxes that can be seen."""
        return [box for box in self.dock.findChildren(QtWidgets.QMessageBox, "msgbox") if box.isVisible()]

    def close_boxes(self):
        """As a user who has read them."""
        for box in self.boxes():
            box.close()

    def search(self):
        """Press the button; the end of the search is what to wait for."""
        self.part("search").click()
        return lambda: bool(self.code)

    def blank_pictures(self):
        """Rows whose picture shows nothing."""
        results = self.part("results")
        return [row for row in range(results.count()) if not _shows_something(results.item(row).icon())]

    def double_click(self, row):
        """Click, then double click: FreeCAD 1.1 swallows the very first press of a mouse that has not moved before."""
        results = self.part("results")
        results.setCurrentRow(row)
        results.scrollToItem(results.item(row))  # lays out what was added just now
        centre = QtCore.QPointF(results.visualItemRect(results.item(row)).center())
        left, none = QtCore.Qt.LeftButton, QtCore.Qt.NoModifier
        press, release = QtCore.QEvent.MouseButtonPress, QtCore.QEvent.MouseButtonRelease
        for kind in (press, release, press, release, QtCore.QEvent.MouseButtonDblClick, release):
            event = QtGui.QMouseEvent(kind, centre, left, left, none)
            QtWidgets.QApplication.sendEvent(results.viewport(), event)


def _shows_something(icon):
    image = icon.pixmap(64, 64).toImage()
    dots = {image.pixel(x, y) for x in range(0, image.width(), 3) for y in range(0, image.height(), 3)}
    return len(dots) > 1


def set_parameters(**values):
    """Preset what the macro would ask for."""
    group = App.ParamGet(PARAMETERS)
    for name, value in values.items():
        group.SetString(name, value)


def screenshot(name):
    """Save what the whole screen shows."""
    QtWidgets.QApplication.processEvents()
    QtWidgets.QApplication.primaryScreen().grabWindow(0).save(os.path.join(OUT, name + ".png"))


def is_alive(process):
    """Tell whether there is such a process, one that has ended and was not waited for left out."""
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


sys.path.insert(0, WORK)
