#pragma once

/// The manual of what bind_rendering.cpp binds.
namespace kinegraph::python::docs::rendering {

inline constexpr char make[] = R"(Sees the scene as it is whenever an image is computed.

Args:
    config: The scene.
    offscreen: Not used; older scripts pass it.
    verbose: Not used; older scripts pass it.
Raises:
    TypeError: config is no Config.)";

inline constexpr char setCamera[] = R"(Looks from a frame and follows it.

The frame's attributes say what the camera is like: `width`, `height` (pixels; 640, 480), `focalLength` (in image
heights; 2.414) or `heightAngle` (degrees), `orthoAbsHeight` (m, for an orthographic camera), `zRange` ([nearest,
farthest] depth in m; [.1, 10]).

Args:
    cameraFrameName: The frame: its name, id or Frame.
Returns:
    The camera, with these attributes.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: An attribute that no camera can have.)";

inline constexpr char computeImageAndDepth[] = R"(The image and its depth, drawn without a display.

Args:
    config: Another scene to look at; None: the one that the view was made for.
    simulateDepthNoise: Adds the errors of a stereo camera (parameters DepthNoise/...).
    visualsOnly: Leaves out markers and transparent shapes. Without it both show in the image, but transparent ones
        not in the depth.
Returns:
    The image, shape (height, width, 3), 0..255, and the depth along the camera's z axis, shape (height, width), m; -1
    where nothing is within zRange.
Raises:
    Error: Drawing needs EGL, which is not there.)";

inline constexpr char computeSegmentationID[] = R"(Which frame each pixel shows.

Args:
    visualsOnly: Leaves out markers and transparent shapes.
Returns:
    Ids of frames, shape (height, width); -1 for the floor and where nothing is.)";

inline constexpr char computeSegmentationImage[] = R"(Which frame each pixel shows, as colors.

Args:
    visualsOnly: Leaves out markers and transparent shapes.
Returns:
    Shape (height, width, 3), 0..255; white for the floor and where nothing is.)";

inline constexpr char depthImage2PointCloud[] = R"(The points that a depth image shows.

Args:
    depth: Shape (height, width), m, along the camera's z axis.
    fxycxy: fx, fy, cx, cy in pixels, as getFxycxy() gives them.
Returns:
    Shape (height, width, 3), in the camera's frame, m; zeros where the depth is negative.
Raises:
    ArgumentError: fxycxy are not four numbers.)";

}  // namespace kinegraph::python::docs::rendering
