"""Targets that come as a stream: from the browser, a file, a gamepad or a function."""

from __future__ import annotations

import csv
import os
import struct
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ._core import Config, DiffIk
from .errors import ArgumentError, FileError

Pose = npt.NDArray[np.float64]


class TargetFile:
    """Poses at times, from a text file: rows of t x y z, or t x y z qw qx qy qz, in s and m.

    Numbers are separated by commas; empty lines, lines that begin with # and a header are left out. Between rows positions
    go straight and rotations turn evenly; before the first and after the last row the pose stays.
    """

    def __init__(self, path: str | os.PathLike[str]):
        """Reads the file.

        Args:
            path: The file.
        Raises:
            FileError: It cannot be read, or a row is not as expected; says which.
        """
        self.path = Path(path)
        try:
            lines = self.path.read_text().splitlines()
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"TargetFile: cannot read '{path}': {error}") from error
        rows: list[list[float]] = []
        for number, fields in enumerate(csv.reader(lines), 1):
            if not fields or not "".join(fields).strip() or fields[0].lstrip().startswith("#"):
                continue
            try:
                row = [float(field.strip()) for field in fields]
            except ValueError as error:
                if not rows and not any(character.isdigit() for character in "".join(fields)):
                    continue  # a header
                raise FileError(f"{path}:{number}: {error}; expected numbers t, x, y, z") from error
            self._check(row, rows, number)
            rows.append(row)
        if not rows:
            raise FileError(f"TargetFile: '{path}' has no rows; expected t, x, y, z or t, x, y, z, qw, qx, qy, qz")
        self._rows = np.array(rows)
        quaternions = self._rows[:, 4:]
        if quaternions.size:
            quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
            for before, after in pairwise(quaternions):
                after *= -1.0 if before @ after < 0 else 1.0

    def _check(self, row: list[float], before: list[list[float]], number: int) -> None:
        widths = (len(before[0]),) if before else (4, 8)
        if len(row) not in widths:
            expected = " or ".join(map(str, widths))
            raise FileError(f"{self.path}:{number}: {len(row)} numbers; expected {expected}")
        if not np.all(np.isfinite(row)):
            raise FileError(f"{self.path}:{number}: numbers that are not finite")
        if len(row) == 8 and not any(row[4:]):
            raise FileError(f"{self.path}:{number}: the quaternion is zero")
        if before and row[0] <= before[-1][0]:
            raise FileError(f"{self.path}:{number}: time {row[0]} does not come after {before[-1][0]}")

    @property
    def duration(self) -> float:
        """Time of the last row, s."""
        return float(self._rows[-1, 0])

    def __call__(self, t: float) -> Pose:
        """The pose at a time.

        Args:
            t: Time, s.
        Returns:
            x y z, shape (3,), or x y z qw qx qy qz, shape (7,).
        """
        times = self._rows[:, 0]
        after = int(np.clip(np.searchsorted(times, t), 1, max(len(times) - 1, 1)))
        if len(times) == 1 or t <= times[0] or t >= times[-1]:
            return np.array(self._rows[0 if len(times) == 1 or t <= times[0] else -1, 1:])
        one, other = self._rows[after - 1], self._rows[after]
        s = (t - one[0]) / (other[0] - one[0])
        pose = np.array((1 - s) * one[1:] + s * other[1:])
        if len(pose) == 7:
            angle = np.arccos(np.clip(one[4:] @ other[4:], -1, 1))
            if angle > 1e-6:
                pose[3:] = (np.sin((1 - s) * angle) * one[4:] + np.sin(s * angle) * other[4:]) / np.sin(angle)
            pose[3:] /= np.linalg.norm(pose[3:])
        return pose


class Gamepad:
    """The sticks of a gamepad as velocities of a position, through Linux' joystick interface."""

    _EVENT = struct.Struct("<IhBB")  # time, value, type, number
    _AXIS, _DEAD = 2, 0.1

    def __init__(self, device: str = "/dev/input/js0", speed: float = 0.2, axes: tuple[int, int, int] = (0, 1, 4)):
        """Opens the device.

        Args:
            device: Its file.
            speed: Of the position where a stick is at its end, m/s.
            axes: Which axes of the gamepad move x, y and z; y and z against the sticks, which count downwards.
        Raises:
            FileError: It cannot be opened.
        """
        try:
            self._file = os.open(device, os.O_RDONLY | os.O_NONBLOCK)
        except OSError as error:
            raise FileError(f"Gamepad: cannot open '{device}': {error.strerror}; is a gamepad connected?") from error
        self._speed, self._axes = speed, axes
        self._values = dict.fromkeys(axes, 0.0)

    def velocity(self) -> Pose:
        """Takes in what has happened since.

        Returns:
            Where the sticks push, m/s, shape (3,).
        """
        while True:
            try:
                event = os.read(self._file, self._EVENT.size)
            except BlockingIOError:
                break
            if len(event) < self._EVENT.size:
                break
            _, value, kind, number = self._EVENT.unpack(event)
            if kind & self._AXIS and number in self._values:
                pushed = value / 32767
                self._values[number] = pushed if abs(pushed) > self._DEAD else 0.0
        x, y, z = (self._values[axis] for axis in self._axes)
        return self._speed * np.array([x, -y, -z])

    def close(self) -> None:
        """Closes the device."""
        os.close(self._file)


def drive(
    ik: DiffIk,
    config: Config,
    target: str,
    source: Callable[[float], npt.ArrayLike] | Gamepad | None = None,
    *,
    seconds: float,
    dt: float = 0.005,
    show: bool | None = None,
    realtime: bool = True,
) -> None:
    """Steps a DiffIk while its target moves: with a file, a gamepad, a function, or the handle in the browser.

    Args:
        ik: With a task at the target.
        config: Its scene.
        target: Name of the frame that moves.
        source: A TargetFile or a function of the time in s, that gives a position or a pose; a Gamepad; or None: the frame
            stays where people put it in the browser.
        seconds: How long.
        dt: Length of a step, s.
        show: Shows the scene thirty times a second; None: without a source, as people drag it there.
        realtime: Waits so that steps come as time goes on; else as fast as they can.
    Raises:
        ArgumentError: seconds or dt is not positive.
        FrameNotFound: There is no such frame.
    """
    if not (seconds > 0 and dt > 0):
        raise ArgumentError(f"drive: seconds is {seconds}, dt is {dt}; expected numbers > 0")
    frame = config.getFrame(target)
    shows = source is None if show is None else show
    begun, shown_at = time.monotonic(), -np.inf
    for i in range(round(seconds / dt)):
        t = (i + 1) * dt
        if isinstance(source, Gamepad):
            frame.setPosition(frame.getPosition() + dt * source.velocity())
        elif source is not None:
            pose = np.asarray(source(t), dtype=float)
            frame.setPosition(pose[:3])
            if len(pose) == 7:
                frame.setQuaternion(pose[3:])
        if shows and t - shown_at >= 1 / 30:
            config.view()  # takes over what people dragged
            shown_at = t
        ik.step(dt)
        if realtime and (left := begun + t - time.monotonic()) > 0:
            time.sleep(left)
