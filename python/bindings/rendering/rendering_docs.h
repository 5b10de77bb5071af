#pragma once

/// Docstrings for bind_rendering.cpp.
namespace kinegraph::python::docs::rendering {

inline constexpr char make[] = R"(Creates cameras for a scene; images show its state at each call.

Args:
    config: The scene.
    offscreen: Not used; older scripts pass it.
    verbose: Not used; older scripts pass it.
Raises:
    TypeError: config is no Config.)";

inline constexpr char setCamera[] = R"(Attaches the camera to a frame.

The frame's attributes define the camera: `width`, `height` (pixels; 640, 480), `focalLength` (in image heights; 2.414)
or `heightAngle` (degrees), `orthoAbsHeight` (m, for an orthographic camera), `zRange` ([nearest, farthest] depth in m;
[.1, 10]).

Args:
    cameraFrameName: The frame: its name, id or Frame.
Returns:
    The camera, with these attributes.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: A camera attribute is invalid.)";

inline constexpr char computeImageAndDepth[] = R"(Renders the image and its depth, without a display.

Args:
    config: Another scene; None: the scene of the constructor.
    simulateDepthNoise: Adds the errors of a stereo camera (parameters DepthNoise/...).
    visualsOnly: Omits markers and transparent shapes. Otherwise both appear in the image, but transparent ones not in
        the depth.
Returns:
    The image, shape (height, width, 3), 0..255, and the depth along the camera's z axis, shape (height, width), m; -1
    for the background and outside zRange.
Raises:
    Error: Rendering needs EGL, which is missing.)";

inline constexpr char computeSegmentationID[] = R"(Renders the frame of each pixel.

Args:
    visualsOnly: Omits markers and transparent shapes.
Returns:
    Ids of frames, shape (height, width); -1 for the floor and the background.)";

inline constexpr char computeSegmentationImage[] = R"(Renders the frame of each pixel as colors.

Args:
    visualsOnly: Omits markers and transparent shapes.
Returns:
    Shape (height, width, 3), 0..255; white for the floor and the background.)";

inline constexpr char depthImage2PointCloud[] =
    R"(Converts a depth image to points, on the rays through the centers of the pixels.

The pixel in row v and column u has its center at (u + 0.5, v + 0.5). Points of pixels that the camera did not see
(depth < 0) are zeros; points[depth > 0] leaves them out.

Args:
    depth: Shape (height, width), m, along the camera's z axis.
    fxycxy: fx, fy, cx, cy in pixels, as from getFxycxy().
Returns:
    Shape (height, width, 3), in the camera's frame, m; zeros for negative depths.
Raises:
    ArgumentError: fxycxy does not have 4 entries.)";

}  // namespace kinegraph::python::docs::rendering
