"""Engines run workers: they start them, send them batches, and return their answers."""

from __future__ import annotations

import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
from multiprocessing import Pipe
from multiprocessing.connection import Connection, wait
from typing import Protocol

from .packing import Packed
from .worker import Answer, Batch, Worker


class WorkerDied(Exception):
    """A worker died. The message says how.

    Attributes:
        started: Whether the worker was ready for batches; otherwise none of them is to blame.
    """

    def __init__(self, how: str, started: bool = True):
        super().__init__(how)
        self.started = started


class Engine(Protocol):
    """Workers with indices from 0. Each computes its batches in the order of sending."""

    workers: int

    def send(self, worker: int, batch: Batch) -> None:
        """Sends a batch to a worker without waiting."""

    def receive(self, seconds: float) -> list[tuple[int, Answer | WorkerDied]]:
        """Waits for answers, at most `seconds`. A worker that died has lost its unanswered batches; a new one without
        scenes replaces it."""

    def stop(self) -> None:
        """Ends all workers, if possible without waiting for their computations."""


class ThreadEngine:
    """Threads of this process. Functions of Kinegraph run in parallel; Python code shares the interpreter lock."""

    def __init__(self, workers: int, function: Packed, seed: int):
        self.workers = workers
        self._batches: list[queue.SimpleQueue[Batch | None]] = [queue.SimpleQueue() for _ in range(workers)]
        self._answers: queue.SimpleQueue[tuple[int, Answer]] = queue.SimpleQueue()
        self._stopped = threading.Event()
        for number in range(workers):
            threading.Thread(target=self._work, args=(number, Worker(function, seed)), daemon=True).start()

    def _work(self, number: int, worker: Worker) -> None:
        while (batch := self._batches[number].get()) is not None and not self._stopped.is_set():
            self._answers.put((number, worker.run(batch)))

    def send(self, worker: int, batch: Batch) -> None:
        self._batches[worker].put(batch)

    def receive(self, seconds: float) -> list[tuple[int, Answer | WorkerDied]]:
        try:
            return [self._answers.get(timeout=seconds)]
        except queue.Empty:
            return []

    def stop(self) -> None:
        self._stopped.set()
        for batches in self._batches:
            batches.put(None)


class _Process:
    """A worker process: a separate program, which does not run the caller's script again."""

    def __init__(self, function: Packed, seed: int):
        self.connection, far = Pipe()
        paths = [os.path.abspath(path) for path in sys.path]  # "" is Python's start folder
        self.process = subprocess.Popen(
            [sys.executable, "-m", "kinegraph.fleets.worker", str(far.fileno())],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
            pass_fds=[far.fileno()],
            start_new_session=True,  # Ctrl-C reaches the caller only
            stdin=subprocess.DEVNULL,
        )
        far.close()
        self.started = False
        self.sender = _Sender(self.connection)
        self.sender.send(pickle.dumps(paths))
        self.sender.send(pickle.dumps((function, seed)))

    def end(self) -> str:
        """Ends the process, if it runs, and returns how it ended."""
        self.sender.stop()
        if self.process.poll() is None:
            try:
                self.process.wait(0.2)  # its connection closes a moment before its end
            except subprocess.TimeoutExpired:
                self.process.kill()
        code = self.process.wait()
        self.connection.close()
        return f"killed by {signal.Signals(-code).name}" if code < 0 else f"ended with status {code}"


class _Sender:
    """Writes to a worker from a thread, so that a full pipe does not block the caller."""

    def __init__(self, connection: Connection):
        self._connection = connection
        self._messages: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._write, daemon=True)
        self._thread.start()

    def _write(self) -> None:
        try:
            while (message := self._messages.get()) is not None:
                self._connection.send_bytes(message)
        except OSError:  # the worker died, which the receiver notices
            pass

    def send(self, message: bytes) -> None:
        self._messages.put(message)

    def stop(self) -> None:
        self._messages.put(None)


class ProcessEngine:
    """Processes of this machine."""

    def __init__(self, workers: int, function: Packed, seed: int):
        self.workers = workers
        self._start = lambda: _Process(function, seed)
        self._processes = [self._start() for _ in range(workers)]

    def send(self, worker: int, batch: Batch) -> None:
        self._processes[worker].sender.send(pickle.dumps(batch))

    def receive(self, seconds: float) -> list[tuple[int, Answer | WorkerDied]]:
        numbers = {process.connection: number for number, process in enumerate(self._processes)}
        events: list[tuple[int, Answer | WorkerDied]] = []
        for connection in wait(list(numbers), seconds):
            number = numbers[connection]
            process = self._processes[number]
            try:
                message = connection.recv_bytes()
                if process.started:
                    events.append((number, pickle.loads(message)))
                process.started = True  # the first message is empty
            except (EOFError, OSError):
                events.append((number, WorkerDied(process.end(), process.started)))
                self._processes[number] = self._start()
        return events

    def stop(self) -> None:
        for process in self._processes:
            process.process.kill()
        for process in self._processes:
            process.end()
