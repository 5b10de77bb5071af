#pragma once

/// The manual of what bind_pictures.cpp binds.
namespace kinegraph::python::docs::pictures {

inline constexpr char getRgb[] = R"(A picture of the scene, with the message, drawn without a browser.

Args:
    nonThreaded: Not used; older scripts pass it.
Returns:
    Shape (height, width, 3), 0..255.
Raises:
    ArgumentError: The viewer shows nothing yet.)";

inline constexpr char fit[] =
    R"(Moves the camera along its line of sight to where all that pictures show fills the image.

Returns:
    The middle of what is shown, shape (3,), m; zeros if there is nothing to see.
Raises:
    ArgumentError: The viewer shows nothing yet.)";

inline constexpr char getDepth[] = R"(The depth of the picture, along the camera's z axis.

Args:
    nonThreaded: Not used; older scripts pass it.
Returns:
    Shape (height, width), m; -1 where nothing is.
Raises:
    ArgumentError: The viewer shows nothing yet.)";

inline constexpr char savePng[] = R"(Saves a picture. Folders are made.

Args:
    saveVideoPath: The file, if it ends in .png; else what stands before a number of six digits and .png.
    count: The number; -1: it counts up from 0.
Returns:
    The file's name.
Raises:
    ArgumentError: The viewer shows nothing yet.
    OSError: The file cannot be written.)";

inline constexpr char setCamera[] = R"(Looks from a camera frame and follows it, as CameraView.setCamera does.

Args:
    camFrame: The Frame, or its name; None: looks from where viewers start.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: A name is given before the viewer shows anything.)";

inline constexpr char setCameraAt[] = R"(Looks from one point at another.

Args:
    position: Where to look from, shape (3,), m.
    target: Where to look at, shape (3,), m.
Raises:
    ArgumentError: Not three numbers each.)";

inline constexpr char setCameraPose[] = R"(Moves the camera.

Args:
    pose_7d: Its pose, shape (7,): x y z (m) qw qx qy qz; x to the right of the image, y down, z forward.
Raises:
    ArgumentError: Not a pose.)";

inline constexpr char focus[] = R"(Turns the camera to a point, and moves it to where a height fits into the window.

Args:
    position_3d: The point, shape (3,), m.
    heightAbs: The height at the point, m.
Raises:
    ArgumentError: Not three numbers, a height that is not positive, or a camera that is at the point.)";

inline constexpr char setWindow[] = R"(Sets the title of the page and the size of pictures.

Args:
    title: The title.
    width: Of pictures, pixels.
    height: Of pictures, pixels.
Raises:
    ArgumentError: A size that is not positive.)";

inline constexpr char visualsOnly[] = R"(Hides markers, transparent shapes and texts, on the page and in pictures.

Args:
    _visualsOnly: False shows them again.)";

}  // namespace kinegraph::python::docs::pictures
