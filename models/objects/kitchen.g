# A kitchen of 5 m by 5 m: a floor with low walls, two tables, a sink and a stove.

floorwalls: {}
table1: { X: "t(2 0 .385) d(90 0 0 1)" }
table2: { X: "t(-2 0 .385) d(90 0 0 1)" }
sink1: { X: [-.5 2 .4] }
stove1: { X: [.5 2 .4] }

# floor, and walls of 40 cm; they take no part in collisions
_5 (floorwalls): { Q: [0 0 -.005], shape: box, size: [5 5 .01], color: [.82 .7 .55] }
_6 (floorwalls): { Q: [0 -2.5 .2], shape: box, size: [5 .02 .4], color: [.82 .7 .55] }
_7 (floorwalls): { Q: [0 2.5 .2], shape: box, size: [5 .02 .4], color: [.82 .7 .55] }
_8 (floorwalls): { Q: [2.5 0 .2], shape: box, size: [.02 5 .4], color: [.82 .7 .55] }
_9 (floorwalls): { Q: [-2.5 0 .2], shape: box, size: [.02 5 .4], color: [.82 .7 .55] }

# furniture
_10 (table1): { shape: ssBox, size: [1.503 .61 .77 .01], color: [.75 .75 .75], contact: 1 }
_11 (table2): { shape: ssBox, size: [1.503 .61 .77 .01], color: [.75 .75 .75], contact: 1 }
_12 (sink1): { shape: ssBox, size: [.6 .6 .8 .01], color: [.25 .25 .75], contact: 1 }
_13 (stove1): { shape: ssBox, size: [.6 .6 .8 .01], color: [.75 .25 .25], contact: 1 }
