#pragma once

/// Docstring of the function in bind_ik.cpp.
namespace kinegraph::python::docs::ik {

inline constexpr char solveIk[] =
    R"(Finds joint values within their limits that bring frames to their targets without collisions.

The first attempt starts at the present q or at `start`, the others at points spread within the limits. The scene does
not change, unless apply is True and there is a solution. The same arguments give the same answer, with any number of
threads.

Args:
    config: The scene.
    targets: A dict from frames to targets in world coordinates (m). A target is a position (3,), a pose (7,) =
        x y z qw qx qy qz or (4, 4), or the name of a frame or a Frame with the desired pose. Or it is a dict with
        position, pose, quaternion, directions of the frame's axes x, y, z, or gaze: a point or frame at which its z
        axis points, or another `axis` (3,) of it. relativeTo, a frame that may move, defines the coordinates of a
        dict; alone it means the pose of that frame. Keys may also be features: (ry.FS.distance, "a", "b") with a
        number or one per component, or with a dict of target or atMost, tolerance and scale; "centerOfMass", or a
        tuple of it and frames, with a point. Arrays (N, ...) define N problems.
    options: IkOptions, or None for the defaults.
    threads: Number of threads for the problems of a batch.
    verbose: 1 logs a line at the end, and shows a progress bar during long searches.
    apply: Sets the scene's q to the solution, if there is one; with `all`, to the first.
    all: Finds all solutions, the nearest to the present q first. Those that differ by whole turns count once. The pose
        of a frame that six hinges move has a closed form if the arm has a spherical wrist, or parallel axes as UR arms
        have. With seven hinges, one of them steps over its range in 32 steps. Other targets have the solutions found
        from `attempts` starting points. The general method checks each one.
    start: Configuration of the first attempt, shape (n,), or (N, n): one per problem. Joints that move no target keep
        the values of the scene. The options best and start_weight measure the distance from it. None: the present q.
    fields: Any field of IkOptions by name, such as best=True, collisions=False, margin=.02, attempts=20; tolerance
        sets position_tolerance (m) and rotation_tolerance (rad).
Returns:
    IkResult, or IkResults for N problems and with `all`: one per solution, or one that says why there is none. Without
    a solution result.feasible is False, and result.message names the missed targets with their errors, the active
    limits, and the colliding pairs. Pairs that no joint of a target separates and that overlap by
    max_start_penetration (5 mm) at most are a warning.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: A target has a wrong shape, no active joint moves it, it is the pose of a frame that the targets
        move, or an option is unknown.)";

}  // namespace kinegraph::python::docs::ik
