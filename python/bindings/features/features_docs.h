#pragma once

/// The manual of what bind_features.cpp binds.
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
    scale: A number, one per row of the feature, or a matrix.
Returns:
    The feature itself.
Raises:
    ArgumentError: By eval, where the size does not fit.)";

inline constexpr char setTarget[] = R"(Sets what is subtracted before the scale.

Args:
    target: A number, or one per row of the feature, in the feature's units.
Returns:
    The feature itself.
Raises:
    ArgumentError: By eval, where the size does not fit.)";

inline constexpr char setOrder[] = R"(Sets the order of the time derivative.

Args:
    order: 0 for the value, 1 for the velocity, 2 for the acceleration; -1: what is usual for the feature.
Returns:
    The feature itself.)";

inline constexpr char dim[] = R"(The number of rows of the feature.

Args:
    config: The scene.
Returns:
    The number d.
Raises:
    FrameNotFound: The scene lacks a frame of the feature.)";

inline constexpr char description[] = R"(The feature in words.

Args:
    config: Not used; older scripts pass it.
Returns:
    Its name, and those of its frames.)";

inline constexpr char eval[] = R"(A feature's value and Jacobian at the present q.

Args:
    featureSymbol: A symbol of FS, or a function of your own. It is called with a FrameView per frame (without frames
        with q) and returns y, or y and its Jacobian dy/dq (d, n); where that is left out, central differences
        replace it.
    frames: The name of a frame, or a list of names.
    scale: A factor: a number, one per row of the feature, or a matrix.
    target: Subtracted before the scale: a number, or one per row of the feature, in the feature's units.
    order: Of the time derivative; -1: what is usual for the feature.
Returns:
    y = scale * (feature - target), shape (d,), and J = dy/dq, shape (d, n).
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The feature cannot be made of these frames, or a scale or target of a wrong size.)";

inline constexpr char feature[] = R"(A feature object with eval(config), setScale, setTarget and setOrder.

Args:
    featureSymbol: A symbol of FS, or a function as for eval.
    frames: The name of a frame, or a list of names.
    scale: A factor: a number, one per row of the feature, or a matrix.
    target: Subtracted before the scale: a number, or one per row of the feature, in the feature's units.
    order: Of the time derivative; -1: what is usual for the feature.
Returns:
    The Feature.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The feature cannot be made of these frames, or a scale or target of a wrong size.)";

}  // namespace kinegraph::python::docs::features
