# Two simple arms at a table with three cubes, a plank, a stick and a ball.

world: {}
table (world): { pose: [0, 0, .6], shape: ssBox, size: [2, 2, .1, .02], color: [.3, .3, .3] }

box0 (table): { joint: rigid, Q: [0, -.3, .1], shape: ssBox, size: [.1, .1, .1, .02], color: [.8, .8, .8], mass: .1 }
box1 (table): { joint: rigid, Q: [0, -.1, .1], shape: ssBox, size: [.4, .2, .04, .01], color: [.8, .8, .8], mass: .1 }
box2 (table): { joint: rigid, Q: [0, .1, .1], shape: ssBox, size: [.1, .1, .1, .02], color: [.8, .8, .8], mass: .1 }
box3 (table): { joint: rigid, Q: [0, .3, .1], shape: ssBox, size: [.1, .1, .1, .02], color: [.8, .8, .8], mass: .1 }
stick (table): { joint: rigid, Q: "t(.6 .5 .08) d(90 1 0 0)", shape: ssBox, size: [.05, .05, .6, .02], color: [.8, .8, .8] }
ball (table): { joint: rigid, Q: [-.8, .8, .09], shape: sphere, size: [.04], color: [.8, .8, .8], contact: 1 }

Prefix: L_
Include: <simpleArm.g>
Edit L_base (table): { joint: rigid, Q: [-.5, -.5, .1] }

Prefix: R_
Include: <simpleArm.g>
Edit R_base (table): { joint: rigid, Q: [.5, -.5, .1] }
Prefix!
