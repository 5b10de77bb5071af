# The Panda arm with its hand as the manufacturer's description has them: the full range of every joint, at q = 0, and
# fingers that are part of q. Nothing collides.

Include: <panda_links.g>
Include: <panda_hand.g>

Edit panda_joint2: { q: 0 }
Edit panda_joint4: { q: 0 }
Edit panda_joint6: { q: 0, limits: [-.0175 3.7525] }
Edit panda_joint7: { q: 0 }
Edit panda_joint8: { joint: rigid }
Edit panda_hand_joint: { joint: rigid }
Edit panda_finger_joint1: { q: 0, joint_active: true }
Edit panda_finger_joint2: { q: 0 }
