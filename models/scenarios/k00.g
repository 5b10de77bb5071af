# The hall of k-hall.g with three pendulums that swing, a base that hovers over the floor and a ball more. The robot that
# this scene was made for is not part of the collection: include one and attach it to `floor`.

Include: <k-hall.g>

hooverJoint (floor): { joint: transXY }
hoover (hooverJoint): { Q: [0 0 .15], shape: ssBox, size: [.4 .4 .2 .02], color: [.9 .9 .9] }

Edit stick2: { Q: "t(-1 -.5 .07) d(10 0 0 1) d(90 1 0 0)" }
Edit pend1joint: { joint: quatBall }
Edit pend2joint: { ctrl_H: .01, q: [.8804509 .4402255 .1760902 0] }
Edit pend3joint: { joint: quatBall }

ball0 (floor): { joint: rigid, Q: [.5 -.2 .1], shape: sphere, size: [.05], color: [1 1 .6] }
