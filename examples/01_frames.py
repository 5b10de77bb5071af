"""Part 1: frames. A scene is a tree of frames, each with a pose relative to its parent.

Loads mini.g, prints its frames, opens its door, and then watches the file: edit it and save.
"""

import os
import sys
from pathlib import Path

from robotic import ry

SCENE = str(Path(__file__).with_name("mini.g"))


def printFrames(C: ry.Config) -> None:
    print(f"{'frame':14} {'parent':14} {'position in the world, m':28} seen from the parent, m")
    for frame in C.getFrames():
        parent = frame.getParent()
        relative = frame.getRelativePosition().round(3) if parent else ""
        print(f"{frame.name:14} {parent.name if parent else '-':14} {frame.getPosition().round(3)!s:28} {relative}")


C = ry.Config()
C.addFile(SCENE)
printFrames(C)
C.view(True, "a post with a sign, and a door handle on a hinge")

# One number moves everything below the hinge.
print("\njoints:", C.getJointNames(), "between", C.getJointLimits().tolist())
C.setJointState([1.0])
print("door opened by 1 rad\n")
printFrames(C)
C.view(True, "the door is open")
assert abs(C.getFrame("hinge").getRelativeQuaternion()[0]) < 0.9  # cos(.5) = .88: it has rotated

if sys.stdin.isatty() and not os.environ.get("KINEGRAPH_HEADLESS"):
    print(f"\nwatching {SCENE}: change a number and save it; close the view to end")
    C.watchFile(SCENE)
