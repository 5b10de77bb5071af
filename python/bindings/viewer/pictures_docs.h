#pragma once

/// Docstrings for bind_pictures.cpp.
namespace kinegraph::python::docs::pictures {

inline constexpr char getRgb[] = R"(Renders the scene with drawings and the message, without a browser.

Args:
    nonThreaded: Not used; older scripts pass it.
Returns:
    Shape (height, width, 3), 0..255.
Raises:
    ArgumentError: The viewer has no scene yet.)";

inline constexpr char fit[] =
    R"(Moves the camera along its line of sight such that the visible scene fills the image.

Returns:
    The center of the visible scene, shape (3,), m; zeros for an empty scene.
Raises:
    ArgumentError: The viewer has no scene yet.)";

inline constexpr char getDepth[] = R"(Renders the depth of the scene, without drawings, along the camera's z axis.

Args:
    nonThreaded: Not used; older scripts pass it.
Returns:
    Shape (height, width), m; -1 for the background.
Raises:
    ArgumentError: The viewer has no scene yet.)";

inline constexpr char savePng[] = R"(Saves a picture, and creates missing folders.

Args:
    saveVideoPath: The file, if it ends in .png; else the prefix of a six-digit number and .png.
    count: The number; -1: counts up from 0.
Returns:
    The file's name.
Raises:
    ArgumentError: The viewer has no scene yet, or the file ends in .jpg or another format of pictures or films.
    OSError: The file cannot be written.)";

inline constexpr char setCamera[] = R"(Attaches the camera to a frame, like CameraView.setCamera.

Args:
    camFrame: The Frame, or its name; None: the initial camera of viewers.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: A name is passed before the viewer has a scene.)";

inline constexpr char setCameraAt[] = R"(Places the camera at one point, directed to another.

Args:
    position: Position of the camera, shape (3,), m.
    target: Point in the center of the picture, shape (3,), m.
Raises:
    ArgumentError: Not three entries each.)";

inline constexpr char setCameraPose[] = R"(Sets the camera's pose.

Args:
    pose_7d: Its pose, shape (7,): x y z (m) qw qx qy qz; x to the right of the image, y down, z forward.
Raises:
    ArgumentError: Not a pose.)";

inline constexpr char focus[] = R"(Turns the camera to a point, and moves it such that a height fits into the window.

Args:
    position_3d: The point, shape (3,), m.
    heightAbs: The height at the point, m.
Raises:
    ArgumentError: Not three entries, a height that is not positive, or a camera at the point.)";

inline constexpr char setWindow[] = R"(Sets the title of the page and the size of pictures.

Args:
    title: The title.
    width: Width of pictures, pixels.
    height: Height of pictures, pixels.
Raises:
    ArgumentError: A size that is not positive.)";

inline constexpr char visualsOnly[] = R"(Hides markers, transparent shapes and texts, on the page and in pictures.

Args:
    _visualsOnly: False shows them again.)";

}  // namespace kinegraph::python::docs::pictures
