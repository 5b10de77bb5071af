"""Where workers live. An engine starts workers, hands them batches one after another, and says what came back."""

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
    """A worker is gone. Its text says how."""


class Engine(Protocol):
    """Workers with numbers from 0. Each computes its batches in the order in which they were sent."""

    workers: int

    def send(self, worker: int, batch: Batch) -> None:
        """Hands a batch to a worker and does not wait."""

    def receive(self, seconds: float) -> list[tuple[int, Answer | WorkerDied]]:
        """Waits until there is an answer, at most for `seconds`. A worker that died has lost all batches that it did not answer;
        another one is in its place, which knows no scenes."""

    def stop(self) -> None:
        """Ends all workers, without waiting for what they compute, as far as that can be done."""


class ThreadEngine:
    """Threads of this process. Functions of Kinegraph run at the same time in them; those in Python take turns."""

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
    """A worker in a process. It is a program of its own and does not run the caller's script again."""

    def __init__(self, function: Packed, seed: int):
        self.connection, far = Pipe()
        paths = [os.path.abspath(path) for path in sys.path]  # "" is the folder that Python was started in
        self.process = subprocess.Popen(
            [sys.executable, "-m", "kinegraph.fleets.worker", str(far.fileno())],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
            pass_fds=[far.fileno()],
            start_new_session=True,  # Ctrl-C is for the caller
            stdin=subprocess.DEVNULL,
        )
        far.close()
        self.sender = _Sender(self.connection)
        self.sender.send(pickle.dumps(paths))
        self.sender.send(pickle.dumps((function, seed)))

    def end(self) -> str:
        """Ends it, if it runs, and says how it ended."""
        self.sender.stop()
        if self.process.poll() is None:
            try:
                self.process.wait(0.2)  # its connection closes a moment before it is gone
            except subprocess.TimeoutExpired:
                self.process.kill()
        code = self.process.wait()
        self.connection.close()
        return f"killed by {signal.Signals(-code).name}" if code < 0 else f"ended with status {code}"


class _Sender:
    """Writes to a worker from a thread, so that a worker whose pipe is full keeps nobody waiting."""

    def __init__(self, connection: Connection):
        self._connection = connection
        self._messages: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._write, daemon=True)
        self._thread.start()

    def _write(self) -> None:
        try:
            while (message := self._messages.get()) is not None:
                self._connection.send_bytes(message)
        except OSError:  # the worker died, which its answers tell
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
            try:
                events.append((number, pickle.loads(connection.recv_bytes())))
            except (EOFError, OSError):
                events.append((number, WorkerDied(self._processes[number].end())))
                self._processes[number] = self._start()
        return events

    def stop(self) -> None:
        for process in self._processes:
            process.process.kill()
        for process in self._processes:
            process.end()
