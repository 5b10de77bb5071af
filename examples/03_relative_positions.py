"""Part 3: relative positions. A frame with a parent moves along with it."""

from pathlib import Path

import numpy as np

from robotic import ry


def show(frame: ry.Frame) -> None:
    print(f"  {frame.name}: position {frame.getPosition().round(3)}, orientation {frame.getQuaternion().round(3)}")


C = ry.Config()
C.addFile(str(Path(__file__).with_name("box.g")))
box1 = C.getFrame("box1")
box2 = (
    C.addFrame("box2", "box1")
    .setShape(ry.ST.ssBox, size=[0.5, 0.5, 0.5, 0.05])
    .setRelativePosition([0, 0, 1])
    .setColor([0, 0, 1])
)

# box2 is 1 m above its parent, and the parent is .25 m above the ground: 1.25 m in the world.
print("a second box, 1 m above the first:")
show(box1)
show(box2)
assert np.allclose(box2.getPosition(), [0, 0, 1.25])
C.view(True, "the blue box is 1 m above the orange one")

box1.setPosition([0.5, 0, 0.25])
print("after moving only the first box by .5 m along x:")
show(box1)
show(box2)
C.view(True, "both moved")

# `Above` means along the parent's z axis, so a tilted parent moves its child to the side.
box1.setQuaternion([np.cos(np.pi / 8), np.sin(np.pi / 8), 0, 0])
print("after tilting only the first box by 45 degrees about x:")
show(box1)
show(box2)
print("  seen from box1, box2 has not moved:", box2.getRelativePosition().round(3))
C.view(True, "both tilted")
