"""The functions `map` and `imap`."""

from __future__ import annotations

import builtins
import itertools
import os
import signal
import threading
import time
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import ArgumentError, Error, KinegraphWarning
from ..progress import drawRate
from .results import ItemFailure, MapResults

if TYPE_CHECKING:  # engines are imported on use
    from .engines import Engine
    from .packing import Packed

GIVE_UP = 100  # consecutive failures from the first item on (or all items) after which the function is to blame


def map(
    function: Callable[..., Any],
    items: Iterable[Any],
    *,
    engine: str = "threads",
    workers: int | None = None,
    seed: int = 0,
    out: str | os.PathLike[str] | None = None,
    errors: str = "collect",
    progress: bool = True,
) -> MapResults:
    """Applies a function to many items in parallel, and returns the results in order.

    The results are the same to the bit for every engine and number of workers: each item is computed by a fresh copy of
    the function, with copies of the scenes that it refers to. Changes that the function makes are lost; only its result
    is returned. Random numbers come from `seed`, an optional parameter of the function.

    Items are sent in batches of about 0.1 s, longer with more than 50 workers. If a worker dies (out of memory,
    killed), its items are computed again. An item is a failure if three workers die while they compute it. A scene is
    sent once to each worker. Items are read when needed, and with `out` results are not stored in memory, so that ten
    million items need no more memory than a thousand.

    A terminal shows a progress bar. Ctrl-C ends the map and returns the finished results; a second one raises.

    Args:
        function: Called with an item, or with `(item, seed=...)` if it has a parameter `seed`: an integer >= 0 of 63
            bits.
        items: A list, an array (its rows), a generator ...
        engine: "threads": of this process; for functions that spend their time in Kinegraph, which runs in parallel
            threads. "processes": of this machine; also for functions in Python. "ray": an existing Ray cluster, or a
            local one that is started (extra `ray`).
        workers: Number of workers; by default the number of processors, with Ray that of the cluster.
        seed: Seed of the items' seeds.
        out: A folder for results as Parquet files (extra `fleets`), instead of memory: a dict is a row, a pyarrow table
            several rows. If the folder has results of the same run, the run continues after them. A run is the same if
            its function (code, defaults and references), seed, first item and number of items are.
        errors: "collect": an item that raises is a failure, with a warning, and the others continue. "raise": the first
            failure ends the map.
        progress: Whether to draw the progress bar.
    Returns:
        The results and failures.
    Raises:
        ArgumentError: An argument is invalid, the function or an item cannot be sent, or the folder belongs to another
            run.
        NotFound: A package is not installed.
        FileError: The folder is in use, or incomplete.
        Exception: The function's exception, with `errors="raise"`, or if all items or all of the first 100 failed.
    """
    from .dispatch import Dispatcher
    from .writing import ResultFolder

    _checkChoice("errors", errors, ("collect", "raise"))
    if not isinstance(items, Iterable):
        raise ArgumentError(f"map: items is {items!r}; expected a list, an array, a generator ...")
    started = time.monotonic()
    total = len(items) if hasattr(items, "__len__") else None
    remaining = iter(items)
    folder = None
    if out is not None:
        peeked = list(itertools.islice(remaining, 1))
        remaining = itertools.chain(peeked, remaining)
        folder = ResultFolder(Path(out), _describe(function, seed, total, peeked))
    results = MapResults(folder.folder if folder else None)
    first = folder.finished if folder else 0
    results.finished = first
    try:
        with _workers(function, engine, workers, seed) as pool, _interruptible() as interrupted:
            dispatcher = Dispatcher(pool, itertools.islice(remaining, first, None), first, total)
            shown = 0.0
            for block in dispatcher.results():
                for value in block:
                    _checkFailure(value, errors, results, first)
                    results.add(value)
                    if folder:
                        folder.add(value)
                if progress and time.monotonic() - shown > 0.2:
                    shown = time.monotonic()
                    drawRate("map", results.finished, total, first, shown - started)
                if interrupted.is_set():
                    break
            else:
                results.complete = True
            if not folder:
                results.addPending(dispatcher.pending())
    finally:
        if folder:
            folder.close()
    results.seconds = time.monotonic() - started
    if progress:
        drawRate("map", results.finished, results.finished if results.complete else total, first, results.seconds, True)
    if results.complete and 0 < len(results.failures) == results.finished - first:
        raise _error(next(iter(results.failures.values())))
    if results.failures:
        warnings.warn(KinegraphWarning(f"map: {results!r}"), stacklevel=2)
    return results


def imap(
    function: Callable[..., Any],
    items: Iterable[Any],
    *,
    engine: str = "threads",
    workers: int | None = None,
    seed: int = 0,
) -> Iterator[Any]:
    """Like `map`, but yields the results in order without storing them.

    Args:
        function: See `map`.
        items: See `map`; read when needed, some in advance.
        engine: See `map`.
        workers: See `map`.
        seed: See `map`.
    Returns:
        An iterator over the results. Its workers end with it (`close()`).
    Raises:
        ArgumentError: An argument is invalid, or the function or an item cannot be sent.
        NotFound: The package of the engine is not installed.
        Exception: The function's exception for the next item.
    """
    from .dispatch import Dispatcher

    with _workers(function, engine, workers, seed) as pool:
        for block in Dispatcher(pool, iter(items), 0, None).results():
            for value in block:
                if isinstance(value, ItemFailure):
                    raise _error(value)
                yield value


@contextmanager
def _workers(function: Callable[..., Any], engine: str, workers: int | None, seed: int) -> Iterator[Engine]:
    """Starts the workers of an engine, and ends them with the block."""
    _checkChoice("engine", engine, ("threads", "processes", "ray"))
    if not callable(function):
        raise ArgumentError(f"map: function is {function!r}; expected a callable")
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise ArgumentError(f"map: workers is {workers!r}; expected a whole number >= 1")
    from .packing import pack

    packed = pack([function], lambda _: f"function {_name(function)}")
    pool = _start(engine, workers, packed, int(seed))
    try:
        yield pool
    finally:
        pool.stop()


def _start(engine: str, workers: int | None, function: Packed, seed: int) -> Engine:
    if engine == "ray":
        from .ray_engine import RayEngine

        return RayEngine(workers, function, seed)
    from .engines import ProcessEngine, ThreadEngine

    count = workers or len(os.sched_getaffinity(0))
    return ThreadEngine(count, function, seed) if engine == "threads" else ProcessEngine(count, function, seed)


@contextmanager
def _interruptible() -> Iterator[threading.Event]:
    """Yields an event that the first Ctrl-C sets; a second one raises, as usual."""
    pressed = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield pressed
        return

    def press(number: int, frame: Any) -> None:
        if pressed.is_set():
            raise KeyboardInterrupt
        pressed.set()

    before = signal.signal(signal.SIGINT, press)
    try:
        yield pressed
    finally:
        signal.signal(signal.SIGINT, before)


def _checkFailure(value: Any, errors: str, results: MapResults, first: int) -> None:
    """Raises if a failure ends the map."""
    if not isinstance(value, ItemFailure):
        return
    all_failed = len(results.failures) == results.finished - first == GIVE_UP - 1
    if errors == "raise" or (first == 0 and all_failed):
        raise _error(value)


def _error(failure: ItemFailure) -> BaseException:
    """Converts a failure to an exception."""
    error = failure.error if isinstance(failure.error, Exception) else Error(failure.message)
    error.add_note(
        f"by item {failure.index} of a map" + (f"; in the worker:\n{failure.traceback}" if failure.traceback else "")
    )
    return error


def _checkChoice(name: str, value: str, choices: tuple[str, ...]) -> None:
    if value not in choices:
        raise ArgumentError(f"map: {name} is {value!r}; expected {', '.join(builtins.map(repr, choices))}")


def _name(function: Callable[..., Any]) -> str:
    return getattr(function, "__qualname__", None) or type(function).__qualname__


def _describe(function: Callable[..., Any], seed: int, total: int | None, first: list[Any]) -> dict[str, Any]:
    """Describes a run, so that a continuation can be recognized."""
    from .fingerprint import fingerprint

    return {
        "function": _name(function),
        "seed": int(seed),
        "items": total,
        "code": fingerprint(function),
        "first item": fingerprint(first),
    }
