#pragma once

/// Docstrings of the functions in custom_feature.cpp.
namespace kinegraph::python::docs::custom_features {

inline constexpr char getPositionJacobian[] =
    R"(Returns the derivative of the world position of a point of the frame with respect to q.

Args:
    point: In the frame's coordinates, shape (3,), m.
Returns:
    Shape (3, n), m per rad or m.
Raises:
    ArgumentError: The point does not have three numbers.)";

}  // namespace kinegraph::python::docs::custom_features
