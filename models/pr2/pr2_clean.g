# The PR2 with all its joints, at q = 0; fixed joints are left out, and shapes are frames of their own.
#
# Lengths, limits, masses and inertias are those that Willow Garage published with its robot description. Frames are
# listed by how many joints they are away from the base, which is the order of q.
# Shapes are rounded convex hulls of our own, for the eye only (contact 0): `core` lists the corners of cross
# sections from one end of a link to the other.
# A viewer shows `visual_mesh` instead when the Python package example-robot-data is installed.

base_footprint: { mass: 1, inertia: [.01 .01 .01] }
base_footprint_0 (base_footprint): { shape: box, size: [.01 .01 .01] }
base_link (base_footprint): {
  Q: [0 0 .051], mass: 116, inertia: [5.65223 -.00971993 1.29399 5.66947 -.00737958 3.6832]
}
base_link_0 (base_footprint): {
  Q: [0 0 .051], shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.326 -.323 .01, -.326 -.323 .646, -.326 .323 .646, -.326 .323 .01,
    -.113 -.323 .01, -.113 -.323 .258, -.113 .323 .258, -.113 .323 .01,
    .111 -.323 .01, .111 -.323 .282, .111 .323 .282, .111 .323 .01,
    .324 -.323 .01, .324 -.323 .284, .324 .323 .284, .324 .323 .01
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/base.stl>
}
base_laser_link (base_footprint): { Q: [.275 0 .303], mass: .001, inertia: [.0001 1e-6 .0001] }
base_laser_link_0 (base_footprint): { Q: [.275 0 .303], shape: box, size: [.001 .001 .001] }
fl_caster_rotation_joint_origin (base_footprint): { Q: [.2246 .2246 .0792] }
fr_caster_rotation_joint_origin (base_footprint): { Q: [.2246 -.2246 .0792] }
bl_caster_rotation_joint_origin (base_footprint): { Q: [-.2246 .2246 .0792] }
br_caster_rotation_joint_origin (base_footprint): { Q: [-.2246 -.2246 .0792] }
torso_lift_joint_origin (base_footprint): { Q: [-.05 0 .790675] }
fl_caster_rotation_joint (fl_caster_rotation_joint_origin): {
  joint: hingeZ, limits: [0 0], ctrl_limits: [100 100 -1]
}
fr_caster_rotation_joint (fr_caster_rotation_joint_origin): {
  joint: hingeZ, limits: [0 0], ctrl_limits: [100 100 -1]
}
bl_caster_rotation_joint (bl_caster_rotation_joint_origin): {
  joint: hingeZ, limits: [0 0], ctrl_limits: [100 100 -1]
}
br_caster_rotation_joint (br_caster_rotation_joint_origin): {
  joint: hingeZ, limits: [0 0], ctrl_limits: [100 100 -1]
}
torso_lift_joint (torso_lift_joint_origin): { joint: transZ, limits: [0 .31], ctrl_limits: [.013 10000 -1] }
fl_caster_rotation_link (fl_caster_rotation_joint): {
  mass: 3.47308, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
fl_caster_rotation_link_0 (fl_caster_rotation_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.081 -.077 -.022, -.081 .077 -.022, .064 .077 -.022, .064 -.077 -.022,
    -.081 -.076 .068, -.081 .077 .068, .064 .077 .068, .064 -.076 .068,
    -.083 -.076 .158, -.083 .076 .158, .084 .076 .158, .084 -.076 .158
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/caster.stl>
}
fl_caster_l_wheel_joint_origin (fl_caster_rotation_joint): { Q: [0 .049 0] }
fl_caster_r_wheel_joint_origin (fl_caster_rotation_joint): { Q: [0 -.049 0] }
fr_caster_rotation_link (fr_caster_rotation_joint): {
  mass: 3.47308, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
fr_caster_rotation_link_0 (fr_caster_rotation_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.081 -.077 -.022, -.081 .077 -.022, .064 .077 -.022, .064 -.077 -.022,
    -.081 -.076 .068, -.081 .077 .068, .064 .077 .068, .064 -.076 .068,
    -.083 -.076 .158, -.083 .076 .158, .084 .076 .158, .084 -.076 .158
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/caster.stl>
}
fr_caster_l_wheel_joint_origin (fr_caster_rotation_joint): { Q: [0 .049 0] }
fr_caster_r_wheel_joint_origin (fr_caster_rotation_joint): { Q: [0 -.049 0] }
bl_caster_rotation_link (bl_caster_rotation_joint): {
  mass: 3.47308, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
bl_caster_rotation_link_0 (bl_caster_rotation_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.081 -.077 -.022, -.081 .077 -.022, .064 .077 -.022, .064 -.077 -.022,
    -.081 -.076 .068, -.081 .077 .068, .064 .077 .068, .064 -.076 .068,
    -.083 -.076 .158, -.083 .076 .158, .084 .076 .158, .084 -.076 .158
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/caster.stl>
}
bl_caster_l_wheel_joint_origin (bl_caster_rotation_joint): { Q: [0 .049 0] }
bl_caster_r_wheel_joint_origin (bl_caster_rotation_joint): { Q: [0 -.049 0] }
br_caster_rotation_link (br_caster_rotation_joint): {
  mass: 3.47308, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
br_caster_rotation_link_0 (br_caster_rotation_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.081 -.077 -.022, -.081 .077 -.022, .064 .077 -.022, .064 -.077 -.022,
    -.081 -.076 .068, -.081 .077 .068, .064 .077 .068, .064 -.076 .068,
    -.083 -.076 .158, -.083 .076 .158, .084 .076 .158, .084 -.076 .158
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/caster.stl>
}
br_caster_l_wheel_joint_origin (br_caster_rotation_joint): { Q: [0 .049 0] }
br_caster_r_wheel_joint_origin (br_caster_rotation_joint): { Q: [0 -.049 0] }
torso_lift_link (torso_lift_joint): { mass: 36.248, inertia: [2.77165 .00428452 -.160419 2.51002 .0296645 .526432] }
torso_lift_link_0 (torso_lift_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.202 -.161 -.496, -.202 .16 -.496, -.035 .16 -.496, -.035 -.161 -.496,
    -.202 -.161 -.232, -.202 .16 -.232, -.035 .16 -.232, -.035 -.161 -.232,
    -.283 -.254 .042, -.283 .254 .042, .104 .254 .042, .104 -.254 .042,
    -.275 -.196 .306, -.275 .196 .306, .102 .196 .306, .102 -.196 .306
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/torso_v0/torso_lift.stl>
}
imu_link (torso_lift_joint): { Q: "t(-.02977 -.1497 .164) d(180 0 1 0)", mass: .001, inertia: [.0001 1e-6 .0001] }
imu_link_0 (torso_lift_joint): { Q: "t(-.02977 -.1497 .164) d(180 0 1 0)", shape: box, size: [.001 .001 .001] }
head_pan_joint_origin (torso_lift_joint): { Q: [-.01707 0 .38145] }
laser_tilt_mount_joint_origin (torso_lift_joint): { Q: [.09893 0 .227] }
r_shoulder_pan_joint_origin (torso_lift_joint): { Q: [0 -.188 0] }
l_shoulder_pan_joint_origin (torso_lift_joint): { Q: [0 .188 0] }
fl_caster_l_wheel_joint (fl_caster_l_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
fl_caster_r_wheel_joint (fl_caster_r_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
fr_caster_l_wheel_joint (fr_caster_l_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
fr_caster_r_wheel_joint (fr_caster_r_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
bl_caster_l_wheel_joint (bl_caster_l_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
bl_caster_r_wheel_joint (bl_caster_r_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
br_caster_l_wheel_joint (br_caster_l_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
br_caster_r_wheel_joint (br_caster_r_wheel_joint_origin): { joint: hingeY, limits: [0 0], ctrl_limits: [100 100 -1] }
head_pan_joint (head_pan_joint_origin): { joint: hingeZ, limits: [-3.007 3.007], ctrl_limits: [6 2.645 -1] }
laser_tilt_mount_joint (laser_tilt_mount_joint_origin): {
  joint: hingeY, limits: [-.7854 1.48353], ctrl_limits: [10 .65 -1]
}
r_shoulder_pan_joint (r_shoulder_pan_joint_origin): {
  joint: hingeZ, limits: [-2.2854 .714602], ctrl_limits: [2.088 30 -1]
}
l_shoulder_pan_joint (l_shoulder_pan_joint_origin): {
  joint: hingeZ, limits: [-.714602 2.2854], ctrl_limits: [2.088 30 -1]
}
fl_caster_l_wheel_link (fl_caster_l_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
fl_caster_l_wheel_link_0 (fl_caster_l_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
fl_caster_r_wheel_link (fl_caster_r_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
fl_caster_r_wheel_link_0 (fl_caster_r_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
fr_caster_l_wheel_link (fr_caster_l_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
fr_caster_l_wheel_link_0 (fr_caster_l_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
fr_caster_r_wheel_link (fr_caster_r_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
fr_caster_r_wheel_link_0 (fr_caster_r_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
bl_caster_l_wheel_link (bl_caster_l_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
bl_caster_l_wheel_link_0 (bl_caster_l_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
bl_caster_r_wheel_link (bl_caster_r_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
bl_caster_r_wheel_link_0 (bl_caster_r_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
br_caster_l_wheel_link (br_caster_l_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
br_caster_l_wheel_link_0 (br_caster_l_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
br_caster_r_wheel_link (br_caster_r_wheel_joint): {
  mass: .44036, inertia: [.0124118 -.000711734 .00050273 .0152182 -4.27347e-6 .011764]
}
br_caster_r_wheel_link_0 (br_caster_r_wheel_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.058 -.009 -.069, -.058 .009 -.069, .058 .009 -.069, .058 -.009 -.069,
    -.069 -.022 0, -.069 .01 0, .069 .01 0, .069 -.022 0,
    -.058 -.009 .069, -.058 .009 .069, .058 .009 .069, .058 -.009 .069
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/base_v0/wheel.stl>
}
head_pan_link (head_pan_joint): {
  mass: 1.61112, inertia: [.00482611 -.000144684 .000110076 .00521899 -.00031424 .00861878]
}
head_pan_link_0 (head_pan_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.073 -.151 -.055, -.073 -.151 .065, .133 -.151 .065, .133 -.151 -.055,
    -.101 -.054 -.055, -.101 -.054 .068, .132 -.054 .068, .132 -.054 -.055,
    -.1 .054 -.055, -.1 .054 .068, .132 .054 .068, .132 .054 -.055,
    -.073 .151 -.055, -.073 .151 .065, .133 .151 .065, .133 .151 -.055
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/head_v0/head_pan.stl>
}
head_tilt_joint_origin (head_pan_joint): { Q: [.068 0 0] }
laser_tilt_mount_link (laser_tilt_mount_joint): { mass: .05, inertia: [.0001 1e-5 .0001] }
laser_tilt_mount_link_0 (laser_tilt_mount_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.051 -.072 -.046, -.051 -.072 .054, .046 -.072 .054, .046 -.072 -.046,
    -.051 0 -.046, -.051 0 .054, .046 0 .054, .046 0 -.046,
    -.051 .072 -.046, -.051 .072 .054, .046 .072 .054, .046 .072 -.046
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/tilting_laser_v0/tilting_hokuyo.stl>
}
laser_tilt_link (laser_tilt_mount_joint): { Q: [0 0 .03], mass: .001, inertia: [.0001 1e-6 .0001] }
laser_tilt_link_0 (laser_tilt_mount_joint): { Q: [0 0 .03], shape: box, size: [.001 .001 .001] }
r_shoulder_pan_link (r_shoulder_pan_joint): {
  mass: 25.7993, inertia: [.866179 -.0608651 -.121181 .874217 -.0588661 .273538]
}
r_shoulder_pan_link_0 (r_shoulder_pan_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.117 -.117 -.481, -.117 .117 -.481, .06 .117 -.481, .06 -.117 -.481,
    -.117 -.117 -.28, -.117 .117 -.28, .055 .117 -.28, .055 -.117 -.28,
    -.117 -.117 -.069, -.117 .117 -.069, .217 .117 -.069, .217 -.117 -.069,
    -.117 -.117 .132, -.117 .117 .132, .211 .117 .132, .211 -.117 .132
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/shoulder_v0/shoulder_pan.stl>
}
r_shoulder_lift_joint_origin (r_shoulder_pan_joint): { Q: [.1 0 0] }
l_shoulder_pan_link (l_shoulder_pan_joint): {
  mass: 25.7993, inertia: [.866179 -.0608651 -.121181 .874217 -.0588661 .273538]
}
l_shoulder_pan_link_0 (l_shoulder_pan_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.117 -.117 -.481, -.117 .117 -.481, .06 .117 -.481, .06 -.117 -.481,
    -.117 -.117 -.28, -.117 .117 -.28, .055 .117 -.28, .055 -.117 -.28,
    -.117 -.117 -.069, -.117 .117 -.069, .217 .117 -.069, .217 -.117 -.069,
    -.117 -.117 .132, -.117 .117 .132, .211 .117 .132, .211 -.117 .132
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/shoulder_v0/shoulder_pan.stl>
}
l_shoulder_lift_joint_origin (l_shoulder_pan_joint): { Q: [.1 0 0] }
head_tilt_joint (head_tilt_joint_origin): { joint: hingeY, limits: [-.471238 1.39626], ctrl_limits: [5 15 -1] }
r_shoulder_lift_joint (r_shoulder_lift_joint_origin): {
  joint: hingeY, limits: [-.5236 1.3963], ctrl_limits: [2.082 30 -1]
}
l_shoulder_lift_joint (l_shoulder_lift_joint_origin): {
  joint: hingeY, limits: [-.5236 1.3963], ctrl_limits: [2.082 30 -1]
}
head_tilt_link (head_tilt_joint): {
  mass: 1.74973, inertia: [.0106023 -.000408814 .00198304 .0118744 .000197909 .00551679]
}
head_tilt_link_0 (head_tilt_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.171 -.138 .076, -.171 -.138 .145, .063 -.138 .145, .063 -.138 .076,
    -.174 -.049 -.052, -.174 -.049 .145, .067 -.049 .145, .067 -.049 -.052,
    -.174 .049 -.052, -.174 .049 .145, .067 .049 .145, .067 .049 -.052,
    -.171 .138 .076, -.171 .138 .145, .063 .138 .145, .063 .138 .076
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/head_v0/head_tilt.stl>
}
head_plate_frame (head_tilt_joint): { Q: [.0232 0 .0645], mass: .01, inertia: [.001 .001 .001] }
head_plate_frame_0 (head_tilt_joint): { Q: [.0232 0 .0645], shape: box, size: [.01 .01 .01] }
sensor_mount_link (head_tilt_joint): { Q: [.0232 0 .0645], mass: .05, inertia: [.001 .001 .001] }
sensor_mount_link_0 (head_tilt_joint): { Q: [.0232 0 .0645], shape: box, size: [.01 .01 .01] }
high_def_frame (head_tilt_joint): { Q: [.0232 -.109 .0995], mass: .01, inertia: [.001 .001 .001] }
high_def_frame_0 (head_tilt_joint): { Q: [.0032 -.109 .0995], shape: box, size: [.04 .04 .04] }
high_def_optical_frame (head_tilt_joint): {
  Q: "t(.0232 -.109 .0995) d(120 -1 1 -1)", mass: .01, inertia: [.001 .001 .001]
}
high_def_optical_frame_0 (head_tilt_joint): {
  Q: "t(.0232 -.109 .0995) d(90 0 1 0)", shape: cylinder, size: [.05 .02]
}
double_stereo_link (head_tilt_joint): { Q: [.0232 0 .0675], mass: .1, inertia: [.001 .001 .001] }
double_stereo_link_0 (head_tilt_joint): { Q: [.0132 0 .0925], shape: box, size: [.02 .12 .05] }
wide_stereo_link (head_tilt_joint): { Q: [.0232 .03 .098], mass: .1, inertia: [.01 .01 .01] }
wide_stereo_link_0 (head_tilt_joint): { Q: [.0232 .03 .098], shape: box, size: [.001 .001 .001] }
wide_stereo_gazebo_l_stereo_camera_frame (head_tilt_joint): {
  Q: [.0232 .03 .098], mass: .01, inertia: [.001 .001 .001]
}
wide_stereo_gazebo_l_stereo_camera_frame_0 (head_tilt_joint): { Q: [.0232 .03 .098], shape: box, size: [.01 .01 .01] }
wide_stereo_gazebo_r_stereo_camera_frame (head_tilt_joint): {
  Q: [.0232 -.06 .098], mass: .01, inertia: [.001 .001 .001]
}
wide_stereo_gazebo_r_stereo_camera_frame_0 (head_tilt_joint): {
  Q: [.0232 -.06 .098], shape: box, size: [.01 .01 .01]
}
narrow_stereo_link (head_tilt_joint): { Q: [.0232 .06 .098], mass: .1, inertia: [.01 .01 .01] }
narrow_stereo_link_0 (head_tilt_joint): { Q: [.0232 .06 .098], shape: box, size: [.001 .001 .001] }
narrow_stereo_gazebo_l_stereo_camera_frame (head_tilt_joint): {
  Q: [.0232 .06 .098], mass: .01, inertia: [.001 .001 .001]
}
narrow_stereo_gazebo_l_stereo_camera_frame_0 (head_tilt_joint): {
  Q: [.0232 .06 .098], shape: box, size: [.01 .01 .01]
}
narrow_stereo_gazebo_r_stereo_camera_frame (head_tilt_joint): {
  Q: [.0232 -.03 .098], mass: .01, inertia: [.001 .001 .001]
}
narrow_stereo_gazebo_r_stereo_camera_frame_0 (head_tilt_joint): {
  Q: [.0232 -.03 .098], shape: box, size: [.01 .01 .01]
}
r_shoulder_lift_link (r_shoulder_lift_joint): {
  mass: 2.74988, inertia: [.0210558 .00496704 -.00194809 .0212722 .00110425 .0197575]
}
r_shoulder_lift_link_0 (r_shoulder_lift_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.085 -.065 -.117, -.085 .065 -.117, .085 .065 -.117, .085 -.065 -.117,
    -.117 -.065 -.042, -.117 .065 -.042, .111 .065 -.042, .111 -.065 -.042,
    -.117 -.065 .042, -.117 .065 .042, .111 .065 .042, .111 -.065 .042,
    -.085 -.065 .117, -.085 .065 .117, .111 .065 .117, .111 -.065 .117
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/shoulder_v0/shoulder_lift.stl>
}
l_shoulder_lift_link (l_shoulder_lift_joint): {
  mass: 2.74988, inertia: [.0210558 .00496704 -.00194809 .0212722 .00110425 .0197575]
}
l_shoulder_lift_link_0 (l_shoulder_lift_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.085 -.065 -.117, -.085 .065 -.117, .085 .065 -.117, .085 -.065 -.117,
    -.117 -.065 -.042, -.117 .065 -.042, .111 .065 -.042, .111 -.065 -.042,
    -.117 -.065 .042, -.117 .065 .042, .111 .065 .042, .111 -.065 .042,
    -.085 -.065 .117, -.085 .065 .117, .111 .065 .117, .111 -.065 .117
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/shoulder_v0/shoulder_lift.stl>
}
r_upper_arm_roll_joint (r_shoulder_lift_link): { joint: hingeX, limits: [-3.9 .8], ctrl_limits: [3.27 30 -1] }
l_upper_arm_roll_joint (l_shoulder_lift_link): { joint: hingeX, limits: [-.8 3.9], ctrl_limits: [3.27 30 -1] }
r_upper_arm_roll_link (r_upper_arm_roll_joint): { mass: .1, inertia: [.01 .01 .01] }
r_upper_arm_roll_link_0 (r_upper_arm_roll_joint): {
  shape: ssCvx, size: [.005], color: [.93 .94 .95],
  core: [
    .122 -.052 -.067, .122 .057 -.067, .135 .057 -.067, .135 -.052 -.067,
    .119 -.061 0, .119 .067 0, .119 .067 0, .119 -.061 0,
    .122 -.057 .067, .122 .057 .067, .135 .057 .067, .135 -.057 .067
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/shoulder_v0/upper_arm_roll.stl>
}
r_upper_arm_link (r_upper_arm_roll_joint): {
  mass: 6.01769, inertia: [.0153775 .00375711 -.000708529 .0747367 -.000179365 .0760876]
}
r_upper_arm_link_0 (r_upper_arm_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.042 -.002 -.013, -.042 -.002 -.005, -.042 -.002 -.005, -.042 -.002 -.013,
    .126 -.066 -.074, .126 -.066 .067, .126 .066 .067, .126 .066 -.074,
    .305 -.059 -.077, .305 -.059 .072, .305 .059 .072, .305 .059 -.077,
    .473 -.059 -.075, .473 -.059 .073, .473 .059 .073, .473 .059 -.075
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/upper_arm_v0/upper_arm.stl>
}
r_elbow_flex_joint_origin (r_upper_arm_roll_joint): { Q: [.4 0 0] }
l_upper_arm_roll_link (l_upper_arm_roll_joint): { mass: .1, inertia: [.01 .01 .01] }
l_upper_arm_roll_link_0 (l_upper_arm_roll_joint): {
  shape: ssCvx, size: [.005], color: [.93 .94 .95],
  core: [
    .122 -.052 -.067, .122 .057 -.067, .135 .057 -.067, .135 -.052 -.067,
    .119 -.061 0, .119 .067 0, .119 .067 0, .119 -.061 0,
    .122 -.057 .067, .122 .057 .067, .135 .057 .067, .135 -.057 .067
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/shoulder_v0/upper_arm_roll.stl>
}
l_upper_arm_link (l_upper_arm_roll_joint): {
  mass: 6.01769, inertia: [.015306 -.00339325 .000607655 .0747369 -.000199537 .0760159]
}
l_upper_arm_link_0 (l_upper_arm_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.042 -.002 -.013, -.042 -.002 -.005, -.042 -.002 -.005, -.042 -.002 -.013,
    .126 -.066 -.074, .126 -.066 .067, .126 .066 .067, .126 .066 -.074,
    .305 -.059 -.077, .305 -.059 .072, .305 .059 .072, .305 .059 -.077,
    .473 -.059 -.075, .473 -.059 .073, .473 .059 .073, .473 .059 -.075
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/upper_arm_v0/upper_arm.stl>
}
l_elbow_flex_joint_origin (l_upper_arm_roll_joint): { Q: [.4 0 0] }
r_elbow_flex_joint (r_elbow_flex_joint_origin): { joint: hingeY, limits: [-2.3213 0], ctrl_limits: [3.3 30 -1] }
l_elbow_flex_joint (l_elbow_flex_joint_origin): { joint: hingeY, limits: [-2.3213 0], ctrl_limits: [3.3 30 -1] }
r_elbow_flex_link (r_elbow_flex_joint): {
  mass: 1.90327, inertia: [.00346542 4.06683e-5 .000431716 .00441606 -3.96891e-5 .00359157]
}
r_elbow_flex_link_0 (r_elbow_flex_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.07 -.009 -.061, -.07 -.009 .061, -.07 .008 .061, -.07 .008 -.061,
    .006 -.009 -.07, .006 -.009 .07, .006 .008 .07, .006 .008 -.07,
    .083 -.036 -.063, .083 -.036 .053, .083 .036 .053, .083 .036 -.063
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/upper_arm_v0/elbow_flex.stl>
}
l_elbow_flex_link (l_elbow_flex_joint): {
  mass: 1.90327, inertia: [.00346542 4.06683e-5 .000431716 .00441606 -3.96891e-5 .00359157]
}
l_elbow_flex_link_0 (l_elbow_flex_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.07 -.009 -.061, -.07 -.009 .061, -.07 .008 .061, -.07 .008 -.061,
    .006 -.009 -.07, .006 -.009 .07, .006 .008 .07, .006 .008 -.07,
    .083 -.036 -.063, .083 -.036 .053, .083 .036 .053, .083 .036 -.063
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/upper_arm_v0/elbow_flex.stl>
}
r_forearm_roll_joint (r_elbow_flex_link): { joint: hingeX, limits: [0 0], ctrl_limits: [3.6 30 -1] }
l_forearm_roll_joint (l_elbow_flex_link): { joint: hingeX, limits: [0 0], ctrl_limits: [3.6 30 -1] }
r_forearm_roll_link (r_forearm_roll_joint): { mass: .1, inertia: [.01 .01 .01] }
r_forearm_roll_link_0 (r_forearm_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.014 0 0, -.014 0 0, -.014 0 0, -.014 0 0,
    .041 0 0, .041 0 0, .041 0 0, .041 0 0,
    .097 -.032 -.031, .097 -.032 .033, .097 .031 .033, .097 .031 -.031
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/upper_arm_v0/forearm_roll.stl>
}
r_forearm_link (r_forearm_roll_joint): {
  mass: 2.57968, inertia: [.00364857 5.21588e-5 .000715348 .0150774 -1.31077e-5 .0165931]
}
r_forearm_link_0 (r_forearm_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .104 -.05 -.044, .104 -.05 .057, .104 .05 .057, .104 .05 -.044,
    .182 -.05 -.04, .182 -.05 .054, .182 .05 .054, .182 .05 -.04,
    .27 -.05 -.039, .27 -.05 .026, .27 .05 .026, .27 .05 -.039,
    .348 -.05 -.031, .348 -.05 .026, .348 .05 .026, .348 .05 -.031
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/forearm_v0/forearm.stl>
}
r_forearm_cam_frame (r_forearm_roll_joint): {
  Q: [.135 0 .044 .679287972 .679287972 -.19638699 .19638699], mass: .01, inertia: [.001 .001 .001]
}
r_forearm_cam_frame_0 (r_forearm_roll_joint): {
  Q: [.135 0 .044 .679287972 .679287972 -.19638699 .19638699], shape: box, size: [.01 .01 .01]
}
r_wrist_flex_joint_origin (r_forearm_roll_joint): { Q: [.321 0 0] }
l_forearm_roll_link (l_forearm_roll_joint): { mass: .1, inertia: [.01 .01 .01] }
l_forearm_roll_link_0 (l_forearm_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.014 0 0, -.014 0 0, -.014 0 0, -.014 0 0,
    .041 0 0, .041 0 0, .041 0 0, .041 0 0,
    .097 -.032 -.031, .097 -.032 .033, .097 .031 .033, .097 .031 -.031
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/upper_arm_v0/forearm_roll.stl>
}
l_forearm_link (l_forearm_roll_joint): {
  mass: 2.57968, inertia: [.00364857 5.21588e-5 .000715348 .0150774 -1.31077e-5 .0165931]
}
l_forearm_link_0 (l_forearm_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .104 -.05 -.044, .104 -.05 .057, .104 .05 .057, .104 .05 -.044,
    .182 -.05 -.04, .182 -.05 .054, .182 .05 .054, .182 .05 -.04,
    .27 -.05 -.039, .27 -.05 .026, .27 .05 .026, .27 .05 -.039,
    .348 -.05 -.031, .348 -.05 .026, .348 .05 .026, .348 .05 -.031
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/forearm_v0/forearm.stl>
}
l_forearm_cam_frame (l_forearm_roll_joint): {
  Q: [.135 0 .044 .679287972 -.679287972 -.19638699 -.19638699], mass: .01, inertia: [.001 .001 .001]
}
l_forearm_cam_frame_0 (l_forearm_roll_joint): {
  Q: [.135 0 .044 .679287972 -.679287972 -.19638699 -.19638699], shape: box, size: [.01 .01 .01]
}
l_wrist_flex_joint_origin (l_forearm_roll_joint): { Q: [.321 0 0] }
r_wrist_flex_joint (r_wrist_flex_joint_origin): { joint: hingeY, limits: [-2.094 0], ctrl_limits: [3.078 10 -1] }
l_wrist_flex_joint (l_wrist_flex_joint_origin): { joint: hingeY, limits: [-2.094 0], ctrl_limits: [3.078 10 -1] }
r_wrist_flex_link (r_wrist_flex_joint): {
  mass: .61402, inertia: [.000651657 2.8864e-7 3.03477e-6 .000198244 -2.2645e-7 .000644505]
}
r_wrist_flex_link_0 (r_wrist_flex_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.021 -.011 -.031, -.021 .011 -.031, .018 .011 -.031, .018 -.011 -.031,
    -.027 -.012 -.002, -.027 .012 -.002, .018 .012 -.002, .018 -.012 -.002,
    -.023 -.011 .027, -.023 .011 .027, .018 .011 .027, .018 -.011 .027
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/forearm_v0/wrist_flex.stl>
}
l_wrist_flex_link (l_wrist_flex_joint): {
  mass: .61402, inertia: [.000651657 2.8864e-7 3.03477e-6 .000198244 -2.2645e-7 .000644505]
}
l_wrist_flex_link_0 (l_wrist_flex_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    -.021 -.011 -.031, -.021 .011 -.031, .018 .011 -.031, .018 -.011 -.031,
    -.027 -.012 -.002, -.027 .012 -.002, .018 .012 -.002, .018 -.012 -.002,
    -.023 -.011 .027, -.023 .011 .027, .018 .011 .027, .018 -.011 .027
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/forearm_v0/wrist_flex.stl>
}
r_wrist_roll_joint (r_wrist_flex_link): { joint: hingeX, limits: [0 0], ctrl_limits: [3.6 10 -1] }
l_wrist_roll_joint (l_wrist_flex_link): { joint: hingeX, limits: [0 0], ctrl_limits: [3.6 10 -1] }
r_wrist_roll_link (r_wrist_roll_joint): { mass: .1, inertia: [.01 .01 .01] }
r_wrist_roll_link_0 (r_wrist_roll_joint): {
  shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    .029 -.015 -.015, .029 -.015 .015, .038 -.015 .015, .038 -.015 -.015,
    .029 .015 -.015, .029 .015 .015, .038 .015 .015, .038 .015 -.015
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/forearm_v0/wrist_roll.stl>
}
r_gripper_palm_link (r_wrist_roll_joint): {
  mass: .58007, inertia: [.000352239 -1.58048e-5 -9.175e-7 .000677413 -5.9554e-7 .000865633]
}
r_gripper_palm_link_0 (r_wrist_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .053 -.041 -.014, .053 -.041 .014, .112 -.041 .014, .112 -.041 -.014,
    .039 0 -.014, .039 0 .014, .116 0 .014, .116 0 -.014,
    .052 .041 -.014, .052 .041 .014, .112 .041 .014, .112 .041 -.014
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/gripper_palm.stl>
}
r_gripper_motor_accelerometer_link (r_wrist_roll_joint): { mass: .001, inertia: [.001 .001 .001] }
r_gripper_motor_accelerometer_link_0 (r_wrist_roll_joint): { shape: box, size: [.001 .001 .001] }
r_gripper_l_finger_joint_origin (r_wrist_roll_joint): { Q: [.07691 .01 0] }
r_gripper_r_finger_joint_origin (r_wrist_roll_joint): { Q: [.07691 -.01 0] }
r_gripper_l_parallel_root_joint_origin (r_wrist_roll_joint): { Q: [.05891 .031 0] }
r_gripper_r_parallel_root_joint_origin (r_wrist_roll_joint): { Q: [.05891 -.031 0] }
l_wrist_roll_link (l_wrist_roll_joint): { mass: .1, inertia: [.01 .01 .01] }
l_wrist_roll_link_0 (l_wrist_roll_joint): {
  shape: ssCvx, size: [.004], color: [.93 .94 .95],
  core: [
    .029 -.015 -.015, .029 -.015 .015, .038 -.015 .015, .038 -.015 -.015,
    .029 .015 -.015, .029 .015 .015, .038 .015 .015, .038 .015 -.015
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/forearm_v0/wrist_roll.stl>
}
l_gripper_palm_link (l_wrist_roll_joint): {
  mass: .58007, inertia: [.000352239 -1.58048e-5 -9.175e-7 .000677413 -5.9554e-7 .000865633]
}
l_gripper_palm_link_0 (l_wrist_roll_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .053 -.041 -.014, .053 -.041 .014, .112 -.041 .014, .112 -.041 -.014,
    .039 0 -.014, .039 0 .014, .116 0 .014, .116 0 -.014,
    .052 .041 -.014, .052 .041 .014, .112 .041 .014, .112 .041 -.014
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/gripper_palm.stl>
}
l_gripper_motor_accelerometer_link (l_wrist_roll_joint): { mass: .001, inertia: [.001 .001 .001] }
l_gripper_motor_accelerometer_link_0 (l_wrist_roll_joint): { shape: box, size: [.001 .001 .001] }
l_gripper_l_finger_joint_origin (l_wrist_roll_joint): { Q: [.07691 .01 0] }
l_gripper_r_finger_joint_origin (l_wrist_roll_joint): { Q: [.07691 -.01 0] }
l_gripper_l_parallel_root_joint_origin (l_wrist_roll_joint): { Q: [.05891 .031 0] }
l_gripper_r_parallel_root_joint_origin (l_wrist_roll_joint): { Q: [.05891 -.031 0] }
r_gripper_l_finger_joint (r_gripper_l_finger_joint_origin): {
  joint: hingeZ, limits: [0 .548], ctrl_limits: [.5 1000 -1]
}
r_gripper_r_finger_joint (r_gripper_r_finger_joint_origin): {
  joint: hingeZ, joint_scale: -1, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: r_gripper_l_finger_joint
}
r_gripper_l_parallel_root_joint (r_gripper_l_parallel_root_joint_origin): {
  joint: hingeZ, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: r_gripper_l_finger_joint
}
r_gripper_r_parallel_root_joint (r_gripper_r_parallel_root_joint_origin): {
  joint: hingeZ, joint_scale: -1, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: r_gripper_l_finger_joint
}
l_gripper_l_finger_joint (l_gripper_l_finger_joint_origin): {
  joint: hingeZ, limits: [0 .548], ctrl_limits: [.5 1000 -1]
}
l_gripper_r_finger_joint (l_gripper_r_finger_joint_origin): {
  joint: hingeZ, joint_scale: -1, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: l_gripper_l_finger_joint
}
l_gripper_l_parallel_root_joint (l_gripper_l_parallel_root_joint_origin): {
  joint: hingeZ, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: l_gripper_l_finger_joint
}
l_gripper_r_parallel_root_joint (l_gripper_r_parallel_root_joint_origin): {
  joint: hingeZ, joint_scale: -1, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: l_gripper_l_finger_joint
}
r_gripper_l_finger_link (r_gripper_l_finger_joint): {
  mass: .17126, inertia: [7.7562e-5 1.49095e-6 -9.83385e-6 .000197083 -3.06125e-6 .000181054]
}
r_gripper_l_finger_link_0 (r_gripper_l_finger_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .001 .001 -.018, .001 .001 .018, .001 .036 .018, .001 .036 -.018,
    .043 .005 -.018, .043 .005 .018, .043 .035 .018, .043 .035 -.018,
    .085 .006 -.004, .085 .006 .004, .085 .026 .004, .085 .026 -.004
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger.stl>
}
r_gripper_l_finger_tip_joint_origin (r_gripper_l_finger_joint): { Q: [.09137 .00495 0] }
r_gripper_r_finger_link (r_gripper_r_finger_joint): {
  mass: .17389, inertia: [7.73841e-5 -2.09309e-6 -8.36228e-6 .000198474 2.4611e-6 .00018107]
}
r_gripper_r_finger_link_0 (r_gripper_r_finger_joint): {
  Q: "d(180 1 0 0)", shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .001 .001 -.018, .001 .001 .018, .001 .036 .018, .001 .036 -.018,
    .043 .005 -.018, .043 .005 .018, .043 .035 .018, .043 .035 -.018,
    .085 .006 -.004, .085 .006 .004, .085 .026 .004, .085 .026 -.004
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger.stl>
}
r_gripper_r_finger_tip_joint_origin (r_gripper_r_finger_joint): { Q: [.09137 -.00495 0] }
r_gripper_l_parallel_link (r_gripper_l_parallel_root_joint): {
  mass: .17126, inertia: [7.7562e-5 1.49095e-6 -9.83385e-6 .000197083 -3.06125e-6 .000181054]
}
r_gripper_r_parallel_link (r_gripper_r_parallel_root_joint): {
  mass: .17389, inertia: [7.73841e-5 -2.09309e-6 -8.36228e-6 .000198474 2.4611e-6 .00018107]
}
l_gripper_l_finger_link (l_gripper_l_finger_joint): {
  mass: .17126, inertia: [7.7562e-5 1.49095e-6 -9.83385e-6 .000197083 -3.06125e-6 .000181054]
}
l_gripper_l_finger_link_0 (l_gripper_l_finger_joint): {
  shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .001 .001 -.018, .001 .001 .018, .001 .036 .018, .001 .036 -.018,
    .043 .005 -.018, .043 .005 .018, .043 .035 .018, .043 .035 -.018,
    .085 .006 -.004, .085 .006 .004, .085 .026 .004, .085 .026 -.004
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger.stl>
}
l_gripper_l_finger_tip_joint_origin (l_gripper_l_finger_joint): { Q: [.09137 .00495 0] }
l_gripper_r_finger_link (l_gripper_r_finger_joint): {
  mass: .17389, inertia: [7.73841e-5 -2.09309e-6 -8.36228e-6 .000198474 2.4611e-6 .00018107]
}
l_gripper_r_finger_link_0 (l_gripper_r_finger_joint): {
  Q: "d(180 1 0 0)", shape: ssCvx, size: [.01], color: [.93 .94 .95],
  core: [
    .001 .001 -.018, .001 .001 .018, .001 .036 .018, .001 .036 -.018,
    .043 .005 -.018, .043 .005 .018, .043 .035 .018, .043 .035 -.018,
    .085 .006 -.004, .085 .006 .004, .085 .026 .004, .085 .026 -.004
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger.stl>
}
l_gripper_r_finger_tip_joint_origin (l_gripper_r_finger_joint): { Q: [.09137 -.00495 0] }
l_gripper_l_parallel_link (l_gripper_l_parallel_root_joint): {
  mass: .17126, inertia: [7.7562e-5 1.49095e-6 -9.83385e-6 .000197083 -3.06125e-6 .000181054]
}
l_gripper_r_parallel_link (l_gripper_r_parallel_root_joint): {
  mass: .17389, inertia: [7.73841e-5 -2.09309e-6 -8.36228e-6 .000198474 2.4611e-6 .00018107]
}
r_gripper_l_finger_tip_joint (r_gripper_l_finger_tip_joint_origin): {
  joint: hingeZ, joint_scale: -1, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: r_gripper_l_finger_joint
}
r_gripper_r_finger_tip_joint (r_gripper_r_finger_tip_joint_origin): {
  joint: hingeZ, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: r_gripper_l_finger_joint
}
l_gripper_l_finger_tip_joint (l_gripper_l_finger_tip_joint_origin): {
  joint: hingeZ, joint_scale: -1, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: l_gripper_l_finger_joint
}
l_gripper_r_finger_tip_joint (l_gripper_r_finger_tip_joint_origin): {
  joint: hingeZ, limits: [0 .548], ctrl_limits: [.5 1000 -1], mimic: l_gripper_l_finger_joint
}
r_gripper_l_finger_tip_link (r_gripper_l_finger_tip_joint): {
  mass: .04419, inertia: [8.37047e-6 5.83632e-6 0 9.87067e-6 0 1.54177e-5]
}
r_gripper_l_finger_tip_link_0 (r_gripper_l_finger_tip_joint): {
  shape: ssCvx, size: [.005], color: [.93 .94 .95],
  core: [
    -.021 .016 -.004, -.021 .016 .004, -.021 .024 .004, -.021 .024 -.004,
    .003 -.011 -.006, .003 -.011 .006, .003 .022 .006, .003 .022 -.006,
    .026 -.011 -.006, .026 -.011 .006, .026 -.003 .006, .026 -.003 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger_tip.stl>
}
r_gripper_r_finger_tip_link (r_gripper_r_finger_tip_joint): {
  mass: .04419, inertia: [8.37047e-6 -5.83632e-6 0 9.87067e-6 0 1.54177e-5]
}
r_gripper_r_finger_tip_link_0 (r_gripper_r_finger_tip_joint): {
  Q: "d(180 1 0 0)", shape: ssCvx, size: [.005], color: [.93 .94 .95],
  core: [
    -.021 .016 -.004, -.021 .016 .004, -.021 .024 .004, -.021 .024 -.004,
    .003 -.011 -.006, .003 -.011 .006, .003 .022 .006, .003 .022 -.006,
    .026 -.011 -.006, .026 -.011 .006, .026 -.003 .006, .026 -.003 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger_tip.stl>
}
l_gripper_l_finger_tip_link (l_gripper_l_finger_tip_joint): {
  mass: .04419, inertia: [8.37047e-6 5.83632e-6 0 9.87067e-6 0 1.54177e-5]
}
l_gripper_l_finger_tip_link_0 (l_gripper_l_finger_tip_joint): {
  shape: ssCvx, size: [.005], color: [.93 .94 .95],
  core: [
    -.021 .016 -.004, -.021 .016 .004, -.021 .024 .004, -.021 .024 -.004,
    .003 -.011 -.006, .003 -.011 .006, .003 .022 .006, .003 .022 -.006,
    .026 -.011 -.006, .026 -.011 .006, .026 -.003 .006, .026 -.003 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger_tip.stl>
}
l_gripper_r_finger_tip_link (l_gripper_r_finger_tip_joint): {
  mass: .04419, inertia: [8.37047e-6 -5.83632e-6 0 9.87067e-6 0 1.54177e-5]
}
l_gripper_r_finger_tip_link_0 (l_gripper_r_finger_tip_joint): {
  Q: "d(180 1 0 0)", shape: ssCvx, size: [.005], color: [.93 .94 .95],
  core: [
    -.021 .016 -.004, -.021 .016 .004, -.021 .024 .004, -.021 .024 -.004,
    .003 -.011 -.006, .003 -.011 .006, .003 .022 .006, .003 .022 -.006,
    .026 -.011 -.006, .026 -.011 .006, .026 -.003 .006, .026 -.003 -.006
  ],
  visual_mesh: <package://example-robot-data/robots/pr2_description/meshes/gripper_v0/l_finger_tip.stl>
}
r_gripper_joint (r_gripper_r_finger_tip_link): { joint: transY, limits: [0 .09], ctrl_limits: [.2 1000 -1] }
l_gripper_joint (l_gripper_r_finger_tip_link): { joint: transY, limits: [0 .09], ctrl_limits: [.2 1000 -1] }
