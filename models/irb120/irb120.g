# An ABB IRB 120: an arm with a spherical wrist. Lengths, limits of position (rad) and speed (rad/s) are those of the
# manufacturer's public data sheet; its mass of 25 kg is shared out by the size of the links. Shapes are boxes, capsules
# and cylinders in place of its surfaces. The tool is to be attached to `tool0`.

base: {}
base_0 (base): { shape: cylinder, size: [.16 .09], Q: [0 0 .08], mass: 8.5, color: [.37 .37 .37], contact: -1 }

joint_1 (base): { joint: hingeZ, pre: [0 0 .29], limits: [-2.87979 2.87979], ctrl_limits: [4.36332 -1 -1] }
link_1 (joint_1): { shape: capsule, size: [.06 .085], Q: [0 0 -.03], mass: 5, color: [.95 .5 .1], contact: -2 }

joint_2 (joint_1): { joint: hingeY, limits: [-1.91986 1.91986], ctrl_limits: [4.36332 -1 -1] }
link_2 (joint_2): { shape: capsule, size: [.27 .06], Q: [0 0 .135], mass: 4.5, color: [.95 .5 .1], contact: -2 }

joint_3 (joint_2): { joint: hingeY, pre: [0 0 .27], limits: [-1.91986 1.22173], ctrl_limits: [4.36332 -1 -1] }
link_3 (joint_3): { shape: capsule, size: [.07 .06], Q: [0 0 .035], mass: 3.5, color: [.95 .5 .1], contact: -2 }

joint_4 (joint_3): { joint: hingeX, pre: [0 0 .07], limits: [-2.79253 2.79253], ctrl_limits: [5.58505 -1 -1] }
link_4 (joint_4): {
  shape: capsule, size: [.18 .05], Q: "t(.16 0 0) d(90 0 1 0)", mass: 2.5, color: [.95 .5 .1], contact: -2
}

joint_5 (joint_4): { joint: hingeY, pre: [.302 0 0], limits: [-2.0944 2.0944], ctrl_limits: [5.58505 -1 -1], q: 1 }
link_5 (joint_5): {
  shape: capsule, size: [.05 .035], Q: "t(.01 0 0) d(90 0 1 0)", mass: .8, color: [.95 .5 .1], contact: -2
}

joint_6 (joint_5): { joint: hingeX, pre: [.072 0 0], limits: [-6.98132 6.98132], ctrl_limits: [7.33038 -1 -1] }
link_6 (joint_6): { shape: cylinder, size: [.02 .025], Q: "t(-.01 0 0) d(90 0 1 0)", mass: .2, color: [.6 .6 .6], contact: -2 }
tool0 (joint_6): { Q: "d(90 0 1 0)" }
