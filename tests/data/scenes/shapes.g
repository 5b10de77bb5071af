# Every primitive, with colors of every length, masses and inertias.
box: { X: [0 0 0], shape: box, size: [1 2 3], mass: 1, color: [.5] }
sphere: { X: [1 0 0], shape: sphere, size: [.5], mass: 1, color: [.5 .3] }
capsule: { X: [2 0 0], shape: capsule, size: [2 .5], mass: 1, color: [1 0 0] }
cylinder: { X: [3 0 0], shape: cylinder, size: [2 .5], mass: 1, color: [1 0 0 .5] }
ssBox: { X: [4 0 0], shape: ssBox, size: [1 2 3 .1], mass: 1 }
ssCylinder: { X: [5 0 0], shape: ssCylinder, size: [1 .5 .1] }
quad: { X: [6 0 0], shape: quad, size: [1 2] }
marker: { X: [7 0 0], shape: marker, size: [.3], mass: 2 }
core: { X: [8 0 0], shape: ssCvx, size: [.1], core: [0 0 0, 1 0 0, 0 1 0, 0 0 1] }
dense: { X: [9 0 0], shape: box, size: [1 1 1], mass: 0 }
given: { X: [10 0 0], shape: box, size: [1 1 1], mass: 2, inertia: [.1 .2 .3] }
full (given): { Q: [1 0 0], mass: 2, inertia: [.1 .01 .02 .2 .03 .3] }
nine (given): { Q: [2 0 0], mass: 3, inertia: [.1 .01 .02 .01 .2 .03 .02 .03 .3] }
shared (given): { mimic_shape: sphere, Q: [0 0 1] }
