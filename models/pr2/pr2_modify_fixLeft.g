# For scenes with a PR2: the left arm stands still.

Edit l_shoulder_pan_joint: { joint_active: false }
Edit l_shoulder_lift_joint: { joint_active: false }
Edit l_upper_arm_roll_joint: { joint_active: false }
Edit l_elbow_flex_joint: { joint_active: false }
Edit l_forearm_roll_joint: { joint_active: false }
Edit l_wrist_flex_joint: { joint_active: false }
Edit l_wrist_roll_joint: { joint_active: false }
