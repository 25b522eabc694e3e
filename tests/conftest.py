"""What all tests share: where real files lie, and a switch for the pictures' backend."""

import os
from pathlib import Path

import pytest

# Pictures are drawn without a screen; set before anything imports matplotlib, and for the programs that tests start.
os.environ["MPLBACKEND"] = "Agg"

_REPOSITORY = Path(__file__).parent.parent


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
