"""Part 16: a conveyor belt.

A conveyor belt carries boxes of different weight, and a bar pushes them off.

`surfaceVelocity` moves a shape's surface without moving the shape. `python 16_conveyor.py falls.png` saves a picture.
"""

import sys

import numpy as np

from robotic import ry

C = ry.Config()
C.addFrame("belt", "", "shape: box, size: [2 .3 .1], color: [.2 .2 .2], surfaceVelocity: [.3 0 0]").setPosition(
    [0, 0, 0.5]
)
C.addFrame("rail", "").setPosition([0.6, 0.4, 0.6])
C.addFrame("bar", "rail", "joint: transY, limits: [-1 1], shape: box, size: [.3 .05 .08], color: [.8 .3 .2]")
for i, mass in enumerate([0.05, 0.5, 2.0]):
    box = C.addFrame(f"box{i}").setShape(ry.ST.ssBox, [0.08, 0.08, 0.08, 0.005]).setPosition([-0.8 + 0.3 * i, 0, 0.59])
    box.setColor([1, 0.6, 0.2]).setMass(mass)

S = ry.Simulation(C)
for _ in range(150):
    S.step()
speeds = S.get_frameVelocities()[:, 0, 0]
print("the boxes move at", np.round(speeds, 4), "m/s")
assert np.allclose(speeds, 0.3, atol=1e-3)

# The bar waits until the first box (the one that started in front) is before it, then pushes.
while C.getFrame("box2").getPosition()[0] < 0.55:
    S.step()
for _ in range(60):
    S.step([-1.0], 0.01, ry.ControlMode.velocity)
if len(sys.argv) > 1:
    C.view(offscreen=True)
    C.viewer().setWindow("pushed off", 480, 360)
    C.viewer().setCamera([0.9, -1.5, 1.7], [0.15, -0.1, 0.4])
    C.viewer().savePng(sys.argv[1])
for _ in range(100):
    S.step()
heights = [C.getFrame(f"box{i}").getPosition()[2] for i in range(3)]
print("heights of the boxes:", np.round(heights, 3))
assert heights[2] < 0.1 < 0.5 < heights[0]
C.view(False, "one box is on the floor")
