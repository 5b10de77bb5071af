#pragma once

/// Docstrings of the functions in bind_batch.cpp.
namespace kinegraph::python::docs::batch {

inline constexpr char evalBatch[] =
    R"(Evaluates a feature and its Jacobian at N joint vectors. The scene's own q does not change.

Runs without the interpreter lock. The result does not depend on the number of threads.

Args:
    feature: A symbol of FS, or a custom function as for eval.
    frames: Name of a frame, or a list of names.
    Q: Joint vectors, shape (N, n), rad or m; one vector, shape (n,), gives a result without the axis N.
    scale: Factor: a number, one per component of the feature, or a matrix.
    target: Subtracted before scaling: a number, or one per component.
    threads: Number of threads.
Returns:
    y, shape (N, d), and J = dy/dq, shape (N, d, n), in the feature's units.
Raises:
    ArgumentError: Q has another shape, or the frames do not fit the feature.
    FrameNotFound: A frame is not in the scene.)";

inline constexpr char getFramePoses[] = R"(Returns world poses of f frames at N joint vectors.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one vector, shape (n,), gives a result without the axis N.
    frames: Name of a frame, or a list of f names.
    threads: Number of threads.
Returns:
    Shape (N, f, 7): x y z (m) qw qx qy qz with qw >= 0.
Raises:
    ArgumentError: Q has another shape.
    FrameNotFound: A frame is not in the scene.)";

inline constexpr char getFrameJacobians[] = R"(Returns geometric Jacobians of f frames at N joint vectors.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one vector, shape (n,), gives a result without the axis N.
    frames: Name of a frame, or a list of f names.
    threads: Number of threads.
Returns:
    Shape (N, f, 6, n): the velocity of the frame's origin (m/s), then its angular velocity (rad/s), both in world
    coordinates, per unit of each dof's velocity.
Raises:
    ArgumentError: Q has another shape.
    FrameNotFound: A frame is not in the scene.)";

inline constexpr char getDistances[] =
    R"(Returns signed distances of the p collidable pairs, in the order of getCollidablePairs, at N joint vectors.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one vector, shape (n,), gives a result without the axis N.
    threads: Number of threads.
Returns:
    Shape (N, p), m; negative: penetration depth.
Raises:
    ArgumentError: Q has another shape.)";

inline constexpr char getNearestPoints[] =
    R"(Returns distances, nearest points and normals of the p collidable pairs, in the order of getCollidablePairs.

Args:
    Q: Joint vectors, shape (N, n), rad or m; None for the present q, with results without the axis N.
    threads: Number of threads.
Returns:
    The signed distances (N, p), m, the nearest points on both surfaces (N, p, 2, 3), world coordinates, m, and the
    unit normals from the second to the first (N, p, 3): distance = normal . (point 0 - point 1).
Raises:
    ArgumentError: Q has another shape.)";

inline constexpr char isValid[] =
    R"(Returns which of N joint vectors are within their limits and collision-free.

Joints may exceed a limit by 1e-5 rad or m, because files round. Pairs that no joint separates do not count.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one vector, shape (n,), gives a result without the axis N.
    margin: Minimum distance of all pairs that joints move relative to each other, m.
    threads: Number of threads.
Returns:
    Shape (N,), bool.
Raises:
    ArgumentError: Q has another shape, or the margin is not finite.)";

inline constexpr char isMotionFree[] =
    R"(Checks N linear motions of q continuously for collisions, as checkMotion does for one.

Args:
    start: Starts, shape (N, n), rad or m; one vector, shape (n,), gives a result without the axis N.
    end: Ends, shape (N, n), rad or m.
    margin: Minimum distance of all pairs that joints move relative to each other, m.
    tolerance: Pairs that come within margin + tolerance (m) may count as contacts.
    threads: Number of threads.
Returns:
    Shape (N,), bool: True for motions that are collision-free and within the limits.
Raises:
    ArgumentError: start and end have other shapes.)";

}  // namespace kinegraph::python::docs::batch
