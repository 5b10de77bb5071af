"""Results of jobs in their order, computed ahead by threads: what comes out does not depend on how many there are."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from threading import Event
from typing import TYPE_CHECKING, TypeVar

from .errors import ArgumentError

if TYPE_CHECKING:
    from concurrent.futures import Future

T = TypeVar("T")
Stopped = Callable[[], bool]


def checkThreads(call: str, threads: int) -> int:
    """The number of threads that a call was given.

    Args:
        call: Its name.
        threads: What it was given.
    Returns:
        The same.
    Raises:
        ArgumentError: It is less than one.
    """
    if threads < 1:
        raise ArgumentError(f"{call}: threads is {threads}; expected 1 or more")
    return threads


def inOrder(jobs: Iterable[Callable[[Stopped], T]], threads: int) -> Iterator[T]:
    """Runs jobs and gives their results in order. Each is called with a function that says whether its result is still
    wanted: it is not where the caller leaves the loop before.

    Args:
        jobs: They are taken from the iterable on the calling thread, as many ahead as there are threads.
        threads: How many run at the same time; with 1 on the calling thread, one after the other.
    """
    if threads == 1:
        for job in jobs:
            yield job(lambda: False)
        return
    from concurrent.futures import ThreadPoolExecutor  # not at import: it takes milliseconds, and few need it

    over = Event()
    pool = ThreadPoolExecutor(threads)
    ahead: deque[Future[T]] = deque()
    try:
        for job in jobs:
            ahead.append(pool.submit(job, over.is_set))
            if len(ahead) == threads:
                yield ahead.popleft().result()
        while ahead:
            yield ahead.popleft().result()
    finally:
        over.set()
        pool.shutdown(wait=False, cancel_futures=True)
