# A planar arm of two links and a wrist, in the dialect of older files: joints are entries of their own and name both
# sides. `pre` places the joint on the first frame, `B` the second frame behind the joint. A size of four numbers is
# [0 0 length radius].

zero { X:"T t(0 0 0) d(180 0 0 1)" shape:sphere mass=1 size=[0. 0. .2 .05] }

link1 { shape:capsule mass=1 size=[0. 0. .3 .05] color:[0 0 1] }
(zero link1) { joint:hingeX, pre:"T t(0 0 0)" B:"T t(0 0 .2)" }

link2 { shape:capsule mass=1 size=[0. 0. .3 .05] color:[1 0 0] }
(link1 link2) { joint:hingeX, pre:"T t(0 0 .15)" B:"T t(0 0 .15)" }

endeffector { shape:sphere mass=1 size=[0. 0. .2 .05] color:[0 1 0] }
(link2 endeffector) { joint:hingeX, pre:"T t(0 0 .18)" B:"T t(0 0 0)" }
