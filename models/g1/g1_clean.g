# The Unitree G1 humanoid as g1_29dof_conv.g has it, with another order of q: frames are listed by how many joints they are
# away from the pelvis.
#
# Shapes are rounded convex hulls of our own, for the eye only (contact 0): `core` lists the corners of cross
# sections from one end of a link to the other.
# A viewer shows `visual_mesh` instead when the Python package example-robot-data is installed.

pelvis: {
  mass: 3.814, com: [0 0 -.0760301],
  inertia: [.0105549 0 2.1e-6 .00931478 0 .0079185],
  shape: ssCvx, size: [.01],
  color: [.2 .2 .2 1],
  core: [
    -.036 -.054 -.137, -.036 .054 -.137, .036 .054 -.137, .036 -.054 -.137,
    -.039 -.054 -.072, -.039 .054 -.072, .039 .054 -.072, .039 -.054 -.072,
    -.038 -.041 -.007, -.038 .041 -.007, .038 .041 -.007, .038 -.041 -.007
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/pelvis.STL>
}
left_hip_pitch_joint_origin (pelvis): { Q: [0 .064452 -.1027] }
right_hip_pitch_joint_origin (pelvis): { Q: [0 -.064452 -.1027] }
waist_yaw_joint (pelvis): {
  joint: hingeZ, limits: [-2.618 2.618], ctrl_limits: [32 88 -1],
  mass: .244, com: [.003964 0 .018769],
  inertia: [9.9587e-5 -1.833e-6 -1.2617e-5 .00012411 -1.18e-7 .00015586],
  shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    -.027 -.032 .01, -.027 -.032 .036, .029 -.032 .036, .029 -.032 .01,
    -.032 0 .01, -.032 0 .036, .032 0 .036, .032 0 .01,
    -.027 .032 .01, -.027 .032 .036, .029 .032 .036, .029 .032 .01
  ]
}
pelvis_contour_link_0 (pelvis): {
  shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    -.047 -.058 -.119, -.047 -.058 -.038, .049 -.058 -.038, .049 -.058 -.119,
    -.048 0 -.142, -.048 0 -.038, .051 0 -.038, .051 0 -.142,
    -.047 .058 -.119, -.047 .058 -.038, .049 .058 -.038, .049 .058 -.119
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/pelvis_contour_link.STL>
}
left_hip_pitch_joint (left_hip_pitch_joint_origin): {
  joint: hingeY, limits: [-2.5307 2.8798], ctrl_limits: [32 88 -1],
  mass: 1.35, com: [.002741 .047791 -.02606],
  inertia: [.001811 3.68e-5 -3.44e-5 .0014193 .000171 .0012812],
  shape: ssCvx, size: [.01],
  color: [.2 .2 .2 1],
  core: [
    -.023 .015 -.07, -.023 .086 -.07, .03 .086 -.07, .03 .015 -.07,
    -.032 .01 -.021, -.032 .089 -.021, .028 .089 -.021, .028 .01 -.021,
    -.026 .01 .027, -.026 .076 .027, .017 .076 .027, .017 .01 .027
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_hip_pitch_link.STL>
}
right_hip_pitch_joint (right_hip_pitch_joint_origin): {
  joint: hingeY, limits: [-2.5307 2.8798], ctrl_limits: [32 88 -1],
  mass: 1.35, com: [.002741 -.047791 -.02606],
  inertia: [.001811 -3.68e-5 -3.44e-5 .0014193 -.000171 .0012812],
  shape: ssCvx, size: [.01],
  color: [.2 .2 .2 1],
  core: [
    -.023 -.086 -.07, -.023 -.015 -.07, .03 -.015 -.07, .03 -.086 -.07,
    -.032 -.089 -.021, -.032 -.01 -.021, .028 -.01 -.021, .028 -.089 -.021,
    -.026 -.076 .027, -.026 -.01 .027, .017 -.01 .027, .017 -.076 .027
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_hip_pitch_link.STL>
}
waist_roll_joint_origin (waist_yaw_joint): { Q: [-.0039635 0 .035] }
left_hip_roll_joint_origin (left_hip_pitch_joint): { Q: [0 .052 -.030465 .996178686 0 -.08733857 0] }
right_hip_roll_joint_origin (right_hip_pitch_joint): { Q: [0 -.052 -.030465 .996178686 0 -.08733857 0] }
waist_roll_joint (waist_roll_joint_origin): {
  joint: hingeX, limits: [-.52 .52], ctrl_limits: [30 35 -1],
  mass: .047, com: [0 -.000236 .010111],
  inertia: [7.515e-6 0 0 6.398e-6 9.9e-8 3.988e-6],
  shape: ssCvx, size: [.005], color: [.7 .7 .7 1],
  core: [
    -.005 -.006 -.005, -.005 .006 -.005, .005 .006 -.005, .005 -.006 -.005,
    -.005 -.006 .024, -.005 .006 .024, .005 .006 .024, .005 -.006 .024
  ]
}
left_hip_roll_joint (left_hip_roll_joint_origin): {
  joint: hingeX, limits: [-.5236 2.9671], ctrl_limits: [20 139 -1],
  mass: 1.52, com: [.029812 -.001045 -.087934],
  inertia: [.0023773 -3.8e-6 -.0003908 .0024123 1.84e-5 .0016595],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.016 -.037 -.114, -.016 .037 -.114, .07 .037 -.114, .07 -.037 -.114,
    -.009 -.039 -.039, -.009 .039 -.039, .07 .039 -.039, .07 -.039 -.039,
    .044 -.036 .036, .044 .036 .036, .063 .036 .036, .063 -.036 .036
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_hip_roll_link.STL>
}
right_hip_roll_joint (right_hip_roll_joint_origin): {
  joint: hingeX, limits: [-2.9671 .5236], ctrl_limits: [20 139 -1],
  mass: 1.52, com: [.029812 .001045 -.087934],
  inertia: [.0023773 3.8e-6 -.0003908 .0024123 -1.84e-5 .0016595],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.016 -.037 -.114, -.016 .037 -.114, .07 .037 -.114, .07 -.037 -.114,
    -.009 -.039 -.039, -.009 .039 -.039, .07 .039 -.039, .07 -.039 -.039,
    .044 -.036 .036, .044 .036 .036, .063 .036 .036, .063 -.036 .036
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_hip_roll_link.STL>
}
waist_pitch_joint_origin (waist_roll_joint): { Q: [0 0 .019] }
left_hip_yaw_joint_origin (left_hip_roll_joint): { Q: [.025001 0 -.12412] }
right_hip_yaw_joint_origin (right_hip_roll_joint): { Q: [.025001 0 -.12412] }
waist_pitch_joint (waist_pitch_joint_origin): {
  joint: hingeY, limits: [-.52 .52], ctrl_limits: [30 35 -1],
  mass: 9.6, com: [.00331672 .000261479 .179808],
  inertia: [.12406 -8.877e-5 -.00329001 .112061 7.36516e-5 .0326569],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.047 -.075 0, -.047 .074 0, .057 .074 0, .057 -.075 0,
    -.053 -.088 .093, -.053 .09 .093, .069 .09 .093, .069 -.088 .093,
    -.057 -.098 .197, -.057 .098 .197, .074 .098 .197, .074 -.098 .197,
    -.052 -.089 .29, -.052 .09 .29, .053 .09 .29, .053 -.089 .29
  ]
}
left_hip_yaw_joint (left_hip_yaw_joint_origin): {
  joint: hingeZ, limits: [-2.7576 2.7576], ctrl_limits: [32 88 -1],
  mass: 1.702, com: [-.057709 -.010981 -.15078],
  inertia: [.0057774 -.0005411 -.0023948 .0076124 -.0007072 .003149],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.116 -.035 -.216, -.116 .019 -.216, -.033 .019 -.216, -.033 -.035 -.216,
    -.117 -.035 -.151, -.117 .026 -.151, .011 .026 -.151, .011 -.035 -.151,
    -.045 -.03 -.075, -.045 .03 -.075, .035 .03 -.075, .035 -.03 -.075,
    -.044 -.034 -.01, -.044 .033 -.01, .042 .033 -.01, .042 -.034 -.01
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_hip_yaw_link.STL>
}
right_hip_yaw_joint (right_hip_yaw_joint_origin): {
  joint: hingeZ, limits: [-2.7576 2.7576], ctrl_limits: [32 88 -1],
  mass: 1.702, com: [-.057709 .010981 -.15078],
  inertia: [.0057774 .0005411 -.0023948 .0076124 .0007072 .003149],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.116 -.019 -.216, -.116 .035 -.216, -.033 .035 -.216, -.033 -.019 -.216,
    -.117 -.026 -.151, -.117 .035 -.151, .01 .035 -.151, .01 -.026 -.151,
    -.045 -.03 -.075, -.045 .03 -.075, .035 .03 -.075, .035 -.03 -.075,
    -.044 -.033 -.01, -.044 .034 -.01, .042 .034 -.01, .042 -.033 -.01
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_hip_yaw_link.STL>
}
left_shoulder_pitch_joint_origin (waist_pitch_joint): {
  Q: [.0039563 .10022 .23778 .99026414 .13920102 .00004054 -.00009104]
}
right_shoulder_pitch_joint_origin (waist_pitch_joint): {
  Q: [.0039563 -.10021 .23778 .99026414 -.13920102 .00004054 .00009104]
}
logo_link_0 (waist_pitch_joint): {
  Q: [.0039635 0 -.054], shape: ssCvx, size: [.007], color: [.2 .2 .2 1],
  core: [
    -.066 -.068 .264, -.066 -.068 .279, -.066 .068 .279, -.066 .068 .264,
    .002 -.068 .264, .002 -.068 .279, .002 .068 .279, .002 .068 .264,
    .07 -.062 .264, .07 -.062 .278, .07 .063 .278, .07 .063 .264
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/logo_link.STL>
}
head_link_0 (waist_pitch_joint): {
  Q: [.0039635 0 -.054], shape: ssCvx, size: [.01], color: [.2 .2 .2 1],
  core: [
    -.049 -.068 .335, -.049 .068 .335, .038 .068 .335, .038 -.068 .335,
    -.032 -.039 .393, -.032 .039 .393, .043 .039 .393, .043 -.039 .393,
    -.056 -.046 .462, -.056 .046 .462, .064 .046 .462, .064 -.046 .462,
    -.051 -.042 .521, -.051 .042 .521, .063 .042 .521, .063 -.042 .521
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/head_link.STL>
}
waist_support_link_0 (waist_pitch_joint): {
  Q: [.0039635 0 -.054], shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    -.048 -.057 .022, -.048 -.057 .042, .047 -.057 .042, .047 -.057 .022,
    -.048 0 .021, -.048 0 .039, .049 0 .039, .049 0 .021,
    -.048 .057 .022, -.048 .057 .042, .047 .057 .042, .047 .057 .022
  ]
}
left_knee_joint_origin (left_hip_yaw_joint): { Q: [-.078273 .0021489 -.17734 .996178686 0 .08733857 0] }
right_knee_joint_origin (right_hip_yaw_joint): { Q: [-.078273 -.0021489 -.17734 .996178686 0 .08733857 0] }
left_shoulder_pitch_joint (left_shoulder_pitch_joint_origin): {
  joint: hingeY, limits: [-3.0892 2.6704], ctrl_limits: [37 25 -1],
  mass: .718, com: [0 .035892 -.011628],
  inertia: [.0004291 -9.2e-6 6.4e-6 .000453 2.26e-5 .000423],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.021 .01 -.04, -.021 .062 -.04, .021 .062 -.04, .021 .01 -.04,
    -.021 .01 -.005, -.021 .064 -.005, .021 .064 -.005, .021 .01 -.005,
    -.021 .01 .03, -.021 .047 .03, .021 .047 .03, .021 .01 .03
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_shoulder_pitch_link.STL>
}
right_shoulder_pitch_joint (right_shoulder_pitch_joint_origin): {
  joint: hingeY, limits: [-3.0892 2.6704], ctrl_limits: [37 25 -1],
  mass: .718, com: [0 -.035892 -.011628],
  inertia: [.0004291 9.2e-6 6.4e-6 .000453 -2.26e-5 .000423],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.021 -.062 -.04, -.021 -.01 -.04, .021 -.01 -.04, .021 -.062 -.04,
    -.021 -.064 -.005, -.021 -.01 -.005, .021 -.01 -.005, .021 -.064 -.005,
    -.021 -.047 .03, -.021 -.01 .03, .021 -.01 .03, .021 -.047 .03
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_shoulder_pitch_link.STL>
}
left_knee_joint (left_knee_joint_origin): {
  joint: hingeY, limits: [-.087267 2.8798], ctrl_limits: [20 139 -1],
  mass: 1.932, com: [.005457 .003964 -.12074],
  inertia: [.011329 4.82e-5 -4.49e-5 .011277 -.0007146 .0015168],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.005 -.01 -.305, -.005 .01 -.305, .023 .01 -.305, .023 -.01 -.305,
    -.024 -.025 -.197, -.024 .025 -.197, .045 .025 -.197, .045 -.025 -.197,
    -.027 -.026 -.078, -.027 .026 -.078, .053 .026 -.078, .053 -.026 -.078,
    -.03 -.014 .03, -.03 .025 .03, .054 .025 .03, .054 -.014 .03
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_knee_link.STL>
}
right_knee_joint (right_knee_joint_origin): {
  joint: hingeY, limits: [-.087267 2.8798], ctrl_limits: [20 139 -1],
  mass: 1.932, com: [.005457 -.003964 -.12074],
  inertia: [.011329 -4.82e-5 4.49e-5 .011277 .0007146 .0015168],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.005 -.01 -.305, -.005 .01 -.305, .023 .01 -.305, .023 -.01 -.305,
    -.024 -.025 -.197, -.024 .025 -.197, .045 .025 -.197, .045 -.025 -.197,
    -.027 -.026 -.078, -.027 .026 -.078, .053 .026 -.078, .053 -.026 -.078,
    -.03 -.025 .03, -.03 .014 .03, .054 .014 .03, .054 -.025 .03
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_knee_link.STL>
}
left_shoulder_roll_joint_origin (left_shoulder_pitch_joint): { Q: [0 .038 -.013831 .99026822 -.13917203 0 0] }
right_shoulder_roll_joint_origin (right_shoulder_pitch_joint): { Q: [0 -.038 -.013831 .99026822 .13917203 0 0] }
left_ankle_pitch_joint_origin (left_knee_joint): { Q: [0 -.000094445 -.30001] }
right_ankle_pitch_joint_origin (right_knee_joint): { Q: [0 .000094445 -.30001] }
left_shoulder_roll_joint (left_shoulder_roll_joint_origin): {
  joint: hingeX, limits: [-1.5882 2.2515], ctrl_limits: [37 25 -1],
  mass: .643, com: [-.000227 .00727 -.063243],
  inertia: [.0006177 -1e-6 8.7e-6 .0006912 -5.3e-6 .0003894],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.022 -.016 -.093, -.022 .029 -.093, .022 .029 -.093, .022 -.016 -.093,
    -.03 -.023 -.035, -.03 .03 -.035, .031 .03 -.035, .031 -.023 -.035,
    -.03 -.023 .023, -.03 .027 .023, .031 .027 .023, .031 -.023 .023
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_shoulder_roll_link.STL>
}
right_shoulder_roll_joint (right_shoulder_roll_joint_origin): {
  joint: hingeX, limits: [-2.2515 1.5882], ctrl_limits: [37 25 -1],
  mass: .643, com: [-.000227 -.00727 -.063243],
  inertia: [.0006177 1e-6 8.7e-6 .0006912 5.3e-6 .0003894],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.022 -.029 -.093, -.022 .016 -.093, .022 .016 -.093, .022 -.029 -.093,
    -.03 -.03 -.035, -.03 .023 -.035, .031 .023 -.035, .031 -.03 -.035,
    -.03 -.027 .023, -.03 .023 .023, .031 .023 .023, .031 -.027 .023
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_shoulder_roll_link.STL>
}
left_ankle_pitch_joint (left_ankle_pitch_joint_origin): {
  joint: hingeY, limits: [-.87267 .5236], ctrl_limits: [30 35 -1],
  mass: .074, com: [-.007269 0 .011137],
  inertia: [8.4e-6 0 -2.9e-6 1.89e-5 0 1.26e-5],
  shape: ssCvx, size: [.003], color: [.7 .7 .7 1],
  core: [
    -.021 -.003 -.022, -.021 .004 -.022, .009 .004 -.022, .009 -.003 -.022,
    -.015 -.003 .01, -.015 .003 .01, .009 .003 .01, .009 -.003 .01
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_ankle_pitch_link.STL>
}
right_ankle_pitch_joint (right_ankle_pitch_joint_origin): {
  joint: hingeY, limits: [-.87267 .5236], ctrl_limits: [30 35 -1],
  mass: .074, com: [-.007269 0 .011137],
  inertia: [8.4e-6 0 -2.9e-6 1.89e-5 0 1.26e-5],
  shape: ssCvx, size: [.003], color: [.7 .7 .7 1],
  core: [
    -.021 -.004 -.022, -.021 .003 -.022, .009 .003 -.022, .009 -.004 -.022,
    -.015 -.003 .01, -.015 .003 .01, .009 .003 .01, .009 -.003 .01
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_ankle_pitch_link.STL>
}
left_shoulder_yaw_joint_origin (left_shoulder_roll_joint): { Q: [0 .00624 -.1032] }
right_shoulder_yaw_joint_origin (right_shoulder_roll_joint): { Q: [0 -.00624 -.1032] }
left_ankle_roll_joint_origin (left_ankle_pitch_joint): { Q: [0 0 -.017558] }
right_ankle_roll_joint_origin (right_ankle_pitch_joint): { Q: [0 0 -.017558] }
left_shoulder_yaw_joint (left_shoulder_yaw_joint_origin): {
  joint: hingeZ, limits: [-2.618 2.618], ctrl_limits: [37 25 -1],
  mass: .734, com: [.010773 -.002949 -.072009],
  inertia: [.0009988 7.9e-6 .0001412 .0010605 -2.86e-5 .0004354],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.02 -.031 -.104, -.02 .012 -.104, .038 .012 -.104, .038 -.031 -.104,
    -.022 -.031 -.041, -.022 .022 -.041, .038 .022 -.041, .038 -.031 -.041,
    -.023 -.022 .022, -.023 .023 .022, .023 .023 .022, .023 -.022 .022
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_shoulder_yaw_link.STL>
}
right_shoulder_yaw_joint (right_shoulder_yaw_joint_origin): {
  joint: hingeZ, limits: [-2.618 2.618], ctrl_limits: [37 25 -1],
  mass: .734, com: [.010773 .002949 -.072009],
  inertia: [.0009988 -7.9e-6 .0001412 .0010605 2.86e-5 .0004354],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.02 -.012 -.104, -.02 .031 -.104, .038 .031 -.104, .038 -.012 -.104,
    -.022 -.022 -.041, -.022 .031 -.041, .038 .031 -.041, .038 -.022 -.041,
    -.023 -.023 .022, -.023 .022 .022, .023 .022 .022, .023 -.023 .022
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_shoulder_yaw_link.STL>
}
left_ankle_roll_joint (left_ankle_roll_joint_origin): {
  joint: hingeX, limits: [-.2618 .2618], ctrl_limits: [30 35 -1],
  mass: .608, com: [.026505 0 -.016425],
  inertia: [.0002231 2e-7 8.91e-5 .0016161 -1e-7 .0016667],
  shape: ssCvx, size: [.01],
  color: [.2 .2 .2 1],
  core: [
    -.056 -.02 -.025, -.056 -.02 .011, -.056 .02 .011, -.056 .02 -.025,
    .004 -.025 -.025, .004 -.025 .013, .004 .025 .013, .004 .025 -.025,
    .073 -.028 -.025, .073 -.028 .014, .073 .028 .014, .073 .028 -.025,
    .132 -.025 -.025, .132 -.025 -.02, .132 .025 -.02, .132 .025 -.025
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_ankle_roll_link.STL>
}
right_ankle_roll_joint (right_ankle_roll_joint_origin): {
  joint: hingeX, limits: [-.2618 .2618], ctrl_limits: [30 35 -1],
  mass: .608, com: [.026505 0 -.016425],
  inertia: [.0002231 -2e-7 8.91e-5 .0016161 1e-7 .0016667],
  shape: ssCvx, size: [.01],
  color: [.2 .2 .2 1],
  core: [
    -.056 -.02 -.025, -.056 -.02 .011, -.056 .02 .011, -.056 .02 -.025,
    .004 -.025 -.025, .004 -.025 .013, .004 .025 .013, .004 .025 -.025,
    .073 -.028 -.025, .073 -.028 .014, .073 .028 .014, .073 .028 -.025,
    .132 -.025 -.025, .132 -.025 -.02, .132 .025 -.02, .132 .025 -.025
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_ankle_roll_link.STL>
}
left_elbow_joint_origin (left_shoulder_yaw_joint): { Q: [.015783 0 -.080518] }
right_elbow_joint_origin (right_shoulder_yaw_joint): { Q: [.015783 0 -.080518] }
left_elbow_joint (left_elbow_joint_origin): {
  joint: hingeY, limits: [-1.0472 2.0944], ctrl_limits: [37 25 -1],
  mass: .6, com: [.064956 .004454 -.010062],
  inertia: [.0002891 6.53e-5 1.72e-5 .0004152 -5.6e-6 .0004197],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.02 .028 -.022, -.02 .028 .02, -.02 .028 .02, -.02 .028 -.022,
    .035 -.021 -.035, .035 -.021 .02, .035 .025 .02, .035 .025 -.035,
    .09 -.021 -.035, .09 -.021 .014, .09 .025 .014, .09 .025 -.035
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_elbow_link.STL>
}
right_elbow_joint (right_elbow_joint_origin): {
  joint: hingeY, limits: [-1.0472 2.0944], ctrl_limits: [37 25 -1],
  mass: .6, com: [.064956 -.004454 -.010062],
  inertia: [.0002891 -6.53e-5 1.72e-5 .0004152 5.6e-6 .0004197],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.02 -.028 -.022, -.02 -.028 .02, -.02 -.028 .02, -.02 -.028 -.022,
    .035 -.025 -.035, .035 -.025 .02, .035 .021 .02, .035 .021 -.035,
    .09 -.025 -.035, .09 -.025 .014, .09 .021 .014, .09 .021 -.035
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_elbow_link.STL>
}
left_wrist_roll_joint_origin (left_elbow_joint): { Q: [.1 .00188791 -.01] }
right_wrist_roll_joint_origin (right_elbow_joint): { Q: [.1 -.00188791 -.01] }
left_wrist_roll_joint (left_wrist_roll_joint_origin): {
  joint: hingeX, limits: [-1.97222 1.97222], ctrl_limits: [37 25 -1],
  mass: .085445, com: [.0171394 .000537591 4.8864e-7],
  inertia: [4.82154e-5 -4.24511e-6 0 3.7229e-5 0 5.48211e-5],
  shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    .01 -.02 -.016, .01 -.02 .016, .046 -.02 .016, .046 -.02 -.016,
    .005 0 -.02, .005 0 .02, .005 0 .02, .005 0 -.02,
    .01 .02 -.016, .01 .02 .016, .046 .02 .016, .046 .02 -.016
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_wrist_roll_link.STL>
}
right_wrist_roll_joint (right_wrist_roll_joint_origin): {
  joint: hingeX, limits: [-1.97222 1.97222], ctrl_limits: [37 25 -1],
  mass: .085445, com: [.0171394 -.000537591 4.8864e-7],
  inertia: [4.82154e-5 4.24511e-6 0 3.7229e-5 0 5.48211e-5],
  shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    .01 -.02 -.016, .01 -.02 .016, .046 -.02 .016, .046 -.02 -.016,
    .005 0 -.02, .005 0 .02, .005 0 .02, .005 0 -.02,
    .01 .02 -.016, .01 .02 .016, .046 .02 .016, .046 .02 -.016
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_wrist_roll_link.STL>
}
left_wrist_pitch_joint_origin (left_wrist_roll_joint): { Q: [.038 0 0] }
right_wrist_pitch_joint_origin (right_wrist_roll_joint): { Q: [.038 0 0] }
left_wrist_pitch_joint (left_wrist_pitch_joint_origin): {
  joint: hingeY, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1],
  mass: .4840496, com: [.0229999 -.00111685 -.00111658],
  inertia: [.000165796 -1.23121e-5 1.2317e-5 .000429541 8.14177e-7 .000429537],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.019 -.013 -.018, -.019 -.013 .018, -.019 .011 .018, -.019 .011 -.018,
    .023 -.018 -.018, .023 -.018 .018, .023 .018 .018, .023 .018 -.018,
    .065 -.018 -.013, .065 -.018 .011, .065 .018 .011, .065 .018 -.013
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_wrist_pitch_link.STL>
}
right_wrist_pitch_joint (right_wrist_pitch_joint_origin): {
  joint: hingeY, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1],
  mass: .4840496, com: [.0229999 .00111685 -.00111658],
  inertia: [.000165796 1.23121e-5 1.2317e-5 .000429541 -8.14177e-7 .000429537],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.019 -.011 -.018, -.019 -.011 .018, -.019 .013 .018, -.019 .013 -.018,
    .023 -.018 -.018, .023 -.018 .018, .023 .018 .018, .023 .018 -.018,
    .065 -.018 -.013, .065 -.018 .011, .065 .018 .011, .065 .018 -.013
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_wrist_pitch_link.STL>
}
left_wrist_yaw_joint_origin (left_wrist_pitch_joint): { Q: [.046 0 0] }
right_wrist_yaw_joint_origin (right_wrist_pitch_joint): { Q: [.046 0 0] }
left_wrist_yaw_joint (left_wrist_yaw_joint_origin): {
  joint: hingeZ, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1],
  mass: .2545765, com: [.0708244 .000191745 .00161742],
  inertia: [.000150445 3.76028e-5 -2.95494e-6 .000643113 3.77548e-6 .000560114],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.008 -.013 -.02, -.008 .016 -.02, .032 .016 -.02, .032 -.013 -.02,
    .035 -.014 0, .035 .02 0, .035 .02 0, .035 -.014 0,
    -.008 -.013 .02, -.008 .016 .02, .032 .016 .02, .032 -.013 .02
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_wrist_yaw_link.STL>
}
right_wrist_yaw_joint (right_wrist_yaw_joint_origin): {
  joint: hingeZ, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1],
  mass: .2545765, com: [.0708244 -.000191745 .00161742],
  inertia: [.000150445 -3.76028e-5 -2.95494e-6 .000643113 -3.77548e-6 .000560114],
  shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.008 -.016 -.02, -.008 .013 -.02, .032 .013 -.02, .032 -.016 -.02,
    .035 -.02 0, .035 .014 0, .035 .014 0, .035 -.02 0,
    -.008 -.016 .02, -.008 .013 .02, .032 .013 .02, .032 -.016 .02
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_wrist_yaw_link.STL>
}
left_rubber_hand_0 (left_wrist_yaw_joint): {
  Q: [.0415 .003 0], shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    .01 -.006 -.025, .01 -.006 .026, .01 .009 .026, .01 .009 -.025,
    .066 -.019 -.032, .066 -.019 .053, .066 .008 .053, .066 .008 -.032,
    .122 -.038 -.033, .122 -.038 .026, .122 -.008 .026, .122 -.008 -.033
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_rubber_hand.STL>
}
right_rubber_hand_0 (right_wrist_yaw_joint): {
  Q: [.0415 -.003 0], shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    .01 -.009 -.025, .01 -.009 .026, .01 .006 .026, .01 .006 -.025,
    .066 -.008 -.032, .066 -.008 .053, .066 .019 .053, .066 .019 -.032,
    .122 .008 -.033, .122 .008 .026, .122 .038 .026, .122 .038 -.033
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_rubber_hand.STL>
}
