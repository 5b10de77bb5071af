# A hall without robots, for the scenes k00.g and kswing.g: floor, roof and two walls, boxes and sticks on the floor,
# pendulums below the roof, balls, and a drawer of three sides around one of them.

world: {}
floor (world): { Q: [0 0 .05], shape: ssBox, size: [4.5 6.5 .1 .02], color: [.3 .3 .3] }
roof (world): { Q: [-.5 -1 3], shape: ssBox, size: [3 4.5 .1 .02], color: [.9 .9 .9 .2] }
wall (world): { Q: [0 -3 1.5], shape: ssBox, size: [4.1 .1 3 .02], color: [.3 .3 .3] }
back (world): { Q: [-2 0 1.5], shape: ssBox, size: [.1 6.1 3 .02], color: [.3 .3 .3] }

# boxes on their sides; the fourth stands on the third
box1 (floor): {
  joint: rigid, Q: "t(1 -2.5 .35) d(110 0 0 1)", shape: ssBox, size: [.2 .4 .6 .02], color: [.6 .6 .6], friction: .1
}
box2 (floor): {
  joint: rigid, Q: "t(0 -2.5 .25) d(20 0 0 1) d(90 1 0 0)",
  shape: ssBox, size: [.2 .4 .6 .02], color: [.6 .6 .6], friction: .1
}
box3 (floor): {
  joint: rigid, Q: "t(-1 -2.5 .15) d(-20 0 0 1) d(90 0 1 0)",
  shape: ssBox, size: [.2 .4 .6 .02], color: [.6 .6 .6], friction: .1
}
box4 (box3): {
  joint: rigid, Q: "d(-90 0 1 0) t(0 0 .4) d(30 0 0 1)",
  shape: ssBox, size: [.2 .4 .6 .02], color: [.6 .6 .6], friction: .1
}
box5 (floor): { joint: rigid, Q: [1.5 1.6 .25], shape: ssBox, size: [1 .2 .4 .02], color: [.6 .6 .6], friction: .1 }

stick1 (floor): {
  joint: rigid, Q: "t(-1.5 -1.7 .07) d(20 0 0 1) d(90 1 0 0)", shape: capsule, size: [.8 .02], color: [.6 .6 .6], friction: .1
}
stick2 (floor): {
  joint: rigid, Q: "t(-1.5 -.9 .07) d(10 0 0 1) d(90 1 0 0)", shape: capsule, size: [.8 .02], color: [.6 .6 .6], friction: .1
}

# pendulums: anchor, joint, rod
pend1anchor (roof): { Q: [.5 -.5 0] }
pend1joint (pend1anchor): { joint: rigid }
pend1 (pend1joint): { Q: [0 0 -.8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
pend2anchor (roof): { Q: [1.3 1 0] }
pend2joint (pend2anchor): { joint: quatBall, ctrl_H: 0 }
pend2 (pend2joint): { Q: [0 0 -.6], shape: capsule, size: [1.2 .02], color: [.6 .6 .6] }
pend3anchor (roof): { Q: [0 2 0] }
pend3joint (pend3anchor): { joint: rigid }
pend3 (pend3joint): { Q: [0 0 -.6], shape: capsule, size: [1.2 .02], color: [.6 .6 .6] }

ball1 (pend3): { joint: rigid, Q: [0 0 -.6], shape: sphere, size: [.05], color: [1 1 .6] }
ball2 (floor): { joint: rigid, Q: [1.5 2.2 .1], shape: sphere, size: [.05], color: [1 1 .6] }
ball3 (floor): { joint: rigid, Q: [0 2.8 .1], shape: sphere, size: [.05], color: [1 1 .6] }
ball4 (floor): { joint: rigid, Q: [-1.5 2.2 .1], shape: sphere, size: [.05], color: [1 1 .6] }

drawer (floor): { Q: [-1.5 2.2 .1] }
drawerA (drawer): { Q: [0 -.18 0], shape: ssBox, size: [.6 .05 .1 .02], color: [.6 .6 .6] }
drawerB (drawer): { Q: [-.28 0 0], shape: ssBox, size: [.05 .4 .1 .02], color: [.6 .6 .6] }
drawerC (drawer): { Q: [.28 0 0], shape: ssBox, size: [.05 .4 .1 .02], color: [.6 .6 .6] }

# a fence across the hall
(floor): { Q: [2 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [1.6 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [1.2 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [.8 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [.4 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [0 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [-.4 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [-.8 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [-1.2 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [-1.6 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
(floor): { Q: [-2 1.75 .8], shape: capsule, size: [1.6 .02], color: [.6 .6 .6] }
