# A UR10 arm. Frames have the prefix `ur_`; the tool is to be attached to `ur_ee_fixed_joint`.

Prefix: ur_
Include: <ur10_conv.g>
Prefix!

# on the floor, in a pose to work from
Edit ur_world_joint_origin: { Q: [0 0 0] }
Edit ur_shoulder_lift_joint: { q: -2 }
Edit ur_elbow_joint: { q: 1 }
Edit ur_wrist_1_joint: { q: -1 }
Edit ur_wrist_2_joint: { q: 1 }
