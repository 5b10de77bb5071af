"""Part 15: grasp and lift.

A Panda grasps a box of 1 kg, lifts and rotates it, and the box does not slip.

A Simulation moves the Config itself: motors move the joints along a reference, gravity and contacts move the box.

`python 15_grasp_and_lift.py lifted.png` saves a picture of the box in the hand.
"""

import sys

import numpy as np

from robotic import ry

np.set_printoptions(precision=4, suppress=True)

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
start = np.array([0.0, 0.3, 0.68])
C.addFrame("box").setShape(ry.ST.ssBox, [0.06, 0.06, 0.06, 0.005]).setPosition(start).setColor([1, 0.5, 0]).setMass(1.0)


def reach(position: np.ndarray) -> np.ndarray:
    result = ry.solveIk(C, {"l_gripper": {"position": position, "z": [0, 0, 1], "y": [1, 0, 0]}})
    assert result.feasible, result.message
    return np.array(result.q)


def in_hand() -> np.ndarray:
    hand, box = C.getFrame("l_gripper"), C.getFrame("box")
    return np.asarray(hand.getRotationMatrix().T @ (box.getPosition() - hand.getPosition()))


above, at, up = reach(start + np.array([0, 0, 0.12])), reach(start), reach(start + np.array([0, 0, 0.2]))
turned = up + np.eye(7)[0]
C.setJointState(above)
S = ry.Simulation(C)


def go(q: np.ndarray, seconds: float = 1.0) -> None:
    S.setSplineRef([q], [seconds])
    S.multi_step(seconds, 0.01)


go(at)
S.closeGripper("l_gripper", force=30.0)
while not S.gripperIsDone("l_gripper"):
    S.step()
print("fingers are apart by", round(S.getGripperWidth("l_gripper"), 4), "m")

held = in_hand()
go(up)
go(turned)
if len(sys.argv) > 1:
    C.view(offscreen=True)
    C.viewer().setWindow("in the hand", 480, 360)
    C.viewer().setCamera([0.6, 1.6, 1.5], [-0.1, 0.1, 0.95])
    C.viewer().savePng(sys.argv[1])
go(up)
slip = 1e3 * np.linalg.norm(in_hand() - held)
print(f"lifted and rotated; it has slipped by {slip:.4f} mm")
assert slip < 0.05

state = S.getState()  # from here, the run repeats bit for bit
go(at)
first = C.getFrame("box").getPosition()
S.setState(state)
go(at)
assert np.array_equal(first, C.getFrame("box").getPosition())
S.moveGripper("l_gripper", 0.08)
S.multi_step(0.5)
print("put down at", C.getFrame("box").getPosition())
C.view(False, "the box is back")
