# A ball on one side of a thin wall, and where it is to go on the other.

wall: { X: [0 0 1], shape: ssBox, size: [.03 1 2 .01] }
ball (wall): { joint: trans3, q: [-2 .5 0], shape: sphere, size: [.1] }
target: { X: [2 -.5 1], shape: sphere, size: [.1], color: [0 1 0 .4] }
