"""Where and with what a benchmark ran, in general words."""

import os
import platform
import shutil
import subprocess
from importlib.metadata import PackageNotFoundError, version

__all__ = ["described"]

_PACKAGES = ("mashape-cad", "numpy", "numba", "scipy", "pyvoronoi", "cadquery-ocp")


def described() -> str:
    """Return machine and versions in one line."""
    node = subprocess.run(["node", "--version"], capture_output=True, text=True, check=True) if _has_node() else None
    versions = [f"{name} {_version(name)}" for name in _PACKAGES]
    versions += [f"node {node.stdout.strip().removeprefix('v')} with flo-mat 3.0.3"] if node else []
    machine = f"{os.cpu_count()} cores, {platform.system()} on {platform.machine()}, Python {platform.python_version()}"
    return f"{machine}, {', '.join(versions)}"


def _has_node() -> bool:
    return shutil.which("node") is not None


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"
