"""A loop at 1 kHz.

A gripper follows a target, within limits of velocity and acceleration, and avoids the table.

The loop runs in the time of the scene. On a robot, `BotOp` or a driver sends each `ik.step` and waits for the next ms.
"""

import time

import numpy as np

import kinegraph as ry

DT = 0.001  # s


def main() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    target = C.addFrame("target").setShape(ry.ST.marker, [0.2]).setPose(C.getFrame("l_gripper").getPose())
    start = np.array(target.getPosition())
    C.view()

    ik = ry.DiffIk(C, velocity=2.0, acceleration=20.0)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"])
    errors, used = [], []
    for t in np.arange(0, 6.3, DT):
        target.setPosition(start + 0.1 * np.array([np.sin(t), 1 - np.cos(t), 0]))
        begin = time.perf_counter()
        ik.step(DT)
        used.append(time.perf_counter() - begin)
        errors.append(np.linalg.norm(C.eval(ry.FS.positionDiff, ["l_gripper", "target"])[0]))
    print(f"around the circle within {1e3 * np.mean(errors):.3f} mm on average")
    print(f"a step takes {1e6 * np.median(used):.0f} of 1000 us")

    target.setPosition(start - [0, 0, 1])  # below the table
    for _ in range(3000):
        ik.step(DT)
    print("restricted by:", *ik.active, sep="\n    ")
    print(f"overlap: {C.coll_totalViolation():.4f} m")
    C.view()


if __name__ == "__main__":
    main()
