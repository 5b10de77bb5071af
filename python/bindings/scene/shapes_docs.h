#pragma once

/// Docstrings for bind_shapes.cpp.
namespace kinegraph::python::docs::shapes {

inline constexpr char getMeshTriangles[] =
    R"(Returns the triangles of the shape's surface, shape (m, 3), as vertex indices; for lines, their ends, shape (m,
2).)";

inline constexpr char getMeshColors[] =
    R"(Returns colors in 0..255, shape (n, 3) or (n, 4): one per vertex, or only the frame's color; (0, 3) without
color.)";

inline constexpr char getMesh[] =
    R"(Returns points (n, 3), triangles (m, 3) and colors (n, 3) or (n, 4); see getMeshPoints, getMeshTriangles and
getMeshColors.)";

inline constexpr char setShape[] = R"(Gives the frame a shape. It collides with nothing until `setContact(1)`.

Args:
    type: An ST.
    size: In m: box [x y z], ssBox [x y z radius], sphere [r], capsule and cylinder [length r], marker [length],
        quad [x y], plane [x y]: endless, and solid below; x y are the widths that are drawn.
Returns:
    The frame itself.
Raises:
    ArgumentError: The number of sizes is wrong, or a size is negative.)";

inline constexpr char setShapeByName[] = R"(Gives the frame a shape, by the name of the type.

Args:
    type: Name such as "box".
    size: As for the ST of that name.
Returns:
    The frame itself.
Raises:
    ArgumentError: The type does not exist, or it has other sizes.)";

inline constexpr char setColor[] = R"(Sets the color of the frame's shape.

Args:
    color: Gray, gray and alpha, rgb, or rgba; in 0..1.
Returns:
    The frame itself.
Raises:
    ArgumentError: color has not 1 to 4 numbers, or a number outside of 0..1.)";

inline constexpr char setContact[] = R"(Sets the contact flag of the frame's shape.

Args:
    contact: 0: collides with nothing; 1: with every other shape with a nonzero flag, except on its own link; -k: also
        not with links within k joints above.
Returns:
    The frame itself.)";

}  // namespace kinegraph::python::docs::shapes
