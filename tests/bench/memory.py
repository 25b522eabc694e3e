"""Peak memory of one axis above what importing takes, in a process of its own: `python memory.py SHAPE` prints MB.

The system counts the peak of a process from its start, and on Linux even from that of the process that started it.
There we take what the kernel keeps of this program alone, and set its peak back after the import.
"""

import re
import resource
import subprocess
import sys
from pathlib import Path

__all__ = ["peak_mb"]

_STATUS, _RESET = Path("/proc/self/status"), Path("/proc/self/clear_refs")
_RESET_PEAK = "5"


def peak_mb(name: str) -> float:
    """Measure in a fresh process."""
    done = subprocess.run([sys.executable, Path(__file__), name], capture_output=True, text=True, check=True)
    return float(done.stdout)


def _above_import(name: str) -> float:
    from shapes import SHAPES

    from mashape_cad.medial.axis import medial_axis

    profile = SHAPES[name]()
    before = _resident_mb()
    medial_axis(profile)
    return _most_mb() - before


def _resident_mb() -> float:
    """Memory in use now; where the system does not tell, the most so far."""
    if not _STATUS.exists():
        return _most_mb()
    _RESET.write_text(_RESET_PEAK, encoding="ascii")
    return _status_mb("VmRSS")


def _most_mb() -> float:
    if _STATUS.exists():
        return _status_mb("VmHWM")
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)


def _status_mb(field: str) -> float:
    found = re.search(rf"{field}:\s*(\d+) kB", _STATUS.read_text(encoding="ascii"))
    return int(found[1]) / 1024


if __name__ == "__main__":
    print(_above_import(sys.argv[1]))
