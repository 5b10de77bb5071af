# An arm that other files include.
base: { shape: box, size: [.1 .1 .1] }
shoulder (base): { joint: hingeX, pre: "t(0 0 .1)" }
elbow (shoulder): { joint: hingeX, pre: "t(0 0 .3)", q: .2, limits: [-2 2] }
finger1 (elbow): { joint: transX, pre: "t(.05 0 .3)", limits: [0 .1], joint_active: false, q: .03 }
finger2 (elbow): { joint: transX, pre: "t(-.05 0 .3)", joint_scale: -1, mimic: finger1 }
spare (elbow): { Q: [0 0 .5] }
spare_tip (spare): { }
Edit elbow: { color: [1 0 0] }
