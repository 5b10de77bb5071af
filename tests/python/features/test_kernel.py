"""Viewers in the kernel of a notebook: the output of cells, and interrupts of waiting calls."""

from __future__ import annotations

import os
import queue
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest

manager = pytest.importorskip("jupyter_client.manager")

PATIENCE = 120  # s


@dataclass
class Cell:
    """The result of a cell."""

    html: list[str] = field(default_factory=list)
    values: list[str] = field(default_factory=list)
    printed: str = ""
    error: str = ""


class Kernel:
    def __init__(self) -> None:
        hidden = ("KINEGRAPH_HEADLESS", "DISPLAY", "WAYLAND_DISPLAY")
        environment = {name: value for name, value in os.environ.items() if name not in hidden}
        self.manager, self._client = manager.start_new_kernel(startup_timeout=PATIENCE, env=environment)

    def end(self) -> None:
        self._client.stop_channels()
        self.manager.shutdown_kernel(now=True)

    def run(self, code: str, interrupt: bool = False) -> Cell:
        """Runs a cell; with `interrupt`, interrupts the kernel once the cell has printed 'waiting'."""
        asked, cell = self._client.execute(code), Cell()
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            try:
                message = self._client.get_iopub_msg(timeout=1)
            except queue.Empty:
                continue
            if message["parent_header"].get("msg_id") != asked:
                continue
            self._take(cell, message["msg_type"], message["content"])
            if message["content"].get("execution_state") == "idle":
                return cell
            if interrupt and "waiting" in cell.printed:
                time.sleep(0.3)
                self.manager.interrupt_kernel()
                interrupt = False
        raise AssertionError(f"the cell does not end: {code}")

    @staticmethod
    def _take(cell: Cell, kind: str, content: dict[str, Any]) -> None:
        if kind == "stream":
            cell.printed += content["text"]
        elif kind == "error":
            cell.error = content["ename"]
        elif kind in ("display_data", "execute_result"):
            cell.html += [content["data"]["text/html"]] if "text/html" in content["data"] else []
            cell.values += [content["data"]["text/plain"]] if kind == "execute_result" else []


@pytest.fixture(scope="module")
def kernel() -> Iterator[Kernel]:
    kernel = Kernel()
    setup = kernel.run("""
import kinegraph as ry
C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
komo = ry.KOMO(C, 1, 4, 1, False)
komo.addObjective([1], ry.FS.position, ["l_gripper"], ry.OT.eq, [1], [0.3, 0.3, 1])
images = ry.ImageViewer()
print(ry.NLP_Solver(komo.nlp(), verbose=0).solve().feasible)
""")
    assert setup.printed == "True\n", setup
    yield kernel
    kernel.end()


@pytest.mark.parametrize(
    ("show", "url"),
    [
        ("C.view()", "C.viewer().url"),
        ("komo.view()", "komo.get_viewer().url"),
        ("images.view(C.viewer().getRgb())", "images.url"),
    ],
)
def test_a_page_appears_below_the_first_cell_that_shows_something(kernel: Kernel, show: str, url: str) -> None:
    cell = kernel.run(show)
    assert len(cell.html) == 1, cell
    frame = cell.html[0]
    assert "<iframe" in frame and f'src="{kernel.run(url).values[0][1:-1]}"' in frame
    assert cell.values == ["0"] and cell.error == ""
    again = kernel.run(show)
    assert (again.html, again.values) == ([], ["0"])


def test_what_stands_at_the_end_of_a_cell_shows_itself(kernel: Kernel) -> None:
    for name, element in [("C", "<img"), ("komo", "<iframe"), ("C.viewer()", "<iframe"), ("C.frames()[0]", "<table")]:
        (html,) = kernel.run(name).html
        assert element in html, name


@pytest.mark.parametrize(
    "wait",
    [
        "C.view(True)",
        "C.watchFile(ry.raiPath('scenarios/pandaSingle.g'))",
        "C.view_path([C.getJointState()] * 3, seconds=60)",
        "komo.view_play(True, delay=10)",
        "ry.interactiveIk(C, 'l_gripper')",
    ],
)
def test_an_interrupt_ends_the_waiting_and_the_kernel_goes_on(kernel: Kernel, wait: str) -> None:
    cell = kernel.run(f"print('waiting', flush=True)\n{wait}", interrupt=True)
    assert cell.error == "KeyboardInterrupt", cell
    assert kernel.run("1 + 1").values == ["2"]


def test_waiting_ends_by_itself_where_nobody_looks(kernel: Kernel) -> None:
    started = time.monotonic()
    assert kernel.run("C.view(True)").values == ["0"]
    assert time.monotonic() - started < 60
