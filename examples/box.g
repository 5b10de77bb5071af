# The box of 02_box.py as a file: 50 cm wide with edges rounded by 5 cm, standing on the ground.

box1: { X: "t(0 0 .25)", shape: ssBox, size: [.5 .5 .5 .05], color: [1 .5 0], mass: .1, contact: true }
