"""Computes batches of items. As a program, it is a worker process."""

from __future__ import annotations

import contextlib
import inspect
import itertools
import os
import pickle
import sys
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from .packing import Packed, SceneCache, Unpacker, itemSeed, loadScene
from .results import ItemFailure


@dataclass(frozen=True)
class Batch:
    """Items for one worker.

    Attributes:
        first: Index of the first item.
        data: The pickled items.
        ends: End of each item in `data`.
        scenes: Content of their scenes, or None for scenes that the worker knows.
    """

    first: int
    data: bytes
    ends: list[int]
    scenes: dict[str, bytes | None]


@dataclass(frozen=True)
class Answer:
    """The results of a batch.

    Attributes:
        first: Index of the first item.
        results: Result of each item, or an `ItemFailure`.
        seconds: Duration of the items, s.
    """

    first: int
    results: list[Any]
    seconds: float


class Worker:
    """Applies a function to batches. Every item gets fresh copies of the function and the scenes, so that its result
    does not depend on previous items of this worker."""

    def __init__(self, function: Packed, seed: int):
        self._function = function.data
        self._seed = seed
        self._own_scenes = {key: loadScene(content) for key, content in function.scenes.items()}
        self._scenes = SceneCache()
        self._takes_seed: bool | None = None

    def run(self, batch: Batch) -> Answer:
        """Computes the items of a batch; an exception becomes an `ItemFailure`."""
        start = time.perf_counter()
        self._scenes.use({key: self._known(key, content) for key, content in batch.scenes.items()})
        results = []
        for index, (begin, end) in enumerate(itertools.pairwise([0, *batch.ends]), batch.first):
            try:
                results.append(self._apply(batch.data[begin:end], index))
            except (Exception, SystemExit) as error:
                trace = "".join(traceback.format_exception(error))
                results.append(ItemFailure(index, describeError(error), trace, error))
        return Answer(batch.first, results, time.perf_counter() - start)

    def _apply(self, data: bytes, index: int) -> Any:
        item = Unpacker(data, self._scenes).load()
        function = Unpacker(self._function, self._own_scenes).load()
        if self._takes_seed is None:
            self._takes_seed = takesSeed(function)
        return function(item, seed=itemSeed(self._seed, index)) if self._takes_seed else function(item)

    def _known(self, key: str, content: bytes | None) -> Any:
        return self._scenes[key] if content is None else self._scenes.get(key) or loadScene(content)


def takesSeed(function: Callable[..., Any]) -> bool:
    """Returns whether a function has a parameter `seed` after the first one, the item."""
    try:
        return "seed" in list(inspect.signature(function).parameters)[1:]
    except (TypeError, ValueError):  # some functions in C have no signature
        return False


def describeError(error: BaseException) -> str:
    """Returns the type and the first line of an error."""
    text = str(error).split("\n", 1)[0]
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def packAnswer(answer: Answer) -> bytes:
    """Pickles an answer; a result that cannot be pickled becomes a failure of its item."""
    import cloudpickle

    def sendable(index: int, result: Any) -> Any:
        try:
            cloudpickle.loads(cloudpickle.dumps(result))
            return result
        except Exception as error:
            if isinstance(result, ItemFailure):  # its exception cannot be sent, but its text can
                return ItemFailure(result.index, result.message, result.traceback)
            return ItemFailure(index, f"the result cannot be sent back: {describeError(error)}")

    if not any(isinstance(result, ItemFailure) for result in answer.results):
        with contextlib.suppress(Exception):  # if one of them cannot be sent, each is checked
            whole: bytes = cloudpickle.dumps(answer)
            return whole
    results = [sendable(answer.first + i, result) for i, result in enumerate(answer.results)]
    packed: bytes = cloudpickle.dumps(Answer(answer.first, results, answer.seconds))
    return packed


def _serve(connection: Connection) -> None:
    """Sends an empty message as soon as it is ready, and answers batches until the connection closes."""
    try:
        sys.path[:] = pickle.loads(connection.recv_bytes())
        worker = Worker(*pickle.loads(connection.recv_bytes()))
        connection.send_bytes(b"")  # ready: from now on a batch may be to blame for the end of this process
        while True:
            connection.send_bytes(packAnswer(worker.run(pickle.loads(connection.recv_bytes()))))
    except (EOFError, BrokenPipeError, ConnectionResetError):
        pass


if __name__ == "__main__":
    os.environ.setdefault("KINEGRAPH_HEADLESS", "1")
    _serve(Connection(int(sys.argv[1])))
