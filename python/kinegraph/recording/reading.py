"""Reads recordings: MCAP files and bags of rosbag2."""

from __future__ import annotations

import os
import re
import sqlite3
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .._core import JT, Config, GripperState, KinematicDriver, RecordedDriver, RobotInfo, RobotState, SampledTrajectory
from ..errors import ArgumentError, FileError, KinegraphWarning, NotFound
from . import messages
from .poses import framesOf, movingJoints

Message = tuple[str, str, int, bytes]  # topic, type, time (ns), CDR


class Recording:
    """A recorded motion.

    Attributes:
        path: Path of the file or folder.
        topics: The number of messages per topic.
        types: The type of the messages per topic.
        joints: Names of the joints, n.
        times: Times of the joint states, s, from 0. Shape (T,).
        start: Unix time of time 0, s; 0 for a recording in control time that begins at 0.
        q, velocity: Shape (T, n), rad or m, and per s. Velocities that were not recorded are differences of q.
        effort: Shape (T, n), N m or N; shape (T, 0) if it was not recorded.
        complete: False if the file was not closed, as after a crash, or is damaged; its complete parts were read.
    """

    def __init__(self, path: Path):
        """Creates an empty recording, which readRecording fills.

        Args:
            path: Path of the file or folder.
        """
        self.path = path
        self.topics: dict[str, int] = {}
        self.types: dict[str, str] = {}
        self.joints: list[str] = []
        self.times, self.start = np.zeros(0), 0.0
        self.q, self.velocity, self.effort = np.zeros((0, 0)), np.zeros((0, 0)), np.zeros((0, 0))
        self.complete = True

    def __repr__(self) -> str:
        length = self.times[-1] if len(self.times) else 0.0
        return f"<Recording '{self.path.name}', {length:.2f} s, {len(self.joints)} joints, {len(self.topics)} topics>"

    def trajectory(
        self,
        config: Config,
        begin: float = 0.0,
        end: float = float("inf"),
        *,
        speed: float = 1.0,
        names: Mapping[str, str] | None = None,
    ) -> SampledTrajectory:
        """Returns the recorded motion of the joints of a scene, for `bot.follow`, which checks the limits.

        Args:
            config: The scene.
            begin, end: The part of the recording, s.
            speed: Factor on the speed.
            names: Recorded names of joints that have other names in the scene: {scene: recorded}.
        Returns:
            A trajectory through all recorded states.
        Raises:
            NotFound: A joint of the scene was not recorded, as in a recording of another robot.
            ArgumentError: Fewer than two states are in the part, a number is not finite, or speed is not positive.
        """
        if not 0 < speed < float("inf"):
            raise ArgumentError(f"Recording.trajectory: speed is {speed}; expected a number above 0")
        columns = self._columns("Recording.trajectory", config, names)
        rows = np.flatnonzero((self.times >= begin) & (self.times <= end))
        if len(rows) < 2:
            raise ArgumentError(
                f"Recording.trajectory: {len(rows)} recorded states lie between {begin} s and {end} s; expected 2 or more"
            )
        self._requireFinite("Recording.trajectory", rows, columns, "choose a part without it by begin and end")
        times, q, velocity = self.times[rows], self.q[rows][:, columns], self.velocity[rows][:, columns]
        acceleration = np.gradient(velocity, times, axis=0)
        return SampledTrajectory((times - times[0]) / speed, q, velocity * speed, acceleration * speed**2)

    def driver(
        self, config: Config, *, names: Mapping[str, str] | None = None, grippers: bool = True
    ) -> RecordedDriver:
        """Returns a robot that repeats the recorded states, one per control period, for tests.

        Args:
            config: The scene.
            names: As in `trajectory`.
            grippers: Whether the driver has the grippers of the scene whose fingers were recorded.
        Returns:
            The driver; its info has the joints and limits of the scene.
        Raises:
            NotFound: A joint of the scene was not recorded.
            ArgumentError: There are no joint states.
        """
        columns = self._columns("Recording.driver", config, names)
        if not len(self.times):
            raise ArgumentError("Recording.driver: the recording has no joint states")
        info = RobotInfo.of(config, f"recording {self.path.name}")
        hands = self._hands(config) if grippers else []
        info.grippers = [hand for hand, _ in hands]
        states = [
            RobotState(
                float(time),
                self.q[row, columns],
                self.velocity[row, columns],
                self.effort[row, columns] if self.effort.size else [],
                grippers=[GripperState(2.0 * float(self.q[row, column]), True) for _, column in hands],
            )
            for row, time in enumerate(self.times)
        ]
        return RecordedDriver(info, states)

    def frames(self, config: Config, rate: float = 25.0, *, names: Mapping[str, str] | None = None) -> np.ndarray:
        """Returns the recorded poses of all frames of a scene, for `saveFilm` and `C.setFrameState`.

        Joints have their recorded values, fingers, too, and objects the poses of the topics /tf and /tf_static, in
        "world" or in another frame of the scene. A warning names other parents, such as "map": add a frame of that name
        to the scene, or the objects in it are not moved. All other frames stay in their place.

        Args:
            config: The scene, which does not change.
            rate: Number of poses per second; each is the last recorded one.
            names: As in `trajectory`.
        Returns:
            World poses, shape (T, frames, 7): x y z qw qx qy qz.
        Raises:
            NotFound: A joint of the scene was not recorded.
            ArgumentError: The rate is not positive, there are no joint states, or a joint value is not finite.
        """
        if not 0 < rate < float("inf"):
            raise ArgumentError(f"Recording.frames: rate is {rate}; expected a number > 0")
        if not len(self.times):
            raise ArgumentError("Recording.frames: the recording has no joint states")
        self._columns("Recording.frames", config, names)
        scene_name = {recorded: scene for scene, recorded in (names or {}).items()}
        joints = [scene_name.get(name, name) for name in self.joints]
        at = self.start + np.arange(0, self.times[-1] + 0.5 / rate, 1 / rate) + 1e-6
        rows = np.searchsorted(self.times, at - self.start, side="right") - 1
        columns = [joints.index(name) for part in movingJoints(config, joints) for name in part]
        self._requireFinite("Recording.frames", rows, columns, "replace it in recording.q", with_velocity=False)
        return np.array(framesOf(config, joints, zip(self.q[rows], self._transforms(at))))

    def _transforms(self, at: np.ndarray) -> list[list[Any]]:
        """The transforms that were recorded up to each time, after the one before; `at` in s of the recording."""
        found: list[list[Any]] = [[] for _ in at]
        for topic, kind, _, data in _read(self.path)[0]:
            if kind == messages.TRANSFORMS and topic in ("/tf", "/tf_static"):
                for stamped in messages.decode(data, kind).transforms:
                    stamp = stamped.header.stamp
                    row = int(np.searchsorted(at, stamp.sec + stamp.nanosec / 1e9))
                    if row < len(found):
                        found[row].append(stamped)
        return found

    def images(self, topic: str) -> tuple[np.ndarray, list[np.ndarray]]:
        """Reads the images of a topic of CompressedImage.

        Args:
            topic: Name of the topic, or of the camera in recordings of `recordTo`.
        Returns:
            Times in s, shape (T,), from the start of the recording; and images, shape (height, width, 3), 0..255.
        Raises:
            NotFound: There is no such topic.
        """
        name = topic if topic in self.types else f"/{topic}/image/compressed"
        if self.types.get(name) != messages.IMAGE:
            known = [topic for topic, kind in self.types.items() if kind == messages.IMAGE]
            raise NotFound(
                f"Recording.images: no images '{topic}' in '{self.path}'; images: {', '.join(known) or 'none'}"
            )
        found = [
            (time, messages.decode(data, messages.IMAGE)) for at, _, time, data in _read(self.path)[0] if at == name
        ]
        times = np.array([time / 1e9 - self.start for time, _ in found])
        return times, [messages.decodeImage(bytes(image.data)) for _, image in found]

    def _columns(self, caller: str, config: Config, names: Mapping[str, str] | None) -> list[int]:
        given = dict(names or {})
        wanted = config.getJointNames()
        for name in given:
            if name not in wanted:
                raise NotFound(f"{caller}: names has '{name}', which is no joint of the scene: {', '.join(wanted)}")
        missing = [given.get(name, name) for name in wanted if given.get(name, name) not in self.joints]
        if missing:
            raise NotFound(
                f"{caller}: '{self.path.name}' has no joint '{missing[0]}' ({len(missing)} of {len(wanted)} are missing); "
                f"it has {', '.join(self.joints) or 'none'}; pass names={{scene: recorded}} if names differ"
            )
        return [self.joints.index(given.get(name, name)) for name in wanted]

    def _requireFinite(
        self, caller: str, rows: np.ndarray, columns: Sequence[int], remedy: str, with_velocity: bool = True
    ) -> None:
        read = [self.q, self.velocity] if with_velocity else [self.q]
        broken = np.argwhere(~np.all([np.isfinite(values[rows][:, columns]) for values in read], axis=0))
        if len(broken):
            row, column = broken[0]
            raise ArgumentError(
                f"{caller}: the state of joint '{self.joints[columns[column]]}' at {self.times[rows[row]]:.3f} s is not "
                f"finite; {remedy}"
            )

    def _hands(self, config: Config) -> list[tuple[Any, int]]:
        hands = []
        for gripper in KinematicDriver(config).info().grippers:
            frame = config.getFrame(gripper.name)
            fingers = [joint for joint in self.joints if joint not in config.getJointNames()]
            under = _fingersNear(config, frame, fingers)
            if under:
                hands.append((gripper, self.joints.index(under)))
        return hands


def _fingersNear(config: Config, frame: Any, fingers: list[str]) -> str:
    """Returns the first recorded finger joint below the link that carries a gripper's frame."""
    link: Any = frame
    while link.getParent() is not None and link.getJointType() in (JT.none, JT.rigid):
        link = link.getParent()
    for name in config.getFrameNames():
        if name not in fingers:
            continue
        above: Any = config.getFrame(name)
        while above is not None and above.name != link.name:
            above = above.getParent()
        if above is not None:
            return str(name)
    return ""


def readRecording(path: str | os.PathLike[str], topic: str = "/joint_states") -> Recording:
    """Reads a recording of `recordTo`, any MCAP file of ROS 2, or a bag of rosbag2 (MCAP or SQLite).

    Joint states of several publishers on the topic are merged by name: a state has the latest value of each joint.
    A file that was not closed, as after a crash, is read up to its last complete part, with a warning.

    Args:
        path: A file .mcap or .db3, or the folder of a bag.
        topic: The topic of joint states; "/joint_commands" are the references of a recording of `bot.recordTo`.
    Returns:
        A Recording; without joint states if the topic is missing and no other one has them.
    Raises:
        FileError: The file is missing, or is no recording.
        NotFound: The topic is missing, but others have joint states. Or the extra `mcap` is not installed.
    """
    recording = Recording(Path(path))
    stream, state = _read(recording.path)
    found: list[tuple[int, int, Any]] = []
    for at, kind, time, data in stream:
        recording.topics[at] = recording.topics.get(at, 0) + 1
        recording.types[at] = kind
        if at == topic and kind == messages.JOINT_STATE:
            try:
                message = messages.decode(data, kind)
            except Exception as error:
                raise FileError(f"readRecording: '{path}': a message of {at} is no {kind}: {error}") from None
            found.append((message.header.stamp.sec * 10**9 + message.header.stamp.nanosec, time, message))
    recording.complete = state.complete and not state.damaged
    others = [name for name, kind in recording.types.items() if kind == messages.JOINT_STATE and name != topic]
    if not found and others:
        raise NotFound(f"readRecording: '{path}' has no joint states on '{topic}'; it has them on {', '.join(others)}")
    _fill(recording, found)
    if state.damaged:
        warnings.warn(
            f"readRecording: '{path}' has {state.damaged} damaged parts, which are left out", KinegraphWarning, 2
        )
    if not state.complete:
        end = f"{recording.times[-1]:.2f} s" if len(recording.times) else "its first part"
        warnings.warn(
            f"readRecording: '{path}' was not closed, as after a crash; it is read up to {end}", KinegraphWarning, 2
        )
    return recording


def _fill(recording: Recording, found: list[tuple[int, int, Any]]) -> None:
    """Merges the joint states."""
    stamped = any(stamp for stamp, _, _ in found)
    names: dict[str, int] = {}
    for _, _, message in found:
        for name in message.name:
            names.setdefault(str(name), len(names))
    latest = np.full((3, len(names)), np.nan)
    known = np.zeros(len(names), bool)
    times: list[int] = []
    rows: list[np.ndarray] = []
    for stamp, logged, message in found:
        columns = [names[str(name)] for name in message.name]
        for row, values in enumerate((message.position, message.velocity, message.effort)):
            if len(values) == len(columns):
                latest[row, columns] = values
        known[columns] = True
        time = stamp if stamped else logged
        if not known.all() or (times and time < times[-1]):
            continue
        if times and time == times[-1]:
            rows[-1] = latest.copy()
        else:
            times.append(time)
            rows.append(latest.copy())
    if not times:
        return
    all_rows = np.array(rows)
    recording.joints = list(names)
    recording.start = times[0] / 1e9
    recording.times = np.array([time - times[0] for time in times]) / 1e9
    recording.q, recording.velocity, effort = all_rows[:, 0], all_rows[:, 1], all_rows[:, 2]
    recording.effort = effort if np.isfinite(effort).all() else np.zeros((len(times), 0))
    unknown = np.isnan(recording.velocity).all(axis=0)
    if unknown.any() and len(times) > 1:
        recording.velocity[:, unknown] = np.gradient(recording.q[:, unknown], recording.times, axis=0)
    elif unknown.any():
        recording.velocity[:, unknown] = 0.0


# --- files ------------------------------------------------------------------------------------------------------------


def _natural(path: Path) -> list[Any]:
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", path.name)]


@dataclass
class _FileState:
    complete: bool = True
    damaged: int = 0  # chunks


def _read(path: Path) -> tuple[Iterator[Message], _FileState]:
    """Returns the messages in their order, and a state that is valid after the last one."""
    state = _FileState()
    files = [path]
    metadata = path / "metadata.yaml"
    if metadata.is_file() and re.search(r"compression_mode:\s*['\"]?(FILE|MESSAGE)", metadata.read_text(), re.I):
        return _readCompressed(path), state
    if path.is_dir():
        files = sorted([*path.glob("*.mcap"), *path.glob("*.db3")], key=_natural)
        if not files:
            raise FileError(f"readRecording: the folder '{path}' has no files .mcap or .db3; is it a bag of rosbag2?")
    elif not path.is_file():
        raise FileError(f"readRecording: there is no file '{path}'")

    def read() -> Iterator[Message]:
        for file in files:
            yield from _readSqlite(file) if file.suffix == ".db3" else _readMcap(file, state)

    return read(), state


def _readMcap(path: Path, state: _FileState) -> Iterator[Message]:
    """Reads chunk by chunk. A damaged chunk is left out; damage between chunks ends the reading."""
    reading = messages.needed("mcap.stream_reader")
    records = messages.needed("mcap.records")
    errors = messages.needed("mcap.exceptions")
    schemas: dict[int, str] = {}
    channels: dict[int, tuple[str, str]] = {}
    ended = found = False
    with open(path, "rb") as file:
        stream = iter(reading.StreamReader(file, emit_chunks=True).records)
        while True:
            try:
                record = next(stream, None)
                found = found or record is not None
            except errors.InvalidMagic:
                if not found:
                    raise FileError(f"readRecording: '{path}' is not an MCAP file") from None
                break
            except Exception:  # whatever the package raises on arbitrary bytes
                break
            if record is None or isinstance(record, records.Footer):
                ended = record is not None
                break
            try:
                parts = reading.breakup_chunk(record, True) if isinstance(record, records.Chunk) else [record]
            except Exception:
                state.damaged += 1
                continue
            for part in parts:
                if isinstance(part, records.Schema):
                    schemas[part.id] = part.name
                elif isinstance(part, records.Channel):
                    kind = schemas.get(part.schema_id, "") if part.message_encoding == "cdr" else ""
                    channels[part.id] = (part.topic, kind or f"{part.message_encoding} message")
                elif isinstance(part, records.Message) and part.channel_id in channels:
                    yield (*channels[part.channel_id], part.log_time, part.data)
    state.complete = state.complete and ended


def _readCompressed(path: Path) -> Iterator[Message]:
    """Reads a bag whose files or messages are compressed."""
    rosbag2 = messages.needed("rosbags.rosbag2")
    try:
        with rosbag2.Reader(path) as reader:
            for connection, time, data in reader.messages():
                yield connection.topic, connection.msgtype, time, bytes(data)
    except Exception as error:
        raise FileError(f"readRecording: '{path}' is not a readable bag of rosbag2: {error}") from None


def _readSqlite(path: Path) -> Iterator[Message]:
    query = "SELECT name, type, timestamp, data FROM messages JOIN topics ON topics.id = topic_id ORDER BY timestamp"
    try:
        connection = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        try:
            yield from connection.execute(query)
        finally:
            connection.close()
    except sqlite3.Error as error:
        raise FileError(f"readRecording: '{path}' is not a bag of rosbag2: {error}") from None
