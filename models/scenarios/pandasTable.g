# Two Pandas side by side on a table (prefixes `l_` and `r_`), and a camera.

world: {}

# `origin` is the middle of the table top
origin (world): { Q: [0 0 .6], shape: marker, size: [.03] }
table (origin): { Q: [0 0 -.05], shape: ssBox, size: [2.3 1.24 .1 .02], color: [1], contact: 1, logical: {} }

Prefix: "l_"
Include: <../panda/panda.g>
Prefix: "r_"
Include: <../panda/panda.g>
Prefix: False

# 80 cm apart, both facing along y
Edit l_panda_base (origin): { joint: rigid, Q: "t(-.4 -.3 0) d(90 0 0 1)", motors: true }
Edit r_panda_base (origin): { joint: rigid, Q: "t(.4 -.3 0) d(90 0 0 1)", motors: true }

# looks down on the table, from the far side
camera (world): {
  Q: "t(-.01 -.2 2) d(-150 1 0 0)", shape: camera, size: [.1],
  focalLength: .895, width: 640, height: 360, zRange: [.5 100]
}
