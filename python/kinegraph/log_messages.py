"""Messages of the library: progress of calls with `verbose`, and the addresses of viewers.

They go to the logger "kinegraph" of the module `logging`, which a program configures as all others:

    logging.basicConfig(level=logging.INFO, format="%(message)s")

Progress and results have the level INFO, which `logging` does not show by default. The address of a viewer and a
request for a key have the level WARNING, which it prints to standard error.
"""

from __future__ import annotations

import logging

logger = logging.getLogger("kinegraph")


def emit(is_notice: bool, message: str) -> None:
    """Logs one message of the compiled library."""
    logger.log(logging.WARNING if is_notice else logging.INFO, "%s", message)
