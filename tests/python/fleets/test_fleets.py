"""The same function for many items: results in order and equal to the bit for all engines."""

import contextlib
import itertools
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from kinegraph.fleets import ItemFailure
from kinegraph.fleets.dispatch import Dispatcher
from kinegraph.fleets.engines import WorkerDied
from kinegraph.fleets.worker import Answer, Batch

pytest.importorskip("cloudpickle")
ENGINES = ["threads", "processes"]


@pytest.fixture(scope="module")
def arm() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    return C


def square(x: int) -> int:
    return x * x


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("workers", [1, 3])
def test_results_are_in_the_order_of_the_items(engine: str, workers: int) -> None:
    results = ry.map(square, range(500), engine=engine, workers=workers)
    assert list(results) == [i * i for i in range(500)]
    assert results.complete and results.finished == 500 and not results.failures


@pytest.mark.parametrize("engine", ENGINES)
def test_solutions_are_the_same_bits_wherever_they_are_computed(arm: ry.Config, engine: str) -> None:
    targets = np.random.default_rng(3).uniform([-0.5, -0.5, 0.1], [0.5, 0.5, 0.8], (24, 3))

    def solve(target: np.ndarray, seed: int) -> bytes:
        answer = ry.solveIk(arm, {"gripper": target}, seed=seed % 1000, apply=True)  # changes its scene
        return np.r_[answer.q, arm.getJointState()].tobytes()

    before = arm.getJointState()
    expected = list(ry.map(solve, targets, engine="threads", workers=1))
    assert list(ry.map(solve, targets, engine=engine, workers=3)) == expected
    assert (arm.getJointState() == before).all()  # the function worked on copies
    assert len(set(expected)) == len(expected)


def test_an_item_gets_the_same_seed_in_every_run_and_no_other_item_does() -> None:
    seeds = list(ry.map(lambda i, seed: seed, range(1000), seed=5))
    assert seeds == list(ry.map(lambda i, seed: seed, range(1000), seed=5, engine="processes"))
    assert len(set(seeds)) == 1000 and all(0 <= seed < 2**63 for seed in seeds)
    assert not set(seeds) & set(ry.map(lambda i, seed: seed, range(1000), seed=6))
    assert list(ry.map(lambda seed: seed, [7, 8])) == [7, 8]  # items may be seeds


@pytest.mark.parametrize("engine", ENGINES)
def test_the_state_of_a_function_is_reset_before_the_next_item(engine: str) -> None:
    seen: list[int] = []

    def count(i: int) -> int:
        seen.append(i)
        return len(seen)

    assert list(ry.map(count, range(30), engine=engine)) == [1] * 30 and not seen


@pytest.mark.parametrize("engine", ENGINES)
def test_scenes_in_items_travel_and_are_not_shared(arm: ry.Config, engine: str) -> None:
    scenes = [ry.Config() for _ in range(40)]  # more than a worker remembers
    for i, scene in enumerate(scenes):
        scene.addFrame("a").setPosition([i, 0, 0])

    def move(item: tuple[ry.Config, float]) -> float:
        scene, step = item
        frame = scene.getFrame("a")
        frame.setPosition(np.add(frame.getPosition(), [step, 0, 0]))
        return float(frame.getPosition()[0])

    items = [(scene, 0.5) for scene in [*scenes, *scenes[::-1], *scenes[:3] * 20]]
    expected = [*range(40), *range(39, -1, -1), *[0, 1, 2] * 20]
    assert list(ry.map(move, items, engine=engine, workers=2)) == [x + 0.5 for x in expected]


@pytest.mark.parametrize("engine", ENGINES)
def test_functions_and_methods_in_cpp_can_be_sent(arm: ry.Config, engine: str) -> None:
    from kinegraph import solveIk

    evaluate, method = arm.eval, ry.Config.getJointNames
    apart = [0.1, 0.2]
    found = ry.map(lambda x: solveIk(arm, {"gripper": [0.4, x, 0.5]}).feasible, apart, engine=engine)
    assert list(found) == [True, True]
    assert list(ry.map(lambda f: float(evaluate(ry.FS.position, [f])[0][2]), ["gripper"], engine=engine)) == [
        arm.eval(ry.FS.position, ["gripper"])[0][2]
    ]
    assert list(ry.map(lambda C: method(C), [arm], engine=engine)) == [arm.getJointNames()]


@pytest.mark.parametrize("engine", ENGINES)
def test_an_item_that_raises_is_reported_and_the_others_continue(engine: str) -> None:
    with pytest.warns(ry.KinegraphWarning, match="1 failed, first item 7: ZeroDivisionError"):
        results = ry.map(lambda x: 1 / (x - 7), range(20), engine=engine)
    assert results[7] is None and results[8] == 1.0 and results.complete
    assert "lambda" in results.failures[7].traceback
    with pytest.raises(ZeroDivisionError) as raised:
        ry.map(lambda x: 1 / (x - 7), range(20), engine=engine, errors="raise")
    assert "by item 7 of a map" in raised.value.__notes__[0]


def test_a_function_that_never_works_ends_the_map() -> None:
    with pytest.raises(NameError, match="sqare"):
        ry.map(lambda x: sqare(x), itertools.count())  # type: ignore[name-defined]  # noqa: F821
    with pytest.raises(ZeroDivisionError):
        ry.map(lambda x: 1 / x, [0])


@pytest.mark.parametrize("engine", ENGINES)
def test_results_and_errors_that_cannot_be_sent_are_failures_or_come_as_they_are(engine: str) -> None:
    class Odd(Exception):
        def __init__(self, a: int, b: int):
            super().__init__("odd")

    def odd(x: int) -> object:
        if x == 1:
            raise Odd(1, 2)
        if x == 3:
            sys.exit(4)
        return threading.Lock() if x == 2 else x

    with pytest.warns(ry.KinegraphWarning):
        results = ry.map(odd, range(5), engine=engine)
    assert results[0] == 0 and results[4] == 4
    assert results.failures[1].message == "Odd: odd" and results.failures[3].message == "SystemExit: 4"
    assert (2 in results.failures) == (engine == "processes")


def test_an_item_that_kills_workers_is_given_up_and_nothing_else_is_lost() -> None:
    def deadly(x: int) -> int:
        if x in (0, 333):
            os.kill(os.getpid(), signal.SIGKILL)
        return x

    with pytest.warns(
        ry.KinegraphWarning, match="2 failed, first item 0: 3 workers died while computing it: killed by SIGKILL"
    ):
        results = ry.map(deadly, range(2000), engine="processes", workers=2)
    assert [x for x in results if x is not None] == [x for x in range(2000) if x not in (0, 333)]
    assert "workers died while computing it" in results.failures[333].message


def test_workers_that_are_killed_lose_nothing() -> None:
    def slow(x: int) -> tuple[int, int]:
        time.sleep(0.002)
        return x, os.getpid()

    killed: set[int] = set()
    results = []
    for x, pid in ry.imap(slow, range(1500), engine="processes", workers=2):
        results.append(x)
        if x % 300 == 150 and pid not in killed:
            killed.add(pid)
            with contextlib.suppress(ProcessLookupError):  # a batch from before it was killed
                os.kill(pid, signal.SIGKILL)
    assert results == list(range(1500)) and killed


def test_items_are_read_only_as_far_as_they_are_needed() -> None:
    read = 0

    def items() -> "itertools.count[int]":
        nonlocal read
        while True:
            read += 1
            yield read

    results = ry.imap(lambda x: time.sleep(0.001) or x, items(), workers=2)
    assert list(itertools.islice(results, 50)) == list(range(1, 51))
    time.sleep(0.3)  # nothing is read while nobody asks
    assert read < 20000
    before = read
    results.close()
    assert read == before


class CountingEngine:
    """Answers each batch at once, and says that each item took a millisecond."""

    def __init__(self, workers: int):
        self.workers = workers
        self.sizes: list[int] = []
        self._answers: list[tuple[int, Answer]] = []

    def send(self, worker: int, batch: Batch) -> None:
        count = len(batch.ends)
        self.sizes.append(count)
        self._answers.append((worker, Answer(batch.first, [None] * count, 0.001 * count)))

    def receive(self, seconds: float) -> list[tuple[int, Answer]]:
        answers, self._answers = self._answers, []
        return answers

    def stop(self) -> None:
        pass


@pytest.mark.parametrize(("workers", "items"), [(2, 100), (50, 100), (100, 200)])
def test_batches_are_of_a_tenth_of_a_second_and_of_more_where_many_workers_wait_for_one_process(
    workers: int, items: int
) -> None:
    engine = CountingEngine(workers)
    results = Dispatcher(engine, iter(range(1 << 40)), 0, None).results()
    while not engine.sizes or engine.sizes[-1] < items:
        next(results)
    assert max(engine.sizes) == engine.sizes[-1] == items


class ForgetfulEngine:
    """Workers that die of some items, and whose answers are lost that they gave just before."""

    def __init__(self, workers: int, deadly: set[int]):
        self.workers = workers
        self._deadly = deadly
        self._sent: list[list[Batch]] = [[] for _ in range(workers)]

    def send(self, worker: int, batch: Batch) -> None:
        self._sent[worker].append(batch)

    def receive(self, seconds: float) -> list[tuple[int, Answer | WorkerDied]]:
        answers: list[tuple[int, Answer | WorkerDied]] = []
        for worker, batches in enumerate(self._sent):
            if any(self._deadly & set(range(b.first, b.first + len(b.ends))) for b in batches):
                answers.append((worker, WorkerDied("killed")))
            else:
                answers += [(worker, Answer(b.first, ["done"] * len(b.ends), 0.001 * len(b.ends))) for b in batches]
            batches.clear()
        return answers

    def stop(self) -> None:
        pass


@pytest.mark.parametrize("workers", [1, 2, 5])
@pytest.mark.parametrize("deadly", [{70}, {0}, {70, 71, 72}, {3, 50, 99}])
def test_nothing_is_lost_but_what_kills_also_where_answers_die_with_their_worker(
    workers: int, deadly: set[int]
) -> None:
    engine = ForgetfulEngine(workers, deadly)
    found = list(itertools.chain.from_iterable(Dispatcher(engine, iter(range(100)), 0, 100).results()))
    assert len(found) == 100
    assert {i for i, result in enumerate(found) if isinstance(result, ItemFailure)} == deadly


def test_errors_are_reported(tmp_path: Path) -> None:
    with pytest.raises(ry.ArgumentError, match="engine is 'thread'; expected 'threads', 'processes', 'ray'"):
        ry.map(square, [1], engine="thread")
    with pytest.raises(ry.ArgumentError, match="function is 3"):
        ry.map(3, [1])  # type: ignore[arg-type]
    with pytest.raises(ry.ArgumentError, match="workers is 0"):
        ry.map(square, [1], workers=0)
    with pytest.raises(ry.ArgumentError, match="errors is 'ignore'"):
        ry.map(square, [1], errors="ignore")
    with pytest.raises(ry.ArgumentError, match="item 1 cannot be sent to workers"):
        ry.map(square, [1, threading.Lock()])
    with (
        (tmp_path / "x").open("w") as file,
        pytest.raises(ry.ArgumentError, match="function .* cannot be sent to workers"),
    ):
        ry.map(lambda x: file.write(x), ["a"])
    with pytest.raises(ry.FileError, match="does not exist"):
        ry.readResults(tmp_path / "nowhere")
    assert list(ry.map(square, [])) == [] and ry.map(square, []).complete


SCRIPT = """
import sys, time
import kinegraph as ry

print("started", flush=True)
def slow(x):
    time.sleep(0.01)
    return x
results = ry.map(slow, range(10**6), engine=sys.argv[1], workers=2, out=sys.argv[2] if len(sys.argv) > 2 else None)
print(results.finished, results.complete, all(x in (None, i) for i, x in enumerate(results)))
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_control_c_returns_finished_results_also_from_a_script_without_main(tmp_path: Path, engine: str) -> None:
    (tmp_path / "script.py").write_text(SCRIPT)
    with subprocess.Popen(
        [sys.executable, tmp_path / "script.py", engine], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout and process.stdout.readline() == "started\n"
        time.sleep(2.5)
        process.send_signal(signal.SIGINT)
        finished, complete, equal = process.stdout.readline().split()
    assert process.returncode == 0 and int(finished) > 20 and complete == "False" and equal == "True"


def test_a_run_that_was_killed_goes_on(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    (tmp_path / "script.py").write_text(
        SCRIPT.replace("10**6", "1500").replace(
            "import kine", "import kinegraph.fleets.writing as w; w.PART_SECONDS = 0.5\nimport kine"
        )
    )
    command = [sys.executable, tmp_path / "script.py", "threads", tmp_path / "out"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 30
        while len(list((tmp_path / "out").glob("part-*.parquet"))) < 2 and time.monotonic() < deadline:
            time.sleep(0.02)
        process.kill()
    written = list(ry.readResults(tmp_path / "out"))
    assert 0 < len(written) < 1500 and written == list(range(len(written)))
    (tmp_path / "out" / ".part-000000000000-000000000007.parquet.unfinished").write_bytes(b"half a file")
    assert "1500 True" in subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
    assert list(ry.readResults(tmp_path / "out")) == list(range(1500))


def test_files_contain_the_returned_values(tmp_path: Path) -> None:
    pa = pytest.importorskip("pyarrow")
    import pyarrow.dataset

    def rows(x: int) -> dict[str, object]:
        if x == 3:
            raise ValueError("three")
        return {"x": x, "q": np.arange(3.0) + x, "name": f"n{x}", "J": np.full((2, 2), x), "found": x > 2}

    with pytest.warns(ry.KinegraphWarning, match="item 3: ValueError: three"):
        results = ry.map(rows, range(6), out=tmp_path / "rows")
    assert len(results) == 0 and results.finished == 6 and results.complete
    read = list(ry.readResults(tmp_path / "rows"))
    assert read[3] == ItemFailure(3, "ValueError: three")
    assert (
        read[4]["name"] == "n4" and (read[4]["q"] == [4, 5, 6]).all() and (read[4]["J"] == 4).all() and read[4]["found"]
    )
    table = pyarrow.dataset.dataset(tmp_path / "rows", format="parquet").to_table()
    assert table["x"].to_pylist() == [0, 1, 2, None, 4, 5]

    ry.map(lambda x: pa.table({"y": list(range(x))}), range(5), out=tmp_path / "tables")
    assert [part["y"].to_pylist() for part in ry.readResults(tmp_path / "tables")] == [list(range(x)) for x in range(5)]
    ry.map(lambda x: pa.table({"y": [x]}), range(5), out=tmp_path / "one")
    assert [part["y"].to_pylist() for part in ry.readResults(tmp_path / "one")] == [[x] for x in range(5)]
    ry.map(lambda x: (x, {1}), range(5), out=tmp_path / "others")
    assert list(ry.readResults(tmp_path / "others")) == [(x, {1}) for x in range(5)]


def test_a_folder_of_another_run_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    ry.map(square, range(10), out=tmp_path / "out")
    again = ry.map(square, range(10), out=tmp_path / "out")
    assert again.finished == 10 and again.complete
    with pytest.raises(ry.ArgumentError, match="another run: seed was 0 and is 1"):
        ry.map(square, range(10), out=tmp_path / "out", seed=1)
    with pytest.raises(ry.ArgumentError, match="items was 10 and is 11"):
        ry.map(square, range(11), out=tmp_path / "out")
    next((tmp_path / "out").glob("part-*")).unlink()
    ry.map(square, range(10), out=tmp_path / "out")
    assert list(ry.readResults(tmp_path / "out")) == [x * x for x in range(10)]
    with pytest.raises(ry.ArgumentError, match="the key 'item'"):
        ry.map(lambda x: {"item": x}, range(3), out=tmp_path / "key")
    with pytest.raises(ry.ArgumentError, match="the results 'x' do not fit into one column"):
        ry.map(lambda i: {"x": "text" if i else 1}, range(3), out=tmp_path / "mixed")


RAY = """
import os, signal
import kinegraph as ry

C = ry.Config()
C.addFile(ry.raiPath("panda/panda.g"))
own = os.nice(0)

def solve(x, seed):
    assert os.nice(0) == own  # as important as this process: others would starve it on a busy machine
    if x == 70:
        os.kill(os.getpid(), signal.SIGKILL)
    return ry.solveIk(C, {"gripper": [0.4, x / 300, 0.5]}, seed=seed % 1000).q.tobytes()

found = ry.map(solve, range(100), engine="ray", workers=2)
alone = ry.map(solve, [*range(70)], workers=1)
print(found[:70] == list(alone), sorted(found.failures), found.complete)
"""


def test_a_ray_cluster_gives_the_same_bits_and_survives_workers_that_die(tmp_path: Path) -> None:
    pytest.importorskip("ray")
    (tmp_path / "script.py").write_text(RAY)
    command = [sys.executable, "-W", "ignore", tmp_path / "script.py"]
    program = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=240)
    assert "True [70] True" in program.stdout, program.stderr
