#pragma once

/// Docstrings for bind_perception.cpp.
namespace kinegraph::python::docs::perception {

inline constexpr char makeView[] = R"(Creates a depth image with the camera that took it.

The camera looks along z, x to the right and y down. A pixel with depth d shows the point Z = d,
X = (column + .5 - cx) d / fx, Y = (row + .5 - cy) d / fy.

Args:
    depth: Depths along the camera's z axis, shape (height, width). Zero, negative and non-finite numbers are pixels
        without a measurement.
    fxycxy: fx, fy, cx, cy in pixels, shape (4,).
    camera: The camera: the name of its frame in the scene, or its pose in the world, shape (7,).
    unit: Meters per unit of `depth`; None: .001 for integers, 1 for floats.
    noise: Standard deviation of the depth of a pixel, divided by its squared depth, 1/m.
    bias: The same for an error that all pixels of an object share, 1/m.
Raises:
    ArgumentError: The depth has not two dimensions, fxycxy does not fit the image, depths look like millimeters, or a
        number is invalid.)";

inline constexpr char registerScene[] = R"(Moves frames to where depth images show them.

Each frame starts at its present pose. A robust fit minimizes the distances of measured points from the exact surfaces
that face the camera. A thing on a support has x, y and the rotation about z as variables, a frame with a hinge or slide
its dof, all others six directions. Measurements of the robot and other shapes of the scene are left out, and a point
belongs to one thing only. Frames that are not seen keep their poses. The shape of a frame includes the frames that are
fixed to it. Warnings of the result are also given as Python warnings.

Args:
    config: The scene. Frames that are seen are moved.
    views: A DepthView, or a list of them. The scene must have the joint angles at which they were taken.
    frames: The names of the frames to look for.
    support: The frame on whose top the things rest; None: they may be anywhere. Frames with a joint of their own and
        frames in a hand never rest.
    search_radius: How far a thing may have moved since its last pose, m.
Returns:
    A SeenScene with a SeenFrame for each frame.
Raises:
    FrameNotFound: A frame, a camera or the support is unknown.
    ArgumentError: There is no view, a view is invalid, a frame is listed twice or has no visible shape.)";

}  // namespace kinegraph::python::docs::perception
