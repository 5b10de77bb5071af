# The Allegro right hand, 16 dofs: three fingers of four joints each and a thumb of four, at q = 0.
#
# Lengths, limits, masses and inertias are those that the manufacturer published with its robot description.
# Shapes are rounded convex hulls of our own, for the eye only (contact 0): `core` lists the corners of cross
# sections from one end of a link to the other.
# A viewer shows `visual_mesh` instead when the Python package example-robot-data is installed.

base_link: {
  shape: ssCvx, size: [.01], color: [.2 .2 .2 1],
  core: [
    -.02 -.047 -.082, -.02 -.047 -.01, .001 -.047 -.01, .001 -.047 -.082,
    -.02 0 -.085, -.02 0 -.008, .001 0 -.008, .001 0 -.085,
    -.02 .047 -.085, -.02 .047 -.01, .001 .047 -.01, .001 .047 -.085
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/base_link.STL>
}

# first finger: spread, and three that bend
joint_0.0 (base_link): {
  pre: "t(0 .0435 -.001542) d(-5 1 0 0)", joint: hingeZ, limits: [-.47 .47], ctrl_limits: [7 15 -1], mass: .0138081,
  inertia: [2.10226e-6 0 1.28475e-7 1.49709e-6 0 1.95737e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.009 .004, -.006 -.009 .018, .006 -.009 .018, .006 -.009 .004,
    -.006 .009 .004, -.006 .009 .018, .006 .009 .018, .006 .009 .004
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_0.0.STL>
}
joint_1.0 (joint_0.0): {
  pre: [0 0 .0164], joint: hingeY, limits: [-.196 1.61], ctrl_limits: [7 15 -1], mass: .0352445,
  inertia: [2.05683e-5 1.93491e-5 5.61235e-6],
  shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.01 -.005, -.006 .009 -.005, .006 .009 -.005, .006 -.01 -.005,
    -.006 -.01 .027, -.006 .009 .027, .006 .009 .027, .006 -.01 .027,
    -.006 -.01 .059, -.006 .009 .059, .006 .009 .059, .006 -.01 .059
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_1.0.STL>
}
joint_2.0 (joint_1.0): {
  pre: [0 0 .054], joint: hingeY, limits: [-.174 1.709], ctrl_limits: [7 15 -1], mass: .027071,
  inertia: [1.02645e-5 0 -2.66869e-7 9.21454e-6 -1.20625e-8 4.24714e-6], shape: ssCvx, size: [.004],
  color: [.93 .94 .95],
  core: [
    -.006 -.01 -.002, -.006 .009 -.002, .006 .009 -.002, .006 -.01 -.002,
    -.006 -.01 .02, -.006 .009 .02, .006 .009 .02, .006 -.01 .02,
    -.006 -.007 .043, -.006 .007 .043, .006 .007 .043, .006 -.007 .043
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_2.0.STL>
}
joint_3.0 (joint_2.0): {
  pre: [0 0 .0384], joint: hingeY, limits: [-.227 1.618], ctrl_limits: [7 15 -1], mass: .0249703,
  com: [-.000428096 -3.05085e-8 .0141413],
  inertia: [5.57551e-6 0 -1.99089e-7 4.98291e-6 0 3.22274e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.009 -.002, -.006 -.009 .012, .006 -.009 .012, .006 -.009 -.002,
    -.006 .009 -.002, -.006 .009 .012, .006 .009 .012, .006 .009 -.002
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_3.0.STL>
}
link_3.0_tip_0 (joint_3.0): {
  Q: [0 0 .0267], shape: ssCvx, size: [.005], color: [.9 .9 .9 1],
  core: [
    -.007 -.007 -.006, -.007 -.007 .007, -.007 .007 .007, -.007 .007 -.006,
    .007 -.007 -.006, .007 -.007 .007, .007 .007 .007, .007 .007 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_3.0_tip.STL>
}

# middle finger
joint_4.0 (base_link): {
  pre: [0 0 .0007], joint: hingeZ, limits: [-.47 .47], ctrl_limits: [7 15 -1], mass: .0138081,
  inertia: [2.10226e-6 0 1.28475e-7 1.49709e-6 0 1.95737e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.009 .004, -.006 -.009 .018, .006 -.009 .018, .006 -.009 .004,
    -.006 .009 .004, -.006 .009 .018, .006 .009 .018, .006 .009 .004
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_0.0.STL>
}
joint_5.0 (joint_4.0): {
  pre: [0 0 .0164], joint: hingeY, limits: [-.196 1.61], ctrl_limits: [7 15 -1], mass: .0352445,
  inertia: [2.05683e-5 1.93491e-5 5.61235e-6],
  shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.01 -.005, -.006 .009 -.005, .006 .009 -.005, .006 -.01 -.005,
    -.006 -.01 .027, -.006 .009 .027, .006 .009 .027, .006 -.01 .027,
    -.006 -.01 .059, -.006 .009 .059, .006 .009 .059, .006 -.01 .059
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_1.0.STL>
}
joint_6.0 (joint_5.0): {
  pre: [0 0 .054], joint: hingeY, limits: [-.174 1.709], ctrl_limits: [7 15 -1], mass: .027071,
  inertia: [1.02645e-5 0 -2.66869e-7 9.21454e-6 -1.20625e-8 4.24714e-6], shape: ssCvx, size: [.004],
  color: [.93 .94 .95],
  core: [
    -.006 -.01 -.002, -.006 .009 -.002, .006 .009 -.002, .006 -.01 -.002,
    -.006 -.01 .02, -.006 .009 .02, .006 .009 .02, .006 -.01 .02,
    -.006 -.007 .043, -.006 .007 .043, .006 .007 .043, .006 -.007 .043
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_2.0.STL>
}
joint_7.0 (joint_6.0): {
  pre: [0 0 .0384], joint: hingeY, limits: [-.227 1.618], ctrl_limits: [7 15 -1], mass: .0249703,
  com: [-.000428096 -3.05085e-8 .0141413],
  inertia: [5.57551e-6 0 -1.99089e-7 4.98291e-6 0 3.22274e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.009 -.002, -.006 -.009 .012, .006 -.009 .012, .006 -.009 -.002,
    -.006 .009 -.002, -.006 .009 .012, .006 .009 .012, .006 .009 -.002
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_3.0.STL>
}
link_7.0_tip_0 (joint_7.0): {
  Q: [0 0 .0267], shape: ssCvx, size: [.005], color: [.9 .9 .9 1],
  core: [
    -.007 -.007 -.006, -.007 -.007 .007, -.007 .007 .007, -.007 .007 -.006,
    .007 -.007 -.006, .007 -.007 .007, .007 .007 .007, .007 .007 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_3.0_tip.STL>
}

# third finger
joint_8.0 (base_link): {
  pre: "t(0 -.0435 -.001542) d(5 1 0 0)", joint: hingeZ, limits: [-.47 .47], ctrl_limits: [7 15 -1], mass: .0138081,
  inertia: [2.10226e-6 0 1.28475e-7 1.49709e-6 0 1.95737e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.009 .004, -.006 -.009 .018, .006 -.009 .018, .006 -.009 .004,
    -.006 .009 .004, -.006 .009 .018, .006 .009 .018, .006 .009 .004
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_0.0.STL>
}
joint_9.0 (joint_8.0): {
  pre: [0 0 .0164], joint: hingeY, limits: [-.196 1.61], ctrl_limits: [7 15 -1], mass: .0352445,
  inertia: [2.05683e-5 1.93491e-5 5.61235e-6],
  shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.01 -.005, -.006 .009 -.005, .006 .009 -.005, .006 -.01 -.005,
    -.006 -.01 .027, -.006 .009 .027, .006 .009 .027, .006 -.01 .027,
    -.006 -.01 .059, -.006 .009 .059, .006 .009 .059, .006 -.01 .059
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_1.0.STL>
}
joint_10.0 (joint_9.0): {
  pre: [0 0 .054], joint: hingeY, limits: [-.174 1.709], ctrl_limits: [7 15 -1], mass: .027071,
  inertia: [1.02645e-5 0 -2.66869e-7 9.21454e-6 -1.20625e-8 4.24714e-6], shape: ssCvx, size: [.004],
  color: [.93 .94 .95],
  core: [
    -.006 -.01 -.002, -.006 .009 -.002, .006 .009 -.002, .006 -.01 -.002,
    -.006 -.01 .02, -.006 .009 .02, .006 .009 .02, .006 -.01 .02,
    -.006 -.007 .043, -.006 .007 .043, .006 .007 .043, .006 -.007 .043
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_2.0.STL>
}
joint_11.0 (joint_10.0): {
  pre: [0 0 .0384], joint: hingeY, limits: [-.227 1.618], ctrl_limits: [7 15 -1], mass: .0249703,
  com: [-.000428096 -3.05085e-8 .0141413],
  inertia: [5.57551e-6 0 -1.99089e-7 4.98291e-6 0 3.22274e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.009 -.002, -.006 -.009 .012, .006 -.009 .012, .006 -.009 -.002,
    -.006 .009 -.002, -.006 .009 .012, .006 .009 .012, .006 .009 -.002
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_3.0.STL>
}
link_11.0_tip_0 (joint_11.0): {
  Q: [0 0 .0267], shape: ssCvx, size: [.005], color: [.9 .9 .9 1],
  core: [
    -.007 -.007 -.006, -.007 -.007 .007, -.007 .007 .007, -.007 .007 -.006,
    .007 -.007 -.006, .007 -.007 .007, .007 .007 .007, .007 .007 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_3.0_tip.STL>
}

# thumb: opposes, turns, and two that bend
joint_12.0 (base_link): {
  pre: [-.0182 .019333 -.045987 .47771442 -.5213338 -.5213338 -.47771442], joint: hinge, ctrl_limits: [7 15 -1],
  axis: [-1 0 0],
  limits: [.263 1.396], mass: .0414448, inertia: [1.68187e-5 2.11439e-8 -6.09085e-8 1.97642e-5 8.08179e-7 1.45646e-5],
  shape: ssCvx, size: [.008], color: [.2 .2 .2 1],
  core: [
    -.031 0 0, -.031 .018 0, -.003 .018 0, -.003 0 0,
    -.028 .003 .033, -.028 .017 .033, -.008 .017 .033, -.008 .003 .033
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_12.0_right.STL>
}
joint_13.0 (joint_12.0): {
  pre: [-.027 .005 .0399], joint: hingeZ, limits: [-.105 1.163], ctrl_limits: [7 15 -1], mass: .0137974,
  inertia: [2.09883e-6 0 1.28569e-7 1.49389e-6 0 1.95483e-6], shape: ssCvx, size: [.004], color: [.2 .2 .2 1],
  core: [
    -.006 -.009 .004, -.006 -.009 .018, .006 -.009 .018, .006 -.009 .004,
    -.006 .009 .004, -.006 .009 .018, .006 .009 .018, .006 .009 .004
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_13.0.STL>
}
joint_14.0 (joint_13.0): {
  pre: [0 0 .0177], joint: hingeY, limits: [-.189 1.644], ctrl_limits: [7 15 -1], mass: .0331245,
  inertia: [1.72884e-5 0 3.37679e-7 1.59804e-5 1.5622e-8 5.343e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.007 -.005, -.006 .007 -.005, .006 .007 -.005, .006 -.007 -.005,
    -.006 -.009 .024, -.006 .01 .024, .006 .01 .024, .006 -.009 .024,
    -.006 -.009 .054, -.006 .01 .054, .006 .01 .054, .006 -.009 .054
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_14.0.STL>
}
joint_15.0 (joint_14.0): {
  pre: [0 0 .0514], joint: hingeY, limits: [-.162 1.719], ctrl_limits: [7 15 -1], mass: .0331744,
  com: [0 4.99817e-5 .0217449],
  inertia: [1.2987e-5 0 0 1.22157e-5 2.42841e-8 4.60085e-6], shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    -.006 -.009 -.005, -.006 .01 -.005, .006 .01 -.005, .006 -.009 -.005,
    -.006 -.009 .027, -.006 .01 .027, .006 .01 .027, .006 -.009 .027
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_15.0.STL>
}
link_15.0_tip_0 (joint_15.0): {
  Q: [0 0 .0423], shape: ssCvx, size: [.005], color: [.9 .9 .9 1],
  core: [
    -.007 -.007 -.006, -.007 -.007 .007, -.007 .007 .007, -.007 .007 -.006,
    .007 -.007 -.006, .007 -.007 .007, .007 .007 .007, .007 .007 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/allegro_hand_description/meshes/link_15.0_tip.STL>
}
