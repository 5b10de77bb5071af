# Bars of 3 m along two sides of a hall.

floor: {}

# far side
(floor): { Q: [2 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [1.6 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [1.2 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [.8 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [.4 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [0 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [-.4 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [-.8 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [-1.2 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [-1.6 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [-2 3 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }

# right side
(floor): { Q: [2 2.6 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 2.2 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 1.8 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 1.4 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 1 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 .6 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 .2 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 -.2 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 -.6 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 -1 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 -1.4 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 -1.8 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 -2.2 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
(floor): { Q: [2 -2.6 1.5], shape: capsule, size: [3 .02], color: [.6 .6 .6] }
