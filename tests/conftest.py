"""What all tests share: where real files lie, and a switch for the pictures' backend."""

import os
import time
from pathlib import Path

import numpy as np
import pytest

# Pictures are drawn without a screen; set before anything imports matplotlib, and for the programs that tests start.
os.environ["MPLBACKEND"] = "Agg"

# What is drawn at random anew in every run; set it to repeat one. Workers of one run inherit it.
_SEED = os.environ.setdefault("MASHAPE_SEED", str(time.time_ns() % 2**32))

# A slow test with at least so many parameters tries a share of them in each run: all together they take an hour.
_MANY, _SHARE = 6, 1 / 3

_REPOSITORY = Path(__file__).parent.parent


def pytest_report_header():
    """Tell how to repeat what is drawn at random."""
    return f"MASHAPE_SEED={_SEED} (MASHAPE_ALL=1 tries all that is drawn from)"


@pytest.hookimpl(trylast=True)  # when pytest's own options have chosen
def pytest_collection_modifyitems(config, items):
    """Leave out some parameters of slow tests with many, drawn anew in every run, unless all are asked for."""
    if os.environ.get("MASHAPE_ALL"):
        return
    families = {}
    for item in items:
        if item.get_closest_marker("slow"):
            families.setdefault((item.path, item.originalname), []).append(item)
    draw = np.random.default_rng(int(_SEED))
    left_out = [
        family[k]
        for family in families.values()
        if len(family) >= _MANY
        for k in draw.permutation(len(family))[int(np.ceil(_SHARE * len(family))) :]
    ]
    config.hook.pytest_deselected(items=left_out)
    items[:] = [item for item in items if item not in left_out]


def _folder_of(variable: str) -> Path:
    folder = os.environ.get(variable)
    if not folder:
        pytest.skip(f"{variable} does not name a folder of files to measure with")
    return Path(folder)


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the checkout."""
    return _REPOSITORY


@pytest.fixture(scope="session")
def samples() -> Path:
    """The parts that the repository ships; copy them before you scan."""
    return _REPOSITORY / "samples"


@pytest.fixture(scope="session")
def freeform80(samples) -> Path:
    """The eighty drawings among them: a reconstruction of the paper's database."""
    return samples / "freeform80"


@pytest.fixture(scope="session")
def corpus() -> Path:
    """Real and hostile part files of other projects; without MASHAPE_CORPUS the test is skipped."""
    return _folder_of("MASHAPE_CORPUS")


@pytest.fixture(scope="session")
def retrieval() -> Path:
    """Labelled shape sets; without MASHAPE_RETRIEVAL the test is skipped."""
    return _folder_of("MASHAPE_RETRIEVAL")


@pytest.fixture
def drawn():
    """Draw so many of a list at random, by the seed that is printed above all tests; all of them if so asked."""

    def draw(every: list, count: int) -> list:
        if os.environ.get("MASHAPE_ALL"):
            return every
        order = np.random.default_rng(int(_SEED)).permutation(len(every))
        return [every[k] for k in order[:count]]

    return draw
