# A Panda arm with its hand: what most scenes include. Its root is `panda_base`, its tool point `gripper`.

Include: <panda_arm.g>
Include: <panda_hand.g>
Include: <panda_hand_masses.g>
Include: <panda_collision.g>
