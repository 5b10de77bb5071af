# A Panda without its hand; tools are attached to `panda_joint8`.

Include: <../panda/panda_arm.g>
Include: <../panda/panda_collision.g>

# what belongs to the hand
Delete: gripper
Delete: palm
Delete: finger1
Delete: finger2
