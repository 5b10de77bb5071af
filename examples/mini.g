# A few frames to look at, for 01_frames.py. Change a number while the script watches this file.

world: {}

# a signpost: 30 cm to the side, half a meter up, turned by 30 degrees about the vertical axis
post (world): { Q: "t(.3 0 .5) d(30 0 0 1)", shape: marker, size: [.3] }

# sits 20 cm along the x axis of the post, not of the world
sign (post): { Q: [.2 0 0], shape: marker, size: [.15] }

# a door hinge: turns about its own z axis, between closed (0) and a right angle
hinge (world): { pre: "t(-.3 0 .5)", joint: hingeZ, limits: [0 1.57], shape: marker, size: [.3] }

# the handle of the door moves with the hinge
handle (hinge): { Q: [.4 0 0], shape: sphere, size: [.03], color: [.9 .6 .1] }
