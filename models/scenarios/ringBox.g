# A box of half a kilogram with a handle: a ring of bars, by whose upper one (`ring4`) it is taken.

box: { X: [0 0 .1], shape: ssBox, size: [.2 .2 .2 .02], color: [.6 .6 .6], mass: .5, friction: .1 }

ring (box): { Q: [0 0 .2] }
ring0 (ring): { Q: [0 0 -.1], shape: capsule, size: [.05 .02], color: [.6 .6 .6], logical: { object } }
ring1 (ring): { Q: [.07 0 0], shape: capsule, size: [.1 .02], color: [.6 .6 .6], logical: { object } }
ring2 (ring): { Q: [-.07 0 0], shape: capsule, size: [.1 .02], color: [.6 .6 .6], logical: { object } }
ring3 (ring): { Q: "t(0 0 -.05) d(90 0 1 0)", shape: capsule, size: [.1 .02], color: [.6 .6 .6], logical: { object } }
ring4 (ring): {
  Q: "t(0 0 .05) d(90 0 1 0)", shape: capsule, size: [.1 .02], color: [.6 .6 .6], contact: -1, logical: { object }
}
