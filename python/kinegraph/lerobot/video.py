"""Films of episodes."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ArgumentError, FileError
from .layout import needed

# a key frame at every second image, so that any image is decoded fast
CODECS: dict[str, tuple[str, dict[str, str]]] = {
    "h264": (
        "libx264",
        {"g": "2", "crf": "23", "preset": "veryfast", "x264-params": "threads=1:lookahead-threads=1:sync-lookahead=0"},
    ),
    "av1": ("libsvtav1", {"g": "2", "crf": "30", "preset": "12", "svtav1-params": "lp=1"}),
}


class Film:
    """A film of one camera with the images of several episodes."""

    def __init__(self, path: Path, fps: int, size: tuple[int, int], codec: str):
        av = needed("av")
        if codec not in CODECS:
            raise ArgumentError(f"LeRobotWriter: codec is {codec!r}; expected one of {', '.join(CODECS)}")
        name, options = CODECS[codec]
        path.parent.mkdir(parents=True, exist_ok=True)
        self._path, self._fps, self._size, self._count = path, fps, size, 0
        try:
            self._container: Any = av.open(str(path), "w", format="mp4", options={"movflags": "faststart"})
            self._stream: Any = self._container.add_stream(name, rate=fps, options=options)
        except (OSError, av.error.FFmpegError) as error:
            raise FileError(f"LeRobotWriter: cannot write '{path}': {error}") from None
        self._stream.height, self._stream.width = size
        self._stream.pix_fmt = "yuv420p"
        self._stream.codec_context.thread_count = 1
        self._frame = av.VideoFrame

    def add(self, images: list[np.ndarray]) -> tuple[float, float]:
        """Adds the images of an episode; returns their first and last time in the film, s."""
        begin = self._count / self._fps
        for image in images:
            frame = self._frame.from_ndarray(np.ascontiguousarray(image), "rgb24")
            frame.pts, frame.time_base = self._count, Fraction(1, self._fps)
            self._count += 1
            self._write(frame)
        return begin, self._count / self._fps

    def _write(self, frame: Any) -> None:
        with self._named():
            for packet in self._stream.encode(frame):
                self._container.mux(packet)

    @contextlib.contextmanager
    def _named(self) -> Iterator[None]:
        """Raises FileError, with the name of the file, if it cannot be written."""
        try:
            yield
        except OSError as error:
            reason = os.strerror(error.errno) if error.errno else str(error)
            raise FileError(f"LeRobotWriter: cannot write '{self._path}': {reason}") from None

    def close(self) -> None:
        """Ends the film."""
        self._write(None)
        with self._named():
            self._container.close()
