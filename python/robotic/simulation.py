"""Simulations as scripts of earlier years use them: states that unpack, and cameras without addSensor."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import kinegraph

_BLOCKED = 2e-3  # m: fingers that stop this far from their target hold something


class SimulationState(kinegraph.SimulationState):
    """Like kinegraph.SimulationState, and a tuple (X, q, V, qDot), as in earlier versions of the reference.

    X: (F, 7), world poses of all frames. q, qDot: (n,), joint state and its velocity. V: (F, 2, 3), linear and angular
    velocities of all frames; zero for frames that do not move freely.
    """

    frames: tuple[NDArray[np.float64], NDArray[np.float64]]

    @property
    def _parts(self) -> tuple[NDArray[np.float64], ...]:
        X, V = self.frames
        return X, self.q, V, self.qDot

    def __iter__(self) -> Iterator[NDArray[np.float64]]:
        return iter(self._parts)

    def __getitem__(self, index: Any) -> Any:
        return self._parts[index]

    def __len__(self) -> int:
        return len(self._parts)


class Simulation(kinegraph.Simulation):
    """Like kinegraph.Simulation; getState unpacks, and selectSensor adds the sensor of a camera frame."""

    def __init__(
        self, C: kinegraph.Config, engine: Any = kinegraph.SimulationEngine.physx, *args: Any, **kwargs: Any
    ) -> None:
        """Creates a simulation, as kinegraph.Simulation; MuJoCo takes the place of Bullet, with a warning.

        Args:
            C: The scene, which the simulation moves.
            engine: A SimulationEngine.
            args, kwargs: verbose and options, as in kinegraph.Simulation.
        Raises:
            ArgumentError: The engine does not exist, or an option is invalid.
        """
        if engine == kinegraph.SimulationEngine.bullet:
            warnings.warn(
                "Simulation: there is no engine bullet; physx (MuJoCo) simulates the scene",
                kinegraph.KinegraphWarning,
                stacklevel=2,
            )
            engine = kinegraph.SimulationEngine.physx
        super().__init__(C, engine, *args, **kwargs)
        self._scene = C
        self._widths: dict[str, float] = {}  # of grippers, as commanded
        self._holders: dict[str, str] = {}  # of attached frames

    def getState(self) -> SimulationState:
        """Returns the state, which is also a tuple (X, q, V, qDot).

        Returns:
            A SimulationState for setState; setState(*state) sets poses and velocities.
        """
        core = super().getState()
        state = SimulationState.__new__(SimulationState)
        state.__setstate__(core.__getstate__())  # type: ignore[attr-defined]
        V = np.zeros((self._scene.getFrameDimension(), 2, 3))
        free = [frame.ID for frame in self.getFreeFrames()]
        if free:
            V[free] = core.freeVel
        state.frames = self._scene.getFrameState(), V
        return state

    def setState(
        self,
        state: kinegraph.SimulationState | ArrayLike,
        jointState: ArrayLike = (),
        frameVelocities: ArrayLike = (),
        jointVelocities: ArrayLike = (),
    ) -> None:
        """Sets the state, or poses and velocities.

        Args:
            state: A SimulationState, or world poses of all frames, (F, 7).
            jointState: (n,); used with poses, as the following arguments.
            frameVelocities: (F, 2, 3), of the free frames or of all frames.
            jointVelocities: (n,).
        Raises:
            ArgumentError: A size is wrong.
        """
        if isinstance(state, kinegraph.SimulationState):
            super().setState(state)
            return
        velocities = np.asarray(frameVelocities, float)
        free = [frame.ID for frame in self.getFreeFrames()]
        if velocities.size == 6 * self._scene.getFrameDimension() != 6 * len(free):
            velocities = velocities.reshape(-1, 2, 3)[free]
        super().setState(state, jointState, velocities, jointVelocities)

    def selectSensor(self, sensorName: str) -> None:
        """Selects the camera of getImageAndDepth; a frame with camera attributes becomes a sensor.

        Args:
            sensorName: Name from addSensor, or a frame.
        Raises:
            NotFound: There is no such sensor and no such frame.
        """
        try:
            super().selectSensor(sensorName)
        except kinegraph.NotFound:
            if sensorName not in self._scene.getFrameNames():
                raise
            self.addSensor(sensorName)
            super().selectSensor(sensorName)

    def addSensor(
        self,
        sensorName: str,
        frameAttached: str | int = "",
        width: int | None = None,
        height: int | float | None = None,
        focalLength: float = -1.0,
        orthoAbsHeight: float | ArrayLike = -1.0,
        zRange: ArrayLike = (),
    ) -> None:
        """Adds a camera and selects it, as kinegraph.Simulation.addSensor; attributes of the camera may be given.

        Versions 0.2.3 and 0.2.9 have no frameAttached: a number there is the width, and the others follow.

        Args:
            sensorName, frameAttached: As in kinegraph.Simulation.addSensor.
            width, height: Of pictures, pixels.
            focalLength: Image heights; negative: of the frame.
            orthoAbsHeight: Height of a picture without perspective, m; negative: with perspective.
            zRange: Least and largest distance of what is seen, (2,), m.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: The camera attributes are invalid.
        """
        numbers: list[Any] = [width, height, focalLength, orthoAbsHeight, zRange]
        if not isinstance(frameAttached, str):
            numbers = [frameAttached, *(number for number in numbers if number is not None)]
            numbers += [-1.0, -1.0, ()][len(numbers) - 2 :]
            frameAttached = ""
        names = ("width", "height", "focalLength", "orthoAbsHeight", "zRange")
        given = {name: value for name, value in zip(names, numbers) if np.size(value) and value is not None}
        attributes = {name: value for name, value in given.items() if np.min(value) >= 0.0}
        if attributes:
            self._scene[frameAttached or sensorName].setAttributes(attributes)
        super().addSensor(sensorName, frameAttached)

    def detach(self, frm: Any, to: Any = None) -> None:
        """Ends an attachment, as kinegraph.Simulation.detach; until 0.2.9 the held object alone was given.

        Args:
            frm: Frame of the holding link; without `to`, the held frame of the last attach.
            to: Frame of the held link.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: They are not attached.
        """
        if to is None:
            held = self._gripper(frm)
            if held not in self._holders:
                raise kinegraph.ArgumentError(f"Simulation.detach: '{held}' is not attached to a frame")
            frm, to = self._holders[held], held
        super().detach(frm, to)
        self._holders.pop(self._gripper(to), None)

    def attach(self, frm: Any, to: Any) -> None:
        """Fixes a link to another, as kinegraph.Simulation.attach.

        Args:
            frm, to: As in kinegraph.Simulation.attach.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: Both are the same link, or 32 links are attached already.
        """
        super().attach(frm, to)
        self._holders[self._gripper(to)] = self._gripper(frm)

    def moveGripper(self, gripperFrameName: Any, width: float, speed: float = 0.3) -> None:
        """Moves fingers to a width, as kinegraph.Simulation.moveGripper.

        Args:
            gripperFrameName, width, speed: As in kinegraph.Simulation.moveGripper.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: The frame has no fingers, or a number is out of range.
        """
        super().moveGripper(gripperFrameName, width, speed)
        self._widths[self._gripper(gripperFrameName)] = width

    def closeGripper(self, gripperFrameName: Any, width: float = 0.0, speed: float = 0.3, force: float = 20.0) -> None:
        """Closes fingers until an object blocks them, as kinegraph.Simulation.closeGripper.

        Args:
            gripperFrameName, width, speed, force: As in kinegraph.Simulation.closeGripper.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: The frame has no fingers, or a number is out of range.
        """
        super().closeGripper(gripperFrameName, width, speed, force)
        self._widths[self._gripper(gripperFrameName)] = width

    def openGripper(self, gripperFrameName: Any, width: float = 0.075, speed: float = 0.3) -> None:
        """Opens fingers, like moveGripper.

        Args:
            gripperFrameName: A frame of the link that carries the fingers.
            width: Distance between the fingers, m.
            speed: Speed of the width, m/s.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: The frame has no fingers, or a number is out of range.
        """
        self.moveGripper(gripperFrameName, width, speed)

    def getGripperIsGrasping(self, gripperFrameName: Any) -> bool:
        """Returns whether an object blocks fingers that close.

        Args:
            gripperFrameName: A frame of the link that carries the fingers.
        Returns:
            True if the fingers have stopped at a larger width than closeGripper or moveGripper asked for.
        Raises:
            FrameNotFound: There is no such frame.
        """
        width = self._widths.get(self._gripper(gripperFrameName))
        if width is None or not self.gripperIsDone(gripperFrameName):
            return False
        return self.getGripperWidth(gripperFrameName) > width + _BLOCKED

    def getScreenshot(self) -> NDArray[np.uint8]:
        """Returns a picture of what the page shows, shape (height, width, 3), 0..255, like C.viewer().getRgb."""
        return self._scene.viewer().getRgb()

    def pushConfigurationToSimulator(self, frameVelocities: ArrayLike = (), jointVelocities: ArrayLike = ()) -> None:
        """Takes the state of C over, like pushConfigToSim.

        Args:
            frameVelocities, jointVelocities: As in pushConfigToSim.
        Raises:
            ArgumentError: A size is wrong.
        """
        self.pushConfigToSim(frameVelocities, jointVelocities)

    def _gripper(self, frame: Any) -> str:
        return str(frame if isinstance(frame, str) else getattr(frame, "name", None) or self._scene[frame].name)
