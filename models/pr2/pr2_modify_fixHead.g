# For scenes with a PR2: head and laser stand still.

Edit head_pan_joint: { joint_active: false }
Edit head_tilt_joint: { joint_active: false }
Edit laser_tilt_mount_joint: { joint_active: false }
