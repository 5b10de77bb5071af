"""Progress lines of long computations."""

import sys
from typing import TextIO


def drawProgress(
    what: str, done: int, total: int, seconds: float, ends: bool = False, stream: TextIO | None = None
) -> None:
    """Redraws the progress bar on `stream` (stderr), if it is a terminal.

    Args:
        what: Name of the call.
        done: Number of finished items.
        total: Number of all items.
        seconds: Duration so far, s.
        ends: Whether the call has ended: then the line stays, as after the last item.
        stream: Output stream.
    """
    stream = stream or sys.stderr
    if not stream.isatty():
        return
    width = 30
    filled = width * done // max(total, 1)
    left = f", {seconds * (total - done) / done:.0f} s left" if 0 < done < total and not ends else ""
    bar = "█" * filled + "·" * (width - filled)
    end = "\n" if ends or done >= total else ""
    stream.write(f"\r{what} {bar} {done}/{total}, {seconds:.0f} s{left}\x1b[K{end}")
    stream.flush()


def drawSolve(
    what: str, evals: int, cost: float, violation: float, seconds: float, stream: TextIO | None = None
) -> None:
    """Redraws the progress of a solver on `stream` (stderr), if it is a terminal."""
    stream = stream or sys.stderr
    if not stream.isatty():
        return
    stream.write(
        f"\r{what}: {evals} evaluations, cost {cost:.4g}, violation {violation:.2g}, {seconds:.0f} s (Ctrl-C ends it)\x1b[K\r"
    )
    stream.flush()


def drawTime(what: str, seconds: float, stream: TextIO | None = None) -> None:
    """Redraws how long a call has taken on `stream` (stderr), if it is a terminal."""
    stream = stream or sys.stderr
    if stream.isatty():
        stream.write(f"\r{what}: {seconds:.0f} s (Ctrl-C ends it)\x1b[K\r")
        stream.flush()


def clearLine(stream: TextIO | None = None) -> None:
    """Removes the line on `stream` (stderr), if it is a terminal."""
    stream = stream or sys.stderr
    if stream.isatty():
        stream.write("\r\x1b[K")
        stream.flush()


def drawRate(
    what: str,
    done: int,
    total: int | None,
    before: int,
    seconds: float,
    ends: bool = False,
    stream: TextIO | None = None,
) -> None:
    """Redraws the progress of a run over many items on `stream` (stderr), if it is a terminal, with rate and remaining
    time.

    Args:
        what: Name of the run.
        done: Number of finished items.
        total: Number of all items; None if unknown.
        before: Number of items that were finished at the start.
        seconds: Duration so far, s.
        ends: Whether the run has ended: then the line stays.
        stream: Output stream.
    """
    stream = stream or sys.stderr
    if not stream.isatty():
        return
    rate = (done - before) / seconds if seconds > 0 else 0.0
    share = f"{'█' * (30 * done // max(total, 1)):·<30} {done}/{total}" if total is not None else str(done)
    left = f", {(total - done) / rate:.0f} s left" if total is not None and rate > 0 and not ends else ""
    stream.write(f"\r{what} {share}, {rate:.4g}/s, {seconds:.0f} s{left}\x1b[K" + ("\n" if ends else ""))
    stream.flush()
