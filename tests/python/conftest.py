"""Nothing here opens a browser or waits for a key."""

import os

os.environ["KINEGRAPH_HEADLESS"] = "1"

import json
import signal
import time
from pathlib import Path

import pytest

import kinegraph as ry

# A shell starts background programs without Ctrl-C: Python then raises no KeyboardInterrupt, and the tests of that wait
# in vain.
signal.signal(signal.SIGINT, signal.default_int_handler)

DATA = Path(__file__).parent.parent / "data"


def recorded(name: str) -> dict:
    """Numbers recorded from another implementation; the file says which."""
    return json.loads((DATA / f"{name}.json").read_text())


@pytest.fixture(autouse=True)
def first_seed():
    """Seeds the generators, so no test depends on those before it."""
    yield
    ry.rnd_seed(0)


@pytest.fixture
def first_ctrl_c() -> None:
    """The next Ctrl-C is no second one within a second, which would leave a loop of solves."""
    time.sleep(1.05)


@pytest.fixture
def panda() -> ry.Config:
    """A Panda at a table."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


@pytest.fixture
def column(panda: ry.Config) -> ry.Config:
    """A Panda at a table with a column in front of it."""
    panda.addFrame("column", "table").setShape(ry.ST.ssBox, [0.1, 0.1, 0.8, 0.02]).setRelativePosition(
        [0.0, 0.35, 0.4]
    ).setContact(1)
    return panda
