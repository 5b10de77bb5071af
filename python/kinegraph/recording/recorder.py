"""Records robots and simulations while they move."""

from __future__ import annotations

import math
import weakref
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np

from .._core import BotOp, CameraView, Config, Simulation
from ..errors import ArgumentError
from . import messages
from .files import McapFile
from .links import JointStates, Links

Camera = tuple[np.ndarray, np.ndarray]  # image (height, width, 3) and fx, fy, cx, cy


class Sink(Protocol):
    """Takes messages: a file, or the server of Foxglove."""

    @property
    def closed(self) -> bool: ...

    def send(self, topic: str, kind: str, data: bytes, time: int) -> None: ...

    def close(self) -> None: ...


class Recorder:
    """Turns the states of a robot into messages.

    Topics: /joint_states, /joint_commands, /tf, /tf_static, /clock, /robot_description, and for each camera
    /NAME/image/compressed and /NAME/camera_info.
    """

    def __init__(self, caller: str, rate: float, cameras: Sequence[str], camera_rate: float, start: float):
        """Checks the settings.

        Args:
            caller: Name of the function for messages.
            rate: Samples per second, Hz.
            cameras: Names of camera frames.
            camera_rate: Images per second, Hz.
            start: Unix time of time 0, s.
        Raises:
            ArgumentError: A number is invalid.
        """
        for name, value in (("rate", rate), ("camera_rate", camera_rate)):
            if not 0 < value < math.inf:
                raise ArgumentError(f"{caller}: {name} is {value}; expected a number above 0, in Hz")
        if not 0 <= start < 2**31:
            raise ArgumentError(f"{caller}: start is {start}; expected a Unix time in s, from 0 to 2147483647")
        if isinstance(cameras, str):
            raise ArgumentError(f"{caller}: cameras is '{cameras}'; expected a list of names, ['{cameras}']")
        self.period, self.cameras, self.camera_period = 1.0 / rate, list(cameras), 1.0 / camera_rate
        self._start = round(start * 1e9)
        self._next_sample = self._next_image = -math.inf
        self._sink: Sink | None = None
        self._links: Links | None = None
        self._states: JointStates | None = None

    def open(self, sink: Sink) -> None:
        """Begins to send messages to a sink, which ends with this object or with the program."""
        self._sink = sink
        self._finalizer = weakref.finalize(self, sink.close)

    def close(self) -> None:
        """Ends the recording."""
        if self._sink is not None:
            self._sink = None
            self._finalizer()

    def topics(self) -> dict[str, str]:
        """Returns the type of the messages of each topic."""
        topics = {
            "/robot_description": messages.TEXT,
            "/clock": messages.CLOCK,
            "/joint_states": messages.JOINT_STATE,
            "/joint_commands": messages.JOINT_STATE,
            "/tf_static": messages.TRANSFORMS,
            "/tf": messages.TRANSFORMS,
        }
        for name in self.cameras:
            topics |= {f"/{name}/camera_info": messages.CAMERA_INFO, f"/{name}/image/compressed": messages.IMAGE}
        return topics

    @property
    def isOpen(self) -> bool:
        """False after the end of the recording, or after an error of its sink."""
        return self._sink is not None and not self._sink.closed

    def isDue(self, time: float) -> bool:
        """Returns whether a sample is due, and if so, plans the next one."""
        if not self.isOpen or time < self._next_sample - 1e-9:
            return False
        late = self._next_sample == -math.inf or time >= self._next_sample + self.period
        self._next_sample = (time if late else self._next_sample) + self.period
        return True

    def sample(
        self,
        time: float,
        config: Config,
        joints: Sequence[str],
        q: np.ndarray,
        velocity: np.ndarray,
        effort: np.ndarray | None = None,
        reference: tuple[np.ndarray, np.ndarray] | None = None,
    ) -> None:
        """Sends the messages of one time.

        Args:
            time: s.
            config: The scene in its present state.
            joints: Names of the joints of q.
            q, velocity, effort: (n,) each; effort may be missing.
            reference: q and velocity that the robot tracks.
        """
        stamp = self._stamp(time)
        links = self._links
        if links is None or links.count != config.getFrameDimension():
            links = self._links = Links(config)
            self._send("/robot_description", messages.TEXT, messages.encodeText(links.urdf), stamp)
        if self._states is None:
            self._states = JointStates(joints)
        names, values, speeds = self._states.read(time, config, links, q, velocity)
        self._send("/clock", messages.CLOCK, messages.encodeClock(stamp), stamp)
        if effort is not None:
            effort = np.append(effort, np.zeros(len(values) - len(effort)))
        self._send(
            "/joint_states", messages.JOINT_STATE, messages.encodeJoints(stamp, names, values, speeds, effort), stamp
        )
        if reference is not None:
            data = messages.encodeJoints(stamp, joints, *reference)
            self._send("/joint_commands", messages.JOINT_STATE, data, stamp)
        moving, resting = links.read(config)
        if resting:
            self._send("/tf_static", messages.TRANSFORMS, messages.encodeTransforms(stamp, resting), stamp)
        self._send("/tf", messages.TRANSFORMS, messages.encodeTransforms(stamp, moving), stamp)

    def images(self, time: float, camera: Callable[[str], Camera]) -> None:
        """Sends the images of all cameras, if they are due.

        Args:
            time: s.
            camera: Returns the image of a camera, and its fx, fy, cx, cy.
        """
        if not self.cameras or time < self._next_image - 1e-9:
            return
        late = self._next_image == -math.inf or time >= self._next_image + self.camera_period
        self._next_image = (time if late else self._next_image) + self.camera_period
        stamp = self._stamp(time)
        for name in self.cameras:
            image, fxycxy = camera(name)
            size = (image.shape[0], image.shape[1])
            data = messages.encodeCamera(stamp, name, size, fxycxy)
            self._send(f"/{name}/camera_info", messages.CAMERA_INFO, data, stamp)
            self._send(f"/{name}/image/compressed", messages.IMAGE, messages.encodeImage(stamp, name, image), stamp)

    def _stamp(self, time: float) -> int:
        return max(0, self._start + round(time * 1e9))

    def _send(self, topic: str, kind: str, data: bytes, time: int) -> None:
        if self._sink is not None:
            self._sink.send(topic, kind, data, time)


def watchRobot(bot: BotOp, recorder: Recorder) -> None:
    """Samples a robot with a recorder while calls wait.

    Args:
        bot: The robot.
        recorder: An open recorder.
    """
    joints = bot.getInfo().joints

    def camera(name: str) -> Camera:
        return bot.getImage(name), bot.getCameraFxycxy(name)

    def watch(time: float) -> bool:
        if not recorder.isDue(time):
            return recorder.isOpen
        observation = bot.stepObservation()
        reference = (observation.qref, observation.qvel_ref)
        recorder.sample(time, bot.getWorld(), joints, bot.get_q(), bot.get_qDot(), None, reference)
        recorder.images(time, camera)
        return True

    bot.watch(0.0, watch)


def recordRobot(
    bot: BotOp, path: str, rate: float, cameras: Sequence[str], camera_rate: float, start: float
) -> Recorder:
    """Does what bot.recordTo(path) says, for a path that ends in .mcap. Returns the recorder."""
    recorder = Recorder("BotOp.recordTo", rate, cameras, camera_rate, start)
    for name in recorder.cameras:
        bot.getCameraFxycxy(name)  # refuses a wrong name
    recorder.open(McapFile(path, "BotOp.recordTo"))
    watchRobot(bot, recorder)
    return recorder


def cameraOf(config: Config) -> Callable[[str], Camera]:
    """Returns a function that renders a camera of a scene."""
    view = CameraView(config)

    def camera(name: str) -> Camera:
        view.setCamera(name)
        return view.computeImageAndDepth()[0], view.getFxycxy()

    return camera


class SimulationRecorder(Recorder):
    """Records a simulation, which calls `step` after each step."""

    def __init__(self, simulation: Simulation, config: Config, path: str, *settings: Any):
        super().__init__("Simulation.recordTo", *settings)
        if not path.endswith(".mcap"):
            raise ArgumentError(f"Simulation.recordTo: the file is '{path}'; expected a name that ends in .mcap")
        self._config = config
        self._joints = config.getJointNames()
        self._camera = cameraOf(config)
        for name in self.cameras:
            config.getFrame(name)
        self.open(McapFile(path, "Simulation.recordTo"))
        self.step(simulation)

    def step(self, simulation: Simulation) -> None:
        """Takes a sample if one is due."""
        time = simulation.get_t()
        if self.isDue(time):
            effort = simulation.getJointTorques()
            self.sample(time, self._config, self._joints, simulation.get_q(), simulation.get_qDot(), effort)
            self.images(time, self._camera)


def recordSimulation(
    simulation: Simulation,
    config: Config,
    path: str,
    rate: float,
    cameras: Sequence[str],
    camera_rate: float,
    start: float,
) -> SimulationRecorder:
    """Does what simulation.recordTo(path) says. Returns the recorder."""
    return SimulationRecorder(simulation, config, path, rate, cameras, camera_rate, start)
