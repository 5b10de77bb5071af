# The Trossen arm on a base, in a pose to work from. Its two carriages move together.

trossen_base: { multibody: true, multibody_gravity: false, trossen_ip: "none" }
Include: <trossen_conv.g>
Edit base_link (trossen_base): { color: [.2] }

Edit joint_0: { color: [.2] }
Edit joint_1: { q: 1, color: [.2] }
Edit joint_2: { q: 1, color: [.2] }
Edit joint_3: { q: -.5, color: [.2] }
Edit joint_4: { color: [.2] }
Edit joint_5: { color: [.3] }

# the left carriage follows the right one; its scale multiplies the right one's
Edit right_carriage_joint: { q: .03 }
Edit left_carriage_joint: { joint_scale: -1, mimic: right_carriage_joint }

Edit gripper_right_0: { color: [.5] }
Edit gripper_left_0: { color: [.5] }
Edit camera_mount_d405_0: { color: [.5] }
