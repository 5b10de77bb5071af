# For scenes with a PR2: the right arm stands still.

Edit r_shoulder_pan_joint: { joint_active: false }
Edit r_shoulder_lift_joint: { joint_active: false }
Edit r_upper_arm_roll_joint: { joint_active: false }
Edit r_elbow_flex_joint: { joint_active: false }
Edit r_forearm_roll_joint: { joint_active: false }
Edit r_wrist_flex_joint: { joint_active: false }
Edit r_wrist_roll_joint: { joint_active: false }
