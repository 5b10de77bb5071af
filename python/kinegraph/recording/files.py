"""MCAP files in writing."""

from __future__ import annotations

import os
from typing import Any

from ..errors import FileError
from .messages import definition, needed

CHUNK = 32768  # bytes before compression: this much is lost at most when the process is killed

# Topics whose last message late subscribers of a replay need, too.
LATCHED = ("/robot_description", "/tf_static")
_LATCHED_QOS = """- history: 1
  depth: 1
  reliability: 1
  durability: 1
  deadline: {sec: 2147483647, nsec: 4294967295}
  lifespan: {sec: 2147483647, nsec: 4294967295}
  liveliness: 1
  liveliness_lease_duration: {sec: 2147483647, nsec: 4294967295}
  avoid_ros_namespace_conventions: false
"""


class _Stream:
    """A file whose bytes reach the system at once; a failed write leaves no part of itself."""

    def __init__(self, path: str):
        self._file = open(path, "wb", buffering=0)  # noqa: SIM115
        self._size = 0

    def write(self, data: Any) -> int:
        view, done = memoryview(data), 0
        try:
            while done < len(view):
                done += self._file.write(view[done:]) or 0
        except OSError:
            if self._file.seekable() and os.path.isfile(self._file.name):
                self._file.truncate(self._size)
                self._file.seek(self._size)
            raise
        self._size += done
        return done

    def tell(self) -> int:
        return self._size

    def close(self) -> None:
        self._file.close()


class McapFile:
    """An MCAP file of messages of ROS 2, compressed with zstd.

    Chunks of 32 kB are written as soon as they are full, so that a file of a killed process has all but the last one.
    """

    def __init__(self, path: str, caller: str):
        """Creates the file.

        Args:
            path: Its path; an existing file is replaced.
            caller: Name of the function for messages.
        Raises:
            FileError: The file cannot be written.
            NotFound: The extra `mcap` is not installed.
        """
        writing = needed("mcap.writer")
        definition("std_msgs/msg/String")  # refuses a missing package before the file is touched
        self._path, self._caller, self._last = path, caller, ""
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._stream: _Stream | None = None
        try:
            self._stream = _Stream(path)
            self._writer = writing.Writer(self._stream, chunk_size=CHUNK, compression=writing.CompressionType.ZSTD)
            self._writer.start(profile="ros2", library="kinegraph")
        except OSError as error:
            self._fail(error)

    def _fail(self, error: OSError) -> None:
        if self._stream is not None:
            self._stream.close()
        self._stream = None
        raise FileError(f"{self._caller}: cannot write '{self._path}': {error.strerror or error}{self._last}") from None

    @property
    def closed(self) -> bool:
        """True after close, or after an error."""
        return self._stream is None

    def send(self, topic: str, kind: str, data: bytes, time: int) -> None:
        """Writes a message.

        Args:
            topic: Name of the topic.
            kind: Type of the message.
            data: The message as CDR.
            time: Time, ns.
        Raises:
            FileError: The file cannot be written, for instance because the disk is full. It is complete up to there.
        """
        if self._stream is None:
            return
        try:
            if kind not in self._schemas:
                self._schemas[kind] = self._writer.register_schema(kind, "ros2msg", definition(kind).encode())
            if topic not in self._channels:
                qos = {"offered_qos_profiles": _LATCHED_QOS} if topic in LATCHED else {}
                self._channels[topic] = self._writer.register_channel(topic, "cdr", self._schemas[kind], qos)
            self._writer.add_message(self._channels[topic], time, data, time)
        except OSError as error:
            self._fail(error)
        self._last = f"; the recording ends shortly before its time {time / 1e9:.2f} s"

    def close(self) -> None:
        """Ends the file with its index.

        Raises:
            FileError: The index cannot be written. All messages before the last chunk are in the file.
        """
        if self._stream is None:
            return
        try:
            self._writer.finish()
        except OSError as error:
            self._fail(error)
        stream, self._stream = self._stream, None
        stream.close()
