#pragma once

/// The manual of what custom_feature.cpp binds.
namespace kinegraph::python::docs::own_features {

inline constexpr char getPositionJacobian[] =
    R"(The derivative of the world position of a point of the frame with respect to q.

Args:
    point: In the frame's coordinates, shape (3,), m.
Returns:
    Shape (3, n), m per rad or m.
Raises:
    ArgumentError: Not three numbers.)";

}  // namespace kinegraph::python::docs::own_features
