"""Part 4: a manipulator of two links. Its joint angles determine the position of its end effector.

The arm moves in the y-z plane of the world. With the angles (a, b, c) the end effector is at

    y = .35 sin a + .33 sin(a + b),    z = .35 cos a + .33 cos(a + b),

with the distances .35 and .33 m between its hinges. The third hinge only rotates the end effector.
"""

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robotic import ry

C = ry.Config()
C.addFile(str(Path(__file__).with_name("two_link_arm.g")))
end = C.getFrame("endeffector")
print("frames:", C.getFrameNames())
print("q has", C.getJointDimension(), "entries:", C.getJointState())


def byHand(q: ArrayLike) -> NDArray[np.float64]:
    a, ab, _ = np.cumsum(q)
    return np.array([0, 0.35 * np.sin(a) + 0.33 * np.sin(ab), 0.35 * np.cos(a) + 0.33 * np.cos(ab)])


for q in ([0, 0, 0], [0.3, 0.4, 0.5], [np.pi / 2, 0, 0], [-0.5, 1.5, 0]):
    C.setJointState(q)
    difference = np.abs(end.getPosition() - byHand(q)).max()
    print(f"q = {np.round(q, 2)}: end effector at {end.getPosition().round(4)}, by hand the same to {difference:.1e} m")
    assert difference < 1e-9
    C.view(True, f"q = {np.round(q, 2)}")

# A slow wave: every joint swings with its own phase.
for t in np.linspace(0, 2 * np.pi, 60):
    C.setJointState(0.6 * np.sin(t + np.arange(3)))
    C.view()
