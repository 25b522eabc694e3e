import subprocess
import sys
from pathlib import Path

import pytest

from mashape_cad.errors import KernelUnavailableError

_ASK = """
from mashape_cad.errors import KernelUnavailableError
try:
    import mashape_cad.kernel.{module}
except KernelUnavailableError as error:
    print(error)
"""


def _told(folder: Path, module: str, repository: Path) -> str:
    """What a fresh interpreter says whose OCP is the one in a folder."""
    code = f"import sys; sys.path[:0] = [{str(folder)!r}, {str(repository)!r}]\n" + _ASK.format(module=module)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout


@pytest.mark.parametrize("module", ["curves", "queries", "shapes", "faces"])
def test_missing_system_library_is_told_with_the_command_that_installs_it(tmp_path, repository, module):
    """Whichever module is asked for, an OCP that lacks libGL gives one line with Debian's command."""
    (tmp_path / "OCP").mkdir()
    broken = "raise ImportError('libGL.so.1: cannot open shared object file: No such file or directory')\n"
    (tmp_path / "OCP" / "__init__.py").write_text(broken)
    told = _told(tmp_path, module, repository)
    assert told.count("\n") == 1
    assert "apt-get install --no-install-recommends libgl1" in told


def test_missing_kernel_is_told_with_the_package_that_brings_it(monkeypatch):
    """Without OCP the message names cadquery."""
    from mashape_cad.kernel.door import open_door

    monkeypatch.setitem(sys.modules, "OCP", None)
    monkeypatch.delitem(sys.modules, "OCP.gp")
    with pytest.raises(KernelUnavailableError, match="pip install cadquery"):
        open_door()


def test_other_import_errors_keep_what_the_system_said(tmp_path, repository):
    """A library that nobody thought of is named as the loader names it."""
    (tmp_path / "OCP").mkdir()
    (tmp_path / "OCP" / "__init__.py").write_text("raise ImportError('libfoo.so.7: wrong\\nELF class')\n")
    assert "libfoo.so.7: wrong ELF class" in _told(tmp_path, "curves", repository)


def test_open_door_is_silent():
    """Where the kernel can be imported, opening the door does nothing else."""
    from mashape_cad.kernel.door import open_door

    assert open_door() is None
