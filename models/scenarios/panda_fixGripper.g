# A Panda on its own whose fingers are no part of q: 7 dofs.

Include: <../panda/panda.g>
Edit panda_finger_joint1: { joint_active: false }
