"""The FreeCAD macro as far as it can be looked at without FreeCAD; `tests/freecad/run` drives it."""

import ast
import re
import tomllib
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from mashape_cad.serving.protocol import PROTOCOL
from mashape_cad.version import __version__

REPOSITORY = Path(__file__).parent.parent
MACRO = REPOSITORY / "freecad_macro" / "FindSimilarProfiles.FCMacro"
TEXT = MACRO.read_text(encoding="utf-8")
# The keys that the Addon Manager reads of a macro, in FreeCAD 0.20 and in 1.x.
KEYS = ("Comment", "Web", "Wiki", "Version", "Files", "Author", "Date", "Icon", "License")


def _metadata() -> dict[str, str]:
    return dict(re.findall(r'^__(\w+)__ = "([^"]*)"$', "\n".join(TEXT.splitlines()[:200]), re.MULTILINE))


def test_is_python_of_the_oldest_freecad():
    """FreeCAD 0.20 brings Python 3.8 on Windows."""
    ast.parse(TEXT, feature_version=(3, 8))


def test_imports_nothing_that_must_not_be_in_freecad():
    """The kernel's second copy would meet FreeCAD's own."""
    imported = {
        name.name.partition(".")[0] if isinstance(node, ast.Import) else (node.module or "")
        for node in ast.walk(ast.parse(TEXT))
        if isinstance(node, ast.Import | ast.ImportFrom)
        for name in node.names
    }
    assert not imported & {"OCP", "mashape_cad", "numpy"}


@pytest.mark.parametrize("key", ["Comment", "Version", "Author", "Date", "Icon", "License"])
def test_metadata_is_written_as_the_addon_manager_reads_it(key):
    """One line, one plain text in double quotes, no number sign, which FreeCAD 1 takes for a comment."""
    assert key in KEYS
    assert _metadata()[key]
    assert "#" not in _metadata()[key]


def test_speaks_the_protocol_of_this_release():
    """A new protocol needs a new macro."""
    assert f"\nPROTOCOL = {PROTOCOL}\n" in TEXT


def test_package_and_macro_agree():
    """Version, date, names of files, licence."""
    namespace = {"p": "https://wiki.freecad.org/Package_Metadata"}
    package = ET.parse(REPOSITORY / "package.xml").getroot()  # noqa: S314  (it is our own)
    found = {
        name: package.findtext(f"p:{name}", namespaces=namespace)
        for name in ("version", "date", "license", "freecadmin")
    }
    macro = package.find("p:content/p:macro", namespace)
    files = [macro.findtext(f"p:{name}", namespaces=namespace) for name in ("subdirectory", "file", "icon")]
    licence = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]["license"]
    own = _metadata()
    assert package.get("format") == "1"
    assert found == {"version": __version__, "date": own["Date"], "license": licence, "freecadmin": "0.20.0"}
    assert (own["Version"], own["License"]) == (__version__, licence)
    assert files == ["freecad_macro", MACRO.name, own["Icon"]]


def test_icon_is_there():
    """Beside the macro, and where package.xml says."""
    assert (MACRO.parent / _metadata()["Icon"]).read_bytes().startswith(b"\x89PNG")


def test_there_is_no_other_macro():
    """The Addon Manager would install that too."""
    folders = ("freecad_macro", "tests", "docs", "samples", "mashape_cad")
    found = [path for folder in folders for path in (REPOSITORY / folder).rglob("*.FCMacro")]
    assert found == [MACRO]
