#pragma once

/// Docstrings for bind_frame_poses.cpp.
namespace kinegraph::python::docs::frame_poses {

inline constexpr char getPose[] = R"(Returns the pose in the world, or in another frame.

Args:
    relativeTo: The other frame; None: the world.
Returns:
    x y z (m) qw qx qy qz, shape (7,).
Raises:
    FrameDeleted: The other frame has been deleted.)";

inline constexpr char getPosition[] = R"(Returns the position in the world, or in another frame.

Args:
    relativeTo: The other frame; None: the world.
Returns:
    x y z in m, shape (3,).
Raises:
    FrameDeleted: The other frame has been deleted.)";

inline constexpr char getQuaternion[] = R"(Returns the rotation in the world, or in another frame.

Args:
    relativeTo: The other frame; None: the world.
Returns:
    w x y z, shape (4,).
Raises:
    FrameDeleted: The other frame has been deleted.)";

inline constexpr char getTransform[] = R"(Returns the pose in the world, or in another frame, as a homogeneous matrix.

Args:
    relativeTo: The other frame; None: the world.
Returns:
    Shape (4, 4), lengths in m.
Raises:
    FrameDeleted: The other frame has been deleted.)";

inline constexpr char setPose[] = R"(Sets the pose in the world.

Args:
    pose: 7 numbers x y z (m) qw qx qy qz; 3 numbers, a position; or 4 numbers, a quaternion.
Returns:
    The frame itself.
Raises:
    ArgumentError: pose has another size, non-finite numbers, or a quaternion of length 0.)";

inline constexpr char setPoseFromText[] = R"doc(Sets the pose in the world from text.

Args:
    pose: Consecutive motions, such as "t(0 0 1) d(90 0 0 1)": t in m; d in degrees and r in rad, about an axis.
Returns:
    The frame itself.
Raises:
    ParseError: The text is not a pose.)doc";

inline constexpr char setPoseByText[] = R"doc(Sets the pose in the world from text.

Args:
    pose: Consecutive motions, such as "t(0 0 1) d(90 0 0 1)": t in m; d in degrees and r in rad, about an axis.
Returns:
    The frame itself.
Raises:
    ParseError: The text is not a pose.)doc";

inline constexpr char setPosition[] = R"(Sets the position in the world.

Args:
    position: x y z in m, shape (3,).
Returns:
    The frame itself.
Raises:
    ArgumentError: position is not three finite numbers.)";

inline constexpr char setQuaternion[] = R"(Sets the rotation in the world.

Args:
    quaternion: w x y z, shape (4,); normalized by this call.
Returns:
    The frame itself.
Raises:
    ArgumentError: quaternion is not four finite numbers, or all of them are 0.)";

inline constexpr char setRotationMatrix[] = R"(Sets the rotation in the world.

Args:
    matrix: Shape (3, 3); its columns are the frame's axes.
Returns:
    The frame itself.
Raises:
    ArgumentError: The matrix is not a rotation.)";

inline constexpr char setRelativePose[] = R"(Sets the pose in the parent.

Args:
    pose: 7 numbers x y z (m) qw qx qy qz; 3 numbers, a position; or 4 numbers, a quaternion.
Returns:
    The frame itself.
Raises:
    ArgumentError: pose has another size, non-finite numbers, or a quaternion of length 0.)";

inline constexpr char setRelativePoseFromText[] = R"doc(Sets the pose in the parent from text.

Args:
    pose: Consecutive motions, such as "t(0 0 1) d(90 0 0 1)": t in m; d in degrees and r in rad, about an axis.
Returns:
    The frame itself.
Raises:
    ParseError: The text is not a pose.)doc";

inline constexpr char setRelativePoseByText[] = R"doc(Sets the pose in the parent from text.

Args:
    pose: Consecutive motions, such as "t(0 0 1) d(90 0 0 1)": t in m; d in degrees and r in rad, about an axis.
Returns:
    The frame itself.
Raises:
    ParseError: The text is not a pose.)doc";

inline constexpr char setRelativePosition[] = R"(Sets the position in the parent.

Args:
    position: x y z in m, shape (3,).
Returns:
    The frame itself.
Raises:
    ArgumentError: position is not three finite numbers.)";

inline constexpr char setRelativeQuaternion[] = R"(Sets the rotation in the parent.

Args:
    quaternion: w x y z, shape (4,); normalized by this call.
Returns:
    The frame itself.
Raises:
    ArgumentError: quaternion is not four finite numbers, or all of them are 0.)";

inline constexpr char setRelativeRotationMatrix[] = R"(Sets the rotation in the parent.

Args:
    matrix: Shape (3, 3); its columns are the frame's axes.
Returns:
    The frame itself.
Raises:
    ArgumentError: The matrix is not a rotation.)";

inline constexpr char get_Jacobian_pos[] =
    R"(Computes the Jacobian of a point fixed in the frame with respect to q, in world coordinates.

Args:
    world_pos_optional: Current position of the point in the world, shape (3,), m; None: the frame's origin.
Returns:
    Shape (3, n), m per rad or m.
Raises:
    ArgumentError: world_pos_optional is not three finite numbers.)";

inline constexpr char get_Jacobian_angular[] =
    R"(Returns the angular velocity of the frame per velocity of q, in world coordinates, shape (3, n), rad per rad or
m.)";

inline constexpr char trans_rel2world[] = R"(Transforms a point of the frame to world coordinates.

Args:
    point: In the frame's coordinates, shape (3,), m.
Returns:
    The point in world coordinates, shape (3,), m.
Raises:
    ArgumentError: point is not three finite numbers.)";

}  // namespace kinegraph::python::docs::frame_poses
