"""An environment of gymnasium for policies that learn from the demonstrations of `kinegraph.demonstrate`.

    from kinegraph.task_env import TaskEnv
    env = TaskEnv(C, "(on tray box)", cameras=["cameraTop"])
    observation, info = env.reset(seed=0)
    observation, reward, terminated, truncated, info = env.step(action)

States and actions have the names, order and units of the data sets. Extra `gym`.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

try:
    import gymnasium
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "kinegraph.task_env needs the package gymnasium: pip install 'kinegraph[gym]'", name=error.name
    ) from None

from ._core import BotOp, Config
from .errors import ArgumentError
from .lerobot.demonstrations import Randomization
from .lerobot.rehearsal import literals, sentence, stateNames

LOOK_AHEAD = 2.0  # frames in which a command is reached
STRETCHES = (1.0, 2.0, 4.0, 8.0)
STILL = 2e-3  # m per frame: an object that moves more is not placed
CLOSED, CHANGE = 2e-3, 1e-3  # m: an opening this near to the smallest one closes the hand; smaller changes are ignored


class TaskEnv(gymnasium.Env[dict[str, Any], NDArray[np.float64]]):
    """A robot places objects: goals are "(on PLACE OBJECT)", one or several.

    An observation has `agent_pos`, the joint values (rad or m) and openings of hands (m), and `pixels`, an image per
    camera. An action is the command for the next frame: joint values, and openings. The smallest opening closes the
    hand with force. An episode ends with reward 1 and `info["is_success"]` when the objects rest on their places and
    the robot does not touch them.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(
        self,
        scene: Config | Callable[[np.random.Generator], Config],
        goal: str,
        *,
        cameras: Sequence[str] = (),
        size: int | tuple[int, int] = 128,
        fps: int = 20,
        randomize: Callable[..., None] | None = None,
        task: str | None = None,
        max_episode_steps: int = 400,
        render_mode: str | None = "rgb_array",
    ):
        """Makes the environment; reset() makes the first scene.

        Args:
            scene, goal, cameras, size, fps, randomize, task: As for demonstrate.
            max_episode_steps: Frames after which an episode is truncated.
            render_mode: "rgb_array": render() returns the image of the first camera.
        Raises:
            ArgumentError: The goal has other predicates than `on`, or fps does not divide 100.
            FrameNotFound: There is no such camera or object.
        """
        if fps < 1 or 100 % fps:
            raise ArgumentError(f"TaskEnv: fps is {fps}; expected a divisor of the control rate, 100 Hz, such as 20")
        self._goal = literals(goal)
        if not self._goal or any(len(words) != 3 or words[0] != "on" for words in self._goal):
            raise ArgumentError(f"TaskEnv: the goal is '{goal}'; expected literals (on PLACE OBJECT)")
        self._scene, self._cameras, self._fps = scene, list(cameras), fps
        self._size = (size, size) if isinstance(size, int) else size
        self._vary = Randomization() if randomize is None else randomize
        self.task, self.task_description = "Task-v0", task or sentence(goal)
        self._max_episode_steps, self.render_mode = max_episode_steps, render_mode
        self.metadata = {**self.metadata, "render_fps": fps}
        self._bot: BotOp | None = None
        self._begin(np.random.default_rng(0))
        n = len(self.names)
        image = gymnasium.spaces.Box(0, 255, (*self._size, 3), np.uint8)
        spaces: dict[str, gymnasium.Space[Any]] = {"agent_pos": gymnasium.spaces.Box(-np.inf, np.inf, (n,), np.float64)}
        if self._cameras:
            spaces["pixels"] = gymnasium.spaces.Dict(dict.fromkeys(self._cameras, image))
        self.observation_space = gymnasium.spaces.Dict(spaces)
        lower, upper = self._scene_now.getJointLimits()
        grippers = self._robot.getInfo().grippers
        low = np.append(np.maximum(lower, -1e3), [gripper.min_width for gripper in grippers])
        high = np.append(np.minimum(upper, 1e3), [gripper.max_width for gripper in grippers])
        self.action_space = gymnasium.spaces.Box(low, high, (n,), np.float64)

    @property
    def _robot(self) -> BotOp:
        assert self._bot is not None
        return self._bot

    @property
    def world(self) -> Config:
        """A copy of the scene in its present state."""
        return self._robot.getWorld()

    def _begin(self, rng: np.random.Generator) -> None:
        C = self._scene.copy() if isinstance(self._scene, Config) else self._scene(rng)
        for camera in self._cameras:
            C.getFrame(camera).setAttributes({"height": float(self._size[0]), "width": float(self._size[1])})
        for _, place, thing in self._goal:
            C.getFrame(place), C.getFrame(thing)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self._vary(C, rng, self._cameras)
        self.close()
        self._scene_now, self._bot = C, BotOp(C, strict=False)
        self.names = stateNames(self._bot)
        self._hands = [self._bot.getGripperPos(i) for i in range(len(self._bot.getInfo().grippers))]
        self._last = self._places(self.world)
        joints = C.getJointNames()
        self._moving = {frame.name for frame in C.getFrame(joints[0]).getSubtree()} | set(joints)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Starts a new episode in a new variation of the scene.

        Args:
            seed: Seed of all random numbers from now on.
            options: Not used.
        Returns:
            The observation, and a dict with `is_success`.
        """
        super().reset(seed=seed)
        self._begin(self.np_random)
        return self._observation(), {"is_success": False}

    def step(self, action: NDArray[np.float64]) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        """Executes the command of one frame.

        Args:
            action: Joint values and openings, clipped to their limits.
        Returns:
            Observation, reward (1 at the goal), whether the goal is reached, False, and a dict with `is_success`.
        Raises:
            ArgumentError: The action has another size, or is not finite.
        """
        command = np.asarray(action, float)
        if command.shape != (len(self.names),) or not np.isfinite(command).all():
            raise ArgumentError(f"TaskEnv.step: the action is {command}; expected {len(self.names)} finite numbers")
        command = np.clip(command, self.action_space.low, self.action_space.high)  # type: ignore[attr-defined]
        bot, n = self._robot, len(self._robot.getInfo().joints)
        self._aim(command[:n])
        for i, width in enumerate(command[n:]):
            if abs(width - self._hands[i]) > CHANGE:
                self._hands[i] = float(width)
                if width < bot.getInfo().grippers[i].min_width + CLOSED:
                    bot.gripperClose(i, width=float(width))
                else:
                    bot.gripperMove(i, float(width))
        bot.sync(self._scene_now, 1.0 / self._fps)
        success = self._isReached()
        return self._observation(), float(success), success, False, {"is_success": success}

    def _aim(self, q: NDArray[np.float64]) -> None:
        """Moves toward a command: within LOOK_AHEAD frames, or longer if the limits of the robot demand it."""
        for stretch in STRETCHES:
            try:
                self._robot.move(q[None], [stretch * LOOK_AHEAD / self._fps], True)
                return
            except ArgumentError:
                continue
        self._robot.hold()

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """Returns the image of the first camera, (height, width, 3), or None without one."""
        return self._robot.getImage(self._cameras[0]) if self._cameras else None

    def close(self) -> None:
        """Ends the simulation."""
        if self._bot is not None:
            self._bot.close()
            self._bot = None

    def _observation(self) -> dict[str, Any]:
        bot = self._robot
        state = bot.stepObservation().qpos
        widths = [bot.getGripperPos(i) for i in range(len(self._hands))]
        found: dict[str, Any] = {"agent_pos": np.append(state, widths)}
        if self._cameras:
            found["pixels"] = {camera: bot.getImage(camera) for camera in self._cameras}
        return found

    def _places(self, world: Config) -> dict[str, NDArray[np.float64]]:
        return {thing: world.getFrame(thing).getPosition() for _, _, thing in self._goal}

    def _isReached(self) -> bool:
        """Returns whether all objects rest on their places, and the robot does not touch them."""
        world = self.world
        before, self._last = self._last, self._places(world)
        touching = {tuple(sorted(contact["frames"])) for contact in self._robot.getContacts()}
        for _, place, thing in self._goal:
            base = world.getFrame(place)
            at = base.getRotationMatrix().T @ (self._last[thing] - base.getPosition())
            half = 0.5 * np.asarray(base.getSize())[:2]
            others = {name for pair in touching if thing in pair for name in pair}
            if (
                (np.abs(at[:2]) > half).any()
                or at[2] < 0
                or place not in others
                or others & self._moving
                or np.linalg.norm(self._last[thing] - before[thing]) > STILL
            ):
                return False
        return True
