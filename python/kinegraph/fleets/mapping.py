"""`map` and `imap`."""

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

if TYPE_CHECKING:  # what computes is imported when it is needed
    from .engines import Engine
    from .packing import Packed

GIVE_UP = 100  # items in a row, from the first on, that fail: then the function is wrong, not the items; all, if there are fewer


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
    """Applies a function to many items, several at a time, and gives the results in order.

    The results are the same to the bit with every engine and number of workers: each item is computed by a copy of the function
    that nothing else has used, with copies of the scenes that it refers to. So what the function changes is gone afterwards; only
    what it returns comes back. What is random takes its numbers from `seed`, a parameter that the function may have.

    Items go out in batches of about 0.1 s, of more with more than 50 workers. A worker that dies (out of memory, killed) loses nothing: its items are computed again. An
    item that kills three workers is a failure. A scene travels once to each worker. Items are read as they are needed, and with
    `out` results are not kept, so that ten million items need no more memory than a thousand.

    On a terminal, a bar says how far it is. Ctrl-C ends it and gives what is finished; a second one raises.

    Args:
        function: Called with an item, or with `(item, seed=...)` if it has a parameter `seed`: a whole number >= 0 of 63 bits.
        items: A list, an array (its rows), a generator ...
        engine: "threads": of this process; for functions that spend their time in Kinegraph, which runs beside other threads.
            "processes": of this machine; for functions in Python, too. "ray": a Ray cluster, or one that is started on this machine
            (extra `ray`).
        workers: How many; as many as there are processors by default, with Ray as many as the cluster has.
        seed: Of the items' seeds.
        out: A folder for results as Parquet files (extra `fleets`), instead of keeping them: a dict is a row, a pyarrow table several. If
            the folder has results of the same run, the first items are not computed again.
        errors: "collect": an item that raises is a failure, a warning tells, and the others go on. "raise": the first ends the map.
        progress: Whether to draw the bar.
    Returns:
        The results, and what failed.
    Raises:
        ArgumentError: An argument makes no sense, the function or an item cannot be sent, or the folder holds another run.
        NotFound: A package is not installed.
        FileError: The folder is in use, or incomplete.
        Exception: What the function raised, with `errors="raise"`, or if all items failed, or all of the first 100.
    """
    from .dispatch import Dispatcher
    from .writing import ResultFolder

    _checkChoice("errors", errors, ("collect", "raise"))
    if not isinstance(items, Iterable):
        raise ArgumentError(f"map: items is {items!r}; expected a list, an array, a generator ...")
    started = time.monotonic()
    total = len(items) if hasattr(items, "__len__") else None
    folder = None if out is None else ResultFolder(Path(out), _describe(function, seed, total))
    results = MapResults(folder.folder if folder else None)
    first = folder.finished if folder else 0
    results.finished = first
    try:
        with _workers(function, engine, workers, seed) as pool, _interruptible() as interrupted:
            dispatcher = Dispatcher(pool, itertools.islice(iter(items), first, None), first, total)
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
                results.addLater(dispatcher.later())
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
    """As `map`, and yields the results one after another, in order; it keeps none.

    Args:
        function: As for `map`.
        items: As for `map`; read as they are needed, some ahead.
        engine: As for `map`.
        workers: As for `map`.
        seed: As for `map`.
    Returns:
        An iterator over what the function gives for each item. Its workers end with it (`close()`).
    Raises:
        ArgumentError: An argument makes no sense, or the function or an item cannot be sent.
        NotFound: The package of the engine is not installed.
        Exception: What the function raised for the next item.
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
    """Workers of an engine, which end with the block."""
    _checkChoice("engine", engine, ("threads", "processes", "ray"))
    if not callable(function):
        raise ArgumentError(f"map: function is {function!r}; expected something that can be called with an item")
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
    """An event that the first Ctrl-C sets; a second one raises, as usual."""
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
    """Raises where a failure ends the map."""
    if not isinstance(value, ItemFailure):
        return
    all_failed = len(results.failures) == results.finished - first == GIVE_UP - 1
    if errors == "raise" or (first == 0 and all_failed):
        raise _error(value)


def _error(failure: ItemFailure) -> BaseException:
    """A failure as what to raise."""
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


def _describe(function: Callable[..., Any], seed: int, total: int | None) -> dict[str, Any]:
    """What a run is, as far as it can be known again."""
    return {"function": _name(function), "seed": int(seed), "items": total}
