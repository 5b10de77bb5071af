# The Unitree G1 humanoid as g1_29dof_conv.g has it, with the masses of hollow shells and another order of q: frames are
# listed by how many joints they are away from the pelvis.
#
# Shapes are rounded convex hulls of our own, for the eye only (contact 0): `core` lists the corners of cross
# sections from one end of a link to the other.
# A viewer shows `visual_mesh` instead when the Python package example-robot-data is installed.

pelvis: {
  mass: .793878, com: [.000297452 1.17304e-5 -.0760703],
  inertia: [.00280151 -1.42902e-7 -1.26125e-6 .00275155 -1.1233e-7 .00255542], shape: ssCvx, size: [.01],
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
  joint: hingeZ, limits: [-2.618 2.618], ctrl_limits: [32 88 -1], mass: .168083,
  inertia: [8.83938e-5 0 -9.9721e-6 .000103081 0 .000150067],
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
  joint: hingeY, limits: [-2.5307 2.8798], ctrl_limits: [32 88 -1], mass: .264573,
  inertia: [.000474721 4.31311e-6 5.93997e-6 .000392354 4.96908e-5 .000375138], shape: ssCvx, size: [.01],
  color: [.2 .2 .2 1],
  core: [
    -.023 .015 -.07, -.023 .086 -.07, .03 .086 -.07, .03 .015 -.07,
    -.032 .01 -.021, -.032 .089 -.021, .028 .089 -.021, .028 .01 -.021,
    -.026 .01 .027, -.026 .076 .027, .017 .076 .027, .017 .01 .027
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_hip_pitch_link.STL>
}
right_hip_pitch_joint (right_hip_pitch_joint_origin): {
  joint: hingeY, limits: [-2.5307 2.8798], ctrl_limits: [32 88 -1], mass: .264569,
  inertia: [.000474711 -4.31398e-6 5.94077e-6 .000392343 -4.96889e-5 .000375138], shape: ssCvx, size: [.01],
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
  joint: hingeX, limits: [-.52 .52], ctrl_limits: [30 35 -1], mass: .0221562,
  inertia: [4.0451e-6 3.67093e-6 2.32541e-6],
  shape: ssCvx, size: [.005], color: [.7 .7 .7 1],
  core: [
    -.005 -.006 -.005, -.005 .006 -.005, .005 .006 -.005, .005 -.006 -.005,
    -.005 -.006 .024, -.005 .006 .024, .005 .006 .024, .005 -.006 .024
  ]
}
left_hip_roll_joint (left_hip_roll_joint_origin): {
  joint: hingeX, limits: [-.5236 2.9671], ctrl_limits: [20 139 -1], mass: .388504,
  inertia: [.00122176 -2.52983e-6 -.000212212 .00118448 -1.72307e-6 .00069136], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.016 -.037 -.114, -.016 .037 -.114, .07 .037 -.114, .07 -.037 -.114,
    -.009 -.039 -.039, -.009 .039 -.039, .07 .039 -.039, .07 -.039 -.039,
    .044 -.036 .036, .044 .036 .036, .063 .036 .036, .063 -.036 .036
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_hip_roll_link.STL>
}
right_hip_roll_joint (right_hip_roll_joint_origin): {
  joint: hingeX, limits: [-2.9671 .5236], ctrl_limits: [20 139 -1], mass: .388501,
  inertia: [.00122175 2.52204e-6 -.000212212 .00118447 1.73174e-6 .000691349], shape: ssCvx, size: [.01],
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
  joint: hingeY, limits: [-.52 .52], ctrl_limits: [30 35 -1], mass: 4.46637, com: [.00435575 .00507317 .15113],
  inertia: [.0736175 -4.25291e-6 -.0008917 .0665665 .000409521 .0246276], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.047 -.075 0, -.047 .074 0, .057 .074 0, .057 -.075 0,
    -.053 -.088 .093, -.053 .09 .093, .069 .09 .093, .069 -.088 .093,
    -.057 -.098 .197, -.057 .098 .197, .074 .098 .197, .074 -.098 .197,
    -.052 -.089 .29, -.052 .09 .29, .053 .09 .29, .053 -.089 .29
  ]
}
left_hip_yaw_joint (left_hip_yaw_joint_origin): {
  joint: hingeZ, limits: [-2.7576 2.7576], ctrl_limits: [32 88 -1], mass: .681619,
  inertia: [.0044275 -.000108056 -.00166275 .00545319 -.000187376 .001876], shape: ssCvx, size: [.01],
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
  joint: hingeZ, limits: [-2.7576 2.7576], ctrl_limits: [32 88 -1], mass: .681613,
  inertia: [.00442747 .000108056 -.00166275 .00545319 .000187351 .00187597], shape: ssCvx, size: [.01],
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
  joint: hingeY, limits: [-3.0892 2.6704], ctrl_limits: [37 25 -1], mass: .126023,
  inertia: [.000160485 -1.66228e-7 3.91865e-7 .000151496 1.75614e-5 .000138798], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.021 .01 -.04, -.021 .062 -.04, .021 .062 -.04, .021 .01 -.04,
    -.021 .01 -.005, -.021 .064 -.005, .021 .064 -.005, .021 .01 -.005,
    -.021 .01 .03, -.021 .047 .03, .021 .047 .03, .021 .01 .03
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_shoulder_pitch_link.STL>
}
right_shoulder_pitch_joint (right_shoulder_pitch_joint_origin): {
  joint: hingeY, limits: [-3.0892 2.6704], ctrl_limits: [37 25 -1], mass: .126023,
  inertia: [.000160483 1.65124e-7 3.90512e-7 .000151492 -1.75623e-5 .000138793], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.021 -.062 -.04, -.021 -.01 -.04, .021 -.01 -.04, .021 -.062 -.04,
    -.021 -.064 -.005, -.021 -.01 -.005, .021 -.01 -.005, .021 -.064 -.005,
    -.021 -.047 .03, -.021 -.01 .03, .021 -.01 .03, .021 -.047 .03
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_shoulder_pitch_link.STL>
}
left_knee_joint (left_knee_joint_origin): {
  joint: hingeY, limits: [-.087267 2.8798], ctrl_limits: [20 139 -1], mass: .876712,
  inertia: [.00648182 3.3975e-5 -.000127209 .00672925 -.000358869 .00109586], shape: ssCvx, size: [.01],
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
  joint: hingeY, limits: [-.087267 2.8798], ctrl_limits: [20 139 -1], mass: .876714,
  inertia: [.00648176 -3.398e-5 -.000127209 .00672918 .000358822 .00109587], shape: ssCvx, size: [.01],
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
  joint: hingeX, limits: [-1.5882 2.2515], ctrl_limits: [37 25 -1], mass: .246281,
  inertia: [.000394956 2.09873e-8 -1.93073e-7 .000469736 1.57454e-5 .000272781], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.022 -.016 -.093, -.022 .029 -.093, .022 .029 -.093, .022 -.016 -.093,
    -.03 -.023 -.035, -.03 .03 -.035, .031 .03 -.035, .031 -.023 -.035,
    -.03 -.023 .023, -.03 .027 .023, .031 .027 .023, .031 -.023 .023
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_shoulder_roll_link.STL>
}
right_shoulder_roll_joint (right_shoulder_roll_joint_origin): {
  joint: hingeX, limits: [-2.2515 1.5882], ctrl_limits: [37 25 -1], mass: .246283,
  inertia: [.000394966 -1.6719e-8 -1.89014e-7 .000469741 -1.57405e-5 .000272773], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.022 -.029 -.093, -.022 .016 -.093, .022 .016 -.093, .022 -.029 -.093,
    -.03 -.03 -.035, -.03 .023 -.035, .031 .023 -.035, .031 -.03 -.035,
    -.03 -.027 .023, -.03 .023 .023, .031 .023 .023, .031 -.027 .023
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_shoulder_roll_link.STL>
}
left_ankle_pitch_joint (left_ankle_pitch_joint_origin): {
  joint: hingeY, limits: [-.87267 .5236], ctrl_limits: [30 35 -1], mass: .0197524,
  inertia: [2.78775e-6 0 -5.8987e-7 4.52084e-6 0 2.51425e-6],
  shape: ssCvx, size: [.003], color: [.7 .7 .7 1],
  core: [
    -.021 -.003 -.022, -.021 .004 -.022, .009 .004 -.022, .009 -.003 -.022,
    -.015 -.003 .01, -.015 .003 .01, .009 .003 .01, .009 -.003 .01
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_ankle_pitch_link.STL>
}
right_ankle_pitch_joint (right_ankle_pitch_joint_origin): {
  joint: hingeY, limits: [-.87267 .5236], ctrl_limits: [30 35 -1], mass: .0197524,
  inertia: [2.78777e-6 0 -5.89865e-7 4.52084e-6 0 2.51424e-6],
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
  joint: hingeZ, limits: [-2.618 2.618], ctrl_limits: [37 25 -1], mass: .330191,
  inertia: [.00075724 1.01914e-5 .000118153 .000781633 -6.07748e-5 .000303097], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.02 -.031 -.104, -.02 .012 -.104, .038 .012 -.104, .038 -.031 -.104,
    -.022 -.031 -.041, -.022 .022 -.041, .038 .022 -.041, .038 -.031 -.041,
    -.023 -.022 .022, -.023 .023 .022, .023 .023 .022, .023 -.022 .022
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_shoulder_yaw_link.STL>
}
right_shoulder_yaw_joint (right_shoulder_yaw_joint_origin): {
  joint: hingeZ, limits: [-2.618 2.618], ctrl_limits: [37 25 -1], mass: .330189,
  inertia: [.000757238 -1.01934e-5 .000118161 .000781632 6.07703e-5 .000303094], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.02 -.012 -.104, -.02 .031 -.104, .038 .031 -.104, .038 -.012 -.104,
    -.022 -.022 -.041, -.022 .031 -.041, .038 .031 -.041, .038 -.022 -.041,
    -.023 -.023 .022, -.023 .022 .022, .023 .022 .022, .023 -.023 .022
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/right_shoulder_yaw_link.STL>
}
left_ankle_roll_joint (left_ankle_roll_joint_origin): {
  joint: hingeX, limits: [-.2618 .2618], ctrl_limits: [30 35 -1], mass: .456098,
  inertia: [.000287801 6.50248e-8 8.30648e-5 .00151895 -1.18792e-7 .0016069], shape: ssCvx, size: [.01],
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
  joint: hingeX, limits: [-.2618 .2618], ctrl_limits: [30 35 -1], mass: .45609,
  inertia: [.0002878 -9.56202e-8 8.30614e-5 .00151893 1.13682e-7 .00160687], shape: ssCvx, size: [.01],
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
  joint: hingeY, limits: [-1.0472 2.0944], ctrl_limits: [37 25 -1], mass: .133212,
  inertia: [.000105606 4.41256e-5 1.51768e-5 .000221879 -4.66813e-6 .000221601], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.02 .028 -.022, -.02 .028 .02, -.02 .028 .02, -.02 .028 -.022,
    .035 -.021 -.035, .035 -.021 .02, .035 .025 .02, .035 .025 -.035,
    .09 -.021 -.035, .09 -.021 .014, .09 .025 .014, .09 .025 -.035
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_elbow_link.STL>
}
right_elbow_joint (right_elbow_joint_origin): {
  joint: hingeY, limits: [-1.0472 2.0944], ctrl_limits: [37 25 -1], mass: .133212,
  inertia: [.000105601 -4.41257e-5 1.5176e-5 .000221877 4.66758e-6 .000221596], shape: ssCvx, size: [.01],
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
  joint: hingeX, limits: [-1.97222 1.97222], ctrl_limits: [37 25 -1], mass: .0819051,
  inertia: [5.76855e-5 -6.70778e-7 0 4.18275e-5 0 6.33789e-5], shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
  core: [
    .01 -.02 -.016, .01 -.02 .016, .046 -.02 .016, .046 -.02 -.016,
    .005 0 -.02, .005 0 .02, .005 0 .02, .005 0 -.02,
    .01 .02 -.016, .01 .02 .016, .046 .02 .016, .046 .02 -.016
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_wrist_roll_link.STL>
}
right_wrist_roll_joint (right_wrist_roll_joint_origin): {
  joint: hingeX, limits: [-1.97222 1.97222], ctrl_limits: [37 25 -1], mass: .0819045,
  inertia: [5.76834e-5 6.70746e-7 0 4.18274e-5 0 6.33769e-5], shape: ssCvx, size: [.01], color: [.7 .7 .7 1],
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
  joint: hingeY, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1], mass: .102165,
  inertia: [6.54114e-5 -1.39886e-6 1.39875e-6 .000133698 1.78434e-8 .000133699], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.019 -.013 -.018, -.019 -.013 .018, -.019 .011 .018, -.019 .011 -.018,
    .023 -.018 -.018, .023 -.018 .018, .023 .018 .018, .023 .018 -.018,
    .065 -.018 -.013, .065 -.018 .011, .065 .018 .011, .065 .018 -.013
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_wrist_pitch_link.STL>
}
right_wrist_pitch_joint (right_wrist_pitch_joint_origin): {
  joint: hingeY, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1], mass: .102164,
  inertia: [6.54077e-5 1.39993e-6 1.3996e-6 .000133692 -1.67215e-8 .000133692], shape: ssCvx, size: [.01],
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
  joint: hingeZ, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1], mass: .235411,
  com: [.0788504 -.00205286 .0021586],
  inertia: [.000185982 6.57578e-5 -7.51085e-6 .000766002 3.21636e-6 .000670575], shape: ssCvx, size: [.01],
  color: [.7 .7 .7 1],
  core: [
    -.008 -.013 -.02, -.008 .016 -.02, .032 .016 -.02, .032 -.013 -.02,
    .035 -.014 0, .035 .02 0, .035 .02 0, .035 -.014 0,
    -.008 -.013 .02, -.008 .016 .02, .032 .016 .02, .032 -.013 .02
  ],
  visual_mesh: <package://example-robot-data/robots/g1_description/meshes/left_wrist_yaw_link.STL>
}
right_wrist_yaw_joint (right_wrist_yaw_joint_origin): {
  joint: hingeZ, limits: [-1.61443 1.61443], ctrl_limits: [22 5 -1], mass: .235418,
  com: [.0788478 .00205232 .00215915],
  inertia: [.00018599 -6.5759e-5 -7.50542e-6 .000766053 -3.21646e-6 .000670623], shape: ssCvx, size: [.01],
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
