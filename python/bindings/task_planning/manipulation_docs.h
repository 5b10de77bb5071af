#pragma once

/// The manual of what bind_manipulation.cpp binds.
namespace kinegraph::python::docs::manipulation {

// What several of them say.
#define KINEGRAPH_LIMITS                                 \
  "    accumulated_collisions: Nothing overlaps.\n"      \
  "    joint_limits: Joints stay within their limits.\n" \
  "    quaternion_norms: Quaternions have norm one.\n"
#define KINEGRAPH_GRASP                                                                                      \
  "    time: In phases; the axes are aligned from 0.2 before it on, and the palm keeps off from 0.3 before " \
  "it on.\n"                                                                                                 \
  "    gripper: Name of the gripper frame.\n"
#define KINEGRAPH_PALM "    palm: Name of the frame that does not touch the object; empty: none.\n"
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
    R"(Sets up two waypoints: at 1 the gripper takes the object, in a pose that is found, and at 2 it still has it.

Args:
    C: The scene.
    gripper: Name of the frame that takes.
    obj: Name of the object. The frame '<obj>_grasp' is where it will be in the gripper.
    homing_scale: Weight of the distance from home; 0: none.
    velocity_scale: Weight of the distance from one to the next.
)" KINEGRAPH_LIMITS R"(Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char setup_point_to_point_motion[] =
    R"(Sets up a motion of 50 slices to given joints. It starts on the way there.

Args:
    C: The scene, at the start.
    q1: Joints at the end, shape (n,), rad or m.
    homing_scale: Weight of the distance from home; 0: none.
    acceleration_scale: Weight of accelerations.
)" KINEGRAPH_LIMITS R"(Raises:
    ArgumentError: q1 has another length.)";

inline constexpr char add_stable_frame[] =
    R"(Adds a frame whose pose relative to another one is found, the same at all times.

Args:
    jointType: Of JT: which motions relative to the parent are open.
    parent: Name of the frame above.
    name: Of the new frame.
    initFrame: Name of the frame where it starts; None: at the parent.
    markerSize: Does nothing; the frames of a path are shown as markers.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The new name exists.)";

inline constexpr char add_place_frame[] =
    R"(Adds a frame on top of another where an object would stand upright. It slides and turns there, within the edges, and is
the same at all times.

Args:
    parent: Name of what the object stands on.
    obj: Name of the object.
    name: Of the new frame.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The new name exists.)";

inline constexpr char snap_switch[] = R"(Puts an object at a frame from a time on.

Args:
    time: In phases.
    parent: Name of the frame.
    obj: Name of the object.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char grasp_top_box[] = R"(The gripper is at the center of an object, and their axes are aligned.

Args:
    time: In phases; the axes are aligned from 0.2 before it on.
    gripper: Name of the gripper frame.
    obj: Name of the object.
    grasp_direction: One of xz, yz, xy, zy, yx, zx: the object's axes that the fingers close along and the hand comes from.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another direction.)";

inline constexpr char grasp_box[] = R"(The fingers close along an axis of a box, and hold it inside of its sides.

Args:
)" KINEGRAPH_GRASP R"(    obj: Name of the box; for cylinders and capsules, the box around them counts.
)" KINEGRAPH_PALM R"(    grasp_direction: x, y or z, of the object.
    margin: How far inside of the sides the gripper is, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another direction, or an object of another shape.)";

inline constexpr char grasp_cylinder[] = R"(The fingers close across a cylinder or capsule.

Args:
)" KINEGRAPH_GRASP R"(    obj: Name of the cylinder.
)" KINEGRAPH_PALM R"(    margin: How far inside of the ends the gripper is, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: An object of another shape.)";

inline constexpr char place_box[] = R"(A box stands on a table.

Args:
    time: In phases.
    obj: Name of the box; for cylinders and capsules, the box around them counts.
    table: Name of the box that it stands on.
    palm: Name of the frame that does not touch the table; empty: none.
    place_direction: x, y, z, xNeg, yNeg or zNeg: the object's axis that is up.
    margin: How far inside of the table's edges the object's center is, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another direction, or a frame of another shape.)";

inline constexpr char straight_push[] = R"(The gripper pushes an object along a line.

Args:
    time_interval: [from, to] in phases.
    obj: Name of the object.
    gripper: Name of the gripper frame.
    table: Name of the frame that it slides over.
    scale: Weight of how the gripper touches.
    helper: Name of the frame that is added, whose y axis is the line; empty: one is made up.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char pull[] = R"(The gripper presses on an object from above and slides it over a table.

Args:
    times: [from, to] in phases.
    obj: Name of the object.
    gripper: Name of the gripper frame.
    table: Name of the frame that it slides over.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char retract[] =
    R"(The hand leaves along its z axis, straight and without turning, from where it is in the path at times[0].

Args:
)" KINEGRAPH_HAND R"(    dist: How far it is at the end at least, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char approach[] =
    R"(The hand comes along its z axis, straight and without turning, to where it is in the path at times[1]. To be called
after the path was initialized, as setup_point_to_point_motion does.

Args:
)" KINEGRAPH_HAND R"(    dist: How far it is at the beginning at least, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char retractPush[] = R"(The hand leaves what it pushed, back and up.

Args:
)" KINEGRAPH_HAND R"(    dist: How far back and up it is at the end at least, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char approachPush[] = R"(The hand comes to what it will push, from behind and above.

Args:
)" KINEGRAPH_HAND R"(    dist: How far behind and above it is at the beginning at least, m.
)" KINEGRAPH_TIMES_RAISE;

inline constexpr char no_collisions[] = R"(Frames keep apart, two by two.

Args:
    time_interval: [], [at] or [from, to] in phases.
    objs: Their names, two by two.
    margin: The least distance, m.
    scale: Weight.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: An odd number of names.)";

inline constexpr char freeze_joint[] = R"(Joints do not move.

Args:
    time_interval: [], [at] or [from, to] in phases.
    joints: Names of their frames.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char freeze_relativePose[] = R"(A frame does not move relative to another.

Args:
    time_interval: [], [at] or [from, to] in phases.
    obj: Name of the frame.
    relFrom: Name of the other.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char target_position[] = R"(A frame is at a place.

Args:
    time: In phases.
    obj: Name of the frame.
    pos: Shape (3,), m, in the world.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char target_relative_xy_position[] = R"(A frame has given coordinates x and y in another.

Args:
    time: In phases.
    obj: Name of the frame.
    relativeTo: Name of the other.
    pos: Shape (2,) or (3,), of which two count, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another number of coordinates.)";

inline constexpr char target_x_orientation[] = R"(The x axis of a frame points somewhere.

Args:
    time: In phases.
    obj: Name of the frame.
    x_vector: Shape (3,), in the world.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char bias[] = R"(The joints stay near given ones, at a cost.

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
