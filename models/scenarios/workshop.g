# A workshop: two mobile Pandas (prefixes `l_` and `r_`) between two long tables with blocks, boards, sticks and a box with
# a handle; boxes, balls, a drawer and a fence stand on the floor. 20 dofs.

world: {}
floor (world): { Q: [0 0 .05], shape: ssBox, size: [4.5 6.5 .1 .02], color: [.3 .3 .3] }
wall (world): { Q: [0 -3 1], shape: ssBox, size: [4.1 .1 2 .02], color: [.3 .3 .3] }
back (world): { Q: [-2 0 1], shape: ssBox, size: [.1 6.1 2 .02], color: [.3 .3 .3] }

Prefix: "l_"
Include: <panda_mobile.g>
Prefix: "r_"
Include: <panda_mobile.g>
Prefix!
Edit l_base_origin (world): { Q: [-.4 -.4 .15] }
Edit r_base_origin (world): { Q: [.4 -.4 .15] }

table1 (world): {
  Q: [-1.5 0 .5], shape: ssBox, size: [.8 6 .1 .02], color: [.3 .3 .3], friction: .1, logical: { table }
}
table2 (world): {
  Q: [1.5 0 .5], shape: ssBox, size: [.8 6 .1 .02], color: [.3 .3 .3], friction: .1, logical: { table }
}

# blocks in a row, and boards beside them
block1 (table2): {
  joint: rigid, Q: "t(0 0 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6]
}
block2 (table2): {
  joint: rigid, Q: "t(0 -.2 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6]
}
block3 (table2): {
  joint: rigid, Q: "t(0 -.4 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6]
}
block4 (table2): {
  joint: rigid, Q: "t(0 -.6 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6]
}
block5 (table2): {
  joint: rigid, Q: "t(0 -.8 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6]
}
block6 (table2): {
  joint: rigid, Q: "t(0 -1 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6]
}
board1 (table2): { joint: rigid, Q: [-.25 -2.4 .095], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6] }
board2 (table2): { joint: rigid, Q: [-.25 -2.2 .095], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6] }
board3 (table2): { joint: rigid, Q: [-.25 -2 .095], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6] }
board4 (table2): { joint: rigid, Q: [-.25 -1.8 .095], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6] }
board5 (table2): { joint: rigid, Q: [-.25 -1.6 .095], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6] }
board6 (table2): { joint: rigid, Q: [-.25 -1.4 .095], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6] }

# short sticks across the table, long ones aslant
stick1 (table1): { joint: rigid, Q: "t(.25 -2.4 .07) d(90 0 1 0)", shape: capsule, size: [.5 .02], color: [.6 .6 .6] }
stick2 (table1): { joint: rigid, Q: "t(.25 -2.2 .07) d(90 0 1 0)", shape: capsule, size: [.5 .02], color: [.6 .6 .6] }
stick3 (table1): { joint: rigid, Q: "t(.25 -2 .07) d(90 0 1 0)", shape: capsule, size: [.5 .02], color: [.6 .6 .6] }
stick4 (table1): {
  joint: rigid, Q: "t(.25 -1.4 .07) d(45 0 0 1) d(90 0 1 0)", shape: capsule, size: [.8 .02], color: [.6 .6 .6]
}
stick5 (table1): {
  joint: rigid, Q: "t(.25 -1.2 .07) d(45 0 0 1) d(90 0 1 0)", shape: capsule, size: [.8 .02], color: [.6 .6 .6]
}
stick6 (table1): {
  joint: rigid, Q: "t(.25 -1 .07) d(45 0 0 1) d(90 0 1 0)", shape: capsule, size: [.8 .02], color: [.6 .6 .6]
}

Include: <ringBox.g>
Edit box (table1): { joint: rigid, Q: "t(0 0 .15) d(45 0 0 1)" }

box1 (floor): { joint: rigid, Q: [-.5 1 .35], shape: ssBox, size: [.4 .2 .6 .02], color: [.6 .6 .6], friction: .1 }
box2 (floor): { joint: rigid, Q: [.5 1.6 .25], shape: ssBox, size: [1 .2 .4 .02], color: [.6 .6 .6], friction: .1 }

ball1 (table1): { joint: rigid, Q: [0 1 .1], shape: sphere, size: [.05], color: [1 1 .6] }
ball2 (table2): { joint: rigid, Q: [0 2.5 .1], shape: sphere, size: [.05], color: [1 1 .6] }
ball3 (floor): { joint: rigid, Q: [.5 2.8 .1], shape: sphere, size: [.05], color: [1 1 .6] }
ball4 (floor): { joint: rigid, Q: [-.5 2.2 .1], shape: sphere, size: [.05], color: [1 1 .6] }

# three sides of a drawer, around the last ball
drawer (floor): { Q: [-.5 2.2 .1] }
drawerA (drawer): { Q: [0 -.18 0], shape: ssBox, size: [.6 .05 .1 .02], color: [.6 .6 .6] }
drawerB (drawer): { Q: [-.28 0 0], shape: ssBox, size: [.05 .4 .1 .02], color: [.6 .6 .6] }
drawerC (drawer): { Q: [.28 0 0], shape: ssBox, size: [.05 .4 .1 .02], color: [.6 .6 .6] }

# the fence
(floor): { Q: [.8 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [.4 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [0 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [-.4 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [-.8 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
