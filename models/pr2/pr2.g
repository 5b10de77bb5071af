# The PR2 on its mobile base, from the URDF of the Python package example-robot-data, which must be installed:
# pip install example-robot-data. The base moves in the plane by `worldTranslationRotation`.

world: {}
worldTranslationRotation (world): {
  joint: transXYPhi, q: [0 0 1.5707963267948966], limits: [-10 -10 -6 10 10 6], ctrl_H: 10, gains: [1 1], base
}

Include: <package://example-robot-data/robots/pr2_description/urdf/pr2.urdf>
Edit base_footprint (worldTranslationRotation): { Q: [0 0 .05] }

# what stands still: wheels, and the inner parts of the grippers follow their finger or are fixed
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

# the width of the grippers, which nothing hangs on: fixed in this URDF, with the limits that it gives nevertheless
Edit r_gripper_joint: { joint: transY, limits: [0 .09], ctrl_limits: [.2 1000 -1] }
Edit l_gripper_joint: { joint: transY, limits: [0 .09], ctrl_limits: [.2 1000 -1] }

# a pose to work from
Edit torso_lift_joint: { q: .1 }
Edit r_shoulder_pan_joint: { q: -1 }
Edit l_shoulder_pan_joint: { q: 1 }
Edit r_shoulder_lift_joint: { q: .5 }
Edit l_shoulder_lift_joint: { q: .5 }
Edit r_upper_arm_roll_joint: { q: -1 }
Edit l_upper_arm_roll_joint: { q: 1 }
Edit r_elbow_flex_joint: { q: -2 }
Edit l_elbow_flex_joint: { q: -2 }
Edit r_forearm_roll_joint: { q: -1.5 }
Edit l_forearm_roll_joint: { q: 1.5 }
Edit r_wrist_flex_joint: { q: -.5 }
Edit l_wrist_flex_joint: { q: -.5 }
Edit r_wrist_roll_joint: { q: -.5 }
Edit l_wrist_roll_joint: { q: .5 }
Edit r_gripper_l_finger_joint: { q: .1 }
Edit l_gripper_l_finger_joint: { q: .1 }
Edit head_tilt_joint: { q: .4 }
