# For scenes with a PR2, included by pr2.g: a pose to work from, gains of the motors, and frames to command and to look
# from. It needs the frames of pr2_conv.g before it.

Edit torso_lift_joint: { q: .1, ctrl_H: 3000, gains: [100000 10], torso }
Edit head_pan_joint: { ctrl_H: .1, gains: [20 2], head }
Edit head_tilt_joint: { q: .4, ctrl_H: .1, gains: [60 4], head }
Edit laser_tilt_mount_joint: { laser }

# right arm and gripper
Edit r_shoulder_pan_joint: { q: -1, gains: [220 30], armR }
Edit r_shoulder_lift_joint: { q: .5, gains: [200 20], armR }
Edit r_upper_arm_roll_joint: { q: -1, gains: [100 8], armR }
Edit r_elbow_flex_joint: { q: -2, gains: [70 4], armR }
Edit r_forearm_roll_joint: { q: -1.5, gains: [10 1], armR }
Edit r_wrist_flex_joint: { q: -.5, gains: [30 1], armR }
Edit r_wrist_roll_joint: { q: -.5, gains: [15 1], armR }
Edit r_gripper_joint: { q: .01, gains: [1000 1], gripR }
Edit r_gripper_l_finger_joint: { q: .1 }
Edit r_gripper_r_finger_joint: { gripR }
Edit r_gripper_l_finger_tip_joint: { gripR }
Edit r_gripper_r_finger_tip_joint: { gripR }

# left arm and gripper
Edit l_shoulder_pan_joint: { q: 1, gains: [220 30], armL }
Edit l_shoulder_lift_joint: { q: .5, gains: [200 20], armL }
Edit l_upper_arm_roll_joint: { q: 1, gains: [100 8], armL }
Edit l_elbow_flex_joint: { q: -2, gains: [70 4], armL }
Edit l_forearm_roll_joint: { q: 1.5, gains: [10 1], armL }
Edit l_wrist_flex_joint: { q: -.5, gains: [30 1], armL }
Edit l_wrist_roll_joint: { q: .5, gains: [15 1], armL }
Edit l_gripper_joint: { q: .01, gains: [1000 1], gripL }
Edit l_gripper_l_finger_joint: { q: .1 }
Edit l_gripper_r_finger_joint: { gripL }
Edit l_gripper_l_finger_tip_joint: { gripL }
Edit l_gripper_r_finger_tip_joint: { gripL }

# force and torque sensors
r_ft_sensor (r_wrist_roll_joint): {
  Q: "t(.01 0 0) d(-90 0 1 0) d(70.015 0 0 1)", shape: cylinder, size: [.0356 .02], color: [1 0 0]
}
l_ft_sensor (l_wrist_roll_joint): {
  Q: "t(.01 0 0) d(-90 0 1 0) d(70.015 0 0 1)", shape: cylinder, size: [.0356 .02], color: [1 0 0]
}

# points to command
base_footprint_marker (worldTranslationRotation): { shape: marker, size: [.5], color: [1 0 0] }
endeffBase (torso_lift_joint): { Q: "t(0 0 -.2) d(90 0 1 0)", shape: marker, size: [.1], color: [1 0 0] }
endeffHead (head_tilt_joint): { Q: "t(0 -.08 .12) d(180 0 1 1)", shape: marker, size: [.1], color: [1 0 0] }
endeffWorkspace (torso_lift_joint): { Q: "t(-.1 0 -.6) d(120 -1 1 -1)", shape: marker, size: [.1], color: [1 0 0] }

# where it looks from
endeffEyes (head_tilt_joint): { Q: "t(0 -.05 .12) d(180 0 -1 1)", shape: marker, size: [.1], color: [1 1 0] }
endeffKinect (head_tilt_joint): {
  Q: "t(-.0175 .147067 .291953) d(120 -1 1 -1)", shape: camera, size: [.1], color: [1 0 0], zRange: [.1 2]
}
endeffLaser (laser_tilt_mount_joint): {
  Q: "t(-.00300578 .00167121 .0122175) d(120 -1 1 -1)", shape: camera, size: [.1], color: [1 1 1], zRange: [.1 2]
}

# grippers
pr2R (r_wrist_roll_joint): {
  Q: "t(.18 0 0) d(120 1 -1 -1)", shape: ssBox, size: [.03 .03 .05 .01], color: [1 1 0], logical: { gripper }
}
pr2L (l_wrist_roll_joint): {
  Q: "t(.18 0 0) d(120 1 -1 -1)", shape: ssBox, size: [.03 .03 .05 .01], color: [1 1 0], logical: { gripper }
}
