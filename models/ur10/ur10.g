# A UR10 arm. Frames have the prefix `ur_`; the tool is to be attached to `ur_ee_fixed_joint`.
#
# Lengths from the manufacturer's table: base 127.3 mm, upper arm 612 mm, forearm 572.3 mm, wrists 114.9, 115.7 and
# 92.2 mm; the shoulder is 220.94 mm beside the base's axis and the forearm 171.9 mm nearer. Each joint is a pair of
# frames, `..._origin` where it sits on the link before it and the joint itself. Shapes are capsules of our own; a viewer
# shows `visual_mesh` instead when the Python package example-robot-data is installed.

ur_world: {}
ur_world_joint_origin (ur_world): {}
ur_world_joint (ur_world_joint_origin): {
  joint: rigid, shape: cylinder, size: [.08 .09], color: [.55 .57 .6],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/base.dae>
}

ur_shoulder_pan_joint_origin (ur_world_joint): { pose: [0 0 .1273] }
ur_shoulder_pan_joint (ur_shoulder_pan_joint_origin): {
  joint: hingeZ, limits: [-6.28318530718 6.28318530718], ctrl_limits: [2.16 330 -1], q: 0,
  shape: capsule, size: [.1 .075], color: [.75 .77 .8],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/shoulder.dae>
}

ur_shoulder_lift_joint_origin (ur_shoulder_pan_joint): { pose: [0 .220941 0 .707106781186547 0 .707106781186547 0] }
ur_shoulder_lift_joint (ur_shoulder_lift_joint_origin): {
  joint: hingeY, limits: [-6.28318530718 6.28318530718], ctrl_limits: [2.16 330 -1], q: -2,
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/upperarm.dae>
}
ur_upper_arm_0 (ur_shoulder_lift_joint): { pose: [0 -.03 .306], shape: capsule, size: [.612 .06], color: [.75 .77 .8] }

ur_elbow_joint_origin (ur_shoulder_lift_joint): { pose: [0 -.1719 .612] }
ur_elbow_joint (ur_elbow_joint_origin): {
  joint: hingeY, limits: [-6.28318530718 6.28318530718], ctrl_limits: [3.15 150 -1], q: 1,
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/forearm.dae>
}
ur_forearm_0 (ur_elbow_joint): { pose: [0 0 .286], shape: capsule, size: [.5723 .05], color: [.75 .77 .8] }

ur_wrist_1_joint_origin (ur_elbow_joint): { pose: [0 0 .5723 .707106781186547 0 .707106781186547 0] }
ur_wrist_1_joint (ur_wrist_1_joint_origin): {
  joint: hingeY, limits: [-6.28318530718 6.28318530718], ctrl_limits: [3.2 54 -1], q: -1
}
ur_wrist_1_0 (ur_wrist_1_joint): { Q: "t(0 .06 0) d(90 1 0 0)", shape: capsule, size: [.08 .045], color: [.55 .57 .6] }

ur_wrist_2_joint_origin (ur_wrist_1_joint): { pose: [0 .1149 0] }
ur_wrist_2_joint (ur_wrist_2_joint_origin): {
  joint: hingeZ, limits: [-6.28318530718 6.28318530718], ctrl_limits: [3.2 54 -1], q: 1
}
ur_wrist_2_0 (ur_wrist_2_joint): { pose: [0 0 .05], shape: capsule, size: [.08 .045], color: [.55 .57 .6] }

ur_wrist_3_joint_origin (ur_wrist_2_joint): { pose: [0 0 .1157] }
ur_wrist_3_joint (ur_wrist_3_joint_origin): {
  joint: hingeY, limits: [-6.28318530718 6.28318530718], ctrl_limits: [3.2 54 -1], q: 0
}
ur_wrist_3_0 (ur_wrist_3_joint): { Q: "t(0 .06 0) d(90 1 0 0)", shape: cylinder, size: [.05 .04], color: [.75 .77 .8] }

# the flange: x points away from the arm
ur_ee_fixed_joint_origin (ur_wrist_3_joint): { Q: "t(0 .0922 0) d(90 0 0 1)" }
ur_ee_fixed_joint (ur_ee_fixed_joint_origin): { joint: rigid }
