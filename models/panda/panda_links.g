# The links of the seven-joint Panda arm, from the first to the mechanical flange; panda_arm.g puts them on a base.
#
# Each joint is a pair of frames: `..._origin` is where the joint sits on the link before it (the constant part, from
# the manufacturer's Denavit-Hartenberg table: d1 .333, d3 .316, a4 .0825, a5 -.0825, d5 .384, a7 .088, flange .107),
# and the joint frame itself, which turns about its z axis and carries the link behind it.
#
# Shapes of joint frames are for the eye only: rounded convex hulls with contact 0. A viewer shows `visual_mesh`
# instead when the Python package example-robot-data is installed; those meshes sit in the same frames.
# Angles are in degrees inside d(..), otherwise in radians; lengths in meters.

panda_link0: {
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
    -.142 -.083  .012, -.142  .083  .012,   .03  -.08  .012,   .03   .08  .012,   .05 -.055  .012
      .05  .055  .012,  .058 -.025  .012,  .058  .025  .012,   -.1 -.085  .012,   -.1  .085  .012
     .044  .014  .128,  .027  .037  .128,     0  .046  .128, -.027  .037  .128, -.044  .014  .128
    -.044 -.014  .128, -.027 -.037  .128,     0 -.046  .128,  .027 -.037  .128,  .044 -.014  .128
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link0.dae>
}

# shoulder: turns about the vertical axis
panda_joint1_origin (panda_link0): { Q: "t(0 0 .333)" }
panda_joint1 (panda_joint1_origin): {
  joint: hingeZ, limits: [-2.8973 2.8973], ctrl_limits: [2.175 87 -1], q: 0,
  mj_actuator_kp: "870.", mj_joint_damping: "100.",
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
     .042  .014  -.18,  .026  .036  -.18,     0  .044  -.18, -.026  .036  -.18, -.042  .014  -.18
    -.042 -.014  -.18, -.026 -.036  -.18,     0 -.044  -.18,  .026 -.036  -.18,  .042 -.014  -.18
     .013 -.117  .041,  .035 -.117  .025,  .043 -.117     0,  .035 -.117 -.025,  .013 -.117 -.041
    -.013 -.117 -.041, -.035 -.117 -.025, -.043 -.117     0, -.035 -.117  .025, -.013 -.117  .041
     .013 -.012  .041,  .035 -.012  .025,  .043 -.012     0,  .035 -.012 -.025,  .013 -.012 -.041
    -.013 -.012 -.041, -.035 -.012 -.025, -.043 -.012     0, -.035 -.012  .025, -.013 -.012  .041
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link1.dae>
}

# shoulder: leans; the axis lies across the arm
panda_joint2_origin (panda_joint1): { Q: "d(-90 1 0 0)" }
panda_joint2 (panda_joint2_origin): {
  joint: hingeZ, limits: [-1.7628 1.7628], ctrl_limits: [2.175 87 -1], q: -.5,
  mj_actuator_kp: "870.", mj_joint_damping: "100.",
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
     .014 -.182  .042,  .036 -.182  .026,  .044 -.182     0,  .036 -.182 -.026,  .014 -.182 -.042
    -.014 -.182 -.042, -.036 -.182 -.026, -.044 -.182     0, -.036 -.182  .026, -.014 -.182  .042
     .041  .013  .117,  .025  .035  .117,     0  .043  .117, -.025  .035  .117, -.041  .013  .117
    -.041 -.013  .117, -.025 -.035  .117,     0 -.043  .117,  .025 -.035  .117,  .041 -.013  .117
     .041  .013  .012,  .025  .035  .012,     0  .043  .012, -.025  .035  .012, -.041  .013  .012
    -.041 -.013  .012, -.025 -.035  .012,     0 -.043  .012,  .025 -.035  .012,  .041 -.013  .012
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link2.dae>
}

# upper arm: turns about its own axis (d3)
panda_joint3_origin (panda_joint2): { Q: "t(0 -.316 0) d(90 1 0 0)" }
panda_joint3 (panda_joint3_origin): {
  joint: hingeZ, limits: [-2.8973 2.8973], ctrl_limits: [2.175 87 -1], q: 0,
  mj_actuator_kp: "870.", mj_joint_damping: "100.",
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
     .042  .014 -.109,  .026  .036 -.109,     0  .044 -.109, -.026  .036 -.109, -.042  .014 -.109
    -.042 -.014 -.109, -.026 -.036 -.109,     0 -.044 -.109,  .026 -.036 -.109,  .042 -.014 -.109
     .096  .098  .041,  .117  .098  .025,  .126  .098     0,  .117  .098 -.025,  .096  .098 -.041
     .069  .098 -.041,  .048  .098 -.025,   .04  .098     0,  .048  .098  .025,  .069  .098  .041
     .096   .01  .041,  .117   .01  .025,  .126   .01     0,  .117   .01 -.025,  .096   .01 -.041
     .069   .01 -.041,  .048   .01 -.025,   .04   .01     0,  .048   .01  .025,  .069   .01  .041
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link3.dae>
}

# elbow, beside the axis of the upper arm (a4)
panda_joint4_origin (panda_joint3): { Q: "t(.0825 0 0) d(90 1 0 0)" }
panda_joint4 (panda_joint4_origin): {
  joint: hingeZ, limits: [-3.0718 -.0698], ctrl_limits: [2.175 87 -1], q: -2,
  mj_actuator_kp: "870.", mj_joint_damping: "100.",
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
    -.069  .112  .042, -.047  .112  .026, -.039  .112     0, -.047  .112 -.026, -.069  .112 -.042
    -.096  .112 -.042, -.118  .112 -.026, -.126  .112     0, -.118  .112  .026, -.096  .112  .042
     .041  .013  .098,  .025  .035  .098,     0  .043  .098, -.025  .035  .098, -.041  .013  .098
    -.041 -.013  .098, -.025 -.035  .098,     0 -.043  .098,  .025 -.035  .098,  .041 -.013  .098
     .041  .013   .01,  .025  .035   .01,     0  .043   .01, -.025  .035   .01, -.041  .013   .01
    -.041 -.013   .01, -.025 -.035   .01,     0 -.043   .01,  .025 -.035   .01,  .041 -.013   .01
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link4.dae>
}

# forearm: turns about its own axis (a5, d5)
panda_joint5_origin (panda_joint4): { Q: "t(-.0825 .384 0) d(-90 1 0 0)" }
panda_joint5 (panda_joint5_origin): {
  joint: hingeZ, limits: [-2.8973 2.8973], ctrl_limits: [2.61 12 -1], q: 0,
  mj_actuator_kp: "120.", mj_joint_damping: "10.",
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
     .042  .014 -.247,  .026  .036 -.247,     0  .044 -.247, -.026  .036 -.247, -.042  .014 -.247
    -.042 -.014 -.247, -.026 -.036 -.247,     0 -.044 -.247,  .026 -.036 -.247,  .042 -.014 -.247
     .012  .117  .037,  .032  .117  .023,  .039  .117     0,  .032  .117 -.023,  .012  .117 -.037
    -.012  .117 -.037, -.032  .117 -.023, -.039  .117     0, -.032  .117  .023, -.012  .117  .037
     .012  .017  .037,  .032  .017  .023,  .039  .017     0,  .032  .017 -.023,  .012  .017 -.037
    -.012  .017 -.037, -.032  .017 -.023, -.039  .017     0, -.032  .017  .023, -.012  .017  .037
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link5.dae>
}

# wrist: bends. The mechanics allow [-.0175 3.7525]; scenes keep clear of the ends
panda_joint6_origin (panda_joint5): { Q: "d(90 1 0 0)" }
panda_joint6 (panda_joint6_origin): {
  joint: hingeZ, limits: [.5 3], ctrl_limits: [2.61 12 -1], q: 2,
  mj_actuator_kp: "120.", mj_joint_damping: "10.",
  shape: ssCvx, size: [.012], color: [.93 .94 .95],
  core: [
     .035  .011 -.032,  .022   .03 -.032,     0  .037 -.032, -.022   .03 -.032, -.035  .011 -.032
    -.035 -.011 -.032, -.022  -.03 -.032,     0 -.037 -.032,  .022  -.03 -.032,  .035 -.011 -.032
     .035  .011  .044,  .022   .03  .044,     0  .037  .044, -.022   .03  .044, -.035  .011  .044
    -.035 -.011  .044, -.022  -.03  .044,     0 -.037  .044,  .022  -.03  .044,  .035 -.011  .044
     .098 -.039  .031,  .115 -.039  .019,  .121 -.039     0,  .115 -.039 -.019,  .098 -.039 -.031
     .078 -.039 -.031,  .061 -.039 -.019,  .055 -.039     0,  .061 -.039  .019,  .078 -.039  .031
     .097  .045  .029,  .112  .045  .018,  .118  .045     0,  .112  .045 -.018,  .097  .045 -.029
     .079  .045 -.029,  .064  .045 -.018,  .058  .045     0,  .064  .045  .018,  .079  .045  .029
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link6.dae>
}

# wrist: turns the flange (a7)
panda_joint7_origin (panda_joint6): { Q: "t(.088 0 0) d(90 1 0 0)" }
panda_joint7 (panda_joint7_origin): {
  joint: hingeZ, limits: [-2.8973 2.8973], ctrl_limits: [2.61 12 -1], q: -.5,
  mj_actuator_kp: "120.", mj_joint_damping: "10.",
  shape: ssCvx, size: [.012], color: [.75 .77 .79],
  core: [
      .03   .01  .064,  .019  .026  .064,     0  .032  .064, -.019  .026  .064,  -.03   .01  .064
     -.03  -.01  .064, -.019 -.026  .064,     0 -.032  .064,  .019 -.026  .064,   .03  -.01  .064
      .03   .01  .095,  .019  .026  .095,     0  .032  .095, -.019  .026  .095,  -.03   .01  .095
     -.03  -.01  .095, -.019 -.026  .095,     0 -.032  .095,  .019 -.026  .095,   .03  -.01  .095
     .058  .058  .074,  .066   .05   .08,   .05  .066   .08,  .066   .05   .09,   .05  .066   .09
  ],
  visual_mesh: <package://example-robot-data/robots/panda_description/meshes/visual/link7.dae>
}

# the flange that tools are screwed to
panda_joint8_origin (panda_joint7): { Q: "t(0 0 .107)" }
panda_joint8 (panda_joint8_origin): {}
