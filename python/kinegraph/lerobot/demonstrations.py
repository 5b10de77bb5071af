"""Demonstrations by planned and simulated tasks."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from .._core import BotOp, Config
from ..errors import ArgumentError, Error
from ..fleets import map as mapItems
from .layout import SHARDS, shardFolder, writeText
from .rehearsal import sentence, stateNames, stateOf
from .video import CODECS
from .writer import LeRobotWriter, finishedShards, mergeShards

KEEP = ("success", "clean", "all")
TRIES = 20  # placements of an object, and attempts per episode
OVERLAP = 1e-3  # m, of two shapes that touch


class Randomization:
    """Random variations of a scene around its present state."""

    def __init__(
        self,
        position: float = 0.05,
        rotation: float = 0.5,
        mass: float = 0.3,
        friction: tuple[float, float] | None = (0.7, 1.2),
        color: bool = True,
        camera: float = 0.01,
    ):
        """Sets the size of the variations.

        Args:
            position: Largest displacement of objects along x and y, m.
            rotation: Largest rotation of objects about z, rad.
            mass: Largest relative change of masses, below 1.
            friction: Range of the friction of objects; None leaves it.
            color: Whether objects get random colors.
            camera: Standard deviation of the positions of cameras, m.
        Raises:
            ArgumentError: A number is negative, or mass is 1 or more.
        """
        if min(position, rotation, mass, camera, *(friction or ())) < 0 or mass >= 1:
            raise ArgumentError("Randomization: expected numbers that are not negative, and mass below 1")
        self.position, self.rotation, self.mass = position, rotation, mass
        self.friction, self.color, self.camera = friction, color, camera

    def __call__(self, C: Config, rng: np.random.Generator, cameras: Sequence[str] = ()) -> None:
        """Varies a scene. Objects stay where they are if no free place is found.

        Args:
            C: The scene, which is changed.
            rng: Random numbers.
            cameras: Frames of the cameras.
        """
        words = [literal.strip("()").split() for literal in _core.sceneFacts(C)]
        for name in [w[1] for w in words if w[0] == "is_object"]:
            frame = C.getFrame(name)
            parent = frame.getParent()
            if parent is not None and not any(w[:2] == ["is_gripper", parent.name] for w in words):
                self._place(C, frame, rng)
            if (mass := frame.getMass()) > 0:
                frame.setMass(mass * (1 + rng.uniform(-self.mass, self.mass)))
            if self.friction is not None:
                frame.setAttributes({"friction": float(rng.uniform(*self.friction))})
            if self.color:
                frame.setColor([float(x) for x in rng.uniform(0.1, 1, 3)])
        for name in cameras:
            frame = C.getFrame(name)
            frame.setRelativePosition(frame.getRelativePosition() + rng.normal(0, 1, 3) * self.camera)

    def _place(self, C: Config, frame: Any, rng: np.random.Generator) -> None:
        position, rotation = frame.getRelativePosition(), frame.getRelativeQuaternion()
        touched = len(C.getCollisions(-OVERLAP))
        for _ in range(TRIES):
            offset = [*rng.uniform(-self.position, self.position, 2), 0.0]
            angle = 0.5 * rng.uniform(-self.rotation, self.rotation)
            w, x, y, z = rotation
            c, s = np.cos(angle), np.sin(angle)
            frame.setRelativePosition(position + offset)
            frame.setRelativeQuaternion([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w])
            if len(C.getCollisions(-OVERLAP)) <= touched:
                return
        frame.setRelativePosition(position)
        frame.setRelativeQuaternion(rotation)


@dataclass
class Demonstrations:
    """The result of demonstrate.

    Attributes:
        folder: Folder of the data set.
        episodes: Number of episodes in it.
        frames: Number of their frames.
        attempts: Number of attempts, including those that were left out.
        failures: Reasons of the attempts that failed, with their numbers.
    """

    folder: Path
    episodes: int
    frames: int
    attempts: int
    failures: dict[str, int]

    def __str__(self) -> str:
        return f"{self.episodes} episodes of {self.attempts} attempts, {self.frames} frames, in '{self.folder}'"


def demonstrate(
    scene: Config | Callable[[np.random.Generator], Config],
    goal: str,
    episodes: int,
    out: str | os.PathLike[str],
    *,
    cameras: Sequence[str] = (),
    size: int | tuple[int, int] = 128,
    fps: int = 20,
    seed: int = 0,
    engine: str = "threads",
    workers: int | None = None,
    keep: str = "success",
    randomize: Callable[..., None] | None = None,
    task: str | None = None,
    robot_type: str = "kinegraph",
    codec: str = "h264",
    shard: int = 10,
    progress: bool = True,
) -> Demonstrations:
    """Makes a data set of LeRobot: plans a task in random variations of a scene, and executes the plans in simulation.

    Each attempt varies the scene, plans (planTask), executes (TaskPlan.execute), and films. The simulation decides
    whether the goal is reached. A state has the joint values and the openings of hands; an action has the command of
    the next frame. The same seed gives the same frames and images for every engine and number of workers. The
    bytes of films may differ on a busy machine. A call with the same
    arguments continues a data set that is not finished.

    Args:
        scene: A scene, or a function of a random generator that makes one. Objects need a mass.
        goal: The goal of planTask: "(on tray box)".
        episodes: Number of episodes.
        out: Folder of the data set.
        cameras: Frames of the cameras.
        size: Height and width of images, pixels; one number for both.
        fps: Frames per second; a divisor of the control rate, 100 Hz.
        seed: Seed of all random numbers.
        engine: "threads", "processes" or "ray", as for map.
        workers: Number of workers, as for map.
        keep: "success": episodes that reach the goal, also after repairs; "clean": only without repairs; "all":
            failures, too. Attempts without a plan have no frames and are left out.
        randomize: Called with the scene, a random generator and the cameras; Randomization() by default. `lambda *_:
            None` varies nothing.
        task: The task as a sentence; by default the goal's words.
        robot_type: Name of the robot.
        codec: "h264" or "av1".
        shard: Episodes per file, the unit of work and of continuation.
        progress: Whether to draw a progress bar.
    Returns:
        Numbers of episodes, frames and attempts, and reasons of failures.
    Raises:
        ArgumentError: An argument is invalid, or the folder has a data set of other arguments.
        NotFound: A package is not installed.
        FrameNotFound: There is no such camera.
        Error: No attempt of a shard succeeds.
    """
    if episodes < 1 or shard < 1:
        raise ArgumentError(f"demonstrate: episodes is {episodes}, shard {shard}; expected numbers above 0")
    if keep not in KEEP:
        raise ArgumentError(f"demonstrate: keep is {keep!r}; expected one of {', '.join(KEEP)}")
    if fps < 1 or 100 % fps:
        raise ArgumentError(f"demonstrate: fps is {fps}; expected a divisor of the control rate, 100 Hz, such as 20")
    if codec not in CODECS:
        raise ArgumentError(f"demonstrate: codec is {codec!r}; expected one of {', '.join(CODECS)}")
    for camera in cameras if isinstance(scene, Config) else ():
        Config.getFrame(scene, camera)  # a name that is not there is told before anything is written
    height, width = (size, size) if isinstance(size, int) else size
    vary = Randomization() if randomize is None else randomize
    job = _Job(scene, goal, tuple(cameras), (height, width), fps, seed, keep, vary, task or sentence(goal))
    settings = {
        "goal": goal,
        "cameras": list(cameras),
        "size": [height, width],
        "fps": fps,
        "seed": seed,
        "keep": keep,
        "task": job.task,
        "robot_type": robot_type,
        "codec": codec,
        "shard": shard,
        "randomize": vars(vary) if isinstance(vary, Randomization) else getattr(vary, "__qualname__", str(vary)),
        "scene": scene.write() if isinstance(scene, Config) else getattr(scene, "__qualname__", str(scene)),
    }
    folder = Path(out)
    _requireSame(folder, json.loads(json.dumps(settings)))
    counts = [min(shard, episodes - k) for k in range(0, episodes, shard)]
    done = set(finishedShards(folder))
    for k, count in enumerate(counts):
        _requireCount(folder, k, count, k in done)
    missing = [(k, count) for k, count in enumerate(counts) if k not in done]

    def make(item: tuple[int, int]) -> int:
        number, count = item
        return _makeShard(job, str(folder), robot_type, codec, number, count)

    if missing:
        mapItems(make, missing, engine=engine, workers=workers, errors="raise", progress=progress)
    info = mergeShards(folder)
    attempts, failures = 0, {}
    for k in range(len(counts)):
        report = json.loads((shardFolder(folder, k) / "attempts.json").read_text())
        attempts += report["attempts"]
        for reason, count in report["failures"].items():
            failures[reason] = failures.get(reason, 0) + count
    return Demonstrations(folder, info["total_episodes"], info["total_frames"], attempts, failures)


def _requireSame(folder: Path, settings: dict[str, Any]) -> None:
    """Writes the settings of a new data set, or raises ArgumentError if there are episodes of other ones."""
    path = folder / SHARDS / "settings.json"
    if not path.exists() or not finishedShards(folder):
        writeText(path, json.dumps(settings, indent=1))
        return
    known = json.loads(path.read_text())
    other = [key for key in settings if known.get(key) != settings[key]]
    if other:
        theirs = ", ".join(f"{key} {_short(known.get(key))} instead of {_short(settings[key])}" for key in other)
        raise ArgumentError(f"demonstrate: '{folder}' has demonstrations with {theirs}; choose another folder")


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 60 else text[:57] + "..."


def _requireCount(folder: Path, number: int, count: int, is_done: bool) -> None:
    """Raises ArgumentError if a finished shard has another number of episodes."""
    if not is_done:
        return
    found = len(json.loads((shardFolder(folder, number) / "episodes.json").read_text())["episodes"])
    if found != count:
        raise ArgumentError(
            f"demonstrate: '{folder}' has {found} episodes in shard {number}; expected {count}. A data set grows by whole "
            "shards; choose a multiple of `shard`, or another folder"
        )


@dataclass
class _Job:
    """The arguments of demonstrate that make an episode."""

    scene: Config | Callable[[np.random.Generator], Config]
    goal: str
    cameras: tuple[str, ...]
    size: tuple[int, int]
    fps: int
    seed: int
    keep: str
    randomize: Callable[..., None]
    task: str


@dataclass
class _Episode:
    names: list[str]
    state: list[np.ndarray]
    command: list[np.ndarray]
    images: dict[str, list[np.ndarray]]
    failure: str
    repairs: int


def _makeShard(job: _Job, folder: str, robot_type: str, codec: str, number: int, count: int) -> int:
    """Makes the episodes of a shard; returns the number of attempts."""
    made, failures, attempt = 0, {}, 0
    writer: LeRobotWriter | None = None
    root = Path(folder)
    shutil.rmtree(shardFolder(root, number).with_name(f"{number:06d}.part"), ignore_errors=True)
    while made < count:
        rng = np.random.default_rng(np.random.SeedSequence([job.seed, number, attempt]))
        attempt += 1
        episode = _attempt(job, rng)
        if episode.failure:
            failures[episode.failure] = failures.get(episode.failure, 0) + 1
        kept = bool(episode.state) and (job.keep == "all" or not episode.failure)
        if job.keep == "clean" and episode.repairs:
            kept = False
        if kept:
            if writer is None:
                sizes = dict.fromkeys(job.cameras, job.size)
                writer = LeRobotWriter(
                    root, job.fps, episode.names, None, sizes, robot_type, codec, number, merge=False
                )
            actions = [*episode.command[1:], episode.command[-1]]
            writer.addEpisode(episode.state, actions, episode.images, job.task, success=not episode.failure)
            made += 1
        elif attempt >= TRIES * (made + 1):
            raise Error(
                f"demonstrate: {attempt} attempts of shard {number} gave {made} episodes; the last one: "
                f"{episode.failure or 'it was repaired'}"
            )
    assert writer is not None
    writer.report = {"attempts": attempt, "failures": failures}
    writer.close()
    return attempt


def _attempt(job: _Job, rng: np.random.Generator) -> _Episode:
    """Plans and executes the task in a random variation of the scene."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        C = job.scene.copy() if isinstance(job.scene, Config) else job.scene(rng)
        for camera in job.cameras:
            C.getFrame(camera).setAttributes({"height": float(job.size[0]), "width": float(job.size[1])})
        job.randomize(C, rng, job.cameras)
        plan = _core.planTask(C, job.goal, seed=int(rng.integers(1 << 31)), threads=1)
        episode = _Episode([], [], [], {camera: [] for camera in job.cameras}, "", 0)
        if not plan.feasible:
            episode.failure = f"no plan: {plan.message}"
            return episode
        bot = BotOp(C)
        episode.names = stateNames(bot)

        def film(_: float) -> None:
            state, command = stateOf(bot)
            episode.state.append(state)
            episode.command.append(command)
            for camera in job.cameras:
                episode.images[camera].append(bot.getImage(camera))

        bot.watch(1 / job.fps, film)
        with contextlib.closing(bot):
            run = plan.execute(bot, threads=1)
        episode.repairs = run.repairs
        if not run.feasible:
            episode.failure = run.message
        return episode
