# The two-finger hand, mounted on the flange `panda_joint8` with an eighth of a turn.
#
# Both fingers slide along y by 0 to 4 cm. The second follows the first in the opposite direction. The fingers are not
# part of q (`joint_active: False`), as a real hand is commanded separately; `selectJoints` adds them.

panda_hand_joint_origin (panda_joint8): { Q: "d(-45 0 0 1)" }
panda_hand_joint (panda_hand_joint_origin): {
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
    -.018  -.09  .002, -.018   .09  .002,  .018  -.09  .002,  .018   .09  .002, -.019 -.091   .02
    -.019  .091   .02,  .019 -.091   .02,  .019  .091   .02, -.008 -.087  .054, -.008  .087  .054
     .008 -.087  .054,  .008  .087  .054,  .024   .01  -.01,   .01  .024  -.01,  -.01  .024  -.01
    -.024   .01  -.01, -.024  -.01  -.01,  -.01 -.024  -.01,   .01 -.024  -.01,  .024  -.01  -.01
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/hand.dae>
}

# where the fingers slide
panda_finger_joint1_origin (panda_hand_joint): { Q: [0 0 .0584] }
panda_finger_joint2_origin (panda_hand_joint): { Q: [0 0 .0584] }

panda_finger_joint1 (panda_finger_joint1_origin): {
  joint: transY, limits: [0 .04], ctrl_limits: [.2 20 -1], q: .04, joint_active: False,
  mj_actuator_kp: "500.", mj_joint_damping: "100.",
  shape: ssCvx, size: [.002], color: [.22 .23 .25],
  core: [
    -.008 .004 .003,  .008 .004 .003,  -.008 .023 .003,  .008 .023 .003,
    -.008 .004 .022,  .008 .004 .022,  -.008 .022 .022,  .008 .022 .022,
    -.007 .002 .052,  .007 .002 .052,  -.007 .013 .052,  .007 .013 .052
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/finger.dae>
}

panda_finger_joint2 (panda_finger_joint2_origin): {
  joint: transY, joint_scale: -1, mimic: panda_finger_joint1, limits: [0 .04], ctrl_limits: [.2 20 -1], q: .04,
  mj_actuator_kp: "500.", mj_joint_damping: "100."
}

# the second finger looks like the first, half a turn about the hand's axis
panda_rightfinger_0 (panda_finger_joint2): {
  Q: "d(180 0 0 1)",
  shape: ssCvx, size: [.002], color: [.22 .23 .25],
  core: [
    -.008 .004 .003,  .008 .004 .003,  -.008 .023 .003,  .008 .023 .003,
    -.008 .004 .022,  .008 .004 .022,  -.008 .022 .022,  .008 .022 .022,
    -.007 .002 .052,  .007 .002 .052,  -.007 .013 .052,  .007 .013 .052
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/finger.dae>
}
