world {}
table_base (world) { Q:[0 0 .6]  shape:marker, size:[.05]  }
table(table_base): { shape: ssBox, Q:[0, 0, -.05], size: [2., 1.5, .1, .02], color: [.3, .3, .3], contact: 1, logical: { is_box, is_place } }
Prefix: "l_"
Include: <../../../models/panda/panda.g>
Prefix: False
Prefix: "r_"
Include: <../../../models/panda/panda.g>
Prefix: False
Edit l_panda_base (table): { Q: "t(-.4 -.2 .05) d(90 0 0 1)" }
Edit r_panda_base (table): { Q: "t(+.4 -.2 .05) d(90 0 0 1)" }
trayG (table_base) {  Q:[.7, .1, 0], shape:ssBox, size:[0.07, 0.07, 0.01, 0.004], color:[0, .6, 0], logical:{ is_box, is_place } }
objG (table) {  Q:[-.6, .2, .1], joint:rigid, shape:ssBox, size:[0.06, 0.06, .1, .005], color:[0, .7, 0], contact:1, logical:{ is_object } }
