"""Environments of gymnasium (`pip install kinegraph[gym]`): a scene, simulated, with actions, observations and rewards.

from kinegraph.environments import ReachEnv
env = ReachEnv()
observation, info = env.reset(seed=0)
observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from ._core import FS, ST, CameraView, Config, ControlMode, Simulation, SimulationState
from .errors import ArgumentError
from .model_paths import raiPath

Array = NDArray[np.float64]
Observation = NDArray[np.float32]

LEAD = 0.05  # rad or m: further from the robot the reference of a joint is never


def _copy(C: Config) -> Config:
    copy = Config()
    copy.addConfigurationCopy(C)
    return copy


@dataclass
class Randomization:
    """What differs from episode to episode. Each number is how much: x drawn uniformly around what the scene says.

    Attributes:
        mass: Relative, of the masses of free frames: .2 is 80 to 120 %.
        friction: Relative, of the friction of free frames.
        position: Of free frames, along x and y, m.
        joints: Of joint values, rad or m.
    """

    mass: float = 0.0
    friction: float = 0.0
    position: float = 0.0
    joints: float = 0.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not 0.0 <= value < np.inf or (name in ("mass", "friction") and value >= 1.0):
                raise ArgumentError(
                    f"Randomization: {name} is {value}; expected 0 or more, and below 1 for mass and friction"
                )


class RobotEnv(gymnasium.Env[Observation, Array]):
    """A robot in a simulated scene. Actions are velocities of its joints, as shares of how fast they may be.

    Observations are q, dq/dt and the positions of `observed` frames. The same seed and actions give the same episode, to the
    bit.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(
        self,
        C: Config,
        reward: Callable[[Config], float],
        observed: tuple[str, ...] = (),
        *,
        time_limit: float = 5.0,
        tau_env: float = 0.05,
        tau_sim: float = 0.01,
        speed: float = 1.0,
        randomize: Randomization | None = None,
        render_mode: str | None = None,
        camera: str | None = None,
    ) -> None:
        """An environment of a scene.

        Args:
            C: The scene; a copy is simulated. reward and the methods below are given that copy.
            reward: What a scene is worth, at the end of a step.
            observed: Names of frames whose positions are observed.
            time_limit: After so many seconds an episode is truncated.
            tau_env: Seconds of a step.
            tau_sim: Seconds of the steps of the simulation that it is made of.
            speed: Of a joint where the action is 1, rad/s or m/s, if its own limit is not lower.
            randomize: What differs between episodes; None: nothing.
            render_mode: None, or "rgb_array".
            camera: The frame that pictures are taken from; None: from where the viewer looks.
        Raises:
            ArgumentError: A time that is not positive, or another render_mode.
            FrameNotFound: A frame that is not there.
        """
        if min(time_limit, tau_env, tau_sim, speed) <= 0.0:
            raise ArgumentError("RobotEnv: time_limit, tau_env, tau_sim and speed must be more than 0")
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ArgumentError(f"RobotEnv: render_mode is {render_mode!r}; expected None or 'rgb_array'")
        self.render_mode = render_mode
        self._given = _copy(C)
        for name in (*observed, *((camera,) if camera else ())):
            self._given.getFrame(name)
        self._reward, self._observed = reward, observed
        self._time_limit, self._tau_env, self._tau_sim = time_limit, tau_env, tau_sim
        self._randomize = randomize or Randomization()
        self._camera = camera
        self._speed = np.minimum(self._given.getVelocityLimits(), speed)
        lower, upper = self._given.getJointLimits()
        self._lower = np.where(upper > lower, lower, -np.inf)
        self._upper = np.where(upper > lower, upper, np.inf)
        self._make(self._given)
        n = self.C.getJointDimension()
        self.action_space = spaces.Box(-1.0, 1.0, (n,), np.float64)
        size = 2 * n + 3 * len(observed)
        self.observation_space = spaces.Box(-np.inf, np.inf, (size,), np.float32)

    def _make(self, scene: Config) -> None:
        self.C = _copy(scene)
        self.simulation = Simulation(self.C, verbose=0)
        self._start: SimulationState = self.simulation.getState()
        self._reference = self.simulation.get_q()
        self._view: CameraView | None = None

    # --- what subclasses may change -----------------------------------------------------------------------------------

    def place(self, C: Config, rng: np.random.Generator) -> None:
        """Places targets and things of a new episode. Does nothing unless a subclass does.

        Args:
            C: The scene at the start of the episode.
            rng: What to draw from.
        """

    def isDone(self, C: Config) -> bool:
        """Whether the episode has ended: never, unless a subclass says when.

        Args:
            C: The scene at the end of a step.
        Returns:
            True if it has.
        """
        return False

    # --- gymnasium ----------------------------------------------------------------------------------------------------

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode.

        Args:
            seed: Of this and the following episodes.
            options: Not used.
        Returns:
            The observation, and an empty dict.
        """
        super().reset(seed=seed)
        varied = self._randomize
        if varied.mass or varied.friction:
            self._make(self._with_other_bodies())
        else:
            self.simulation.setState(self._start)
        if varied.joints:
            n = self.C.getJointDimension()
            q = self.C.getJointState() + self.np_random.uniform(-varied.joints, varied.joints, n)
            self.C.setJointState(np.clip(q, self._lower, self._upper))
        if varied.position:
            for frame in self._things():
                shift = np.append(self.np_random.uniform(-varied.position, varied.position, 2), 0.0)
                frame.setPosition(frame.getPosition() + shift)
        self.place(self.C, self.np_random)
        self.simulation.pushConfigToSim()
        self.simulation.resetTime(0.0)
        self._reference = self.simulation.get_q()
        return self._observe(), {}

    def step(self, action: Array) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Goes on by a step.

        Args:
            action: (n,) in [-1, 1].
        Returns:
            Observation, reward, whether the episode has ended, whether its time is over, and a dict with `time` in s.
        Raises:
            ArgumentError: An action of another shape.
        """
        self.act(np.clip(np.asarray(action, float), -1.0, 1.0))
        time = self.simulation.get_t()
        done = self.isDone(self.C)
        return self._observe(), float(self._reward(self.C)), done, time > self._time_limit - 1e-9, {"time": time}

    def act(self, action: Array) -> None:
        """Simulates a step: here the action is the velocity of joints.

        Args:
            action: As for step, cut off at -1 and 1.
        """
        if action.shape != self.action_space.shape:
            raise ArgumentError(f"step: the action has shape {action.shape}; expected {self.action_space.shape}")
        for _ in range(round(self._tau_env / self._tau_sim)):
            self._move(self._speed * action)

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """The scene now.

        Returns:
            (height, width, 3), 0..255; None without render_mode.
        """
        if self.render_mode is None:
            return None
        if self._view is None:
            self._view = CameraView(self.C)
            if self._camera:
                self._view.setCamera(self._camera)
        return self._view.computeImageAndDepth()[0]

    def _move(self, velocity: Array) -> None:
        """A step of the simulation with this velocity of joints, within their limits; what is in the way is not pushed harder
        and harder."""
        q, tau = self.simulation.get_q(), self._tau_sim
        nearest = np.clip(
            self._reference + tau * velocity, np.maximum(q - LEAD, self._lower), np.minimum(q + LEAD, self._upper)
        )
        velocity, self._reference = (nearest - self._reference) / tau, nearest
        self.simulation.step(np.concatenate([nearest, velocity]), tau, ControlMode.positionVelocity)

    # --- parts --------------------------------------------------------------------------------------------------------

    def _things(self) -> list[Any]:
        return [frame for frame in self.simulation.getFreeFrames() if frame.getMass() > 0.0]

    def _with_other_bodies(self) -> Config:
        scene, varied = _copy(self._given), self._randomize
        for thing in self._things():
            frame = scene.getFrame(thing.name)
            more, rougher = self.np_random.uniform(-1.0, 1.0, 2)
            frame.setMass(frame.getMass() * (1.0 + varied.mass * more))
            friction = float(frame.getAttributes().get("friction", 1.0))
            frame.setAttributes({"friction": friction * (1.0 + varied.friction * rougher)})
        return scene

    def _observe(self) -> Observation:
        parts = [self.simulation.get_q(), self.simulation.get_qDot()]
        parts += [self.C.getFrame(name).getPosition() for name in self._observed]
        return np.concatenate(parts).astype(np.float32)


class ReachEnv(RobotEnv):
    """A Panda that shall bring its hand to a ball, which is somewhere else in each episode.

    The reward is minus the distance in m; an episode ends when it is below 2 cm.
    """

    def __init__(self, **options: Any) -> None:
        """The environment.

        Args:
            options: Those of RobotEnv, by name.
        Raises:
            ArgumentError: As of RobotEnv.
        """
        C = Config()
        C.addFile(raiPath("scenarios/pandaSingle.g"))
        C.addFrame("ball").setShape(ST.sphere, [0.03]).setColor([1.0, 0.2, 0.2]).setPosition([0.1, 0.35, 1.0])
        C.getFrame("ball").setAttributes({"simulate": False})  # only to be seen
        super().__init__(
            C, lambda scene: -self.distance(scene), ("l_gripper", "ball"), **{"time_limit": 2.0, **options}
        )

    @staticmethod
    def distance(C: Config) -> float:
        """How far the hand is from the ball.

        Args:
            C: The scene.
        Returns:
            m.
        """
        return float(np.linalg.norm(C.eval(FS.positionDiff, ["l_gripper", "ball"])[0]))

    def place(self, C: Config, rng: np.random.Generator) -> None:
        """Puts the ball in reach, in front of the robot.

        Args:
            C: The scene.
            rng: What to draw from.
        """
        C.getFrame("ball").setPosition(rng.uniform([-0.25, 0.2, 0.85], [0.25, 0.45, 1.2]))

    def isDone(self, C: Config) -> bool:
        """Whether the hand is at the ball.

        Args:
            C: The scene.
        Returns:
            True within 2 cm.
        """
        return self.distance(C) < 0.02


class LiftEnv(RobotEnv):
    """A Panda that shall grasp a box on the table and lift it by 10 cm.

    Actions are four numbers: the velocity of the hand along x, y, z as shares of `speed` (m/s), while it keeps pointing down, and
    the gripper: it opens above 0, and closes below. The reward is minus the distance of hand and box, and ten times the height
    that the box is lifted, up to .1 m.
    """

    def __init__(self, **options: Any) -> None:
        """The environment.

        Args:
            options: Those of RobotEnv, by name.
        Raises:
            ArgumentError: As of RobotEnv.
        """
        C = Config()
        C.addFile(raiPath("scenarios/pandaSingle.g"))
        box = C.addFrame("box").setShape(ST.box, [0.05, 0.05, 0.08]).setColor([1.0, 0.5, 0.0])
        box.setPosition([-0.25, 0.15, 0.67]).setMass(0.2)
        self._hand_speed = float(options.pop("speed", 0.3))
        self._height = 0.67
        varied = options.pop("randomize", None) or Randomization(position=0.05)
        super().__init__(C, self._worth, ("l_gripper", "box"), randomize=varied, **{"time_limit": 5.0, **options})
        self.action_space = spaces.Box(-1.0, 1.0, (4,), np.float64)
        n = self.C.getJointDimension()
        self.observation_space = spaces.Box(-np.inf, np.inf, (2 * n + 7,), np.float32)
        self._closes = False

    def _worth(self, C: Config) -> float:
        away = float(np.linalg.norm(C.eval(FS.positionDiff, ["l_gripper", "box"])[0]))
        return -away + 10.0 * min(self.lifted(C), 0.1)

    def lifted(self, C: Config) -> float:
        """How high the box is above where it stood.

        Args:
            C: The scene.
        Returns:
            m, at least 0.
        """
        return max(0.0, float(C.getFrame("box").getPosition()[2]) - self._height)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode, with an open gripper.

        Args:
            seed: Of this and the following episodes.
            options: Not used.
        Returns:
            The observation, and an empty dict.
        """
        self._closes = False
        return super().reset(seed=seed, options=options)

    def isDone(self, C: Config) -> bool:
        """Whether the box is lifted.

        Args:
            C: The scene.
        Returns:
            True from 10 cm on.
        """
        return self.lifted(C) > 0.1

    def act(self, action: Array) -> None:
        """Simulates a step.

        Args:
            action: As for step, cut off at -1 and 1.
        Raises:
            ArgumentError: An action of another shape.
        """
        if action.shape != (4,):
            raise ArgumentError(f"step: the action has shape {action.shape}; expected (4,)")
        if (action[3] < 0.0) != self._closes:
            self._closes = not self._closes
            if self._closes:
                self.simulation.closeGripper("l_gripper", 0.0, 0.2, 20.0)
            else:
                self.simulation.moveGripper("l_gripper", 0.08, 0.2)
        for _ in range(round(self._tau_env / self._tau_sim)):
            self._move(self._joint_velocity(action[:3]))

    def _joint_velocity(self, direction: Array) -> Array:
        """Of the least joint motion that moves the hand so and keeps it upright."""
        _, J = self.C.eval(FS.position, ["l_gripper"])
        tilt, turn = self.C.eval(FS.vectorZ, ["l_gripper"]), self.C.eval(FS.vectorX, ["l_gripper"])
        rows = np.concatenate([J, tilt[1][:2], turn[1][:2]])
        wanted = np.concatenate(
            [self._hand_speed * direction, -5.0 * tilt[0][:2], 5.0 * (np.array([1.0, 0.0]) - turn[0][:2])]
        )
        velocity = rows.T @ np.linalg.solve(rows @ rows.T + 1e-4 * np.eye(len(rows)), wanted)
        return np.clip(velocity, -self._speed, self._speed)

    def _observe(self) -> Observation:
        width = np.float32(self.simulation.getGripperWidth("l_gripper"))
        return np.append(super()._observe(), width)
