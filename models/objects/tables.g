# Three tables around the origin, 65 cm high.

table1: {
  X: "t(0 2 .6) d(90 0 0 1)", shape: ssBox, size: [.8 2.2 .1 .02], color: [.3 .3 .3], contact: 1, fixed, logical: {}
}
table2: { X: [2 0 .6], shape: ssBox, size: [.8 2.2 .1 .02], color: [.3 .3 .3], contact: 1, fixed, logical: { table } }
table3: {
  X: "t(0 -2 .6) d(90 0 0 1)", shape: ssBox, size: [.8 2.2 .1 .02], color: [.3 .3 .3], contact: 1, fixed, logical: {}
}
