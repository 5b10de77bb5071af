"""Environments for gymnasium (`pip install 'kinegraph[gym]'`): a Panda that reaches, lifts or pushes, any scene with
any reward, and batches of environments.

    from kinegraph.gym import ReachEnv
    env = ReachEnv()
    observation, info = env.reset(seed=0)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

Importing this module registers kinegraph/Reach-v0, kinegraph/Lift-v0 and kinegraph/Push-v0; gymnasium imports it by
itself in

    env = gymnasium.make("kinegraph.gym:kinegraph/Reach-v0")

An action is a joint velocity, as a share of the largest; LiftEnv has one more entry, which opens (> 0) or closes the
hand. A step takes 50 ms. All random numbers come from the seed of `reset`, so equal seeds give equal episodes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

import kinegraph as ry

try:
    import gymnasium
    from gymnasium.vector.utils import batch_space
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "kinegraph.gym needs the package gymnasium: pip install 'kinegraph[gym]'", name=error.name
    ) from None

_SECONDS = 0.05  # duration of a step
_SUBSTEPS = 5
_HOME_NOISE = 0.1  # rad
_FARTHEST = 100.0  # bound of the entries of an observation, m, rad or their rates: all values are far below


def _panda() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    return C


class _OneEnv(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """Base class of environments with one simulation: each episode starts in the same state."""

    S: ry.Simulation
    start: ry.SimulationState

    def _observation(self) -> NDArray[np.float32]:
        raise NotImplementedError

    def _vary(self) -> None:
        """Randomizes the start of an episode; by default nothing."""

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Starts a new episode.

        Args:
            seed: Seed of all random numbers from now on.
            options: Not used.
        Returns:
            The observation and an empty dict.
        """
        super().reset(seed=seed)
        self.S.setState(self.start)
        self._vary()
        return self._observation(), {}


class _PandaEnv(_OneEnv):
    """Base class of environments with a Panda that is controlled by joint velocities."""

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(self, C: ry.Config, actions: int, observations: int, render_mode: str | None) -> None:
        if render_mode not in (None, "rgb_array"):
            raise ry.ArgumentError(f"render_mode is {render_mode!r}; expected None or 'rgb_array'")
        self.render_mode = render_mode
        self.C = C
        self.home = np.array(C.getJointState())
        self.fastest = 0.5 * np.array(C.getVelocityLimits())
        self.limits = np.array(C.getJointLimits()).reshape(2, -1)
        self.S = ry.Simulation(C, verbose=0)
        self.S.setCamera("cameraTop")
        self.start = self.S.getState()
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (actions,), np.float32)
        self.observation_space = gymnasium.spaces.Box(-_FARTHEST, _FARTHEST, (observations,), np.float32)

    def _place(self) -> None:
        """Places the arm randomly near its home."""
        q = self.home + self.np_random.uniform(-_HOME_NOISE, _HOME_NOISE, self.home.shape)
        self.C.setJointState(np.clip(q, *self.limits))
        self.S.pushConfigToSim()
        self.S.resetTime(0.0)

    def _move(self, action: NDArray[np.float32]) -> None:
        velocity = np.clip(np.asarray(action, float)[:7], -1, 1) * self.fastest
        for _ in range(_SUBSTEPS):
            q = self.S.get_qRef()
            leaves = (q + 0.05 * velocity < self.limits[0]) | (q + 0.05 * velocity > self.limits[1])
            self.S.step(np.where(leaves, 0, velocity), _SECONDS / _SUBSTEPS, ry.ControlMode.velocity)

    def _hand(self) -> NDArray[np.float64]:
        return np.array(self.C.getFrame("l_gripper").getPosition())

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """Renders the image of the camera above the table.

        Returns:
            The image, (height, width, 3), or None without render_mode.
        """
        return self.S.getImageAndDepth()[0] if self.render_mode else None


class ReachEnv(_PandaEnv):
    """Task: move the hand to a random point above the table. Observations: q, velocities, hand and target.

    Args:
        render_mode: None or "rgb_array".
    """

    def __init__(self, render_mode: str | None = None) -> None:
        super().__init__(_panda(), 7, 20, render_mode)
        self.target = np.zeros(3)

    def _observation(self) -> NDArray[np.float32]:
        parts = [self.S.get_q(), self.S.get_qDot(), self._hand(), self.target]
        return np.concatenate(parts).astype(np.float32)

    def _vary(self) -> None:
        self._place()
        self.target = self.np_random.uniform([-0.4, 0.1, 0.75], [0.4, 0.5, 1.2])

    def step(self, action: NDArray[np.float32]) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Advances by 50 ms.

        Args:
            action: (7,) in -1..1.
        Returns:
            Observation, reward (minus the distance, m), terminated (within 2 cm), False, and `distance`.
        """
        self._move(action)
        distance = float(np.linalg.norm(self._hand() - self.target))
        return self._observation(), -distance, distance < 0.02, False, {"distance": distance}


class LiftEnv(_PandaEnv):
    """Task: lift a box from a random place on the table. Observations: q, velocities, the pose of the box, the box
    relative to the hand, and the gripper's width.

    Args:
        render_mode: None or "rgb_array".
    """

    def __init__(self, render_mode: str | None = None) -> None:
        C = _panda()
        C.addFrame("box").setShape(ry.ST.ssBox, [0.05, 0.05, 0.05, 0.005]).setPosition([0, 0.3, 0.676]).setMass(0.1)
        super().__init__(C, 8, 24, render_mode)

    def _box(self) -> NDArray[np.float64]:
        return np.array(self.C.getFrame("box").getPose())

    def _observation(self) -> NDArray[np.float32]:
        width = [self.S.getGripperWidth("l_gripper")]
        lower = self._box()[:3] - self._hand()
        parts = [self.S.get_q(), self.S.get_qDot()[:6], self._box(), lower, width]
        return np.concatenate(parts).astype(np.float32)

    def _vary(self) -> None:
        turn = self.np_random.uniform(-np.pi, np.pi) / 2
        place = [*self.np_random.uniform([-0.15, 0.25], [0.15, 0.4]), 0.676]
        self.C.getFrame("box").setPose([*place, np.cos(turn), 0, 0, np.sin(turn)])
        self._place()

    def step(self, action: NDArray[np.float32]) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Advances by 50 ms.

        Args:
            action: (8,) in -1..1; the last number opens or closes the hand.
        Returns:
            Observation, reward (height of the box minus its distance from the hand, m), terminated (lifted by 10 cm),
            False, and `height`.
        """
        if action[7] > 0:
            self.S.moveGripper("l_gripper", 0.08)
        else:
            self.S.closeGripper("l_gripper", 0.0, 0.3, 20.0)
        self._move(action)
        box = self._box()[:3]
        height = float(box[2] - 0.675)
        reward = height - float(np.linalg.norm(box - self._hand()))
        return self._observation(), reward, height > 0.1, False, {"height": height}


class SimulationEnv(_OneEnv):
    """Any scene with any reward, controlled by joint velocities in steps of 50 ms, with a time limit. Observations: q,
    velocities and the poses of free frames.

    Args:
        C: The scene at the start of each episode; the simulation updates it.
        time_limit: Time after which an episode is truncated, s.
        reward: Computes the reward from C after a step.
        fastest: Velocity of an action of 1, rad/s or m/s.
        render_mode: None, "human" (on the page of C) or "rgb_array".
    Raises:
        ArgumentError: Another render_mode, or a time_limit that is not positive.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["human", "rgb_array"], "render_fps": 20}

    def __init__(
        self,
        C: ry.Config,
        time_limit: float,
        reward: Callable[[ry.Config], float],
        fastest: float = 1.0,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "human", "rgb_array"):
            raise ry.ArgumentError(f"render_mode is {render_mode!r}; expected None, 'human' or 'rgb_array'")
        if not time_limit > 0:
            raise ry.ArgumentError(f"time_limit is {time_limit} s; expected a positive number")
        self.render_mode = render_mode
        self.C, self.time_limit, self.reward, self.fastest = C, time_limit, reward, fastest
        self.S = ry.Simulation(C, verbose=2 if render_mode == "human" else 0)
        self.start = self.S.getState()
        dofs = len(C.getJointState())
        numbers = 2 * dofs + self.start.freePos.size
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (dofs,), np.float32)
        self.observation_space = gymnasium.spaces.Box(-_FARTHEST, _FARTHEST, (numbers,), np.float32)

    def _observation(self) -> NDArray[np.float32]:
        state = self.S.getState()
        parts = np.concatenate([state.q, state.qDot, state.freePos.ravel()])
        return np.clip(parts, -_FARTHEST, _FARTHEST).astype(np.float32)

    def step(self, action: NDArray[np.float32]) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Advances by 50 ms.

        Args:
            action: (n,) in -1..1.
        Returns:
            Observation, reward, False, whether the time limit is reached, and an empty dict.
        """
        velocity = self.fastest * np.clip(np.asarray(action, float), -1, 1)
        self.S.step(velocity, _SECONDS, ry.ControlMode.velocity)
        is_over = self.S.get_t() > self.start.time + self.time_limit - _SECONDS / 2
        return self._observation(), float(self.reward(self.C)), False, is_over, {}

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """Renders the present scene.

        Returns:
            The viewer's picture, (height, width, 3), with "rgb_array"; else None.
        """
        if self.render_mode != "rgb_array":
            return None
        self.C.view(offscreen=True)
        return self.C.viewer().getRgb()


class PushEnv(SimulationEnv):
    """Task: push a box over the table to a target, with a stick in a Panda's hand.

    Args:
        time_limit: Time after which an episode is truncated, s.
        render_mode: None, "human" (on the page of C) or "rgb_array".
    """

    def __init__(self, time_limit: float = 10.0, render_mode: str | None = None) -> None:
        C = _panda()
        box = C.addFrame("box").setShape(ry.ST.ssBox, [0.1, 0.1, 0.1, 0.005]).setColor([1, 0.5, 0]).setMass(0.1)
        box.setPosition([0.1, 0.35, 0.7])
        stick = C.addFrame("stick", "l_gripper").setShape(ry.ST.capsule, [0.3, 0.02]).setColor([0.5, 1, 0])
        stick.setRelativePosition([0, 0, -0.13])
        C.addFrame("target").setShape(ry.ST.marker, [0.1]).setPosition([0.5, 0.0, 0.7])
        C.setJointState([0.0], ["l_panda_joint2"])
        super().__init__(C, time_limit, self._reward, 1.0, render_mode)

    @staticmethod
    def _reward(C: ry.Config) -> float:
        """Returns minus the distances stick-box and box-target, m."""
        touch = C.eval(ry.FS.negDistance, ["stick", "box"])[0][0]
        return float(touch - np.linalg.norm(C.eval(ry.FS.positionDiff, ["box", "target"])[0]))


class BatchEnv(gymnasium.vector.VectorEnv[NDArray[np.float32], NDArray[np.float32], NDArray[Any]]):
    """Many reaching Pandas in one SimulationBatch, stepped in parallel. Each restarts in the step after its success.

    Args:
        num_envs: Number of environments.
        threads: Number of threads.
    """

    def __init__(self, num_envs: int = 16, threads: int = 1) -> None:
        self.num_envs = num_envs
        self.C = _panda()
        self.home = np.array(self.C.getJointState())
        self.fastest = 0.5 * np.array(self.C.getVelocityLimits())
        self.limits = np.array(self.C.getJointLimits()).reshape(2, -1)
        self.batch = ry.SimulationBatch(self.C, num_envs, threads)
        self.single_action_space = gymnasium.spaces.Box(-1.0, 1.0, (7,), np.float32)
        self.single_observation_space = gymnasium.spaces.Box(-_FARTHEST, _FARTHEST, (20,), np.float32)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.metadata = {"autoreset_mode": gymnasium.vector.AutoresetMode.NEXT_STEP}
        self.targets = np.zeros((num_envs, 3))
        self.done = np.zeros(num_envs, bool)

    def _place(self, which: NDArray[np.intp]) -> None:
        if len(which) == 0:
            return
        q = self.home + self.np_random.uniform(-_HOME_NOISE, _HOME_NOISE, (len(which), 7))
        self.batch.place(which, np.clip(q, *self.limits))
        self.targets[which] = self.np_random.uniform([-0.4, 0.1, 0.75], [0.4, 0.5, 1.2], (len(which), 3))

    def _hands(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array(self.C.getFramePoses(q, ["l_gripper"])[:, 0, :3])

    def _observations(self) -> NDArray[np.float32]:
        q = self.batch.q()
        return np.hstack([q, self.batch.qDot(), self._hands(q), self.targets]).astype(np.float32)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Restarts all environments.

        Args:
            seed: Seed of all random numbers from now on.
            options: Not used.
        Returns:
            Observations, (num_envs, 20), and an empty dict.
        """
        if seed is not None:
            self._np_random, self._np_random_seed = gymnasium.utils.seeding.np_random(
                seed if isinstance(seed, int) else seed[0]
            )
        self.done[:] = False
        self._place(np.arange(self.num_envs))
        return self._observations(), {}

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Advances all environments by 50 ms.

        Args:
            actions: (num_envs, 7) in -1..1.
        Returns:
            Observations, rewards (minus the distance, m), which terminated, which were truncated (none), and an empty
            dict.
        """
        velocity = np.clip(np.asarray(actions, float), -1, 1) * self.fastest
        q = self.batch.q()
        ahead = q + 2 * _SECONDS * velocity
        velocity[(ahead < self.limits[0]) | (ahead > self.limits[1])] = 0
        self.batch.step(velocity, _SECONDS, ry.ControlMode.velocity)
        began = np.flatnonzero(self.done)
        self._place(began)
        observations = self._observations()
        distance = np.linalg.norm(observations[:, 14:17] - self.targets, axis=1)
        self.done = distance < 0.02
        self.done[began] = False
        rewards = np.where(np.isin(np.arange(self.num_envs), began), 0.0, -distance)
        return observations, rewards, self.done.copy(), np.zeros(self.num_envs, bool), {}


for _name, _env, _steps in (("Reach", ReachEnv, 200), ("Lift", LiftEnv, 200), ("Push", PushEnv, None)):  # 10 s each
    gymnasium.register(id=f"kinegraph/{_name}-v0", entry_point=f"{__name__}:{_env.__name__}", max_episode_steps=_steps)
