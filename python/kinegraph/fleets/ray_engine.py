"""Workers on a Ray cluster, or on a local one started for them."""

from __future__ import annotations

import os
import pickle
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ..errors import NotFound
from .engines import WorkerDied
from .packing import Packed
from .worker import Answer, Batch, Worker, packAnswer


def _ray() -> Any:
    try:
        import ray
    except ModuleNotFoundError:
        raise NotFound("engine='ray' needs the package ray: pip install 'kinegraph[ray]'") from None
    return ray


@contextmanager
def _environment(name: str, value: str) -> Iterator[None]:
    """Sets an unset variable for the processes of Ray. By default its workers have niceness 15, behind all other
    processes."""
    if name in os.environ:
        yield
        return
    os.environ[name] = value
    try:
        yield
    finally:
        del os.environ[name]


class RayEngine:
    """Actors of Ray. An existing connection is used (`ray.init(address=...)`); otherwise Ray is started on this
    machine, and ended with the map."""

    def __init__(self, workers: int | None, function: Packed, seed: int):
        self._ray = _ray()
        self._ours = not self._ray.is_initialized()
        if self._ours:
            with _environment("RAY_worker_niceness", "0"):
                self._ray.init(num_cpus=workers, include_dashboard=False, log_to_driver=False, logging_level="ERROR")
        self.workers = workers or int(self._ray.cluster_resources().get("CPU", 1))
        self._setup = self._ray.put(pickle.dumps((function, seed)))  # once per machine
        self._class = self._ray.remote(num_cpus=1, max_restarts=0)(_RayWorker)
        self._actors = [self._class.remote(self._setup) for _ in range(self.workers)]
        self._requested: list[deque[Any]] = [deque() for _ in range(self.workers)]

    def send(self, worker: int, batch: Batch) -> None:
        self._requested[worker].append(self._actors[worker].run.remote(pickle.dumps(batch)))

    def receive(self, seconds: float) -> list[tuple[int, Answer | WorkerDied]]:
        first = {requested[0]: number for number, requested in enumerate(self._requested) if requested}
        ready, _ = self._ray.wait(list(first), num_returns=1, timeout=seconds)
        return [self._answer(first[reference]) for reference in ready]

    def _answer(self, number: int) -> tuple[int, Answer | WorkerDied]:
        try:
            answer: Answer = pickle.loads(self._ray.get(self._requested[number].popleft()))
            return number, answer
        except self._ray.exceptions.RayActorError:
            self._requested[number].clear()
            self._actors[number] = self._class.remote(self._setup)
            return number, WorkerDied("killed, or its machine is unreachable")

    def stop(self) -> None:
        for actor in self._actors:
            self._ray.kill(actor)
        if self._ours:
            self._ray.shutdown()


class _RayWorker:
    def __init__(self, setup: bytes):
        self._worker = Worker(*pickle.loads(setup))

    def run(self, batch: bytes) -> bytes:
        return packAnswer(self._worker.run(pickle.loads(batch)))
