#pragma once

/// Docstrings of bind_manipulation.cpp.
namespace kinegraph::python::docs::manipulation {

// Shared parts.
#define KINEGRAPH_LIMITS                                 \
  "    accumulated_collisions: Nothing overlaps.\n"      \
  "    joint_limits: Joints stay within their limits.\n" \
  "    quaternion_norms: Quaternions have norm one.\n"
#define KINEGRAPH_GRASP                                                                                  \
  "    time: In phases; axes are aligned from 0.2 before it on, and the palm does not collide from 0.3 " \
  "before it on.\n"                                                                                      \
  "    gripper: Name of the gripper frame.\n"
#define KINEGRAPH_PALM "    palm: Name of the frame that does not touch the object; empty or None: none.\n"
#define KINEGRAPH_HAND                         \
  "    time_interval: [from, to] in phases.\n" \
  "    gripper: Name of the gripper frame.\n"
#define KINEGRAPH_TIMES_RAISE                             \
  "Raises:\n"                                             \
  "    FrameNotFound: A name that is not in the scene.\n" \
  "    ArgumentError: Other times."

inline constexpr char setup_inverse_kinematics[] = R"(Sets up a problem of one configuration.

Args:
    C: The scene.
    homing_scale: Weight of the distance from home; 0: none.
)" KINEGRAPH_LIMITS R"(Raises:
    ArgumentError: The scene has no joints.)";

inline constexpr char setup_sequence[] = R"(Sets up one configuration for each of K waypoints.

Args:
    C: The scene.
    K: How many.
    homing_scale: Weight of the distance from home; 0: none.
    velocity_scale: Weight of the distance from one to the next.
)" KINEGRAPH_LIMITS R"(Raises:
    ArgumentError: K is not positive.)";

inline constexpr char setup_motion[] = R"(Sets up a smooth motion that ends at rest.

Args:
    C: The scene.
    K: How many phases.
    steps_per_phase: Slices in each.
    homing_scale: Weight of the distance from home; 0: none.
    acceleration_scale: Weight of accelerations.
)" KINEGRAPH_LIMITS R"(Raises:
    ArgumentError: K or steps_per_phase is not positive.)";

inline constexpr char setup_pick_and_place_waypoints[] =
    R"(Sets up two waypoints: at 1 the gripper takes the object, in a pose that the solver finds, and at 2 it still
holds it.

Args:
    C: The scene.
    gripper: Name of the gripper frame.
    obj: Name of the object. The frame '<obj>_grasp' is its pose in the gripper.
    homing_scale: Weight of the distance from home; 0: none.
    velocity_scale: Weight of the distance from one to the next.
)" KINEGRAPH_LIMITS R"(Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char setup_point_to_point_motion[] =
    R"(Sets up a motion of 50 slices to given joints, initialized by interpolation.

Args:
    C: The scene, at the start.
    q1: Joints at the end, shape (n,), rad or m.
    homing_scale: Weight of the distance from home; 0: none.
    acceleration_scale: Weight of accelerations.
)" KINEGRAPH_LIMITS R"(Raises:
    ArgumentError: q1 has another length.)";

inline constexpr char add_stable_frame[] =
    R"(Adds a frame whose pose relative to its parent is a variable shared by all slices.

Args:
    jointType: A JT, the dofs relative to the parent.
    parent: Name of the parent.
    name: Name of the new frame.
    initFrame: Name of the frame at whose pose it starts; None: the parent.
    markerSize: Ignored; the frames of a path are shown as markers.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The new name exists.)";

inline constexpr char add_place_frame[] =
    R"(Adds a frame on top of another one for an upright object. It slides and rotates within the edges; all slices
share it.

Args:
    parent: Name of the frame that the object stands on.
    obj: Name of the object.
    name: Name of the new frame.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The new name exists.)";

inline constexpr char snap_switch[] = R"(Attaches an object to a frame from a time on.

Args:
    time: In phases.
    parent: Name of the frame.
    obj: Name of the object.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char grasp_top_box[] = R"(Puts the gripper at the center of an object, with aligned axes.

Args:
    time: In phases; the axes are aligned from 0.2 before it on.
    gripper: Name of the gripper frame.
    obj: Name of the object.
    grasp_direction: One of xz, yz, xy, zy, yx, zx: the axes of the object along which the
        fingers close and the hand approaches.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another direction.)";

inline constexpr char grasp_box[] = R"(Closes the fingers along an axis of a box, inside of its sides.

Args:
)" KINEGRAPH_GRASP R"(    obj: Name of the box; for cylinders and capsules, the box around them counts.
)" KINEGRAPH_PALM R"(    grasp_direction: x, y or z, of the object.
    margin: Distance of the gripper from the sides, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another direction, or an object of another shape.)";

inline constexpr char grasp_cylinder[] = R"(Closes the fingers across a cylinder or capsule.

Args:
)" KINEGRAPH_GRASP R"(    obj: Name of the cylinder.
)" KINEGRAPH_PALM R"(    margin: Distance of the gripper from the ends, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: An object of another shape.)";

inline constexpr char place_box[] = R"(Places a box on a table.

Args:
    time: In phases.
    obj: Name of the box; for cylinders and capsules, the box around them counts.
    table: Name of the box that it stands on.
    palm: Name of the frame that does not touch the table; empty or None: none.
    place_direction: x, y, z, xNeg, yNeg or zNeg: the axis of the object that points up.
    margin: Distance of the center of the object from the edges of the table, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another direction, or a frame of another shape.)";

inline constexpr char straight_push[] = R"(Pushes an object along a line.

Args:
    time_interval: [from, to] in phases.
    obj: Name of the object.
    gripper: Name of the gripper frame.
    table: Name of the frame that it slides over.
    scale: Weight of the contact constraints.
    helper: Name of the frame whose y axis is the line; empty: a default name. It is added if it does not exist.
Returns:
    The name of that frame.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char pull[] =
    R"(Presses on an object from above and slides it upright over a table, to the added frame `_pull_end`.
snap_switch attaches the object to the gripper.

Args:
    times: [from, to] in phases.
    obj: Name of the object.
    gripper: Name of the gripper frame.
    table: Name of the frame that it slides over.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char retract[] =
    R"(Moves the hand away along its z axis, straight and without rotation, from its pose in the path at times[0].

Args:
)" KINEGRAPH_HAND R"(    dist: Minimum distance at the end, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char approach[] =
    R"(Moves the hand along its z axis, straight and without rotation, to its pose in the path at times[1]. Call it
after the path was initialized, as by setup_point_to_point_motion.

Args:
)" KINEGRAPH_HAND R"(    dist: Minimum distance at the beginning, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char retractPush[] = R"(Moves the hand back and up from a pushed object.

Args:
)" KINEGRAPH_HAND R"(    dist: Minimum distance back and up at the end, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char approachPush[] = R"(Moves the hand to an object before a push, from behind and above.

Args:
)" KINEGRAPH_HAND R"(    dist: Minimum distance behind and above at the beginning, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char no_collisions[] = R"(Keeps pairs of frames apart.

Args:
    time_interval: [], [at] or [from, to] in phases.
    objs: Pairs of names.
    margin: Minimum distance, m.
    scale: Weight.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: An odd number of names.)";

inline constexpr char freeze_joint[] = R"(Fixes joints.

Args:
    time_interval: [], [at] or [from, to] in phases.
    joints: Names of their frames.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char freeze_relativePose[] = R"(Fixes the pose of a frame relative to another one.

Args:
    time_interval: [], [at] or [from, to] in phases.
    obj: Name of the frame.
    relFrom: Name of the other.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char target_position[] = R"(Puts a frame at a position.

Args:
    time: In phases.
    obj: Name of the frame.
    pos: Shape (3,), m, in the world.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char target_relative_xy_position[] = R"(Puts a frame at coordinates x and y of another frame.

Args:
    time: In phases.
    obj: Name of the frame.
    relativeTo: Name of the other.
    pos: Shape (2,) or (3,), m; a third number is ignored.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another number of coordinates.)";

inline constexpr char target_x_orientation[] = R"(Points the x axis of a frame in a direction.

Args:
    time: In phases.
    obj: Name of the frame.
    x_vector: Shape (3,), in the world.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char bias[] = R"(Adds a cost for the distance from given joints.

Args:
    time: In phases.
    qBias: Shape (n,), rad or m.
    scale: Weight.
Raises:
    ArgumentError: Another number of joints.)";

#undef KINEGRAPH_LIMITS
#undef KINEGRAPH_GRASP
#undef KINEGRAPH_PALM
#undef KINEGRAPH_HAND
#undef KINEGRAPH_TIMES_RAISE

}  // namespace kinegraph::python::docs::manipulation
