# A Panda with the simple gripper of gripper.g, whose fingers slide and are part of q: 8 dofs.

Include: <panda_noGripper.g>
Edit panda_joint2: { q: 0 }
Edit panda_joint7: { q: 0 }

Include: <gripper.g>
Edit gripper (panda_joint7): { Q: "d(180 0 1 0) d(135 0 0 1) t(0 0 -.155)" }
Delete: finger1
Delete: finger2

# 7 cm apart from the middle, and 5 cm in or 2 cm out from there
finger1 (gripper): {
  joint: transX, pre: [.07 0 -.05], limits: [-.05 .02],
  shape: capsule, size: [.02 .02], color: [.9 .9 .9], contact: -2
}
finger2 (gripper): {
  joint: transX, pre: "d(180 0 0 1) t(.07 0 -.05)", mimic: finger1, limits: [-.05 .02],
  shape: capsule, size: [.02 .02], color: [.9 .9 .9], contact: -2
}
