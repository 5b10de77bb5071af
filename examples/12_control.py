"""A gripper follows a target in steps of 5 ms, within limits of velocity and acceleration, and avoids the table."""

import numpy as np

import kinegraph as ry


def main() -> None:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    target = C.addFrame("target").setShape(ry.ST.marker, [0.2]).setPose(C.getFrame("l_gripper").getPose())
    start = np.array(target.getPosition())
    C.view()

    ik = ry.DiffIk(C, velocity=2.0, acceleration=20.0)
    ik.addTask(ry.FS.poseDiff, ["l_gripper", "target"])
    errors = []
    for t in np.arange(0, 6.3, 0.005):
        target.setPosition(start + 0.1 * np.array([np.sin(t), 1 - np.cos(t), 0]))
        ik.step(0.005)
        errors.append(np.linalg.norm(C.eval(ry.FS.positionDiff, ["l_gripper", "target"])[0]))
    print(f"around the circle within {1e3 * np.mean(errors):.3f} mm on average")

    target.setPosition(start - [0, 0, 1])  # below the table
    for _ in range(600):
        ik.step(0.005)
    print("restricted by:", *ik.active, sep="\n    ")
    print(f"overlap: {C.coll_totalViolation():.4f} m")


if __name__ == "__main__":
    main()
