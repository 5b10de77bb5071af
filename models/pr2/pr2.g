# The PR2 on its mobile base, in a pose to work from: 25 dofs. The base moves in the plane by
# `worldTranslationRotation`; the wheels stand still, and the inner parts of the grippers follow their finger.

world: {}
worldTranslationRotation (world): {
  joint: transXYPhi, q: [0 0 1.5707963268], limits: [-10 -10 -6 10 10 6], ctrl_H: 10, gains: [1 1], base
}

Include: <pr2_conv.g>
Edit base_footprint (worldTranslationRotation): { Q: [0 0 .05] }

# What collides: boxes around the links, nearly transparent. A flag -k means: not with what is up to k joints nearer to
# the base.
coll_base (base_footprint): {
  Q: [0 0 .12], shape: ssBox, size: [.7 .7 .36 .1], color: [1 1 1 .2], contact: -2, coll_pr2
}
coll_torso (base_footprint): {
  Q: [-.13 0 .6], shape: ssBox, size: [.45 .7 1.1 .1], color: [1 1 1 .2], contact: -2, coll_pr2
}
coll_arm_r (r_upper_arm_roll_joint): {
  Q: [.221337 0 0], shape: ssBox, size: [.55 .201 .201 .1], color: [1 1 1 .2], contact: -5, coll_pr2
}
coll_wrist_r (r_forearm_roll_joint): {
  Q: "t(.21 0 0) d(4 0 1 0)", shape: ssBox, size: [.35 .141 .141 .07], color: [1 1 1 .2], contact: -3, coll_pr2
}
coll_hand_r (r_wrist_roll_joint): {
  Q: [.12 0 0], shape: ssBox, size: [.16 .12 .06 .025], color: [1 1 1 .2], contact: -3, coll_pr2
}
coll_arm_l (l_upper_arm_roll_joint): {
  Q: [.221337 0 0], shape: ssBox, size: [.55 .201 .201 .1], color: [1 1 1 .2], contact: -5, coll_pr2
}
coll_wrist_l (l_forearm_roll_joint): {
  Q: "t(.21 0 0) d(4 0 1 0)", shape: ssBox, size: [.35 .141 .141 .07], color: [1 1 1 .2], contact: -3, coll_pr2
}
coll_hand_l (l_wrist_roll_joint): {
  Q: [.12 0 0], shape: ssBox, size: [.16 .12 .06 .025], color: [1 1 1 .2], contact: -3, coll_pr2
}

# wheels
Edit fl_caster_rotation_joint: { joint: none }
Edit fr_caster_rotation_joint: { joint: none }
Edit bl_caster_rotation_joint: { joint: none }
Edit br_caster_rotation_joint: { joint: none }
Edit fl_caster_l_wheel_joint: { joint: none }
Edit fl_caster_r_wheel_joint: { joint: none }
Edit fr_caster_l_wheel_joint: { joint: none }
Edit fr_caster_r_wheel_joint: { joint: none }
Edit bl_caster_l_wheel_joint: { joint: none }
Edit bl_caster_r_wheel_joint: { joint: none }
Edit br_caster_l_wheel_joint: { joint: none }
Edit br_caster_r_wheel_joint: { joint: none }

Include: <pr2_modifications.g>
