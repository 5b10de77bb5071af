# A UR5e arm: Denavit-Hartenberg parameters, masses, and limits of position (rad), speed (rad/s) and torque (Nm) from the
# manufacturer's public data sheets. Shapes are capsules and cylinders in place of its surfaces. Angles count as on the
# robot's own panel. The tool is to be attached to `tool0`.

base: {}
base_0 (base): { shape: cylinder, size: [.06 .075], Q: [0 0 .03], color: [.37 .37 .37], contact: -1 }

shoulder_pan (base): { joint: hingeZ, pre: "t(0 0 .1625)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 150 -1], q: 0 }
shoulder_pan_0 (shoulder_pan): { shape: capsule, size: [.0725 .058], Q: [0 0 -.03625], mass: 3.761, color: [.93 .94 .95], contact: -2 }

shoulder_lift (shoulder_pan): { joint: hingeZ, pre: "d(90 1 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 150 -1], q: -1.6 }
shoulder_lift_0 (shoulder_lift): { shape: capsule, size: [.138 .06], Q: [0 0 .069], color: [.28 .55 .76], contact: -2 }
shoulder_lift_1 (shoulder_lift): { shape: capsule, size: [.425 .055], Q: "t(-.2125 0 .138) d(90 0 1 0)", mass: 8.058, color: [.93 .94 .95], contact: -2 }

elbow (shoulder_lift): { joint: hingeZ, pre: "t(-.425 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 150 -1], q: 1.9 }
elbow_0 (elbow): { shape: capsule, size: [.131 .053], Q: [0 0 .0725], color: [.28 .55 .76], contact: -2 }
elbow_1 (elbow): { shape: capsule, size: [.3922 .045], Q: "t(-.1961 0 .007) d(90 0 1 0)", mass: 2.846, color: [.93 .94 .95], contact: -2 }

wrist_1 (elbow): { joint: hingeZ, pre: "t(-.3922 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 28 -1], q: -1.9 }
wrist_1_0 (wrist_1): { shape: capsule, size: [.1263 .04], Q: [0 0 .07015], mass: 1.37, color: [.28 .55 .76], contact: -2 }

wrist_2 (wrist_1): { joint: hingeZ, pre: "t(0 0 .1333) d(90 1 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 28 -1], q: -1.6 }
wrist_2_0 (wrist_2): { shape: capsule, size: [.0997 .038], Q: [0 0 .04985], mass: 1.3, color: [.93 .94 .95], contact: -2 }

wrist_3 (wrist_2): { joint: hingeZ, pre: "t(0 0 .0997) d(-90 1 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 28 -1], q: 0 }
wrist_3_0 (wrist_3): { shape: cylinder, size: [.0796 .035], Q: [0 0 .0598], mass: .365, color: [.28 .55 .76], contact: -2 }
tool0 (wrist_3): { Q: [0 0 .0996] }
