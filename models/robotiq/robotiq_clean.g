# The Robotiq 2F-85 gripper. One dof, `finger_joint`: 0 is open, .8 rad is closed; all other hinges follow it.
#
# Each side is a linkage of an outer and an inner knuckle; the finger at their end keeps its direction, so it turns back
# by as much as the knuckle turns. Positions of the hinges from the manufacturer's drawings, m. Shapes are boxes and
# capsules of our own.

robotiq_arg2f_base_link: { mass: .22652, inertia: [.00020005 .00017832 .00013478] }
robotiq_arg2f_base_link_0 (robotiq_arg2f_base_link): {
  pose: [0 0 .035], shape: ssBox, size: [.06 .08 .07 .015], color: [.1]
}

# left side: half a turn about z
finger_joint_origin (robotiq_arg2f_base_link): { pose: [0 -.0306011 .054904 0 0 0 1] }
left_inner_knuckle_joint_origin (robotiq_arg2f_base_link): { pose: [0 -.0127 .06142 0 0 0 1] }
right_outer_knuckle_joint_origin (robotiq_arg2f_base_link): { pose: [0 .0306011 .054904] }
right_inner_knuckle_joint_origin (robotiq_arg2f_base_link): { pose: [0 .0127 .06142] }

finger_joint (finger_joint_origin): { joint: hingeX, limits: [0 .8] }
left_inner_knuckle_joint (left_inner_knuckle_joint_origin): { joint: hingeX, limits: [0 .8757], mimic: finger_joint }
right_outer_knuckle_joint (right_outer_knuckle_joint_origin): { joint: hingeX, limits: [0 .81], mimic: finger_joint }
right_inner_knuckle_joint (right_inner_knuckle_joint_origin): { joint: hingeX, limits: [0 .8757], mimic: finger_joint }

left_inner_knuckle_0 (left_inner_knuckle_joint): {
  Q: "t(0 .018 .021) d(-40 1 0 0)", shape: ssBox, size: [.025 .01 .06 .004], color: [.15]
}
right_inner_knuckle_0 (right_inner_knuckle_joint): {
  Q: "t(0 .018 .021) d(-40 1 0 0)", shape: ssBox, size: [.025 .01 .06 .004], color: [.15]
}
finger_metal_l (finger_joint): {
  Q: "t(0 .0155 -.001) d(90 1 0 0)", shape: capsule, size: [.031 .006], color: [.79 .82 .93]
}
finger_metal_r (right_outer_knuckle_joint): {
  Q: "t(0 .0155 -.001) d(90 1 0 0)", shape: capsule, size: [.031 .006], color: [.79 .82 .93]
}
left_outer_finger_0 (finger_joint): { pose: [0 .0345 .0195], shape: ssBox, size: [.022 .014 .055 .004], color: [.1] }
right_outer_finger_0 (right_outer_knuckle_joint): {
  pose: [0 .0345 .0195], shape: ssBox, size: [.022 .014 .055 .004], color: [.1]
}

left_inner_finger_joint_origin (finger_joint): { pose: [0 .0376 .043] }
right_inner_finger_joint_origin (right_outer_knuckle_joint): { pose: [0 .0376 .043] }
left_inner_finger_joint (left_inner_finger_joint_origin): {
  joint: hingeX, limits: [0 .8757], joint_scale: -1, mimic: finger_joint
}
right_inner_finger_joint (right_inner_finger_joint_origin): {
  joint: hingeX, limits: [0 .8757], joint_scale: -1, mimic: finger_joint
}
left_inner_finger_0 (left_inner_finger_joint): {
  pose: [0 -.011 .03], shape: ssBox, size: [.022 .012 .05 .004], color: [.1]
}
right_inner_finger_0 (right_inner_finger_joint): {
  pose: [0 -.011 .03], shape: ssBox, size: [.022 .012 .05 .004], color: [.1]
}
left_inner_finger_pad_0 (left_inner_finger_joint): {
  pose: [0 -.0220203 .03242], shape: box, size: [.022 .00635 .0375], color: [.9]
}
right_inner_finger_pad_0 (right_inner_finger_joint): {
  pose: [0 -.0220203 .03242], shape: box, size: [.022 .00635 .0375], color: [.9]
}
