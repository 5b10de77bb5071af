# The Robotiq 2F-85 gripper of robotiq_clean.g on a base, a little closed, with the sensor behind it and the point to
# command. One dof, `finger_joint`.

robotiq_base: { X: [0 0 1] }
Include: <robotiq_clean.g>
Edit robotiq_arg2f_base_link (robotiq_base): {}
Edit finger_joint: { q: .2 }

# the force and torque sensor behind the gripper
ftsensor (robotiq_base): { pose: [0 0 -.0175], shape: cylinder, size: [.035 .0375], color: [.2] }

# The point to command, between the pads: z points back at the base. Shapes that collide are nearly transparent.
gripper (robotiq_base): {
  Q: "d(180 0 1 0) d(90 0 0 1) t(0 0 -.14)", shape: marker, size: [.03], color: [.9], logical: { gripper }
}
palm (robotiq_base): {
  Q: "d(90 1 0 0) t(0 .07 0)", shape: capsule, size: [.11 .04], color: [1 1 1 .2], contact: -1
}
finger1 (right_inner_finger_joint): {
  pose: [0 -.009 .025], shape: capsule, size: [.04 .02], color: [1 1 1 .2], contact: -2
}
finger2 (left_inner_finger_joint): {
  pose: [0 -.009 .025], shape: capsule, size: [.04 .02], color: [1 1 1 .2], contact: -2
}

# a marker for motion capture
robotiq_optitrackMarker (robotiq_base): { Q: [0 .049 .0033], shape: sphere, size: [.0049] }
