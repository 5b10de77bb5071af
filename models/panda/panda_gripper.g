# The Panda's hand without its arm: its root is `panda_hand`. The fingers are part of q.

panda_hand: {}
panda_hand_0 (panda_hand): {
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
    -.018  -.09  .002, -.018   .09  .002,  .018  -.09  .002,  .018   .09  .002, -.019 -.091   .02
    -.019  .091   .02,  .019 -.091   .02,  .019  .091   .02, -.008 -.087  .054, -.008  .087  .054
     .008 -.087  .054,  .008  .087  .054,  .024   .01  -.01,   .01  .024  -.01,  -.01  .024  -.01
    -.024   .01  -.01, -.024  -.01  -.01,  -.01 -.024  -.01,   .01 -.024  -.01,  .024  -.01  -.01
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/hand.dae>
}

panda_finger_joint1_origin (panda_hand): { Q: [0 0 .0584] }
panda_finger_joint2_origin (panda_hand): { Q: [0 0 .0584] }
panda_finger_joint1 (panda_finger_joint1_origin): {
  joint: transY, limits: [0 .04], ctrl_limits: [.2 20 -1], motorKp: 100, motorKd: 10
}
panda_finger_joint2 (panda_finger_joint2_origin): {
  joint: transY, joint_scale: -1, mimic: panda_finger_joint1, limits: [0 .04], ctrl_limits: [.2 20 -1],
  motorKp: 100, motorKd: 10
}

# the second finger is the first, half a turn about the hand's axis
panda_leftfinger (panda_finger_joint1): {
  mass: .05, inertia: [1.83e-5 0 0 1.75e-5 2e-6 6.8e-6], shape: ssCvx, size: [.002], color: [.22 .23 .25],
  core: [
    -.008 .004 .003,  .008 .004 .003,  -.008 .023 .003,  .008 .023 .003,
    -.008 .004 .022,  .008 .004 .022,  -.008 .022 .022,  .008 .022 .022,
    -.007 .002 .052,  .007 .002 .052,  -.007 .013 .052,  .007 .013 .052
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/finger.dae>
}
panda_rightfinger (panda_finger_joint2): {
  Q: "d(180 0 0 1)", mass: .05, inertia: [1.83e-5 0 0 1.75e-5 2e-6 6.8e-6],
  shape: ssCvx, size: [.002], color: [.22 .23 .25],
  core: [
    -.008 .004 .003,  .008 .004 .003,  -.008 .023 .003,  .008 .023 .003,
    -.008 .004 .022,  .008 .004 .022,  -.008 .022 .022,  .008 .022 .022,
    -.007 .002 .052,  .007 .002 .052,  -.007 .013 .052,  .007 .013 .052
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/finger.dae>
}
