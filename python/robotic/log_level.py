"""The level of messages, by the call of the reference's latest versions."""

from __future__ import annotations

import logging

_SILENT = logging.NullHandler()


def setLogLevel(level: int) -> None:
    """Silences the messages of the library, or lets them through again; errors and warnings stay.

    Args:
        level: Negative: no messages; others: as at the start.
    """
    logger = logging.getLogger("kinegraph")
    logger.removeHandler(_SILENT)
    logger.propagate = level >= 0
    if level < 0:
        logger.addHandler(_SILENT)
