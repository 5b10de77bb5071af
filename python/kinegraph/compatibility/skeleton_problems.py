"""Benchmark problems of inverse kinematics and of skeletons; `get()` returns the NLP."""

from __future__ import annotations

import enum
from typing import ClassVar

from .._core import FS, KOMO, NLP, OT, SY, Config, Skeleton
from ..enums import teach
from ..errors import ArgumentError
from ..model_paths import raiPath


class ArgWord(enum.IntEnum):
    """Arguments of benchmarks: an arm, or the resolution of a motion."""

    _left = 0
    _right = 1
    _sequence = 2
    _path = 3


teach(ArgWord)
_left, _right, _sequence, _path = ArgWord


class _Benchmark:
    _komo: KOMO

    def get(self) -> NLP:
        """The problem."""
        return self._komo.nlp()


class OptBenchmark_InvKin_Endeff(_Benchmark):
    """Moves a frame `gripper` to the pose of a frame `box` in one step of 1 s."""

    def __init__(self, file: str, unconstrained: bool) -> None:
        """Loads the scene.

        Args:
            file: A scene with both frames.
            unconstrained: Whether the features are costs; otherwise constraints.
        """
        C = Config()
        C.addFile(file)
        komo = KOMO(C, 1, 1, 1, False)
        komo.addControlObjective([], 1, 1.0)
        kind, scale = (OT.sos, 100.0) if unconstrained else (OT.eq, 1.0)
        for feature in (FS.positionDiff, FS.vectorZDiff, FS.scalarProductXX):
            komo.addObjective([], feature, ["gripper", "box"], kind, [scale])
        self._komo = komo


class _SkeletonBenchmark(_Benchmark):
    _entries: ClassVar[list]

    def __init__(self, sequenceOrPath: ArgWord) -> None:
        word = ArgWord(sequenceOrPath)
        if word not in (ArgWord._sequence, ArgWord._path):
            raise ArgumentError(f"{type(self).__name__}: sequenceOrPath is {word!r}; expected _sequence or _path")
        skeleton = Skeleton()
        skeleton.add([part for entry in self._entries for part in entry])
        C = Config()
        C.addFile(raiPath("scenarios/twoArmsTable.g"))
        komo = KOMO()
        komo.setConfig(C, False)
        if word == ArgWord._sequence:
            komo.setTiming(skeleton.getMaxPhase(), 1, 2.0, 1)
            komo.addControlObjective([], 1, 0.1)
        else:
            komo.setTiming(skeleton.getMaxPhase(), 30, 5.0, 2)
            komo.addControlObjective([], 2, 1.0)
        komo.addQuaternionNorms()
        komo.setSkeleton(skeleton)
        self._komo = komo


def _carry(arm: str, obj: str, place: str, start: float, end: float, down: float, up: float) -> list:
    """An arm grasps an object at `start`, descending from `down` to `up`, and releases it at `end` on a place."""
    return [
        ([start], SY.touch, [arm, obj]),
        ([start, end], SY.stable, [arm, obj]),
        ([down, up], SY.downUp, [arm]),
        ([end], SY.touch, [place, obj]),
        ([end - 0.1, end + 0.1], SY.downUp, [arm]),
    ]


def _standing(times: list[float], below: str, obj: str) -> list:
    """Forces from below balance an object."""
    return [(times, SY.forceBalance, [obj]), (times, SY.contact, [below, obj])]


class OptBench_Skeleton_Pick(_SkeletonBenchmark):
    """One of two arms picks a cube from a table.

    Args:
        sequenceOrPath: `_sequence`, one slice per phase, or `_path`, 30 per phase.
    """

    _entries: ClassVar[list] = [([1.0], SY.touch, ["R_endeff", "box3"]), ([1.0], SY.stable, ["R_endeff", "box3"])]


class OptBench_Skeleton_Handover(_SkeletonBenchmark):
    """One arm hands a stick over to the other, which touches a ball with it.

    Args:
        sequenceOrPath: `_sequence`, one slice per phase, or `_path`, 30 per phase.
    """

    _entries: ClassVar[list] = [
        ([1.0], SY.touch, ["R_endeff", "stick"]),
        ([1.0, 2.0], SY.stable, ["R_endeff", "stick"]),
        ([2.0], SY.touch, ["L_endeff", "stick"]),
        ([2.0, -1.0], SY.stable, ["L_endeff", "stick"]),
        ([3.0, -1.0], SY.touch, ["stick", "ball"]),
    ]


class OptBench_Skeleton_StackAndBalance(_SkeletonBenchmark):
    """Two arms stack a plank on a cube and two cubes on the plank; forces between the objects balance the stack.

    Args:
        sequenceOrPath: `_sequence`, one slice per phase, or `_path`, 30 per phase.
    """

    _entries: ClassVar[list] = [
        *_carry("R_endeff", "box0", "table", 1.0, 2.0, 0.9, 1.1),
        ([2.0, -1.0], SY.stable, ["table", "box0"]),
        *_carry("L_endeff", "box1", "box0", 1.5, 3.0, 1.4, 1.5),
        ([3.0, -1.0], SY.stable, ["box0", "box1"]),
        *_standing([3.0, 4.0], "box0", "box1"),
        *_carry("R_endeff", "box2", "box1", 4.0, 5.0, 3.9, 4.5),
        ([5.0, -1.0], SY.stable, ["box1", "box2"]),
        *_standing([5.0], "box1", "box2"),
        *_standing([5.0, -1.0], "box0", "box1"),
        *_carry("L_endeff", "box3", "box1", 4.0, 5.0, 3.9, 4.5),
        ([5.0], SY.touch, ["box2", "box3"]),
        ([5.0, 5.5], SY.stable, ["box1", "box3"]),
        *_standing([5.0], "box1", "box3"),
    ]
