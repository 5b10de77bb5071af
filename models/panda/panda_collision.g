# What the Panda collides with: capsules around the links, nearly transparent, a little larger than the links.
#
# contact -2: no collisions with links up to two joints towards the base; -3 for the palm, three. A capsule's size is
# [length of its core segment, radius], along its z axis.

# base
panda_coll0 (panda_link0): {
  Q: "t(-.04 0 .03) d(90 0 1 0)", shape: capsule, size: [.1 .11], color: [1 1 1 .1], contact: -2
}

# long links, below their joints
panda_coll1 (panda_joint1): { Q: [0 0 -.15], shape: capsule, size: [.2 .08], color: [1 1 1 .1], contact: -2 }
panda_coll3 (panda_joint3): { Q: [0 0 -.15], shape: capsule, size: [.2 .08], color: [1 1 1 .1], contact: -2 }
panda_coll5 (panda_joint5): { Q: [0 .02 -.2], shape: capsule, size: [.22 .09], color: [1 1 1 .1], contact: -2 }

# elbows
panda_coll2 (panda_joint2): { Q: [0 0 0], shape: capsule, size: [.12 .12], color: [1 1 1 .1], contact: -2 }
panda_coll4 (panda_joint4): { Q: [0 0 0], shape: capsule, size: [.12 .08], color: [1 1 1 .1], contact: -2 }
panda_coll6 (panda_joint6): { Q: [0 0 -.04], shape: capsule, size: [.1 .07], color: [1 1 1 .1], contact: -2 }
panda_coll7 (panda_joint7): { Q: [0 0 .01], shape: capsule, size: [.1 .07], color: [1 1 1 .1], contact: -2 }

# The point to command: between the finger tips, x across the palm's narrow side, z pointing back at the hand.
gripper (panda_joint7): {
  Q: "t(0 0 .2105) d(180 0 1 0) d(135 0 0 1)",
  shape: marker, size: [.03], color: [.9 .9 .9], logical: { is_gripper }
}

# hand
palm (panda_hand_joint): { Q: "d(90 1 0 0)", shape: capsule, size: [.14 .07], color: [1 1 1 .1], contact: -3 }

# finger tips: the pads that hold things
finger1 (panda_finger_joint1): {
  Q: [0 .008 .045], shape: ssBox, size: [.02 .016 .02 .005], color: [1 1 1 .1], contact: -2
}
finger2 (panda_finger_joint2): {
  Q: [0 -.008 .045], shape: ssBox, size: [.02 .016 .02 .005], color: [1 1 1 .1], contact: -2
}
