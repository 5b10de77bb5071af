# A chain of two bending joints with a ball at either end, both of which turn.

handA: { X: [0 0 .1], shape: sphere, size: [.1], color: [1 .5 0], contact: -1, logical: { gripper, support } }

arm0 (handA): { joint: hingeZ, pre: [0 0 .22], shape: ssBox, size: [.1 .1 .5 .03], mass: 1, contact: -1 }

# joints sit at the lower ends of their bars
arm1 (arm0): { joint: hingeX, pre: [0 0 .22], q: 1 }
arm1_bar (arm1): { Q: [0 0 .22], shape: ssBox, size: [.1 .1 .5 .03], mass: 1, contact: -1 }
arm2 (arm1_bar): { joint: hingeX, pre: [0 0 .22], q: 1 }
arm2_bar (arm2): { Q: [0 0 .22], shape: ssBox, size: [.1 .1 .5 .03], mass: 1, contact: -1 }

endeffB (arm2_bar): {
  joint: hingeZ, pre: [0 0 .22], ctrl_H: .1, shape: sphere, size: [.1], color: [1 0 .5], contact: -1, logical: { gripper }
}
