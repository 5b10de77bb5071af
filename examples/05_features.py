"""Part 5: features. A feature is a quantity y of a configuration that comes with its derivative J = dy/dq.

Evaluates the features on two Panda arms, and compares every J with finite differences of y.
"""

import numpy as np
from numpy.typing import NDArray

from robotic import ry

FS = ry.FS


def twoArms() -> ry.Config:
    """Two Pandas, 80 cm apart: `gripper` on the left one, `r_gripper` on the right one, and a box."""
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    C.addFile(ry.raiPath("panda/panda.g"), "r_")
    C.getFrame("r_panda_base").setPosition([0, -0.8, 0])
    C.addFrame("box").setPosition([0.5, -0.4, 0.3]).setShape(ry.ST.ssBox, [0.3, 0.3, 0.3, 0.02]).setContact(1)
    return C


def differenceToFiniteDifferences(
    C: ry.Config, symbol: ry.FS, frames: list[str], J: NDArray[np.float64], step: float = 1e-5
) -> float:
    q = C.getJointState()
    worst = 0.0
    for i in range(q.size):
        y = []
        for sign in (1, -1):
            moved = q.copy()
            moved[i] += sign * step
            C.setJointState(moved)
            y.append(C.eval(symbol, frames)[0])
        worst = max(worst, np.abs((y[0] - y[1]) / (2 * step) - J[:, i]).max(initial=0.0))
    C.setJointState(q)
    return worst


ONE = ["position", "quaternion", "pose", "vectorX", "vectorY", "vectorZ"]
TWO = [name + kind for name in ONE for kind in ("Diff", "Rel")] + ["gazeAt"]
TWO += ["scalarProduct" + axes for axes in ("XX", "XY", "XZ", "YX", "YY", "YZ", "ZZ")]
TABLE = [(name, ["gripper"]) for name in ONE] + [(name, ["gripper", "r_gripper"]) for name in TWO]
TABLE += [("distance", ["panda_coll7", "r_panda_coll7"]), ("negDistance", ["panda_coll7", "box"])]
TABLE += [(name, ["gripper", "box"]) for name in ("aboveBox", "insideBox")]
TABLE += [("oppose", ["finger1", "finger2", "box"])]
TABLE += [(name, []) for name in ("accumulatedCollisions", "jointLimits", "qItself")]

C = twoArms()
rng = np.random.default_rng(1)
C.setJointState(C.getJointState() + 0.2 * rng.standard_normal(C.getJointDimension()))
C.view(True, "two arms and a box")

print(f"{'feature':22} {'frames':26} {'D':>2} {'|J - J_fd|':>11}  y")
for name, frames in TABLE:
    y, J = C.eval(getattr(FS, name), frames)
    error = differenceToFiniteDifferences(C, getattr(FS, name), frames, J)
    shown = str(y[:7].round(3))[1:-1] + (" ..." if y.size > 7 else "")
    print(f"{name:22} {' '.join(frames):26} {y.size:2} {error:11.1e}  {shown}")
    assert J.shape == (y.size, C.getJointDimension()) and error < 1e-6

# Velocities compare two configurations: the one of C, and the next slice of a path that starts there.
komo = ry.KOMO(C, 1, 1, 1, False)
komo.addObjective([], FS.angularVel, ["gripper"], ry.OT.eq, [1.0], [], 1)
q = C.getJointState()
q[6] += 0.5
y = komo.nlp().evaluate(q)[0]
print("\nangularVel of the gripper when its last joint rotates by .5 rad within 1 s:")
print(" ", np.round(y, 4), "with norm", np.linalg.norm(y).round(4))

# The same features on a scene with a single arm.
D = ry.Config()
D.addFile(ry.raiPath("scenarios/pandaSingle.g"))
print("height of the gripper over the table:", D.eval(FS.positionRel, ["l_gripper", "table"])[0][2].round(4), "m")
print("distance of palm and table:", -D.eval(FS.negDistance, ["l_palm", "table"])[0][0].round(4), "m")
