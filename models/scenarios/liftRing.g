# A Panda at a table with a box that has a ring as its handle, a stick to lift it by, and a place to put it.

world: {}
table (world): {
  Q: [0 0 .6], shape: ssBox, size: [1 2 .1 .02], color: [.3 .3 .3], contact: 1, fixed, friction: .1, logical: {}
}

Include: <ringBox.g>
Edit box (table): { joint: rigid, Q: [.2 0 .15], mass: 1 }

stick (table): {
  joint: rigid, Q: "t(-.3 .6 .1) d(90 1 0 0)", shape: capsule, size: [.6 .02], color: [.6 .6 .6], mass: 1
}
target (table): { Q: [-.2 0 .2], shape: ssBox, size: [.3 .3 .05 .02], color: [.3 .6 .3 1] }

Include: <panda_fixGripper.g>
Edit panda_base (table): { joint: rigid, Q: "t(.3 .8 .05) d(-90 0 0 1)" }
