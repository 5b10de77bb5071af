"""Moves the tool of an arm by velocities: teleoperation with a keyboard, a gamepad or a 3D mouse."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import FS, Config, DiffIk
from ..errors import ArgumentError

LEAD = 0.02  # m: the target is never farther ahead of the tool, so that it waits at limits
STEEPEST = 0.999  # sine of the steepest inclination whose change is well defined


class ToolControl:
    """Turns velocities of a tool into joint values, for arms with four joints and more.

    An arm with five joints, such as an SO-101, has three for the position; the others are the inclination of the tool
    and its turn about its own axis. The limits of the joints hold, and collidable pairs keep 1 cm.
    """

    def __init__(
        self,
        config: Config,
        tool: str = "gripper",
        *,
        roll: str | None = None,
        velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
    ):
        """Begins at the present state of a scene.

        Args:
            config: The scene; it is moved. Its z axis points up.
            tool: Frame of the tool. Its z axis points back into the hand.
            roll: Joint that turns the tool about its axis; None: the last one of q.
            velocity, acceleration: Limits of the joints, one number or (n,), rad/s and rad/s^2; None: the velocities of
                the scene, and no limit of acceleration.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: `roll` is no joint of q.
        """
        joints = config.getJointNames()
        self._roll = joints[-1] if roll is None else roll
        if self._roll not in joints:
            raise ArgumentError(f"ToolControl: roll is '{self._roll}'; expected one of {', '.join(joints)}")
        self._config, self._tool, self._index = config, config.getFrame(tool), joints.index(self._roll)
        self._control = DiffIk(config, velocity, acceleration, posture=1e-4)
        self._position_task = self._control.addTask(FS.position, [tool], weight=100.0)
        self._direction_task = self._control.addTask(FS.vectorZ, [tool], weight=3.0)
        self._roll_task = self._control.addTask(FS.jointState, [self._roll], weight=1.0)
        self.reset()

    def reset(self) -> None:
        """Takes the present state of the scene as the target."""
        self._control.reset()
        self._target = np.array(self._tool.getPosition())
        self._inclination = math.asin(float(np.clip(self._tool.getRotationMatrix()[2, 2], -1.0, 1.0)))
        self._turn = float(self._config.getJointState()[self._index])

    def step(self, velocity: ArrayLike, dt: float, *, incline: float = 0.0, turn: float = 0.0) -> NDArray[np.float64]:
        """Moves for a time.

        Args:
            velocity: Velocity of the tool, (3,), m/s in world coordinates.
            dt: Time, s.
            incline: Rate of the inclination, rad/s; positive points the tool down.
            turn: Rate of the joint `roll`, rad/s.
        Returns:
            The joint values, (n,), rad or m; the scene has them.
        Raises:
            ArgumentError: A number is not finite, or dt is not positive.
        """
        v = np.asarray(velocity, float)
        if v.shape != (3,) or not (np.isfinite(v).all() and math.isfinite(incline) and math.isfinite(turn)):
            raise ArgumentError(
                f"ToolControl.step: velocity is {v}, incline {incline}, turn {turn}; expected three finite numbers and "
                "finite rates"
            )
        if not 0 < dt < 1:
            raise ArgumentError(f"ToolControl.step: dt is {dt}; expected a number between 0 and 1, in s")
        at = np.array(self._tool.getPosition())
        ahead = self._target + dt * v - at
        self._target = at + ahead * min(1.0, LEAD / max(float(np.linalg.norm(ahead)), 1e-12))
        self._inclination = float(np.clip(self._inclination + dt * incline, -math.pi / 2, math.pi / 2))
        lower, upper = self._config.getJointLimits()[:, self._index]
        self._turn = float(np.clip(self._turn + dt * turn, lower, upper))
        control = self._control
        control.setTarget(self._position_task, self._target)
        control.setTarget(self._direction_task, self._direction())
        control.setTarget(self._roll_task, self._turn)
        control.step(dt)
        return self._config.getJointState()

    def _direction(self) -> NDArray[np.float64]:
        """Returns the target of the tool's z axis: its inclination changes, its heading stays that of the arm."""
        z = self._tool.getRotationMatrix()[:, 2]
        flat = z[:2] / max(float(np.linalg.norm(z[:2])), 1e-9)
        if abs(z[2]) > STEEPEST:  # the heading of a vertical tool: from the tool back to the robot's root
            away = -self._tool.getPosition()[:2]
            flat = away / max(float(np.linalg.norm(away)), 1e-9)
        c, s = math.cos(self._inclination), math.sin(self._inclination)
        return np.array([c * flat[0], c * flat[1], s])
