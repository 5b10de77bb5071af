"""Part 9: custom features. A Python function of frames is a feature like any other.

It receives a view of each frame at one configuration and returns a value, or a value and its Jacobian. Without the
Jacobian, central differences replace it.
"""

import numpy as np
from numpy.typing import NDArray

import kinegraph as ry

np.set_printoptions(suppress=True, precision=4)

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
C.addFrame("post", "table").setShape(ry.ST.marker, [0.1]).setRelativePosition([0.2, 0.35, 0.4])


def fromAxis(gripper: ry.FrameView, post: ry.FrameView) -> float:
    """Distance of the gripper from the vertical line through the post, squared (m^2)."""
    d = (gripper.getPosition() - post.getPosition())[:2]
    return float(d @ d)


def onHeight(gripper: ry.FrameView) -> tuple[float, NDArray[np.float64]]:
    """Height of the gripper (m), with its Jacobian."""
    return gripper.getPosition()[2], gripper.getPositionJacobian()[2]


print("distance squared and its gradient:", *C.eval(fromAxis, ["l_gripper", "post"]))

komo = ry.KOMO(C, 1, 1, 0, False)
komo.addObjective([], ry.FS.jointState, [], ry.OT.sos, [0.1], C.getJointState())
komo.addObjective([], fromAxis, ["l_gripper", "post"], ry.OT.eq, [10.0], [0.15**2])  # on a cylinder around the post
komo.addObjective([], onHeight, ["l_gripper"], ry.OT.eq, [10.0], [1.1])
result = ry.NLP_Solver(komo.nlp(), verbose=0).solve()
print(result)

start, end = C.getJointState(), komo.getPath()[0]
C.setJointState(end)
distance = float(np.sqrt(C.eval(fromAxis, ["l_gripper", "post"])[0][0]))
print(f"gripper at height {C.eval(onHeight, ['l_gripper'])[0][0]:.4f} m, {distance:.4f} m from the post")

assert result.feasible and abs(distance - 0.15) < 1e-3

contact = C.checkMotion(start, end)
print("the straight way there is free" if contact is None else contact)
