# A UR10 arm on a stand of 1 m, at q = 0.
#
# Lengths from the manufacturer's table: base 127.3 mm, upper arm 612 mm, forearm 572.3 mm, wrists 114.9, 115.7 and
# 92.2 mm; the shoulder is 220.94 mm beside the base's axis and the forearm 171.9 mm nearer. Each joint is a pair of
# frames, `..._origin` where it sits on the link before it and the joint itself. Masses and inertias are those of the
# manufacturer's description.
# Shapes are rounded convex hulls of our own, for the eye only (contact 0): `core` lists the corners of cross
# sections from one end of a link to the other.
# A viewer shows `visual_mesh` instead when the Python package example-robot-data is installed.

world: {}
world_joint_origin (world): { Q: [0 0 1] }
world_joint (world_joint_origin): {
  joint: rigid, mass: 4, com: [0 0 0], inertia: [.00610633 .00610633 .01125],
  shape: ssCvx, size: [.009], color: [.37 .37 .37 1],
  core: [
    -.063 -.083 .009, -.063 -.083 .029, .063 -.083 .029, .063 -.083 .009,
    -.066 -.008 .009, -.066 -.008 .029, .066 -.008 .029, .066 -.008 .009,
    -.063 .066 .009, -.063 .066 .029, .063 .066 .029, .063 .066 .009
  ],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/base.dae>
}

# shoulder: turns about the vertical axis, and leans
shoulder_pan_joint_origin (world_joint): { Q: [0 0 .1273] }
shoulder_pan_joint (shoulder_pan_joint_origin): {
  joint: hingeZ, limits: [-6.28319 6.28319], ctrl_limits: [2.16 330 -1],
  mass: 7.778, com: [0 0 0], inertia: [.0314743 .0314743 .0218756],
  shape: ssCvx, size: [.01],
  color: [.93 .94 .95],
  core: [
    -.065 -.065 -.079, -.065 .076 -.079, .065 .076 -.079, .065 -.065 -.079,
    -.065 -.065 0, -.065 .076 0, .065 .076 0, .065 -.065 0,
    -.065 -.064 .078, -.065 .076 .078, .065 .076 .078, .065 -.064 .078
  ],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/shoulder.dae>
}
shoulder_lift_joint_origin (shoulder_pan_joint): { Q: "t(0 .220941 0) d(90 0 1 0)" }
shoulder_lift_joint (shoulder_lift_joint_origin): {
  joint: hingeY, limits: [-6.28319 6.28319], ctrl_limits: [2.16 330 -1],
  mass: 12.93, com: [0 0 .306], inertia: [.421754 .421754 .0363656],
  shape: ssCvx, size: [.01],
  color: [.93 .94 .95],
  core: [
    -.065 -.125 -.064, -.065 .03 -.064, .065 .03 -.064, .065 -.125 -.064,
    -.065 -.125 .175, -.065 .032 .175, .065 .032 .175, .065 -.125 .175,
    -.048 -.093 .424, -.048 .005 .424, .049 .005 .424, .049 -.093 .424,
    -.092 -.095 .664, -.092 .025 .664, .05 .025 .664, .05 -.095 .664
  ],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/upperarm.dae>
}

# elbow
elbow_joint_origin (shoulder_lift_joint): { Q: [0 -.1719 .612] }
elbow_joint (elbow_joint_origin): {
  joint: hingeY, limits: [-6.28319 6.28319], ctrl_limits: [3.15 150 -1],
  mass: 3.87, com: [0 0 .28615], inertia: [.11107 .11107 .0108844],
  shape: ssCvx, size: [.01],
  color: [.93 .94 .95],
  core: [
    -.05 -.059 -.048, -.05 .057 -.048, .05 .057 -.048, .05 -.059 -.048,
    -.048 -.059 .168, -.048 .057 .168, .048 .057 .168, .048 -.059 .168,
    -.033 -.034 .393, -.033 .032 .393, .033 .032 .393, .033 -.034 .393,
    -.035 -.048 .609, -.035 .051 .609, .036 .051 .609, .036 -.048 .609
  ],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/forearm.dae>
}

# wrist: bends, turns, turns the flange
wrist_1_joint_origin (elbow_joint): { Q: "t(0 0 .5723) d(90 0 1 0)" }
wrist_1_joint (wrist_1_joint_origin): {
  joint: hingeY, limits: [-6.28319 6.28319], ctrl_limits: [3.2 54 -1],
  mass: 1.96, com: [0 0 0], inertia: [.00510825 .00510825 .0055125],
  shape: ssCvx, size: [.01],
  color: [.93 .94 .95],
  core: [
    -.036 .071 -.047, -.036 .15 -.047, .035 .15 -.047, .035 .071 -.047,
    -.035 .071 .003, -.035 .151 .003, .035 .151 .003, .035 .071 .003,
    -.035 .071 .052, -.035 .15 .052, .035 .15 .052, .035 .071 .052
  ],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/wrist1.dae>
}
wrist_2_joint_origin (wrist_1_joint): { Q: [0 .1149 0] }
wrist_2_joint (wrist_2_joint_origin): {
  joint: hingeZ, limits: [-6.28319 6.28319], ctrl_limits: [3.2 54 -1],
  mass: 1.96, com: [0 0 0], inertia: [.00510825 .00510825 .0055125],
  shape: ssCvx, size: [.01],
  color: [.93 .94 .95],
  core: [
    -.035 -.047 .072, -.035 -.047 .151, .036 -.047 .151, .036 -.047 .072,
    -.035 .002 .072, -.035 .002 .152, .035 .002 .152, .035 .002 .072,
    -.035 .052 .072, -.035 .052 .151, .035 .052 .151, .035 .052 .072
  ],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/wrist2.dae>
}
wrist_3_joint_origin (wrist_2_joint): { Q: [0 0 .1157] }
wrist_3_joint (wrist_3_joint_origin): {
  joint: hingeY, limits: [-6.28319 6.28319], ctrl_limits: [3.2 54 -1],
  mass: .202, com: [0 0 0], inertia: [.000526462 .000526462 .000568125],
  shape: ssCvx, size: [.007], color: [.46 .46 .46 1],
  core: [
    -.032 .069 -.037, -.032 .085 -.037, .032 .085 -.037, .032 .069 -.037,
    -.038 .069 .001, -.038 .085 .001, .038 .085 .001, .038 .069 .001,
    -.032 .069 .039, -.032 .085 .039, .032 .085 .039, .032 .069 .039
  ],
  visual_mesh: <package://example-robot-data/robots/ur_description/meshes/ur10/visual/wrist3.dae>
}

# the flange: x points away from the arm
ee_fixed_joint_origin (wrist_3_joint): { Q: "t(0 .0922 0) d(90 0 0 1)" }
ee_fixed_joint (ee_fixed_joint_origin): { joint: rigid }
