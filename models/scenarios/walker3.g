# A chain with two ball joints and a knee between them, and a foot at either end.

endeffA: { X: [0 0 .05], shape: sphere, size: [.06], color: [.9 .9 .9], contact: -2, logical: { gripper } }
arm0 (endeffA): { Q: [0 0 .1], shape: ssBox, size: [.1 .1 .2 .03], mass: .5, contact: -2 }

# joints sit at the lower ends of their bars
jointA (arm0): { joint: quatBall, pre: [0 0 .1], q: [.9659258 .2588190 0 0] }
jointA_bar (jointA): { Q: [0 0 .25], shape: ssBox, size: [.1 .1 .5 .03], mass: 1, contact: -2 }
jointMid (jointA_bar): { joint: hingeX, pre: [0 0 .25], q: 2 }
jointMid_bar (jointMid): { Q: [0 0 .25], shape: ssBox, size: [.1 .1 .5 .03], mass: 1, contact: -2 }
jointB (jointMid_bar): { joint: quatBall, pre: [0 0 .25], q: [.9659258 .2588190 0 0] }
jointB_bar (jointB): { Q: [0 0 .1], shape: ssBox, size: [.1 .1 .2 .03], mass: 1, contact: -2 }

endeffB (jointB_bar): { Q: [0 0 .1], shape: sphere, size: [.06], color: [.9 .9 .9], contact: -2, logical: { gripper } }
