# The SO-101 arm of The Robot Studio and Hugging Face: five joints and a gripper with one moving jaw.
#
# Joint frames, limits of position, masses and centers are figures of the public description with LeRobot's new calibration (zero is
# the middle of each joint's range; Apache-2.0). Names are those of LeRobot's motors, except for the moving jaw, whose
# motor is called gripper there. Limits of speed and torque are about those of its servos (STS3215, 7.4 V). Shapes are
# boxes and capsules of our own in place of its surfaces.

base: { multibody: true, multibody_gravity: false }
base_0 (base): { shape: ssBox, size: [.1 .07 .06 .008], Q: [-.005 0 .03], mass: .147, color: [.95 .75 .1], contact: -1 }

shoulder_pan (base): {
  joint: hingeZ, pre: "t(.0388353 0 .0624) d(180 0 1 0)", limits: [-1.91986 1.91986], ctrl_limits: [4.7 1.9 -1], q: 0
}
shoulder_pan_0 (shoulder_pan): {
  shape: ssBox, size: [.056 .05 .052 .006], Q: [-.0304 0 -.03], mass: .1, color: [.15 .15 .15], contact: -2
}

shoulder_lift (shoulder_pan): {
  joint: hingeZ, pre: "t(-.0303992 -.0182778 -.0542) d(-90 0 1 0) d(-90 1 0 0)",
  limits: [-1.74533 1.74533], ctrl_limits: [4.7 1.9 -1], q: 0
}
shoulder_lift_0 (shoulder_lift): {
  shape: capsule, size: [.1 .022], Q: "t(-.06 -.012 .0184) d(98 0 0 1) d(90 1 0 0)", mass: .103, color: [.95 .75 .1], contact: -2
}

elbow_flex (shoulder_lift): {
  joint: hingeZ, pre: "t(-.11257 -.028 0) d(90 0 0 1)", limits: [-1.69 1.69], ctrl_limits: [4.7 1.9 -1], q: 0
}
elbow_flex_0 (elbow_flex): {
  shape: capsule, size: [.11 .02], Q: "t(-.065 .003 .0183) d(90 0 1 0)", mass: .104, color: [.95 .75 .1], contact: -2
}

wrist_flex (elbow_flex): {
  joint: hingeZ, pre: "t(-.1349 .0052 0) d(-90 0 0 1)", limits: [-1.65806 1.65806], ctrl_limits: [4.7 1.9 -1], q: 0
}
wrist_flex_0 (wrist_flex): {
  shape: ssBox, size: [.04 .056 .046 .006], Q: [0 -.034 .0245], mass: .079, color: [.15 .15 .15], contact: -2
}

wrist_roll (wrist_flex): {
  joint: hingeZ, pre: "t(0 -.0611 .0181) d(180 0 0 1) d(2.78913 0 1 0) d(90 1 0 0)",
  limits: [-2.74385 2.84121], ctrl_limits: [4.7 1.9 -1], q: 0
}
wrist_roll_0 (wrist_roll): {
  shape: ssBox, size: [.056 .046 .046 .006], Q: [.004 0 -.024], mass: .087, color: [.95 .75 .1], contact: -2
}
gripper_frame (wrist_roll): { Q: "t(-.0079 -.000218 -.0981274) d(180 0 1 0)" } # of the description: z points out of the jaws

# The point to command, between the jaws: z points back into the hand, x from jaw to jaw.
gripper (wrist_roll): { Q: [.007 0 -.088], shape: marker, size: [.03], color: [.9], logical: { gripper } }

# The moving jaw is not part of q, as grippers are commanded separately. Its opening grows with its angle.
jaw (wrist_roll): {
  joint: hingeZ, pre: "t(.0202 .0188 -.0234) d(90 1 0 0)", limits: [-.174533 1.74533], ctrl_limits: [4.7 1.9 -1], q: .5,
  joint_active: False
}
jaw_0 (jaw): { shape: ssBox, size: [.012 .06 .026 .004], Q: [-.004 -.025 .0188], mass: .012, color: [.15 .15 .15] }
finger2 (jaw): { shape: ssBox, size: [.01 .034 .026 .004], Q: [-.009 -.062 .0188], color: [.15 .15 .15], contact: -2 }

# The fixed jaw. A gripper here is a pair of moving fingers, so this one turns by a millionth of the other's angle.
fixed_jaw (wrist_roll): {
  joint: hingeZ, pre: "t(-.0079 .0188 -.0234) d(90 1 0 0)", joint_scale: -1e-6, mimic: jaw, limits: [-.174533 1.74533]
}
fixed_jaw_0 (fixed_jaw): { shape: ssBox, size: [.012 .04 .026 .004], Q: [-.006 -.03 .0188], color: [.95 .75 .1] }
finger1 (fixed_jaw): { shape: ssBox, size: [.01 .034 .026 .004], Q: [-.005 -.062 .0188], color: [.95 .75 .1], contact: -2 }
