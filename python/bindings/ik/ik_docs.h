#pragma once

/// The manual of what bind_ik.cpp binds.
namespace kinegraph::python::docs::ik {

inline constexpr char solveIk[] =
    R"(Joint values within their limits that bring frames to their targets, without collisions.

The first attempt starts at the present q, the others at points spread within the limits. The scene stays as it is,
unless apply is True and there is an answer. The same arguments give the same answer, with any number of threads.

Args:
    config: The scene.
    targets: A dict from frames to where they are to be, in world coordinates (m): a position (3,), a pose (7,) =
        x y z qw qx qy qz or (4, 4), the name of a frame or a Frame that has the pose; or a dict of position, pose,
        quaternion, directions of the frame's axes x, y, z, and gaze: a point or frame that its z axis points at, or
        another axis (3,) of it. With relativeTo, a frame, a dict is in the coordinates of that frame, which may move as
        well; relativeTo alone means its pose. And from features to their values: (ry.FS.distance, "a", "b") to a number
        or one per row, or to a dict of target or atMost, tolerance and scale; "centerOfMass" or a tuple of that and of
        frames to a point. With rows (N, ...) there are N problems.
    options: IkOptions, or None for the defaults.
    threads: How many share the problems of a batch.
    verbose: 1 prints a line at the end, and a progress bar on the way if it takes long.
    apply: Sets the scene's q to the answer, if there is one.
    fields: Any field of IkOptions by name, such as best=True, collisions=False, margin=.02, attempts=20; tolerance
        sets position_tolerance (m) and rotation_tolerance (rad).
Returns:
    IkResult, or IkResults for N problems. No answer is an outcome: result.feasible is False, and result.message says
    what misses its target by how much, and which limits and pairs are in the way.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Targets of a wrong shape, or that no active joint moves; a target that is where a frame is which the
        targets move; an unknown option.)";

}  // namespace kinegraph::python::docs::ik
