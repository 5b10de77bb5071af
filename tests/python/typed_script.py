"""A script with types, for mypy --strict: common uses of scenes, features, motions and results."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray

import kinegraph
import robotic
from robotic import ry


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    target: ry.Frame = C.addFrame("target", "table").setShape(ry.ST.marker, [0.1]).setRelativePosition([0.0, 0.3, 0.3])
    target.setColor([1, 0, 0]).setPosition(np.array([0.1, 0.2, 0.9])).setContact(0)
    box = C.addFrame(name="box", parent="world", args="shape: box, size: [1 1 1]")
    points, triangles, colors = box.getMesh()
    assert points.shape[1] == triangles.shape[1] and colors.dtype == np.uint8
    return C


def reach(C: ry.Config, steps: int = 1) -> NDArray[np.float64]:
    komo = ry.KOMO(C, 1, steps, 0, False)
    komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [1e-1], C.getJointState())
    komo.addObjective([], ry.FS.positionDiff, ["l_gripper", "target"], ry.OT.eq, [1e1])
    result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
    assert result.feasible
    path: NDArray[np.float64] = komo.getPath()
    return path


def main() -> None:
    C = scene()
    q: NDArray[np.float64] = C.getJointState()
    y, J = C.eval(ry.FS.position, ["l_gripper"])
    assert y.shape == (3,) and J.shape == (3, len(q))
    names: list[str] = [frame.name for frame in C if "panda" in frame.name]
    attributes: dict[str, Any] = C["table"].getAttributes()
    pairs: list[tuple[str, str, float]] = C.getCollisions(belowMargin=0.1)
    other: kinegraph.Config = copy.deepcopy(C)
    other.setJointState(reach(C)[0])
    jacobian: NDArray[np.float64] = other.getFrame("l_gripper").get_Jacobian_pos()
    M, F = C.dyn_MF(0 * q)
    one: ry.IkResult = ry.solveIk(C, {"l_gripper": {"position": "target", "z": [0, 0, 1]}})
    applied: ry.IkResult = ry.solveIk(C, {"l_gripper": C.getFrame("target").getPosition()}, apply=True)
    many = ry.solveIk(C, {"l_gripper": np.tile(C.getFrame("target").getPosition(), (3, 1))})
    assert isinstance(many, ry.IkResults) and bool(many.feasible.all()) and one.feasible and applied.feasible
    attempts: NDArray[np.int64] = many.attempts
    contact: ry.MotionContact | None = C.checkMotion(one.q, applied.q)
    print(attempts, contact)
    print(len(C), names[0], sorted(attributes), len(pairs), jacobian.shape, M.shape, F.shape, robotic.__version__)


if __name__ == "__main__":
    main()
