"""Sends batches of items to workers, and returns their results in order."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..errors import Error
from .engines import Engine, WorkerDied
from .packing import Packed, SceneCache, pack
from .results import ItemFailure
from .worker import Answer, Batch

BATCH_SECONDS = 0.1  # shortest intended duration of a batch: far longer than its transfer
BATCH_SECONDS_PER_WORKER = 0.002  # added per worker, so that many workers do not saturate the dispatcher
BATCH_BYTES = 16 << 20  # largest intended size of a batch
GROWTH = 8  # largest factor between the sizes of successive batches
IN_FLIGHT = 3  # largest number of batches per worker: one in computation, the others queued
WINDOW = 100  # largest number of batches per worker that are finished or in progress behind an unfinished one
KILLS = 3  # number of workers that may die while they compute an item
FRUITLESS = 50  # successive deaths of workers without any result, after which the items are not to blame


@dataclass
class _Job:
    """A batch, and the number of workers that died while computing it."""

    first: int
    packed: Packed
    kills: int = 0


class Dispatcher:
    """Reads items when workers are ready, and stores at most a window of results.

    If a worker dies, another one computes its batch again, in halves, so that an item that kills workers is finally
    alone. After three workers the item counts as a failure. Batches that waited for the same worker are not blamed, and
    no batch is blamed for the death of a worker that has not started yet. A
    repeated batch has its worker for itself: otherwise the lost answer of a previous batch could be blamed on that one.
    """

    def __init__(self, engine: Engine, items: Iterator[Any], first: int, total: int | None):
        """Args:
        engine: Engine of the workers.
        items: Remaining items.
        first: Index of the first remaining item.
        total: Number of all items, including those before `first`; None if unknown.
        """
        self._engine = engine
        self._items = items
        self._read = first
        self._total = total
        self._next = first
        self._again: deque[_Job] = deque()
        self._sent: list[deque[_Job]] = [deque() for _ in range(engine.workers)]
        self._scenes = [SceneCache() for _ in range(engine.workers)]
        self._done: dict[int, list[Any]] = {}
        self._batch_items = 1
        self._item_seconds: float | None = None
        self._item_bytes = 1.0
        self._fruitless = 0

    def results(self) -> Iterator[list[Any]]:
        """Yields the available results of the next items, possibly none, at least every tenth of a second."""
        while self._send():
            for worker, answer in self._engine.receive(0.1):
                if isinstance(answer, WorkerDied):
                    self._lost(worker, answer)
                else:
                    self._take(self._sent[worker].popleft(), answer)
            yield self._inOrder()

    def pending(self) -> dict[int, Any]:
        """Returns available results behind unfinished items, by index."""
        return {first + i: result for first, results in self._done.items() for i, result in enumerate(results)}

    def _send(self) -> bool:
        """Sends batches to ready workers. Returns whether any batch is in progress."""
        while (worker := self._freeWorker()) is not None:
            if self._again and self._again[0].kills and self._sent[worker]:
                break  # until a worker is idle
            if (job := self._job()) is None:
                break
            known = self._scenes[worker]
            scenes = {key: None if key in known else content for key, content in job.packed.scenes.items()}
            known.use(dict.fromkeys(scenes))
            self._engine.send(worker, Batch(job.first, job.packed.data, job.packed.ends, scenes))
            self._sent[worker].append(job)
        return any(self._sent)

    def _freeWorker(self) -> int | None:
        """Returns the ready worker with the fewest batches."""
        free = [i for i, sent in enumerate(self._sent) if len(sent) < IN_FLIGHT and not (sent and sent[0].kills)]
        return min(free, key=lambda i: len(self._sent[i]), default=None)

    def _job(self) -> _Job | None:
        """Returns the next job; None if there is none, or the window is full."""
        if self._again:
            return self._again.popleft()
        if len(self._done) + sum(map(len, self._sent)) >= WINDOW * len(self._sent):
            return None
        first = self._read
        items = list(itertools.islice(self._items, self._size()))
        if not items:
            return None
        self._read += len(items)
        packed = pack(items, lambda i: f"item {first + i}")
        self._item_bytes = max(1.0, len(packed.data) / len(items))
        return _Job(first, packed)

    def _size(self) -> int:
        """Returns the size of the next batch."""
        if self._item_seconds is None:
            return 1
        batch_seconds = max(BATCH_SECONDS, BATCH_SECONDS_PER_WORKER * len(self._sent))
        wanted = min(
            batch_seconds / max(self._item_seconds, 1e-9), BATCH_BYTES / self._item_bytes, GROWTH * self._batch_items
        )
        if self._total is not None:  # so that all workers finish at about the same time
            wanted = min(wanted, (self._total - self._read) / (2 * len(self._sent)))
        self._batch_items = max(1, int(wanted))
        return self._batch_items

    def _take(self, job: _Job, answer: Answer) -> None:
        self._done[job.first] = answer.results
        self._fruitless = 0
        seconds = answer.seconds / len(job.packed)
        self._item_seconds = seconds if self._item_seconds is None else 0.7 * self._item_seconds + 0.3 * seconds

    def _lost(self, worker: int, how: WorkerDied) -> None:
        """Handles the death of a worker: its first batch is suspicious, the others only waited. While the worker
        started, all of them waited."""
        suspect, *others = self._sent[worker] or [None]
        self._sent[worker].clear()
        self._scenes[worker].clear()
        self._again.extend(others)
        if suspect is None:
            return
        self._fruitless += 1
        if self._fruitless > FRUITLESS:
            raise Error(f"map: {FRUITLESS} workers died without any result, the last one: {how}")
        if not how.started:
            self._again.appendleft(suspect)
            return
        kills, count = suspect.kills + 1, len(suspect.packed)
        if count == 1 and kills >= KILLS:
            self._done[suspect.first] = [ItemFailure(suspect.first, f"{kills} workers died while computing it: {how}")]
            self._fruitless = 0
            return
        middle = (count + 1) // 2
        for begin, end in ((0, middle), (middle, count)):
            if begin < end:
                self._again.appendleft(_Job(suspect.first + begin, suspect.packed.part(begin, end), kills))

    def _inOrder(self) -> list[Any]:
        results: list[Any] = []
        while self._next in self._done:
            block = self._done.pop(self._next)
            self._next += len(block)
            results += block
        return results
