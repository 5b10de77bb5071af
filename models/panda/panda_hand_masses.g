# What the Panda's hand and fingers weigh: the manufacturer's figures.

Edit panda_hand_joint: { mass: .73, com: [-.01 0 .03], inertia: [.001 0 0 .0025 0 .0017] }
Edit panda_finger_joint1: { mass: .015, com: [0 .01 .03], inertia: [2.375e-6 0 0 2.375e-6 0 7.5e-7] }
Edit panda_finger_joint2: { mass: .015, com: [0 -.01 .03], inertia: [2.375e-6 0 0 2.375e-6 0 7.5e-7] }
