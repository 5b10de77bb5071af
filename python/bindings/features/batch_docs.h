#pragma once

/// The manual of what bind_batch.cpp binds.
namespace kinegraph::python::docs::batch {

inline constexpr char evalBatch[] =
    R"(A feature's value and Jacobian at each of N joint vectors. The scene's own q stays as it is.

Runs without the interpreter lock. The result does not depend on the number of threads.

Args:
    feature: A symbol of FS, or a function as for eval.
    frames: The name of a frame, or a list of names.
    Q: Joint vectors, shape (N, n), rad or m; one, shape (n,), gives an answer without the axis N.
    scale: A factor: a number, one per row of the feature, or a matrix.
    target: Subtracted before the scale: a number, or one per row of the feature.
    threads: How many share the work.
Returns:
    y, shape (N, d), and J = dy/dq, shape (N, d, n), in the feature's units.
Raises:
    ArgumentError: Q has another shape, or the feature cannot be made of these frames.
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char getFramePoses[] = R"(World poses of f frames at each of N joint vectors.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one, shape (n,), gives an answer without the axis N.
    frames: The name of a frame, or a list of f names.
    threads: How many share the work.
Returns:
    Shape (N, f, 7): x y z (m) qw qx qy qz with qw >= 0.
Raises:
    ArgumentError: Q has another shape.
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char getFrameJacobians[] = R"(Geometric Jacobians of f frames at each of N joint vectors.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one, shape (n,), gives an answer without the axis N.
    frames: The name of a frame, or a list of f names.
    threads: How many share the work.
Returns:
    Shape (N, f, 6, n): the velocity of the frame's origin (m/s), then its angular velocity (rad/s), both in world
    coordinates, per unit of each dof's velocity.
Raises:
    ArgumentError: Q has another shape.
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char getDistances[] =
    R"(Signed distances of the p collidable pairs, in the order of getCollidablePairs, at each of N joint vectors.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one, shape (n,), gives an answer without the axis N.
    threads: How many share the work.
Returns:
    Shape (N, p), m; negative: penetration depth.
Raises:
    ArgumentError: Q has another shape.)";

inline constexpr char getNearestPoints[] =
    R"(Signed distances, nearest points and normals of the p collidable pairs, in the order of getCollidablePairs.

Args:
    Q: Joint vectors, shape (N, n), rad or m; None: the present q, and no first extent N in what is returned.
    threads: How many share the work.
Returns:
    The distances (N, p), m, the nearest points on both surfaces (N, p, 2, 3), world coordinates, m, and the unit
    normals from the second to the first (N, p, 3): distance = normal . (point 0 - point 1).
Raises:
    ArgumentError: Q has another shape.)";

inline constexpr char isValid[] =
    R"(Which of N joint vectors are within their limits and free of collisions. A joint may be 1e-5 rad or m beyond a limit, as
files round. Pairs that no joint moves apart do not count: they say nothing about q.

Args:
    Q: Joint vectors, shape (N, n), rad or m; one, shape (n,), gives an answer without the axis N.
    margin: Distance that all pairs keep that joints move apart, m.
    threads: How many share the work.
Returns:
    Shape (N,), bool.
Raises:
    ArgumentError: Q has another shape, or the margin is not finite.)";

inline constexpr char isMotionFree[] = R"(checkMotion for N straight motions of q.

Args:
    start: Where they start, shape (N, n), rad or m; one, shape (n,), gives an answer without the axis N.
    end: Where they end, shape (N, n), rad or m.
    margin: Distance that all pairs keep that joints move apart, m.
    tolerance: Pairs that come within margin + tolerance (m) may count as contacts.
    threads: How many share the work.
Returns:
    Shape (N,), bool: True where the motion meets nothing and stays within the limits.
Raises:
    ArgumentError: start and end have other shapes.)";

}  // namespace kinegraph::python::docs::batch
