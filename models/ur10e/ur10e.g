# A UR10e arm: Denavit-Hartenberg parameters, masses, and limits of position (rad), speed (rad/s) and torque (Nm) from the
# manufacturer's public data sheets. Shapes are capsules and cylinders in place of its surfaces. Angles count as on the
# robot's own panel. The tool is to be attached to `tool0`.

base: {}
base_0 (base): { shape: cylinder, size: [.06 .095], Q: [0 0 .03], color: [.37 .37 .37], contact: -1 }

shoulder_pan (base): { joint: hingeZ, pre: "t(0 0 .1807)", limits: [-6.28319 6.28319], ctrl_limits: [2.0944 330 -1], q: 0 }
shoulder_pan_0 (shoulder_pan): { shape: capsule, size: [.0907 .078], Q: [0 0 -.04535], mass: 7.369, color: [.93 .94 .95], contact: -2 }

shoulder_lift (shoulder_pan): { joint: hingeZ, pre: "d(90 1 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [2.0944 330 -1], q: -1.6 }
shoulder_lift_0 (shoulder_lift): { shape: capsule, size: [.176 .08], Q: [0 0 .088], color: [.28 .55 .76], contact: -2 }
shoulder_lift_1 (shoulder_lift): { shape: capsule, size: [.6127 .07], Q: "t(-.30635 0 .176) d(90 0 1 0)", mass: 13.051, color: [.93 .94 .95], contact: -2 }

elbow (shoulder_lift): { joint: hingeZ, pre: "t(-.6127 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 150 -1], q: 1.9 }
elbow_0 (elbow): { shape: capsule, size: [.1367 .068], Q: [0 0 .10765], color: [.28 .55 .76], contact: -2 }
elbow_1 (elbow): { shape: capsule, size: [.57155 .055], Q: "t(-.28578 0 .0393) d(90 0 1 0)", mass: 3.989, color: [.93 .94 .95], contact: -2 }

wrist_1 (elbow): { joint: hingeZ, pre: "t(-.57155 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 56 -1], q: -1.9 }
wrist_1_0 (wrist_1): { shape: capsule, size: [.13485 .045], Q: [0 0 .10673], mass: 2.1, color: [.28 .55 .76], contact: -2 }

wrist_2 (wrist_1): { joint: hingeZ, pre: "t(0 0 .17415) d(90 1 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 56 -1], q: -1.6 }
wrist_2_0 (wrist_2): { shape: capsule, size: [.11985 .043], Q: [0 0 .05992], mass: 1.98, color: [.93 .94 .95], contact: -2 }

wrist_3 (wrist_2): { joint: hingeZ, pre: "t(0 0 .11985) d(-90 1 0 0)", limits: [-6.28319 6.28319], ctrl_limits: [3.1416 56 -1], q: 0 }
wrist_3_0 (wrist_3): { shape: cylinder, size: [.09655 .04], Q: [0 0 .06828], mass: .615, color: [.28 .55 .76], contact: -2 }
tool0 (wrist_3): { Q: [0 0 .11655] }
