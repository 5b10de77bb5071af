#pragma once

/// Docstrings for bind_frame.cpp.
namespace kinegraph::python::docs::frame {

inline constexpr char setParent[] =
    R"(Attaches the frame below another one. By default keeps the pose in the parent, so the frame moves in the world.

Args:
    parent: The new parent.
    keepAbsolutePose_and_adaptRelativePose: Keeps the world pose instead.
    checkForLoop: Not used: loops are always rejected.
Returns:
    The frame itself.
Raises:
    Error: The parent is the frame itself, below it, or in another scene.)";

inline constexpr char makeRoot[] =
    R"(Makes the frame the root of its tree by reversing the path above it. World poses stay.

Joints on the path move to the frame below them, with changed sign of q and limits.

Args:
    untilPartBreak: Stops at the first rigid or free joint, which is cut.
Returns:
    The frame itself.
Raises:
    ArgumentError: A joint on the path has no inverse joint type (universal, ...).)";

inline constexpr char setAttributes[] = R"(Sets attributes, with the effect that they have in a .g file.

contact, contact_exclude, mass, color, q and limits change the frame. Words that the library reads when they are needed
(friction, logical, ctrl_limits, simulate, ...) and unknown words are stored, with a KinegraphWarning if an unknown word
is a near miss of a known one.

Args:
    attributes: Dict from names to bool, numbers, text, lists or dicts.
Returns:
    The frame itself.
Raises:
    ArgumentError: A value has another type, or a word has a meaning in files only (joint, shape, pose, ...); the
    message
        names the method to call instead.)";

inline constexpr char setAttribute[] = R"(Sets one attribute; see setAttributes.

Args:
    key: Name of the attribute.
    value: bool, number, text, list or dict.
Returns:
    The frame itself.
Raises:
    ArgumentError: The value has another type.)";

}  // namespace kinegraph::python::docs::frame
