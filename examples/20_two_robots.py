"""Part 20: two robots.

Two robots at a table, moved by one BotOp.

Both arms grasp a block and lift it at the same time. In the simulated world, the grippers hold the blocks by force. The
log of all commands repeats the motion, to the bit. `python 20_two_robots.py lifted.png` saves a picture.
"""

import sys

import numpy as np

from robotic import ry

np.set_printoptions(precision=3, suppress=True)


def scene() -> ry.Config:
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandasTable.g"))
    for side, x in (("l", -0.35), ("r", 0.35)):
        block = C.addFrame(f"{side}_block").setShape(ry.ST.box, [0.05, 0.05, 0.08]).setColor([1, 0.5, 0])
        block.setPosition([x, 0.2, 0.64]).setMass(0.2)
    return C


def hands_at(C: ry.Config, height: float) -> np.ndarray:
    """Returns joint values of both arms with the hands at `height` above their blocks."""
    targets = {}
    for side in "lr":
        block = C.getFrame(f"{side}_block").getPosition()
        targets[f"{side}_gripper"] = {"position": block + height * np.eye(3)[2], "z": [0, 0, 1], "x": [1, 0, 0]}
    answer = ry.solveIk(C, targets)
    assert answer.feasible, answer.message
    return np.array(answer.q)


C = scene()
bot = ry.BotOp(C, False)
bot.sync(C, 0.3)  # the blocks come to rest on the table
start = [C.getFrame(f"{side}_block").getPosition()[2] for side in "lr"]
above, around = hands_at(C, 0.15), hands_at(C, 0.01)
bot.moveAutoTimed([above, above, around], maxVel=1.5)
bot.wait(C)
for hand in (ry._left, ry._right):
    bot.gripperClose(hand, force=20.0)
bot.wait(C, forTimeToEnd=False, forGripper=True)
bot.moveTo(above)
bot.wait(C)
bot.sync(C, 1.0)
lifted = [C.getFrame(f"{side}_block").getPosition()[2] - z for side, z in zip("lr", start)]
print(f"after {bot.get_t():.1f} s the blocks are {lifted[0]:.3f} m and {lifted[1]:.3f} m higher")
assert min(lifted) > 0.12
if len(sys.argv) > 1:
    C.view(offscreen=True)
    C.viewer().setWindow("both lift", 480, 360)
    C.viewer().setCamera([0.6, 2.0, 1.6], [0.0, 0.0, 0.9])
    C.viewer().savePng(sys.argv[1])

again = ry.BotOp(scene(), False)
again.replay(bot.getLog())
print("the replay is equal to the bit:", np.array_equal(again.get_q(), bot.get_q()))
C.view(True, "both blocks are lifted")
