#pragma once

/// The manual of what bind_frame.cpp binds.
namespace kinegraph::python::docs::frame {

inline constexpr char setParent[] =
    R"(Attaches the frame below another one. By default the pose in the parent stays, so that the frame moves in the world.

Args:
    parent: The frame that is above from now on.
    keepAbsolutePose_and_adaptRelativePose: The pose in the world stays instead.
    checkForLoop: Not used: loops are always refused.
Returns:
    The frame itself.
Raises:
    Error: The parent is the frame itself, below it, or in another scene.)";

inline constexpr char makeRoot[] =
    R"(Turns the path above the frame around, so that it becomes the root of its tree. Nothing moves.

Joints on the path move to the frame that is below them then, with the sign of q (and the limits) changed.

Args:
    untilPartBreak: Only up to the first rigid or free joint, which is cut.
Returns:
    The frame itself.
Raises:
    ArgumentError: A joint on the path that no joint type inverts (universal, ...).)";

inline constexpr char setAttributes[] = R"(Adds attributes that the library keeps but does not interpret.

Args:
    attributes: A dict from names to bool, numbers, text, lists or dicts.
Returns:
    The frame itself.
Raises:
    ArgumentError: A value of another kind.)";

inline constexpr char setAttribute[] = R"(Adds one attribute, as setAttributes does.

Args:
    key: Its name.
    value: bool, number, text, list or dict.
Returns:
    The frame itself.
Raises:
    ArgumentError: A value of another kind.)";

}  // namespace kinegraph::python::docs::frame
