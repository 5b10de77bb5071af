#pragma once

/// Parts of the docstrings of all calls that draw traces of frames.
namespace kinegraph::python::docs::path_lines {

inline constexpr char frames[] =
    R"(    frames: A frame's name, or several; None: one frame on each link without children.
)";

inline constexpr char returnsPicture[] = R"(Returns:
    A Config, to be viewed or saved.
)";

inline constexpr char raises[] = R"(Raises:
    ArgumentError: The scene has another number of joints.
    FrameNotFound: A frame is not in the scene.)";

}  // namespace kinegraph::python::docs::path_lines
