#pragma once

/// Docstrings of the functions in bind_features.cpp.
namespace kinegraph::python::docs::features {

inline constexpr char evalOf[] = R"(Evaluates the feature at the present q of a scene.

Args:
    config: The scene.
Returns:
    y = scale * (feature - target), shape (d,), and J = dy/dq, shape (d, n).
Raises:
    FrameNotFound: The scene lacks a frame of the feature.)";

inline constexpr char setScale[] = R"(Sets the factor.

Args:
    scale: A number, one per component of the feature, or a matrix.
Returns:
    The feature itself.
Raises:
    ArgumentError: Raised by eval if the size is wrong.)";

inline constexpr char setTarget[] = R"(Sets the target, which is subtracted before scaling.

Args:
    target: A number, or one per component of the feature, in the feature's units.
Returns:
    The feature itself.
Raises:
    ArgumentError: Raised by eval if the size is wrong.)";

inline constexpr char setOrder[] = R"(Sets the order of the time derivative.

Args:
    order: 0 for the value, 1 for the velocity, 2 for the acceleration; -1 for the feature's own.
Returns:
    The feature itself.)";

inline constexpr char dim[] = R"(Returns the number of components of the feature.

Args:
    config: The scene.
Returns:
    The number d.
Raises:
    FrameNotFound: The scene lacks a frame of the feature.)";

inline constexpr char description[] = R"(Describes the feature.

Args:
    config: Ignored; accepted for older scripts.
Returns:
    Its name, and the names of its frames.)";

inline constexpr char eval[] = R"(Evaluates a feature and its Jacobian at the present q.

Args:
    featureSymbol: A symbol of FS, or a custom function. It is called with a FrameView per frame (without frames: with
        q) and returns y, or y and its Jacobian dy/dq (d, n). Without a Jacobian, central differences replace it.
    frames: Name of a frame, or a list of names.
    scale: Factor: a number, one per component of the feature, or a matrix.
    target: Subtracted before scaling: a number, or one per component, in the feature's units.
    order: Order of the time derivative; -1 for the feature's own.
Returns:
    y = scale * (feature - target), shape (d,), and J = dy/dq, shape (d, n).
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The frames do not fit the feature, or a scale or target has a wrong size.)";

inline constexpr char feature[] = R"(Makes a feature object with eval(config), setScale, setTarget and setOrder.

Args:
    featureSymbol: A symbol of FS, or a custom function as for eval.
    frames: Name of a frame, or a list of names.
    scale: Factor: a number, one per component of the feature, or a matrix.
    target: Subtracted before scaling: a number, or one per component, in the feature's units.
    order: Order of the time derivative; -1 for the feature's own.
Returns:
    The Feature.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The frames do not fit the feature, or a scale or target has a wrong size.)";

}  // namespace kinegraph::python::docs::features
