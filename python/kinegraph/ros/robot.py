"""The robot behind a RosBridge: its states at a rate, and calls on it, in real or in virtual time."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._core import BotOp, Config
from ..errors import ArgumentError, RobotFault


@dataclass(frozen=True)
class State:
    """The state of a robot: joints in rad or m, control time in s, openings of grippers in m."""

    time: float
    q: np.ndarray
    velocity: np.ndarray
    reference: np.ndarray
    reference_velocity: np.ndarray
    to_end: float  # s until the motion ends
    widths: tuple[float, ...]
    fault: str


class Closed(Exception):
    """The bridge was closed."""


class Robot:
    """Reads a robot at a rate and passes its states on.

    In real time a thread does that. In virtual time it happens while calls of the robot wait, and commands of other
    threads wait for that, too: the robot has one thread.
    """

    def __init__(self, bot: BotOp, rate: float, is_virtual: bool):
        """Keeps the robot; start() begins.

        Args:
            bot: The robot.
            rate: States per second, Hz.
            is_virtual: The time of the robot is virtual.
        Raises:
            ArgumentError: The time of the robot is virtual, and is_virtual is False.
        """
        self.bot, self.is_virtual = bot, is_virtual
        self.joints = list(bot.getInfo().joints)
        self.grippers = list(bot.getInfo().grippers)
        self._period = 1.0 / rate
        self._tasks: queue.SimpleQueue[tuple[Future[Any], Callable[[], Any]]] = queue.SimpleQueue()
        self._changed = threading.Condition()
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._state: State | None = None
        self._count = 0
        self._publish: Callable[[State, Config], None] = lambda state, world: None
        if not is_virtual:
            times = [bot.stepObservation().ctrlTime for _ in range(4)]
            if (np.diff(times) > 1e-6).all():  # queries advance virtual time only
                raise ArgumentError(
                    "RosBridge: the robot has virtual time; expected BotOp(C, realtime=True), or clock=True for nodes "
                    "with use_sim_time"
                )

    def start(self, publish: Callable[[State, Config], None]) -> None:
        """Begins to read.

        Args:
            publish: Called with each state and the scene in that state.
        """
        self._publish = publish
        if self.is_virtual:
            self.bot.watch(self._period, self._watch)
        else:
            self._thread.start()

    def close(self) -> None:
        """Ends the thread; calls that wait raise Closed."""
        self._ended.set()
        with self._changed:
            self._changed.notify_all()
        while not self._tasks.empty():
            self._tasks.get()[0].set_exception(Closed())
        if self._thread.is_alive():
            self._thread.join(timeout=2.0)

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Calls a function that commands the robot: now, or, in virtual time, in its next control period.

        Args:
            function: The function.
            arguments: Its arguments.
        Returns:
            Its result.
        """
        if not self.is_virtual:
            return function(*arguments)
        future: Future[Any] = Future()
        self._tasks.put((future, lambda: function(*arguments)))
        while not self._ended.is_set():
            try:
                return future.result(timeout=0.2)
            except TimeoutError:
                if future.done():
                    raise
        raise Closed()

    def next(self) -> State:
        """Waits for the next state and returns it.

        Raises:
            Closed: The bridge was closed.
        """
        with self._changed:
            seen = self._count
            while self._count == seen or self._state is None:
                if self._ended.is_set():
                    raise Closed()
                self._changed.wait(0.2)
            return self._state

    def observe(self) -> State:
        """Returns the present state; in virtual time only within `call`."""
        bot = self.bot
        seen = bot.stepObservation()
        widths = tuple(bot.getGripperPos(i) for i in range(len(self.grippers)))
        return State(
            seen.ctrlTime,
            seen.qpos,
            seen.qvel,
            seen.qref,
            seen.qvel_ref,
            bot.getTimeToEnd(),
            widths,
            bot.getFault(),
        )

    def _pulse(self) -> None:
        while not self._tasks.empty():
            future, task = self._tasks.get()
            try:
                future.set_result(task())
            except Exception as error:
                future.set_exception(error)
        state = self.observe()
        self._publish(state, self.bot.getWorld())
        with self._changed:
            self._state, self._count = state, self._count + 1
            self._changed.notify_all()

    def _watch(self, now: float) -> bool:
        if not self._ended.is_set():
            self._pulse()
        return not self._ended.is_set()

    def _run(self) -> None:
        due = time.monotonic()
        while not self._ended.is_set():
            try:
                self._pulse()
            except RobotFault:
                return  # the robot is closed
            due = max(due + self._period, time.monotonic() - 5.0 * self._period)
            time.sleep(max(0.0, due - time.monotonic()))
