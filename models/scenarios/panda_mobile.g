# A Panda on a round base that drives in the plane, with two hooks to hang things on: 10 dofs.

base_origin: { X: [0 0 .2] }
base (base_origin): {
  joint: transXYPhi, limits: [-10 -10 -4 10 10 4], shape: ssCylinder, size: [.1 .3 .02], contact: 1
}

Include: <panda_fixGripper.g>
Edit panda_base (base): { Q: "t(0 0 .05) d(90 0 0 1)" }

# hooks at the elbow and beside the gripper, which collide neither in plans nor in simulations
hookA (panda_joint5): { Q: [0 .2 0], shape: sphere, size: [.025], color: [.6 .9 .9], visual: true }
(hookA): { Q: "t(0 -.05 0) d(90 1 0 0)", shape: capsule, size: [.075 .01], color: [.9 .9 .9], visual: true }
hookB (gripper): { Q: [.15 0 .02], shape: sphere, size: [.025], color: [.6 .9 .9], visual: true }
(hookB): { Q: "t(-.05 0 0) d(90 0 1 0)", shape: capsule, size: [.075 .01], color: [.9 .9 .9], visual: true }
