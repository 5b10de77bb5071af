#pragma once

/// The manual of what bind_shapes.cpp binds.
namespace kinegraph::python::docs::shapes {

inline constexpr char getMeshTriangles[] =
    R"(Triangles of the shape's surface, shape (m, 3), indices of vertices; of lines: their ends, shape (m, 2).)";

inline constexpr char getMeshColors[] =
    R"(Colors in 0..255, shape (n, 3) or (n, 4): one per vertex, or one row with the frame's color; (0, 3) if it has none.)";

inline constexpr char getMesh[] =
    R"(Points (n, 3), triangles (m, 3) and colors (n, 3) or (n, 4), as getMeshPoints, getMeshTriangles and getMeshColors
give them.)";

inline constexpr char setShape[] = R"(Gives the frame a shape. It collides with nothing until `setContact(1)` says so.

Args:
    type: Of ST.
    size: In m: box [x y z], ssBox [x y z radius], sphere [r], capsule and cylinder [length r], marker [length],
        quad [x y].
Returns:
    The frame itself.
Raises:
    ArgumentError: Another number of sizes, or a negative one.)";

inline constexpr char setShapeByName[] = R"(The same with the name of the type.

Args:
    type: Such as "box".
    size: As above.
Returns:
    The frame itself.
Raises:
    ArgumentError: There is no such type, or it has other sizes.)";

inline constexpr char setColor[] = R"(Sets the color of the frame's shape.

Args:
    color: Gray, gray and alpha, rgb, or rgba; in 0..1.
Returns:
    The frame itself.
Raises:
    ArgumentError: Not 1 to 4 numbers, or some of them not in 0..1.)";

inline constexpr char setContact[] = R"(Sets what the frame's shape collides with.

Args:
    contact: 0: with nothing; 1: with every other shape whose contact is not 0, except on its own link; -k: also not
        with links within k joints above.
Returns:
    The frame itself.)";

}  // namespace kinegraph::python::docs::shapes
