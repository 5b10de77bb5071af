# A shelf of four boards between two sides, 2 m high, with a target on the third board.

shelf: { X: "t(1 1 0) d(120 0 0 1)", fixed }

# sides
(shelf): { Q: [0 .55 1], shape: ssBox, size: [.6 .1 2 .02], color: [0 .3 .7], contact: 1 }
(shelf): { Q: [0 -.55 1], shape: ssBox, size: [.6 .1 2 .02], color: [0 .3 .7], contact: 1 }

# boards
(shelf): { Q: [0 0 .5], shape: ssBox, size: [.6 1 .1 .02], color: [0 .3 .7], contact: 1 }
(shelf): { Q: [0 0 1], shape: ssBox, size: [.6 1 .1 .02], color: [0 .3 .7], contact: 1 }
(shelf): { Q: [0 0 1.5], shape: ssBox, size: [.6 1 .1 .02], color: [0 .3 .7], contact: 1 }
(shelf): { Q: [0 0 1.95], shape: ssBox, size: [.6 1 .1 .02], color: [0 .3 .7], contact: 1 }

target (shelf): { Q: [0 0 1.25], shape: sphere, size: [.07], color: [1 0 0] }
