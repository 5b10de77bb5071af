"""A Python program that uses the viewer, as a person would run it without a terminal."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import sys
import threading
from pathlib import Path

PATIENCE = 60.0  # s; much more than a busy machine needs


class KinematicModel:
    """Runs `code` after `import kinegraph as kg`, with KINEGRAPH_HEADLESS and the display taken away."""

    def __init__(self, code: str, folder: Path, environment: dict[str, str]) -> None:
        hidden = ("KINEGRAPH_HEADLESS", "DISPLAY", "WAYLAND_DISPLAY", "SSH_CONNECTION")
        inherited = {name: value for name, value in os.environ.items() if name not in hidden}
        self._process = subprocess.Popen(
            [sys.executable, "-u", "-c", "import kinegraph as kg\n" + code],
            cwd=folder,
            text=True,
            env=inherited | environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self._lines: queue.Queue[str | None] = queue.Queue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        self.output = ""

    def _read(self) -> None:
        assert self._process.stdout
        with self._process.stdout as lines:
            for line in lines:
                self._lines.put(line.rstrip("\n"))
        self._lines.put(None)

    def line(self, start: str) -> str:
        """Waits for a line of output that begins with `start`; returns its rest."""
        while (line := self._lines.get(timeout=PATIENCE)) is not None:
            self.output += line + "\n"
            if line.startswith(start):
                return line[len(start) :].strip()
        raise AssertionError(f"the program ended without printing {start!r}; it printed:\n{self.output}")

    def url(self) -> str:
        return self.line("Viewer:")

    def interrupt(self) -> None:
        """Presses Ctrl-C."""
        self._process.send_signal(signal.SIGINT)

    def end(self) -> int:
        """Waits for the end; returns the exit code."""
        code = self._process.wait(PATIENCE)
        self._reader.join()
        return code

    def kill(self) -> None:
        self._process.kill()
        self.end()
