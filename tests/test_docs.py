"""The documents say what is so: their commands run, their examples hold, their links lead somewhere."""

import doctest
import os
import re
import shutil
import subprocess
import sys
import tomllib
from itertools import chain
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parent.parent
README = (REPOSITORY / "README.md").read_text(encoding="utf-8")
PROJECT = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
DOCUMENTS = sorted([*REPOSITORY.glob("*.md"), *REPOSITORY.glob("docs/**/*.md")])
COMMANDS_IN_README = re.findall(r"^mashape-cad ([^#\n]*?) *(?:#.*)?$", README, re.MULTILINE)


def _run(arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    environment = os.environ | {"PYTHONPATH": str(REPOSITORY)}
    command = [sys.executable, "-m", "mashape_cad", *arguments.split()]
    return subprocess.run(
        command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
    )


@pytest.fixture(scope="module")
def scanned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a copy of the samples in it, scanned as README's first command does."""
    folder = tmp_path_factory.mktemp("readme")
    shutil.copytree(REPOSITORY / "samples", folder / "samples", ignore=shutil.ignore_patterns("*.mashape.json"))
    done = _run("scan samples", folder)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [each for each in COMMANDS_IN_README if each != "scan samples"])
def test_readme_command(scanned, arguments):
    """Each command of README's usage runs as written and leaves the file that it names."""
    done = _run(arguments, scanned)
    assert done.returncode == 0, done.stderr
    for name in re.findall(r"-o (\S+)", arguments):
        assert (scanned / name).stat().st_size > 1000


@pytest.mark.slow
def test_readme_examples(scanned, monkeypatch):
    """The Python session of README gives what README shows."""
    monkeypatch.chdir(scanned)
    session = "".join(re.findall(r"```python\n(.*?)```", README, re.DOTALL))
    examples = doctest.DocTestParser().get_doctest(session, {}, "README.md", "README.md", 0)
    results = doctest.DocTestRunner().run(examples)
    assert results.attempted > 0
    assert results.failed == 0


def test_examples_of_the_evaluation():
    """The Python session of docs/evaluation.md gives what it shows."""
    text = (REPOSITORY / "docs" / "evaluation.md").read_text(encoding="utf-8")
    session = "".join(re.findall(r"```python\n(.*?)```", text, re.DOTALL))
    results = doctest.DocTestRunner().run(doctest.DocTestParser().get_doctest(session, {}, "evaluation.md", None, 0))
    assert (results.attempted, results.failed) == (3, 0)


def test_readme_names_every_command():
    """A command of the program that README does not show is an undocumented one."""
    from mashape_cad.cli.main import commands

    shown = {each.split()[0] for each in COMMANDS_IN_README}
    assert shown >= set(commands.commands)


def test_readme_has_the_commands_that_are_checked():
    """What .ci/run tries is what README tells people to do."""
    checked = (REPOSITORY / ".ci" / "run").read_text(encoding="utf-8")
    for command in (
        "mashape-cad scan samples",
        "mashape-cad search samples/freeform80/airplane-4.dxf -k 7 -o search.png",
        "pytest -n 2",
    ):
        assert command in README
        assert command in checked


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_links(document):
    """Every link between the documents leads to a file of the repository."""
    links = re.findall(r"\]\((?!https?:)([^)#]+)", document.read_text(encoding="utf-8"))
    assert [each for each in links if not (document.parent / each).exists()] == []


def test_documents_cited_by_the_code():
    """A docstring that sends its reader to a document names one that is there."""
    texts = [path.read_text(encoding="utf-8") for path in REPOSITORY.glob("mashape_cad/**/*.py")]
    cited = {each for text in texts for each in re.findall(r"docs/[\w/.-]+\.\w+", text)}
    assert [each for each in sorted(cited) if not (REPOSITORY / each).exists()] == []


def test_every_dependency_has_its_licence_stated():
    """docs/licences.md knows each package that pyproject.toml asks for."""
    stated = (REPOSITORY / "docs" / "licences.md").read_text(encoding="utf-8")
    asked = [*PROJECT["dependencies"], *chain(*PROJECT["optional-dependencies"].values())]
    names = [re.match(r"[\w-]+", each).group() for each in asked]
    assert [each for each in names if not re.search(rf"\b{re.escape(each)}\b", stated)] == []


def test_changelog_knows_the_version():
    """The changelog has a heading for what is unreleased or for this very version."""
    from mashape_cad.version import __version__

    headings = re.findall(r"^## (.*)$", (REPOSITORY / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert headings[0] == "Unreleased" or headings[0].startswith(__version__)
