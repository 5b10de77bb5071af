"""Messages of the library: progress of calls with `verbose`, and the addresses of viewers.

They go to the logger "kinegraph" of the module `logging`, which a program configures as all others:

    logging.basicConfig(level=logging.INFO, format="%(message)s")

Progress and results have the level INFO; the address of a viewer and a request for a key have the level WARNING. In a
program that configures no logging, messages are printed: the caller asked for them by `verbose` or by a viewer.
"""

from __future__ import annotations

import logging

logger = logging.getLogger("kinegraph")


def emit(is_notice: bool, message: str) -> None:
    """Logs one message of the compiled library, or prints it if the program has no handlers of the logger."""
    if logger.hasHandlers():
        logger.log(logging.WARNING if is_notice else logging.INFO, "%s", message)
    else:
        print(message, flush=True)
