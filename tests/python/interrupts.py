"""Ctrl-C while a call runs."""

import _thread
import gc
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager


class Interrupt:
    """When it came, in seconds of time.perf_counter()."""

    time: float | None = None


@contextmanager
def interrupt_after(seconds: float) -> Iterator[Interrupt]:
    """Interrupts the main thread as Ctrl-C does, after that time; never once the block has been left.

    Python discards a KeyboardInterrupt that comes within a callback of its garbage collector, and packages of the tests
    register such callbacks: the collector rests meanwhile, and the interrupt comes again every 5 seconds.
    """
    collects = gc.isenabled()
    gc.disable()
    interrupt = Interrupt()
    over = threading.Event()
    striking = threading.Lock()

    def strike() -> None:
        wait = seconds
        while not over.wait(wait):
            with striking:
                if not over.is_set():
                    interrupt.time = interrupt.time or time.perf_counter()
                    _thread.interrupt_main()
            wait = 5

    thread = threading.Thread(target=strike)
    thread.start()
    try:
        yield interrupt
    finally:
        with striking:
            over.set()
        thread.join()
        if collects:
            gc.enable()
