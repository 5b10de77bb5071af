"""Writes motions that are already there, such as plans and recorded simulations, into MCAP files."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .._core import Config, Simulation, SimulationRecording, TaskPlan, Trajectory
from ..errors import ArgumentError
from .files import McapFile
from .recorder import Recorder, cameraOf


def saveRecording(
    path: str | os.PathLike[str],
    motion: Trajectory | TaskPlan | SimulationRecording,
    config: Config | None = None,
    *,
    rate: float = 100.0,
    cameras: Sequence[str] = (),
    camera_rate: float = 20.0,
    start: float = 0.0,
) -> None:
    """Writes a plan, a trajectory or a recorded simulation into a file .mcap, as `bot.recordTo` writes an execution.

    Args:
        path: Path of the file, which is replaced.
        motion: A plan of motions or tasks, any Trajectory, or a SimulationRecording.
        config: The scene at the start; not needed for a SimulationRecording. Its state does not change.
        rate: Samples per second, Hz; of a SimulationRecording at most one per step.
        cameras: Camera frames whose images are recorded as JPEG.
        camera_rate: Images per second, Hz.
        start: Unix time of time 0, s.
    Raises:
        ArgumentError: There is no motion, no scene, or a number is invalid.
        FrameNotFound: There is no such camera.
        FileError: The file cannot be written.
        NotFound: The packages of the extra `mcap` are not installed.
    """
    file = os.fspath(path)
    if not file.endswith(".mcap"):
        raise ArgumentError(f"saveRecording: the file is '{file}'; expected a name that ends in .mcap")
    recorder = Recorder("saveRecording", rate, cameras, camera_rate, start)
    scene, states = _states(motion, config, rate)
    for name in recorder.cameras:
        scene.getFrame(name)
    camera = cameraOf(scene)
    joints = scene.getJointNames()
    recorder.open(McapFile(file, "saveRecording"))
    try:
        for time, q, velocity in states:
            if recorder.isDue(time):
                recorder.sample(time, scene, joints, q, velocity)
                recorder.images(time, camera)
    finally:
        recorder.close()


States = Iterator[tuple[float, np.ndarray, np.ndarray]]


def _states(motion: Any, config: Config | None, rate: float) -> tuple[Config, States]:
    """Returns a scene, and an iterator that moves it along the motion."""
    if isinstance(motion, SimulationRecording):
        scene = motion.makeConfig()
        return scene, _recorded(motion, scene)
    if config is None:
        raise ArgumentError("saveRecording: config is None; expected the scene in which the motion takes place")
    scene = config.copy()
    if isinstance(motion, TaskPlan):
        return scene, _planned(motion, scene, config, rate)
    if not isinstance(motion, Trajectory):
        raise ArgumentError(
            f"saveRecording: motion is a {type(motion).__name__}; expected a plan, a Trajectory or a SimulationRecording"
        )
    n = scene.getJointDimension()
    if len(motion.eval(0.0)[0]) != n:
        raise ArgumentError(f"saveRecording: the motion has {len(motion.eval(0.0)[0])} joint values; the scene has {n}")
    return scene, _followed(motion, scene, rate)


def _followed(motion: Trajectory, scene: Config, rate: float) -> States:
    times, q, velocity, _ = motion.sample(rate)
    for row, time in enumerate(times):
        scene.setJointState(q[row])
        yield float(time), q[row], velocity[row]


def _recorded(motion: SimulationRecording, scene: Config) -> States:
    times, q, poses = motion.times, motion.q, motion.freePos
    free = Simulation(scene.copy()).getFreeFrames()
    frames = [scene.getFrame(frame.name) for frame in free]
    velocity = np.gradient(q, times, axis=0) if len(times) > 1 else np.zeros_like(q)
    for row, time in enumerate(times):
        scene.setJointState(q[row])
        for frame, pose in zip(frames, poses[row]):
            frame.setPose(pose)
        yield float(time), q[row], velocity[row]


def _planned(motion: TaskPlan, scene: Config, config: Config, rate: float) -> States:
    if not motion.feasible:
        raise ArgumentError(f"saveRecording: the plan has no motion: {motion.message}")
    frames = motion.frames(config, rate)
    count = len(frames)
    q = []
    for poses in frames:
        scene.setFrameState(poses)
        q.append(scene.getJointState())
    velocity = np.gradient(np.array(q), 1.0 / rate, axis=0) if count > 1 else np.zeros((count, len(q[0])))
    for row, poses in enumerate(frames):
        scene.setFrameState(poses)
        yield row / rate, q[row], velocity[row]
