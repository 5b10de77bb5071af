"""A folder is continued by the same function and items only; starting workers that are killed cost nothing."""

import os
import threading
import time
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.fleets.dispatch import Dispatcher
from kinegraph.fleets.engines import WorkerDied
from kinegraph.fleets.fingerprint import fingerprint
from kinegraph.fleets.worker import Answer, Batch

pytest.importorskip("cloudpickle")


def defined(text: str, **values: object) -> object:
    """Returns the function `f` of a program's text."""
    module = ModuleType("program")
    module.__dict__.update(values)
    exec(compile(text, "program.py", "exec"), module.__dict__)
    return module.f


def test_comments_and_docstrings_do_not_count_but_code_and_values_do() -> None:
    first = fingerprint(defined("def f(x):\n    return x + k", k=1))
    assert first == fingerprint(defined("# moved\n\ndef f(x):\n    'Adds.'\n    return x + k  # k", k=1))
    for text, k in (("x - k", 1), ("x + k", 2), ("x + k", np.ones(3)), ("x + 2 * k", 1)):
        assert first != fingerprint(defined(f"def f(x):\n    return {text}", k=k)), text
    helped = "def g(x):\n    return {}\ndef f(x):\n    return g(x)"
    assert fingerprint(defined(helped.format("x"))) != fingerprint(defined(helped.format("-x")))
    assert fingerprint(defined("def f(x, y=1):\n    return x")) != fingerprint(defined("def f(x, y=2):\n    return x"))


def test_scenes_and_recursion_count_once() -> None:
    C, D = ry.Config(), ry.Config()
    for scene in (C, D):
        scene.addFrame("a").setPosition([1, 2, 3])
    text = "def f(x):\n    return f(x - 1) if x else C.getFrameNames()"
    assert fingerprint(defined(text, C=C)) == fingerprint(defined(text, C=D))
    D.addFrame("b")
    assert fingerprint(defined(text, C=C)) != fingerprint(defined(text, C=D))


def test_results_of_another_function_of_the_same_name_are_refused(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    out = tmp_path / "out"
    ry.map(lambda i: i, range(5), out=out)
    ry.map(lambda i: i, range(5), out=out)
    with pytest.raises(ry.ArgumentError, match="another run: the code of .*<lambda>.* has changed"):
        ry.map(lambda i: -i, range(5), out=out)
    with pytest.raises(ry.ArgumentError, match="the first item is another one"):
        ry.map(lambda i: i, range(1, 6), out=out)
    assert list(ry.readResults(out)) == [0, 1, 2, 3, 4]


class StartingEngine:
    """Workers of which the first ones die before they are ready."""

    workers = 1

    def __init__(self, deaths: int):
        self._deaths = deaths
        self._sent: list[Batch] = []

    def send(self, worker: int, batch: Batch) -> None:
        self._sent.append(batch)

    def receive(self, seconds: float) -> list[tuple[int, Answer | WorkerDied]]:
        batches, self._sent = self._sent, []
        if self._deaths > 0:
            self._deaths -= 1
            return [(0, WorkerDied("killed", started=False))]
        return [(0, Answer(b.first, list(range(b.first, b.first + len(b.ends))), 0.001)) for b in batches]

    def stop(self) -> None:
        pass


def test_workers_that_die_while_they_start_cost_no_item() -> None:
    engine = StartingEngine(20)
    found = [x for block in Dispatcher(engine, iter(range(30)), 0, 30).results() for x in block]
    assert found == list(range(30))
    with pytest.raises(ry.Error, match="50 workers died without any result"):
        list(Dispatcher(StartingEngine(100), iter(range(30)), 0, 30).results())


@pytest.mark.skipif(not Path("/proc").exists(), reason="reads the children of this process")
def test_starting_processes_may_be_killed() -> None:
    killed: set[int] = set()
    done = threading.Event()

    def kill() -> None:
        while len(killed) < 3 and not done.is_set():
            for task in Path("/proc/self/task").iterdir():
                for pid in map(int, (task / "children").read_text().split()):
                    program = Path(f"/proc/{pid}/cmdline").read_bytes().decode()
                    if pid not in killed and len(killed) < 3 and "kinegraph.fleets.worker" in program:
                        os.kill(pid, 9)
                        killed.add(pid)
            time.sleep(0.01)

    thread = threading.Thread(target=kill)
    thread.start()
    try:
        results = ry.map(lambda i: i, range(20), engine="processes", workers=1)
    finally:
        done.set()
        thread.join()
    assert list(results) == list(range(20)) and not results.failures and len(killed) == 3
