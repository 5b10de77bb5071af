# One joint of every type, placed by all kinds of constant transforms, with scales, mimics and inactive joints.
base: { X: "t(0 0 .5) d(30 0 0 1)" }
hingeX (base): { joint: hingeX, pre: "t(.1 0 0) d(20 0 1 0)", q: .3, limits: [-1 1] }
hingeY (hingeX): { joint: hingeY, pre: [0 .2 0], limits: [-2, 1.5], ctrl_limits: [1 2 3] }
hingeZ (hingeY): { joint: hingeZ, pre: [.5 .5 .5 .5] }
hinge (base): { joint: hinge, axis: [0 1 1], q: .5 }
transX (base): { joint: transX, limits: [-.1 .4], joint_scale: 2 }
transY (transX): { joint: transY, q: -.2 }
transZ (transY): { joint: transZ }
transXY (base): { joint: transXY, limits: [-1 -2 1 2] }
trans3 (base): { joint: trans3, q: [.1 .2 .3] }
planar (base): { joint: transXYPhi, pre: "t(0 0 -.1)" }
sledge (base): { joint: transYPhi }
turned (base): { joint: phiTransXY }
cross (base): { joint: universal, q: .2 }
ball (base): { joint: quatBall }
sliding_ball (base): { joint: XBall }
free (base): { joint: free, pre: "E(.1 .2 .3) t(1 2 3)" }
generic (base): { joint: _zxyABC, q: [.1 .2 .3 .4 .5 .6] }
generic_ball (base): { joint: _xywxyz }
circle (base): { joint: circleZ }
fixed (base): { joint: rigid, Q: "t(0 1 0) d(45 1 0 0)" }
asleep (fixed): { joint: hingeZ, joint_active: false, q: .7 }
leader (base): { joint: transX, limits: [0 .04] }
follower (base): { joint: transX, joint_scale: -1, mimic: leader, Q: "d(180 0 0 1)" }
jaw (base): { joint: transY, joint_scale: -1, limits: [0 .05], q: .02 }
other_jaw (base): { joint: transY, joint_scale: -1, mimic: jaw }
early (late): { Q: "t(.1 0 0)" }
late (base): { pose: "t(0 0 .1) E(.3 0 0)" }
world_pose (hingeX): { X: "t(1 1 1) d(90 1 0 0)" }
tip (hingeZ): { Q: [0 0 .1, .8, .6, 0, 0] }
