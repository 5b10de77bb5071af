# The two Pandas of pandasTable.g with hooks on the left one, and a table full of things between three rails: boxes,
# cylinders, blocks, boards, a stick, a hook, a box with a handle, a drawer, a bucket and balls. 14 dofs.

Include: <pandasTable.g>

l_hookA (l_panda_joint5): { Q: [0 .2 0], shape: sphere, size: [.025], color: [.6 .9 .9] }
(l_hookA): { Q: "t(0 -.05 0) d(90 1 0 0)", shape: capsule, size: [.075 .01], color: [.9 .9 .9] }
l_hookB (l_gripper): { Q: [.13 0 .15], shape: sphere, size: [.025], color: [.6 .9 .9] }
(l_hookB): { Q: "t(-.05 0 0) d(90 0 1 0)", shape: capsule, size: [.075 .01], color: [.9 .9 .9] }

# rails
railA (table): { Q: [0 1 .1], shape: ssBox, size: [3.05 .05 .1 .02], color: [.6 .6 .6], contact: 1 }
railB (table): { Q: [-1.5 0 .1], shape: ssBox, size: [.05 2.05 .1 .02], color: [.6 .6 .6], contact: 1 }
railC (table): { Q: [1.5 0 .1], shape: ssBox, size: [.05 2.05 .1 .02], color: [.6 .6 .6], contact: 1 }

# large things
box1 (table): {
  joint: rigid, Q: "t(-.2 .6 .25) d(-45 0 0 1)", shape: ssBox, size: [.6 .2 .4 .02], color: [.6 .6 .6], contact: 1
}
box2 (table): { joint: rigid, Q: [-1.3 -.5 .25], shape: ssBox, size: [.2 1 .4 .02], color: [.6 .6 .6], contact: 1 }
cyl1 (table): { joint: rigid, Q: [.2 .7 .13], shape: ssCylinder, size: [.16 .16 .02], color: [.6 .6 .6], contact: 1 }
cyl2 (table): { joint: rigid, Q: [-.6 .5 .13], shape: ssCylinder, size: [.16 .16 .02], color: [.6 .6 .6], contact: 1 }

# blocks in a row, and boards on the second box
block1 (table): {
  joint: rigid, Q: "t(1 .2 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6], contact: 1
}
block2 (table): {
  joint: rigid, Q: "t(1 0 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6], contact: 1
}
block3 (table): {
  joint: rigid, Q: "t(1 -.2 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6], contact: 1
}
block4 (table): {
  joint: rigid, Q: "t(1 -.4 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6], contact: 1
}
block5 (table): {
  joint: rigid, Q: "t(1 -.6 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6], contact: 1
}
block6 (table): {
  joint: rigid, Q: "t(1 -.8 .095) d(90 0 0 1)", shape: ssBox, size: [.06 .15 .09 .01], color: [.6 .6 .6], contact: 1
}
board1 (box2): { joint: rigid, Q: [0 -.2 .215], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6], contact: 1 }
board2 (box2): { joint: rigid, Q: [0 0 .215], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6], contact: 1 }
board3 (box2): { joint: rigid, Q: [0 .2 .215], shape: ssBox, size: [.5 .15 .03 .01], color: [.6 .6 .6], contact: 1 }

# tools
stick1 (table): {
  joint: rigid, Q: "t(.1 -.5 .07) d(90 1 0 0)", shape: capsule, size: [.5 .02], color: [.6 .6 .6], contact: 1
}
hook (table): {
  joint: rigid, Q: [-.1 -.6 .07], shape: ssBox, size: [.03 .8 .04 .01], color: [.6 .6 .6], contact: 1, logical: { object }
}
hookTip (hook): {
  Q: [.085 -.385 0], shape: ssBox, size: [.2 .03 .04 .01], color: [.6 .6 .6], contact: 1, logical: { object, pusher }
}

Include: <ringBox.g>
Edit box (table): { joint: rigid, Q: "t(1.25 -.7 .15) d(45 0 0 1)" }

# three sides of a drawer
drawer (table): { Q: [-1.2 .5 .1] }
drawerA (drawer): { Q: [0 -.15 0], shape: ssBox, size: [.45 .05 .1 .02], color: [.6 .6 .6], contact: 1 }
drawerB (drawer): { Q: [-.2 0 0], shape: ssBox, size: [.05 .35 .1 .02], color: [.6 .6 .6], contact: 1 }
drawerC (drawer): { Q: [.2 0 0], shape: ssBox, size: [.05 .35 .1 .02], color: [.6 .6 .6], contact: 1 }

# a bucket (bottom and four walls)
bucket (table): { Q: [.5 1 .15] }
bucketA (bucket): { Q: [0 0 -.075], shape: ssBox, size: [.33 .33 .03 .01], color: [.6 .6 .6], contact: 1 }
bucketA1 (bucket): { Q: [0 -.15 0], shape: ssBox, size: [.33 .03 .15 .01], color: [.6 .6 .6], contact: 1 }
bucketA2 (bucket): { Q: [0 .15 0], shape: ssBox, size: [.33 .03 .15 .01], color: [.6 .6 .6], contact: 1 }
bucketB (bucket): { Q: [-.15 0 0], shape: ssBox, size: [.03 .33 .15 .01], color: [.6 .6 .6], contact: 1 }
bucketC (bucket): { Q: [.15 0 0], shape: ssBox, size: [.03 .33 .15 .01], color: [.6 .6 .6], contact: 1 }

# balls in the drawer, beside the bucket and in it
ball1 (drawer): { joint: rigid, shape: sphere, size: [.05], color: [1 1 .6] }
ball2 (table): { joint: rigid, Q: [.8 .5 .1], shape: sphere, size: [.05], color: [1 1 .6] }
ball3 (bucket): { joint: rigid, shape: sphere, size: [.05], color: [1 1 .6] }
