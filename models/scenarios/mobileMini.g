# A small mobile arm: a base that drives in the plane, two bending joints and a wrist of three.

world: { X: [0 0 .2] }
base (world): { joint: transXYPhi, limits: [-10 -10 -4 10 10 4], shape: ssBox, size: [.4 .4 .4 .05], contact: 1 }
arm0 (base): { Q: [0 0 .3], shape: capsule, size: [.4 .08], contact: -1 }

# upper arm
joint1 (arm0): { joint: hingeX, pre: [0 0 .2], limits: [-1 2], q: .5 }
arm1 (joint1): { Q: [0 0 .4], shape: capsule, size: [.8 .06] }
arm1_coll (arm1): { shape: capsule, size: [.8 .2], color: [1 1 1 .2], contact: -2 }

# forearm
joint2 (arm1): { joint: hingeX, pre: [0 0 .4], limits: [-1 3], q: 1.5 }
arm2 (joint2): { Q: [0 0 .2], shape: capsule, size: [.4 .04] }
arm2_coll (arm2): { shape: capsule, size: [.25 .13], color: [1 1 1 .2], contact: -2 }

# wrist
joint2a (arm2): { joint: hingeZ, pre: [0 0 .25], limits: [-2 2] }
joint2b (joint2a): { joint: hingeX, limits: [-2 2] }
joint2c (joint2b): { joint: hingeY, limits: [-1 1] }
arm3 (joint2c): { shape: ssBox, size: [.1 .05 .03 .01] }

Include: <gripper.g>
Edit gripper (joint2c): { Q: "d(180 1 0 0)" }
