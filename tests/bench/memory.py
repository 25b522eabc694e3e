"""Peak memory of one axis above what importing takes, in a process of its own: `python memory.py SHAPE` prints MB."""

import resource
import subprocess
import sys
from pathlib import Path

__all__ = ["peak_mb"]

# Linux counts in kB, macOS in bytes.
_UNIT = 1024 if sys.platform == "darwin" else 1


def peak_mb(name: str) -> float:
    """Measure in a fresh process."""
    done = subprocess.run([sys.executable, Path(__file__), name], capture_output=True, text=True, check=True)
    return float(done.stdout)


def _resident_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / _UNIT / 1024


def _above_import(name: str) -> float:
    from shapes import SHAPES

    from mashape_cad.medial.axis import medial_axis

    profile = SHAPES[name]()
    before = _resident_mb()
    medial_axis(profile)
    return _resident_mb() - before


if __name__ == "__main__":
    print(_above_import(sys.argv[1]))
