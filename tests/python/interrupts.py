"""Ctrl-C while a call runs."""

import _thread
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager


class Interrupt:
    """When it came, in seconds of time.perf_counter()."""

    time: float | None = None


@contextmanager
def interrupt_after(seconds: float) -> Iterator[Interrupt]:
    """Interrupts the main thread as Ctrl-C does, after that time; never once the block has been left."""
    interrupt = Interrupt()
    over = threading.Lock()

    def strike() -> None:
        with over:
            if not timer.finished.is_set():
                interrupt.time = time.perf_counter()
                _thread.interrupt_main()

    timer = threading.Timer(seconds, strike)
    timer.start()
    try:
        yield interrupt
    finally:
        with over:
            timer.cancel()
        timer.join()
