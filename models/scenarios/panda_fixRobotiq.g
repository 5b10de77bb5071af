# A Panda with a Robotiq 2F-85 in place of its hand; `finger_joint` is no part of q: 7 dofs.

Include: <panda_noGripper.g>
Edit panda_joint8: { joint: none }

Include: <../robotiq/robotiq.g>
Edit robotiq_base (panda_joint8): { Q: [0 0 .05] }
Edit finger_joint: { joint_active: false }

# the wrist is wider with the sensor and its cable
Edit panda_coll7: { Q: [0 0 .07], size: [.22 .07] }
panda_coll7b (panda_joint7): {
  Q: "d(-90 0 1 0) t(.08 0 0) d(45 1 0 0) t(0 0 -.03)", shape: capsule, size: [.05 .05], color: [1 1 1 .2], contact: -2
}
