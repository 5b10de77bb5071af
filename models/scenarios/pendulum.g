# A pendulum of a bar and a beam below a roof, in front of a table and a ball that bounces.

world: {}
roof (world): { Q: [0 0 2], shape: ssBox, size: [2 2 .1 .02], color: [.9 .9 .9 .2] }

pend2base: { X: [0 0 2], shape: ssBox, size: [.2 .2 .2 .01], mass: .1, multibody, multibody_gravity }
pend2joint (pend2base): { joint: hingeY, q: 1, noMotor }
pend2a (pend2joint): { Q: [0 0 -.6], shape: capsule, size: [1.2 .02], color: [.6] }
pend2b (pend2joint): { Q: [0 .25 -1.2], shape: ssBox, size: [.1 2.5 .1 .02], color: [.6], mass: .5 }

table (world): { Q: [0 0 .35], shape: ssBox, size: [2 2 .1 .01], restitution: .9 }
ball: { X: [0 0 1], shape: sphere, size: [.2], mass: 1, restitution: .9 }
