# An arm of seven capsules, 40 cm each: six bend about axes that turn by 45 degrees from one to the next, the fifth joint
# is a ball. It hangs on a stem, among a target and an obstacle.

stem: { X: [0 0 1], shape: capsule, size: [2 .1] }

arm1 (j1): { Q: [0 0 .2], shape: capsule, size: [.4 .1], contact: -1 }
arm2 (j2): { Q: [0 0 .2], shape: capsule, size: [.4 .1], contact: -1 }
arm3 (j3): { Q: [0 0 .2], shape: capsule, size: [.4 .1], contact: -1 }
arm4 (j4): { Q: [0 0 .2], shape: capsule, size: [.4 .1], contact: -1 }
arm5 (j5): { Q: [0 0 .2], shape: capsule, size: [.4 .1], contact: -1 }
arm6 (j6): { Q: [0 0 .2], shape: capsule, size: [.4 .1], contact: -1 }
arm7 (j7): { Q: [0 0 .2], shape: capsule, size: [.4 .1], contact: -1 }

j1 (stem): { joint: hingeX, pre: "t(0 0 1) d(90 1 0 0)", limits: [-2 2] }
j2 (arm1): { joint: hingeX, pre: "t(0 0 .2) d(45 0 0 1)", limits: [-2 2] }
j3 (arm2): { joint: hingeX, pre: "t(0 0 .2) d(45 0 0 1)", limits: [-2 2] }
j4 (arm3): { joint: hingeX, pre: "t(0 0 .2) d(45 0 0 1)", limits: [-2 2] }
j5 (arm4): { joint: quatBall, pre: "t(0 0 .2) d(45 0 0 1)", limits: [0 -1 -1 -1 1.5 1 1 1] }
j6 (arm5): { joint: hingeX, pre: "t(0 0 .2) d(45 0 0 1)", limits: [-2 2] }
j7 (arm6): { joint: hingeX, pre: "t(0 0 .2) d(45 0 0 1)", limits: [-2 2] }

target: { X: [.7 -.5 1.2], shape: sphere, size: [.05], color: [0 .5 0] }
obstacle: { X: [1 -1.5 1], shape: sphere, size: [.5], color: [1 0 0], contact }

endeff (arm7): { Q: [0 0 .3], shape: marker, size: [.1] }
