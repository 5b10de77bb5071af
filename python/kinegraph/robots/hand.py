"""The hand of Franka's arms, whose calls block."""

from __future__ import annotations

import queue
import threading
from typing import Any

from .._core import GripperCommand, GripperInfo, GripperState

HAND = ("hand", 0.0, 0.08, 0.1, 70.0)  # name, smallest and largest width (m), speed (m/s), force (N)


def handInfo() -> GripperInfo:
    """Returns the properties of the hand."""
    return GripperInfo(*HAND)


class Hand:
    """A hand with the interface of libfranka's Gripper. A thread makes its calls, which block."""

    def __init__(self, hand: Any) -> None:
        self._hand = hand
        self._commands: queue.SimpleQueue[GripperCommand | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._open = 0  # number of unfinished commands
        self._error = ""
        self._width = float(hand.read_once().width)
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        while (command := self._commands.get()) is not None:
            error = ""
            try:
                if command.grasp:
                    self._hand.grasp(command.width, command.speed, command.force, 1.0, 1.0)
                else:
                    self._hand.move(command.width, command.speed)
            except Exception as problem:
                error = str(problem)
            width = float(self._hand.read_once().width)
            with self._lock:
                self._open -= 1
                self._width, self._error = width, error or self._error

    def command(self, command: GripperCommand) -> None:
        """Queues a command."""
        with self._lock:
            self._open += 1
        self._commands.put(command)

    def state(self) -> tuple[GripperState, str]:
        """Returns the state after the last command, and an error."""
        with self._lock:
            return GripperState(self._width, self._open == 0), self._error

    def clear(self) -> None:
        """Forgets an error."""
        with self._lock:
            self._error = ""

    def close(self) -> None:
        """Ends the thread."""
        self._commands.put(None)
        self._thread.join(timeout=5.0)
